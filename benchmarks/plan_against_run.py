#!/usr/bin/env python3
"""plan_against_run.py --suffuse PROGRAM --mpirun SCRIPT [--ranks 1 2] [--scenes NAME ...] [--within 25] [--repeat 3]

What `lbm plan` says that a run will take, beside what it takes: five scenes of input_scripts/ and docs/examples/ in small versions, the plan
made just before the run in the same process. What it takes is the first rank's processor time, the wall time of each part by the share of the
run that the rank was on a processor; the plan leaves out what other programs took, too. They still matter where they
take caches and bandwidth, and where ranks wait for each other, so the least of --repeat plans is held against the least of as many runs, and several ranks are judged only where they had their
processors for nine tenths of a run. Exit code 1 where a ratio is off by more than --within per cent.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
SCENES = {
    "sphere held": ("input_scripts/04_single_sphere/in.single_sphere", {"re": "1", "resolution": "4", "relaxation_time": "0.8"}),
    "sphere settles": ("input_scripts/05_settling_sphere/in.settling_sphere", {"case": "E2", "resolution": "7.5", "relaxation_time": "0.7"}),
    "packed bed": ("input_scripts/06_packed_bed/in.packed_bed", {}),
    "grains fall": ("docs/examples/in.falling_grains", {}),
    "grains settle": ("input_scripts/studies/in.settling_grains", {"resolution": "4"}),
}
ONE_RANK = {"packed bed"}  # its water lies in one half of the box, which two ranks share
# Nanoseconds on a processor of the suffuse that calls this through its shell, and the time.
MARK = """process=$PPID
while [ "$(cat /proc/$process/comm)" != suffuse ]; do process=$(awk '{ print $4 }' /proc/$process/stat); done
echo "$1 $(cut -d ' ' -f 1 /proc/$process/schedstat) $(date +%s.%N)" >> marks
"""


def with_a_plan(script):
    """The script with a plan of each run before it, and marks around both."""
    lines = []
    for line in script.read_text().splitlines():
        run = re.match(r"lbm\s+run\s+(?:until\s+)?(\S+)", line)
        if run:
            lines += [f"lbm plan {run[1]}", "shell sh mark.sh run", line, "shell sh mark.sh end"]
        elif not re.match(r"lbm\s+plan\s", line):
            lines.append(line)
    return "\n".join(lines) + "\n"


def beside_its_files(script, scratch):
    """The script with plans, where it finds what it includes from its folder and those beside it; and a folder to run it in."""
    scenes, runs = scratch / "scenes", scratch / "runs"
    place = scenes / script.parent.name
    for folder in (place, runs):
        folder.mkdir(parents=True)
    for other, at in ((script.parent.parent, scenes), (script.parent, place)):
        for file in other.iterdir():
            if not (at / file.name).exists():
                (at / file.name).symlink_to(file)
    (place / "in.planned").write_text(with_a_plan(script))
    (runs / "mark.sh").write_text(MARK)
    return place / "in.planned", runs


def share_on_a_processor(folder):
    """Seconds on a processor over seconds by the clock, of the run."""
    marks = [line.split() for line in (folder / "marks").read_text().splitlines()]
    (run_busy, run_time), (end_busy, end_time) = [(1e-9 * float(busy), float(time)) for _, busy, time in marks[-2:]]
    return (end_busy - run_busy) / (end_time - run_time)


def table_of(screen, head):
    """Rows of a table of costs: name -> ms a step."""
    rows = {}
    for line in screen[screen.index(head):].splitlines()[1:]:
        found = re.match(r"(\S.*?)\s{2,}([\d.]+)\s+([\d.]+)\s+[\d.]+%$", line) or re.match(r"(\S.*?)\s{2,}([\d.]+)\s+\S", line)
        if not found:
            break
        rows[found[1]] = float(found[found.lastindex])
    return rows


def measure(options, name, ranks):
    script, variables = SCENES[name]
    with tempfile.TemporaryDirectory(prefix="suffuse-plan-") as scratch:
        folder = pathlib.Path(scratch)
        scene, folder = beside_its_files(ROOT / script, folder)
        words = [options.suffuse, "-in", str(scene)]
        for key, value in variables.items():
            words += ["-var", key, value]
        done = subprocess.run(([options.mpirun, str(ranks)] if ranks > 1 else []) + words, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
        if done.returncode != 0:
            sys.exit(f"{name}: {done.stdout[-2000:]}")
        share = share_on_a_processor(folder)
    planned = table_of(done.stdout, "cost of ")
    taken = table_of(done.stdout, "time in  ")
    return planned, {key: share * value for key, value in taken.items()}, share


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--suffuse", required=True, type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--mpirun", required=True, type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--scenes", nargs="+", choices=list(SCENES), default=list(SCENES))
    parser.add_argument("--within", type=float, default=25, help="per cent")
    parser.add_argument("--repeat", type=int, default=1)
    options = parser.parse_args()
    print("ms a step, planned/taken\n" + f"{'scene':<16}{'ranks':>6}{'fluid':>16}{'mapping':>16}{'forces':>16}{'grains':>16}{'rest':>9}{'together':>16}{'ratio':>7}")
    off = 0
    for ranks in options.ranks:
        for name in options.scenes:
            if ranks > 1 and name in ONE_RANK:
                continue
            turns = [measure(options, name, ranks) for _ in range(options.repeat)]
            planned = min((turn[0] for turn in turns), key=lambda table: table["together"])
            taken = min((turn[1] for turn in turns), key=lambda table: sum(table.values()))
            cells = []
            for key in ("fluid", "solid mapping", "forces on grains", "grains"):
                whole = [sum(value for row, value in table.items() if row.startswith(key)) for table in (planned, taken)]
                cells.append(f"{whole[0]:.3f}/{whole[1]:.3f}")
            known = ("fluid", "solid mapping", "forces on grains", "grains")
            rest = sum(value for row, value in taken.items() if not row.startswith(known))
            whole, all_taken = planned["together"], sum(taken.values())
            ratio = whole / all_taken
            judged = ranks == 1 or max(turn[2] for turn in turns) > 0.9
            off += judged and abs(ratio - 1) > options.within / 100
            print(f"{name:<16}{ranks:>6}" + "".join(f"{cell:>16}" for cell in cells) + f"{rest:>9.3f}" + f"{whole:>8.3f}/{all_taken:<7.3f}{ratio:>7.2f}{'' if judged else '  not judged: other programs had the processors'}", flush=True)
    sys.exit(1 if off else 0)


if __name__ == "__main__":
    main()
