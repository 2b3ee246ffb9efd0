#!/usr/bin/env python3
"""hard_cases.py --suffuse PROGRAM --mpirun SCRIPT [--case NAME ...] [--full] [--report FILE]

Scenes that have broken codes like this one: a folder each with a case.py, whose docstring tells the physics, what used to go wrong
and the criterion, and whose `run(bench, preset, full)` asserts it and returns what was reached. Without --case all of them; --full
takes the long versions; --report writes the table of docs/hard_cases.md.
"""
import argparse
import importlib.util
import pathlib
import re
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "support"), str(HERE)]
from scenes import Program, columns, variable_words  # noqa: E402


class Failed(Exception):
    pass


class Bench:
    """Where one variant of a case runs: a folder of its own, and the program on as many ranks as the case wants."""

    def __init__(self, options, folder):
        self.options, self.folder, self.guards = options, pathlib.Path(folder), []

    def expect(self, condition, message):
        if not condition:
            raise Failed(message)

    def watch(self, run, ranks):
        """What `run` returns of the program on so many ranks, its guards' words kept."""
        for written in ("flow.csv", "grains.dump"):  # by the scene before
            (self.folder / written).unlink(missing_ok=True)
        code, screen = run(Program(self.options.suffuse, self.options.mpirun, ranks))
        self.guards += [line[line.index(":") + 1:].strip() for line in screen.splitlines() if re.match(r"(suffuse: error|lbm run): .*(must|note|warning)", line)]
        return code, screen

    def run(self, text, ranks=1, name="scene", timeout=600):
        return self.watch(lambda program: program.run(text, self.folder, name, timeout), ranks)

    def must_run(self, text, ranks=1, name="scene", timeout=600):
        return self.must_end(*self.run(text, ranks, name, timeout))

    def must_run_scene(self, script, variables, timeout=600):
        """A script file with `-var` options, on one rank."""
        words = variable_words(variables)
        return self.must_end(*self.watch(lambda program: program.run_file(script, self.folder, words, "log.scene", timeout), 1))

    def must_end(self, code, screen):
        self.expect(code == 0, f"ended with code {code}:\n{screen[-2500:]}")
        return screen

    def with_h5py(self, text):
        """Numbers that a Python with h5py (Debian's) prints in the folder."""
        done = subprocess.run(["/usr/bin/python3", "-c", text], cwd=self.folder, capture_output=True, text=True)
        self.expect(done.returncode == 0, done.stderr)
        return list(map(float, done.stdout.split()))

    def series(self, name="flow.csv"):
        return columns(self.folder / name)


def load(name):
    spec = importlib.util.spec_from_file_location(f"case_{name}", HERE / name / "case.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def case_names():
    return sorted(path.parent.name for path in HERE.glob("*/case.py"))


def run_case(options, name):
    """Lines of (preset, what was reached, what the guards said, seconds); raises Failed."""
    module, lines = load(name), []
    for preset in getattr(module, "PRESETS", ("default",)):
        with tempfile.TemporaryDirectory(prefix="suffuse-hard-") as folder:
            bench, began = Bench(options, folder), time.time()
            try:
                reached = module.run(bench, preset, options.full)
            except Failed as failure:
                raise Failed(f"{name}, {preset}: {failure}") from failure
            lines.append((preset, reached, "; ".join(dict.fromkeys(bench.guards)), time.time() - began))
            print(f"{name:24}{preset:9}{lines[-1][3]:6.1f} s  {reached}", flush=True)
    return lines


def report(results, path):
    """The pages's table: what each case is, and what was reached."""
    text = [path.read_text().split("<!-- made by hard_cases.py -->")[0].rstrip() if path.exists() else "# Hard cases", "", "<!-- made by hard_cases.py -->", "",
            "| case | settings | reached | what the program said |", "|---|---|---|---|"]
    for name, lines in results.items():
        title = load(name).__doc__.strip().splitlines()[0]
        for k, (preset, reached, guards, _) in enumerate(lines):
            text.append(f"| {f'[{title}](../tests/hard_cases/{name}/case.py)' if k == 0 else ''} | {preset} | {reached} | {guards[:160]} |")
    path.write_text("\n".join(text) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--suffuse", required=True)
    parser.add_argument("--mpirun", required=True)
    parser.add_argument("--case", nargs="+", choices=case_names(), default=case_names())
    parser.add_argument("--full", action="store_true")
    parser.add_argument("--report", type=pathlib.Path)
    options = parser.parse_args()
    options.suffuse, options.mpirun = (str(pathlib.Path(path).resolve()) for path in (options.suffuse, options.mpirun))
    results, failures = {}, []
    for name in options.case:
        try:
            results[name] = run_case(options, name)
        except Failed as failure:
            failures.append(str(failure))
            print(f"FAILED {failure}", flush=True)
    if options.report:
        report(results, options.report)
    sys.exit("\n".join(failures) if failures else 0)


if __name__ == "__main__":
    main()
