"""From where a campaign's step begins (continued_run.py), on folders as a stopped and a finished run leave them.

The program is a script that writes what the scenes write, or stops on its way, and notes its words.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from scenes import expect  # noqa: E402

# A restart file of this program is its name; the rows of the series are the times 1 to 3, from a restart file on 3 to 5.
PROGRAM = """#!/bin/sh
case "$*" in
  *in.read_restart*) while [ "$1" != restart ]; do shift; done; exec grep -q whole "$2" ;;
  *in.isotropic_compression*) output=A; series=compression.csv; restart=compression.1000.restart; last=target.restart ;;
  *) output=A/shear; series=shear.csv; restart=shear.1000.restart; last=shear_start.inc ;;
esac
echo "$*" >> words.txt
echo time_s,mean_stress_pa > $output/$series
case "$*" in *1000.restart*) times="3 4 5" ;; *) times="1 2 3" ;; esac
for time in $times; do echo $time,200 >> $output/$series; done
if [ -n "$STOPPED" ]; then echo whole > $output/$restart; printf 4,2 >> $output/$series; exit 9; fi
echo whole > $output/$last
"""
SETTINGS = {"stiffness_scale": "0.001", "snapshots": "0 0.02 1e9", "restart_every": "1000"}


class Step:
    def __init__(self, campaigns, folder, step, name):
        self.script, self.place, self.step = campaigns / "continued_run.py", folder / name, step
        self.folder = self.place / ("A" if step == "equilibrate" else "A/shear")
        self.folder.mkdir(parents=True)
        program = self.place / "program"
        program.write_text(PROGRAM)
        program.chmod(0o755)
        self.grains()
        (self.place / "A" / "isotropic.restart").write_text("whole")

    def grains(self, title="from one folder", grains="300 atoms"):
        for name in ("sample.data", "sample.inc"):
            (self.place / "A" / name).write_text(f"# {title}\n{grains}\n")

    def run(self, stopped=False, **settings):
        """What it says, and the words that the program was run with."""
        given = [word for name, value in {**SETTINGS, **settings}.items() for word in ("-var", name, value)]
        if self.step == "shear":
            given += ["-var", "sample", "A/isotropic.restart"]
        done = subprocess.run([sys.executable, str(self.script), self.step, "--output", str(self.folder.relative_to(self.place)), "--suffuse", "./program",
                               "--", *given], cwd=self.place, env=dict(os.environ, STOPPED="yes" if stopped else ""), capture_output=True, text=True)
        expect((done.returncode == 0) != stopped, f"{self.step}: {done.returncode}, {done.stdout}{done.stderr}")
        return done.stdout, (self.place / "words.txt").read_text().splitlines()[-1]

    def times(self):
        name = "compression.csv" if self.step == "equilibrate" else "shear.csv"
        return [int(row.split(",")[0]) for row in (self.folder / name).read_text().splitlines()[1:]]

    def expect_anew(self, ran, reason):
        screen, words = ran
        expect("1000.restart" not in words and "target.restart" not in words and self.times() == [1, 2, 3], f"went on: {words}, {self.times()}")
        expect(("begins anew" in screen and reason in screen) if reason else not screen, f"{reason} is not in: {screen}")

    def expect_goes_on(self, ran):
        screen, words = ran
        expect("goes on from" in screen and "1000.restart" in words and self.times() == [1, 2, 3, 4, 5], f"did not go on: {screen}{words}, {self.times()}")


def stopped_steps(campaigns, folder):
    """With the same settings and grains it goes on; with others not, and what was stopped can be moved back."""
    for step in ("equilibrate", "shear"):
        case = Step(campaigns, folder, step, f"{step}_stopped")
        case.run(stopped=True)
        case.grains(title="from another folder")
        case.expect_goes_on(case.run(restart_every="500", stiffness_scale="1e-3"))
        case.run(stopped=True)
        case.expect_anew(case.run(stiffness_scale="0.01"), "stiffness_scale 0.001 (now 0.01)")
        expect((case.folder / "earlier_1").is_dir() and not list(case.folder.glob("*.1000.restart")), "what was stopped is not kept elsewhere")
        for path in (case.folder / "earlier_1").iterdir():
            path.rename(case.folder / path.name)
        case.expect_goes_on(case.run())
        case.run(stopped=True)
        next(case.folder.glob("*.1000.restart")).write_text("cut short")
        case.expect_anew(case.run(), "no restart file that can be read")


def other_grains(campaigns, folder):
    case = Step(campaigns, folder, "equilibrate", "grains")
    case.run(stopped=True)
    case.grains(grains="400 atoms")
    case.expect_anew(case.run(), "other grains")
    case = Step(campaigns, folder, "shear", "sheared_grains")
    case.run(stopped=True)
    (case.place / "A" / "isotropic.restart").write_text("whole, of another sample")
    case.expect_anew(case.run(), "other grains")


def finished_steps(campaigns, folder):
    """A step that is done again begins at its beginning, and leaves nothing of the run before."""
    case = Step(campaigns, folder, "equilibrate", "finished")
    case.run()
    expect(not (case.folder / "target.restart").exists(), "target.restart stays")
    case.expect_anew(case.run(), "")
    case = Step(campaigns, folder, "shear", "finished_shear")
    case.run()
    leftovers = [case.folder / name for name in ("shear_0.02.grains.dump", "shear_0.02.contacts.dump", "sheared.restart")]
    for path in leftovers:
        path.write_text("of the run before")
    (case.folder / "shear_start.inc").write_text("of the run before")
    case.expect_anew(case.run(snapshots="0 0.01 1e9"), "")
    expect(not [path for path in leftovers if path.exists()], "snapshots of an earlier shear stay")
    expect((case.folder / "shear_start.inc").read_text() == "whole\n", "the start of an earlier shear stays")


def snapshots_of_a_stopped_shear(campaigns, folder):
    case = Step(campaigns, folder, "shear", "snapshots")
    case.run(stopped=True)
    snapshot = case.folder / "shear_0.grains.dump"
    snapshot.write_text("before the stop")
    case.expect_goes_on(case.run())
    expect(snapshot.exists(), "a shear that goes on has lost its first snapshot")


def work_without_a_record(campaigns, folder):
    """As earlier versions left it: the command tells the settings, and the grains are not newer than the restart files."""
    def stopped(name):
        case = Step(campaigns, folder, "equilibrate", name)
        case.run(stopped=True)
        (case.folder / "equilibrate.settings.json").unlink()
        command = case.folder / "command.txt"
        command.write_text(command.read_text().replace("'", ""))
        return case

    case = stopped("same")
    case.expect_goes_on(case.run())
    case = stopped("other_settings")
    case.expect_anew(case.run(snapshots="0 1e9"), "snapshots 0 0.02 1000000000 (now 0 1000000000)")
    case = stopped("other_grains")
    (case.folder / "target.restart").write_text("whole")  # which a finished step left, too
    now = (case.folder / "target.restart").stat().st_mtime
    os.utime(case.folder / "sample.data", (now + 10, now + 10))
    case.expect_anew(case.run(), "restart files older than its grains")


def check_decisions(campaigns):
    with tempfile.TemporaryDirectory(prefix="suffuse-campaign-steps-") as scratch:
        for check in (stopped_steps, other_grains, finished_steps, snapshots_of_a_stopped_shear, work_without_a_record):
            check(campaigns, pathlib.Path(scratch))
