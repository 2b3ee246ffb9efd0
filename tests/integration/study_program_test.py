#!/usr/bin/env python3
"""study_program_test.py --study PROGRAM --mpirun SCRIPT

`suffuse-study` on the tank of 05_settling_sphere, three cells a diameter: runs of less than a second, one of which is too fast for a
lattice fluid and stops. Interrupted in a run of minutes, resumed without repeating what has ended, with another quantity; a time
limit; two ranks after a run that prepares; three runs at once by a launcher; and what people get wrong.
"""
import argparse
import csv
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "integration" / "analysis"))
from program_under_test import check, python_with_figures  # noqa: E402

SCENES = ROOT / "input_scripts"
TANK = f"""
title  = "tank"
script = "{SCENES}/05_settling_sphere/in.settling_sphere"

[fixed]
case = "E2"

[sweep]
resolution      = [3]
relaxation_time = [0.6, 0.7, 1.0]   # the last one: a Mach number of 0.36

[[quantity]]
name      = "peak_speed"
file      = "settling_result.csv"
reference = {{ file = "{SCENES}/05_settling_sphere/expected.csv", where = {{ case = "E2" }} }}
"""
SPEED = """
[[quantity]]
name = "fastest"
file = "settling.csv"
column = "speed_m_per_s"
take = "largest"
"""
# A script that takes no time: its result is the value of a variable; LIGGGHTS stops above 5.
TINY = """
variable value index 1
variable file index none
shell test -e ${file} || exit 0
print "quantity,value" file result.csv
print "answer,${value}" append result.csv
if "${value} > 5" then "no_such_command"
"""
TINY_STUDY = 'script = "in.tiny"\n[sweep]\nvalue = [1, 2]\n[[quantity]]\nname = "answer"\nfile = "result.csv"\nreference = 1.5\nsource = "by hand"\n'


class Study:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def run(self, *words):
        done = subprocess.run([self.program, *map(str, words)], cwd=self.folder, capture_output=True, text=True, timeout=170)
        return done.returncode, done.stdout, done.stderr

    def must_run(self, *words):
        code, out, err = self.run(*words)
        check(code == 0, f"{words} ended with {code}: {out}{err}")
        return out

    def must_refuse(self, words, *told):
        code, _, err = self.run(*words)
        lines = err.strip().splitlines()
        check(code == 1 and len(lines) == 1, f"{words}: exit code {code}, {len(lines)} lines:\n{err}")
        check(lines[0].startswith("suffuse-study: error: "), lines[0])
        check(all(text in err for text in told), f"{words}: does not tell {told}: {err}")

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return name

    def rows(self, out):
        with open(self.folder / out / "study.csv", newline="") as file:
            return list(csv.DictReader(file))


def records(folder):
    return {path: path.stat().st_mtime_ns for path in folder.glob("tank/runs/*/run.json")}


def interrupt(study, file):
    """Starts the study and ends it by SIGINT in its fourth run, which would take minutes; returns its exit code and words."""
    process = subprocess.Popen([study.program, file, "--out", "tank", "--no-figure"], cwd=study.folder, stdout=subprocess.PIPE, text=True)
    deadline = time.monotonic() + 120
    while not (len(records(study.folder)) == 3 and list(study.folder.glob("tank/runs/*resolution=10.5*/log.txt"))):
        if process.poll() is not None or time.monotonic() > deadline:
            process.terminate()
            check(False, "the study did not come to its fourth run")
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=60)
    return process.returncode, out


def check_study(study, has_figures):
    file = study.write("tank.toml", TANK.replace("[3]", "[3, 10.5]").replace("[0.6, 0.7, 1.0]", "[0.6, 0.7, 1.0, 0.505]"))
    dry = study.must_run(file, "--dry-run")
    check(dry.count("-var case E2 -var resolution 10.5") == 4 and "# 8 runs, 0 of them done" in dry, dry)
    check(not (study.folder / "runs").exists(), "--dry-run leaves a folder")

    # Three short runs and a long one, which is interrupted.
    file = study.write("tank.toml", TANK.replace("[sweep]", "[base]\nresolution = 3\n[[sweep]]").replace("resolution      = [3]\n", "") +
                       "[[sweep]]\nresolution = [10.5]\nrelaxation_time = [0.505]\n")
    code, out = interrupt(study, file)
    check(code == 130 and "interrupted: 3 of 4 runs are done" in out, f"{code}: {out}")
    before = records(study.folder)
    study.must_refuse([file, "--out", "tank"], "--out", "--resume")

    # Resumed with a time limit for the long run, and one more quantity.
    text = (study.folder / file).read_text()
    study.write(file, text.replace("\n[fixed]", "\ntime_limit = 0.5\n\n[fixed]") + SPEED)
    out = study.must_run(file, "--out", "tank", "--resume", *([] if has_figures else ["--no-figure"]))
    after = records(study.folder)
    check(len(after) == 4 and all(after[path] == stamp for path, stamp in before.items()), "runs were repeated")
    check("[4/4]" in out and "[1/4]" not in out, out)
    rows = {(row["resolution"], row["relaxation_time"]): row for row in study.rows("tank")}
    status = [rows["3", tau]["status"] for tau in ("0.6", "0.7", "1")] + [rows["10.5", "0.505"]["status"]]
    check(status == ["finished", "finished", "failed", "too long"], f"{status}")
    check("Mach number" in rows["3", "1"]["reason"] and rows["3", "1"]["error"] == "", f"{rows['3', '1']}")
    for tau in ("0.6", "0.7"):
        row = rows["3", tau]
        # ten Cate's peak at three cells: some per cent (6.1 and 5.5 were seen); the script rounds its result to eight digits.
        check(abs(float(row["peak_speed_error"])) < 0.1 and row["case"] == "E2", f"{row}")
        check(abs(float(row["peak_speed"]) / float(row["fastest"]) - 1) < 1e-7, f"{row}")
        check(abs(float(row["peak_speed"]) / 0.05718 - 1 - float(row["peak_speed_error"])) < 1e-6, f"{row}")
        check(0 < float(row["core_s"]) < 1.1 * float(row["wall_s"]), f"seconds: {row}")
    check(rows["3", "1"]["front"] == "0", "a run that failed is on the front")
    best = min(("0.6", "0.7"), key=lambda tau: float(rows["3", tau]["error"]))
    verdict = "fastest within 3 %: " if float(rows["3", best]["error"]) <= 0.03 else f"no run is within 3 %; the most accurate: relaxation_time={best}, resolution=3"
    check(verdict in out and rows["3", best]["front"] == "1", out)
    check((study.folder / "tank" / "study.png").exists() == has_figures, "study.png")
    # Nothing is left to do; a value that is added is one run; failures are repeated where that is asked for.
    check("[" not in study.must_run(file, "--out", "tank", "--resume", "--no-figure"), "runs after all are done")
    out = study.must_run(file, "--out", "tank", "--resume", "--retry-failed", "--no-figure")
    check("[3/4]" in out and "[4/4]" in out and "[1/4]" not in out, out)


def check_ranks(study, mpirun):
    """Two ranks, a run before all others, a value that names its folder; results by hand."""
    study.write("in.tiny", TINY)
    study.write("two.toml", TINY_STUDY.replace("[sweep]", 'ranks = 1\nwithin = 40\n[fixed]\nfile = "{prepare}/result.csv"\n[sweep]') +
                f'[prepare]\nscript = "in.tiny"\nvariables = {{ value = 3 }}\n')
    out = study.must_run("two.toml", "--ranks", 2, "--out", "two", "--no-figure", "--time", "core")
    rows = study.rows("two")
    check([row["answer_error"] for row in rows] == ["-0.333333", "0.333333"], f"{rows}")
    check(all(row["file"] == "{prepare}/result.csv" for row in rows) and "preparing: " in out and "fastest within 40 %: value=" in out, out)
    words = study.must_run("two.toml", "--ranks", 2, "--out", "two", "--dry-run", "--resume")
    check(f"{mpirun} 2 " in words and f"-var file {study.folder}/two/prepare/result.csv" in words and "2 runs, 2 of them done" in words, words)
    check("2 runs, 0 of them done" in study.must_run("two.toml", "--out", "two", "--dry-run", "--resume"), "another number of ranks is another run")
    # Another script is another run too.
    study.write("in.tiny", TINY + "# changed\n")
    check("2 runs, 0 of them done" in study.must_run("two.toml", "--ranks", 2, "--out", "two", "--dry-run", "--resume"), "a changed script is another run")


# Starts one rank once all of the first `together` are there; what stands in `asleep` sleeps instead, in two processes.
LAUNCHER = """#!/bin/sh
echo $1 >> "$(dirname $0)/ranks"
echo $$ > "$(dirname $0)/started.$$"
for look in $(seq 200); do [ $(ls $(dirname $0)/started.* | wc -l) -ge {together} ] && break; sleep 0.05; done
[ $look -lt 200 ] || exit 9
shift
if [ -e $(dirname $0)/asleep ]; then sleep 100 & sleep 100; fi
exec "$@"
"""


def in_folder(folder):
    """Living processes at work in a folder or below it."""
    found = []
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if (process / "cwd").resolve().is_relative_to(folder):
                found.append(process.name)
        except OSError:
            pass
    return found


def require_none_in(folder):
    deadline = time.monotonic() + 2  # killed, a process still has to be taken down by the system
    while in_folder(folder):
        check(time.monotonic() < deadline, f"processes are left in {folder}: {in_folder(folder)}")
        time.sleep(0.05)


def check_several_at_once(study):
    """Three of four at once, by a launcher that lets none begin before three have; one fails. Ended by SIGTERM, none is left."""
    study.write("in.tiny", TINY)
    study.write("starts", LAUNCHER.format(together=3))
    (study.folder / "starts").chmod(0o755)
    text = TINY_STUDY.replace("[1, 2]", "[6, 1, 2, 4]").replace("[sweep]", 'launcher = "./starts {ranks}"\n[sweep]') + '[extrapolate]\nspacing = "value"\norder = 1\n'
    file = study.write("several.toml", text)
    out = study.must_run(file, "--out", "several", "--no-figure", "--cores", 3)
    rows = [(row["value"], row["status"], row["answer"]) for row in study.rows("several")]
    check(rows == [("6", "failed", ""), ("1", "finished", "1"), ("2", "finished", "2"), ("4", "finished", "4")], f"{rows}")
    # The answer is the spacing itself: 0 without one, and the first-order index of the finest run is 1.25 times its answer.
    limits = {(row["answer_convergence"], row["extrapolated_from"]) for row in study.rows("several")}
    check(limits == {("", ""), ("converges", "1 2 4")}, f"{limits}")
    finest = study.rows("several")[1]
    check(abs(float(finest["answer_extrapolated"])) < 1e-12 and finest["answer_error_bar"] == "1.25" and finest["answer_order"] == "1", f"{finest}")
    check("± 1.2 (order 1)" in out and "error -1e+02 ± 83 %" in out, out)
    check("4 runs, up to 3 at once" in out and (study.folder / "ranks").read_text().split() == ["1"] * 4, out)

    (study.folder / "asleep").touch()
    study.write(file, text.replace("[6, 1, 2, 4]", "[6, 1, 2, 4, 1.1, 1.2, 1.3]"))
    process = subprocess.Popen([study.program, file, "--out", "several", "--no-figure", "--cores", "2", "--resume"], cwd=study.folder, stdout=subprocess.PIPE, text=True)
    deadline = time.monotonic() + 60
    while len(in_folder(study.folder / "several")) < 6:  # two runs of a shell and two sleeps
        check(time.monotonic() < deadline and process.poll() is None, "two runs at once do not begin")
        time.sleep(0.05)
    process.send_signal(signal.SIGTERM)
    out, _ = process.communicate(timeout=60)
    check(process.returncode == 143 and "interrupted: 4 of 7 runs are done" in out, f"{process.returncode}: {out}")
    require_none_in(study.folder / "several")

    # The same study with what only a run can tell wrong: the others are ended with it.
    (study.folder / "asleep").unlink()
    study.must_refuse([study.write("bad.toml", text.replace('"answer"', '"question"')), "--out", "bad", "--no-figure", "--cores", 3], "no row with quantity=question")
    require_none_in(study.folder / "bad")
    subprocess.run(["rm", "-r", study.folder / "bad"], check=True)


def check_unsteady(study):
    """A run that says it is not steady yet has its numbers in the table and no place on the front."""
    study.write("in.tiny", TINY.replace('if "', 'if "${value} == 1" then "print \'lbm run: not yet steady after 0.1 s\'" "print \'note: on its way\'"\nif "'))
    out = study.must_run(study.write("unsteady.toml", TINY_STUDY.replace("1.5", "1.1")), "--out", "unsteady", "--no-figure")
    rows = study.rows("unsteady")
    check([(row["status"], row["front"], row["notes"]) for row in rows] == [("unsteady", "0", "on its way"), ("finished", "1", "")], f"{rows}")
    check(rows[0]["answer"] == "1" and "unsteady: not yet steady after 0.1 s" in out and "\n  1 (1 run): on its way\n" in out and "the most accurate: value=2" in out, out)
    study.write("in.tiny", TINY)


def check_failed_preparation(study):
    """A preparation that has failed is done again on --resume, and no run goes on without it."""
    study.write("in.tiny", TINY)
    # Fails as long as the study's folder has no file `there`.
    study.write("in.before", f'variable value index 1\nvariable line file {study.folder}/there\n'
                'print "quantity,value" file result.csv\nprint "answer,${value}" append result.csv\n')
    file = study.write("prepared.toml", TINY_STUDY.replace("[sweep]", '[fixed]\nfile = "{prepare}/result.csv"\n[sweep]') +
                       '[prepare]\nscript = "in.before"\nvariables = { value = 9 }\n')
    for words in ((), ("--resume",)):
        study.must_refuse([file, "--out", "prepared", "--no-figure", *words], "[prepare]", f"{study.folder}/there")
        check(not list((study.folder / "prepared" / "runs").iterdir()), f"{words}: runs without their preparation")
    study.write("there", "a line\n")
    out = study.must_run(file, "--out", "prepared", "--no-figure", "--resume")
    check("preparing: " in out and [row["status"] for row in study.rows("prepared")] == ["finished"] * 2, out)
    check("preparing: " not in study.must_run(file, "--out", "prepared", "--no-figure", "--resume"), "prepared twice")
    # Runs that had failed while the preparation was not there are done with it, those that had finished stay.
    (study.folder / "prepared" / "prepare" / "run.json").unlink()
    for value, status in ((1, "failed"), (2, "finished")):
        record = study.folder / "prepared" / "runs" / f"value={value}" / "run.json"
        record.write_text(record.read_text().replace('"finished"', f'"{status}"'))
    check("2 runs, 1 of them done" in study.must_run(file, "--out", "prepared", "--dry-run", "--resume"), "a run that failed counts as done")
    out = study.must_run(file, "--out", "prepared", "--no-figure", "--resume")
    check("preparing: " in out and "[1/2]" in out and "[2/2]" not in out, out)


def check_another_program(study):
    """Runs of another program are taken with a warning; the same one by another name is the same."""
    study.write("in.tiny", TINY)
    file = study.write("program.toml", TINY_STUDY)
    suffuse = study.program.parent / "suffuse"
    (study.folder / "bin").mkdir()
    (study.folder / "bin" / "same").symlink_to(suffuse)
    study.write("bin/other", f'#!/bin/sh\nexec {suffuse} "$@"\n')
    (study.folder / "bin" / "other").chmod(0o755)
    study.must_run(file, "--out", "program", "--no-figure")
    for program in (suffuse, "bin/../bin/same"):
        check("warning" not in study.must_run(file, "--out", "program", "--no-figure", "--resume", "--program", program), f"{program} is the same")
    study.write(file, TINY_STUDY.replace("[1, 2]", "[1, 2, 3]"))
    out = study.must_run(file, "--out", "program", "--no-figure", "--resume", "--program", "bin/other")
    check(f"warning: 2 runs taken as {suffuse.resolve()} left them, not done with {study.folder}/bin/other" in out and "[3/3]" in out and "[1/3]" not in out, out)


def check_mistakes(study):
    study.write("in.tiny", TINY)
    study.write("expected.csv", "quantity,value\nother,1\n")

    def refuse(told, old="", new="", extra="", words=()):
        study.must_refuse([study.write("bad.toml", TINY_STUDY.replace(old, new, 1) + extra), "--out", "bad", "--no-figure", *words], *told)

    study.must_refuse(["none.toml"], "none.toml", "can be read")
    study.must_refuse([], "STUDY")
    refuse(["bad.toml, line 1"], old="script", new="[script")
    refuse(["scripts", "unknown"], old="script =", new="scripts =")
    refuse(["in.none", "must be a file"], old="in.tiny", new="in.none")
    refuse(["variable = vale", "used by in.tiny", "value"], old="value =", new="vale =")
    refuse(["[sweep] value", "an empty list"], old="[1, 2]", new="[]")
    refuse(["[sweep] value", "each value once"], old="[1, 2]", new="[1, 1]")
    refuse(["[sweep] value", "number or a text"], old="[1, 2]", new="[true]")
    refuse(["[sweep]", "not there"], old="[sweep]\nvalue = [1, 2]\n", new="")
    refuse(["[[quantity]]", "not there"], old=TINY_STUDY[TINY_STUDY.index("[[q"):], new="")
    refuse(["[quantity] source"], old='source = "by hand"\n')
    refuse(["[quantity] reference", "differ from 0"], old="1.5", new="0")
    refuse(["[quantity] reference", "finer", "finest"], old="1.5", new='"finer"')
    refuse(["[finest]", "not there", "answer"], old="1.5", new='"finest"')
    refuse(["take", "median"], extra='take = "median"\n')
    refuse(["no row with quantity=answer", "are other"], old="1.5", new='{ file = "expected.csv" }')
    refuse(["value", "there twice"], extra="[fixed]\nvalue = 3\n")
    refuse(["[base] file", "be swept"], extra='[base]\nfile = "x"\n')
    refuse(["ranks", "be >= 1"], old="[sweep]", new="ranks = 0\n[sweep]")
    refuse(["ranks", "whole number"], old="[sweep]", new="ranks = 1.5\n[sweep]")
    refuse(["value", "[prepare]"], old="[1, 2]", new='["{prepare}/sample"]')
    refuse(["design", "one_at_a_time"], old="[sweep]", new='design = "all"\n[sweep]')
    refuse(["--program", "no_such_program"], words=["--program", "no_such_program"])
    refuse(["[extrapolate] cells", "one of both"], extra="[extrapolate]\norder = 2\n")
    refuse(["[extrapolate] cells", "[sweep]"], extra='[extrapolate]\ncells = "other"\n')
    refuse(["[extrapolate] spacing", "value = -1", "> 0"], old="[1, 2]", new="[-1, 2]", extra='[extrapolate]\nspacing = "value"\n')
    refuse(["--cores", "hold a run", "2 ranks"], words=["--ranks", "2", "--cores", "1"])
    refuse(["--launcher", "{ranks}"], words=["--launcher", "srun -n 1"])
    refuse(["launcher", "/none", "can be run"], old="[sweep]", new='launcher = "./none {ranks}"\n[sweep]')
    refuse(["--time", "cpu", "wall"], words=["--time", "cpu"])
    refuse(["--retry-failed", "--resume"], words=["--retry-failed"])
    check(not (study.folder / "bad").exists(), "a mistake in the study leaves a folder")
    # Those that only a run can tell: the first one ends the study.
    refuse(["no row with quantity=question", "are answer"], old='name = "answer"', new='name = "question"')
    subprocess.run(["rm", "-r", study.folder / "bad"], check=True)
    refuse(["results.csv", "be left by a run", "its folder has result.csv"], old="result.csv", new="results.csv")
    subprocess.run(["rm", "-r", study.folder / "bad"], check=True)
    refuse(["all failed"], old="[1, 2]", new="[6, 7]")
    subprocess.run(["rm", "-r", study.folder / "bad"], check=True)
    refuse(["[prepare]", "no_such_command"], extra='[prepare]\nscript = "in.tiny"\nvariables = { value = 9 }\n')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--study", required=True)
    parser.add_argument("--mpirun", required=True)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="suffuse-test-") as scratch:
        study = Study(pathlib.Path(options.study).resolve(), pathlib.Path(scratch).resolve())
        check("suffuse-study " in study.must_run("--version") and "--resume" in study.must_run("--help"), "--version, --help")
        check_mistakes(study)
        check_several_at_once(study)
        check_unsteady(study)
        check_failed_preparation(study)
        check_another_program(study)
        check_ranks(study, pathlib.Path(options.mpirun).resolve())
        check_study(study, python_with_figures() is not None)
    print("suffuse-study: runs, failures, interruption, resumption and mistakes as described")


if __name__ == "__main__":
    main()
