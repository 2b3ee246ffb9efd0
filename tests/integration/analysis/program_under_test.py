"""`suffuse-analyse` in a folder, for the tests that look at it as a program."""
import os
import subprocess
import sys


def check(condition, message):
    if not condition:
        sys.exit("FAILED: " + message)


def python_with_figures():
    """As the program itself looks for one; None if there is none."""
    for python in ("python3", "/usr/bin/python3"):
        try:
            if subprocess.run([python, "-c", "import matplotlib"], capture_output=True).returncode == 0:
                return python
        except OSError:
            pass
    return None


class Program:
    """Runs in a folder, with a folder for temporary files that must be empty afterwards; `first` words stand before those of
    each call."""

    def __init__(self, path, folder, *first):
        self.path, self.folder, self.first = path, folder, first
        self.temporary = folder / "temporary"
        self.temporary.mkdir()

    def run(self, *words):
        environment = {**os.environ, "TMPDIR": str(self.temporary)}
        done = subprocess.run([self.path, *self.first, *map(str, words)], cwd=self.folder, capture_output=True, timeout=120, env=environment)
        check(not list(self.temporary.iterdir()), f"{words}: temporary files are left")
        return done.returncode, done.stdout.decode(), done.stderr.decode()

    def must_run(self, *words):
        code, out, err = self.run(*words)
        check(code == 0, f"{words} ended with {code}: {err}")
        return out

    def must_refuse(self, words, *told):
        """One line and exit code 1, with nothing left behind; returns what was printed before."""
        before = set(self.folder.rglob("*"))
        code, out, err = self.run(*words)
        lines = err.strip().splitlines()
        check(code == 1 and len(lines) == 1, f"{words}: exit code {code}, {len(lines)} lines:\n{err}")
        check(lines[0].startswith("suffuse-analyse: error: "), lines[0])
        check(all(text in err for text in told), f"{words}: does not tell {told}: {err}")
        left = set(self.folder.rglob("*")) - before
        check(not left, f"{words}: leaves {left}")
        return out
