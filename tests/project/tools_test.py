"""The tools around the code: what they refuse, what they do, and that a second call does nothing."""
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

SOURCE = pathlib.Path(os.environ.get("SUFFUSE_SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))


def run(*command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)


class FakeMachine:
    """A PATH on which dpkg-query, apt-get, sudo and id are ours: packages 'installed' are names in a file."""

    def __init__(self, folder, installed, user_id=0, sudo=True, network=True):
        self.folder, self.log, self.installed = folder, folder / "log", folder / "installed"
        self.bin = folder / "bin"
        self.bin.mkdir()
        self.installed.write_text("".join(name + "\n" for name in installed))
        self.log.write_text("")
        self.command("dpkg-query", f'for name; do :; done; grep -qx "$name" "{self.installed}" && printf installed')
        self.command("id", f"echo {user_id}")
        install = f'for word; do case $word in -*|install|update) ;; *) echo "$word" >> "{self.installed}" ;; esac; done'
        self.command("apt-get", f'echo "apt-get $*" >> "{self.log}"\n' + (install if network else "exit 100"))
        if sudo:
            self.command("sudo", f'echo "sudo $1" >> "{self.log}"\nexec "$@"')
        for name in ("bash", "sh", "env", "awk", "grep", "sort", "xargs", "dirname", "readlink", "echo", "cat"):
            os.symlink(shutil.which(name), self.bin / name)

    def command(self, name, text):
        path = self.bin / name
        path.write_text("#!/bin/sh\n" + text + "\n")
        path.chmod(0o755)

    def install_packages(self, *kinds):
        return run(SOURCE / "scripts/install_packages", *kinds, env={"PATH": str(self.bin)})


def packages(*kinds, choice=0):
    """Of alternatives the first, or the last with -1."""
    lines = (SOURCE / "scripts/packages.txt").read_text().splitlines()
    return [line.split()[1].split("|")[choice] for line in lines if line.split()[:1] and line.split()[0] in kinds]


class InstallPackages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_nothing_is_asked_of_the_network_when_all_is_there(self):
        machine = FakeMachine(self.folder, packages("run", "check"), network=False)
        done = machine.install_packages("run", "check")
        self.assertEqual((done.returncode, done.stdout, machine.log.read_text()), (0, "", ""), done.stderr)

    def test_any_of_alternatives_will_do(self):
        others = packages("run", choice=-1)
        self.assertNotEqual(others, packages("run"), "there are no alternatives to be tested")
        machine = FakeMachine(self.folder, others, network=False)
        done = machine.install_packages("run")
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)

    def test_root_installs_what_is_missing_and_only_that_and_only_once(self):
        missing = packages("run")[-1]
        machine = FakeMachine(self.folder, packages("run")[:-1], sudo=False)
        self.assertEqual(machine.install_packages("run").returncode, 0)
        asked = machine.log.read_text().splitlines()[-1].split()
        self.assertEqual([word for word in asked if not word.startswith("-")], ["apt-get", "install", missing])
        before = machine.log.read_text()
        self.assertEqual(machine.install_packages("run").returncode, 0)
        self.assertEqual(machine.log.read_text(), before)

    def test_a_user_installs_by_sudo(self):
        machine = FakeMachine(self.folder, [], user_id=1000)
        done = machine.install_packages("run", "check")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("sudo", machine.log.read_text())
        self.assertEqual(sorted(machine.installed.read_text().split()), sorted(packages("run", "check")))

    def test_without_root_and_sudo_one_line_says_what_to_do(self):
        machine = FakeMachine(self.folder, packages("run")[1:], user_id=1000, sudo=False)
        done = machine.install_packages("run")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertIn("apt-get install " + packages("run")[0], done.stderr)

    def test_without_network_the_line_names_the_packages(self):
        machine = FakeMachine(self.folder, packages("run")[1:], network=False)
        done = machine.install_packages("run")
        self.assertEqual(done.returncode, 1)
        self.assertIn("could not install", done.stderr)
        self.assertIn(packages("run")[0], done.stderr)

    def test_an_unknown_kind_is_refused(self):
        done = FakeMachine(self.folder, []).install_packages("runs")
        self.assertEqual(done.returncode, 1)
        self.assertIn("'runs'", done.stderr)


class Portability(unittest.TestCase):
    def check(self, text):
        with tempfile.TemporaryDirectory() as folder:
            run("git", "init", "-q", folder)
            (pathlib.Path(folder) / "file.txt").write_text(text)
            return run(SOURCE / "scripts/check_portability", "--root", folder)

    def test_paths_of_one_machine_are_found(self):
        for path in ("/" + "home/someone/data.csv", "/" + "tmp/out", "../" + "shared/DESIGN.md", "cd /" + "root"):
            done = self.check(f"first line\nread {path} # here\n")
            self.assertEqual(done.returncode, 1, path)
            self.assertIn("file.txt:2:", done.stderr)

    def test_ordinary_paths_are_not(self):
        done = self.check("docs/work/x.md ${TMPDIR:-/" + "tmp}/run ./tmp build/home /usr/include https://site.org/work-with-us\n")
        self.assertEqual(done.returncode, 0, done.stderr)


class CompressionFigure(unittest.TestCase):
    SCRIPT = SOURCE / "analysis/figures/compression.py"

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.series = self.folder / "series.csv"
        finder = run(SOURCE / "scripts/python_with_figures")
        self.assertEqual(finder.returncode, 0, finder.stderr)
        self.python = finder.stdout.strip()

    def write(self, header, *rows):
        self.series.write_text("# made by a test\n" + "\n".join([header, *rows]) + "\n")

    def test_table_gives_the_last_state(self):
        # e = 0.25 is n = 0.2; 201 kPa is 0.5 % above 200 kPa.
        self.write("time_s,mean_stress_pa,void_ratio,coordination_number", "0,0,0.6,0", "0.002,201e3,0.25,5.125")
        done = run(self.python, self.SCRIPT, self.series, "--table", "--target", "200e3")
        self.assertEqual(done.returncode, 0, done.stderr)
        values = {line[:30].strip(): line[30:].split()[0] for line in done.stdout.splitlines()}
        self.assertEqual(values["porosity n"], "0.2000")
        self.assertEqual(values["its distance to the target"], "+0.50")
        self.assertEqual(values["coordination number Z"], "5.125")

    def test_figure_is_a_picture_and_has_a_panel_for_each_quantity(self):
        sizes = []
        for header, rest in (("", ""), (",coordination_number,inertial_number", ",4,1e-4")):
            self.write("time_s,mean_stress_pa,void_ratio" + header, "0,0,0.6" + rest, "1e-3,2e5,0.45" + rest)
            figure = self.folder / "figure.png"
            done = run(self.python, self.SCRIPT, self.series, "--output", figure, "--target", "200e3")
            self.assertEqual(done.returncode, 0, done.stderr)
            data = figure.read_bytes()
            self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
            sizes.append(int.from_bytes(data[20:24], "big"))
        self.assertGreater(sizes[1], 1.6 * sizes[0])  # four panels against two

    def wait_for(self, condition, process, seconds=60):
        end = time.monotonic() + seconds
        while not condition():
            self.assertIsNone(process.poll(), "ended by itself")
            self.assertLess(time.monotonic(), end, "the picture does not follow")
            time.sleep(0.02)

    def test_follow_draws_a_series_that_does_not_exist_yet_again_whenever_it_has_grown(self):
        figure = self.folder / "figure.png"
        process = subprocess.Popen([self.python, self.SCRIPT, self.series, "--output", figure, "--follow", "0.05"], stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        with open(self.series, "w") as series:
            def write(text):
                series.write(text)
                series.flush()
            write("time_s,mean_stress_pa,void_ratio\n0,0,0.6\n1e-3,1e5,0.5\n2e-3,1.")  # half a row, as a run may leave it
            self.wait_for(figure.exists, process)
            first = figure.read_bytes()
            write("5e5,0.45\n3e-3,2e5,0.4\n")
            self.wait_for(lambda: figure.read_bytes() != first, process)
        self.assertEqual(figure.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        process.send_signal(signal.SIGINT)
        self.assertEqual((process.wait(timeout=60), process.stderr.read()), (0, ""))
        process.stderr.close()
        whole = self.folder / "whole.png"
        self.assertEqual(run(self.python, self.SCRIPT, self.series, "--output", whole).returncode, 0)
        self.assertEqual(figure.read_bytes(), whole.read_bytes())
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["figure.png", "series.csv", "whole.png"])

    def test_wrong_series_give_one_line(self):
        cases = [("time_s,void_ratio", ["0,1"], "has no column mean_stress_pa"),
                 ("time_s,mean_stress_pa,void_ratio", [], "no rows"),
                 ("time_s,mean_stress_pa,void_ratio", ["0,1"], "row 2 has 2 values"),
                 ("time_s,mean_stress_pa,void_ratio", ["0,much,1"], "'much' is no number")]
        for header, rows, message in cases:
            self.write(header, *rows)
            done = run(self.python, self.SCRIPT, self.series, "--table")
            self.assertEqual(done.returncode, 1)
            self.assertIn(message, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        done = run(self.python, self.SCRIPT, self.folder / "none.csv", "--table")
        self.assertIn("none.csv: No such file", done.stderr)

    def test_without_matplotlib_one_line_says_what_to_install(self):
        blocked = self.folder / "matplotlib"
        blocked.mkdir()
        (blocked / "__init__.py").write_text("raise ImportError('blocked by the test')\n")
        self.write("time_s,mean_stress_pa,void_ratio", "0,0,0.6")
        done = run(self.python, self.SCRIPT, self.series, "--output", self.folder / "f.png",
                   env={**os.environ, "PYTHONPATH": str(self.folder)})
        self.assertEqual(done.returncode, 1)
        self.assertIn("python3-matplotlib", done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)


class TwoCommands(unittest.TestCase):
    def test_quickstart_refuses_what_it_does_not_know_before_doing_anything(self):
        for words, message in ((["--again"], "'--again'"), (["-n", "0"], "ranks = 0"), (["-n", "two"], "ranks = two"), (["-n"], "-n needs")):
            done = run(SOURCE / "quickstart", *words)
            self.assertEqual(done.returncode, 1)
            self.assertIn(message, done.stderr)
            self.assertEqual(done.stdout, "")

    def test_both_say_how_they_are_used(self):
        for program in ("quickstart", "check"):
            done = run(SOURCE / program, "--help")
            self.assertEqual(done.returncode, 0)
            self.assertIn("usage: ./" + program, done.stdout)


if __name__ == "__main__":
    unittest.main()
