#!/usr/bin/env python3
"""study_slurm_test.py --study PROGRAM --scenes DIR: a study inside an allocation of Slurm, its runs as steps by srun, on a cluster of one node.

Two runs of one rank stand beside each other, as Slurm's own record of the steps tells; a run of two ranks is one of two ranks; a study
that is ended by SIGTERM leaves no step behind and goes on with --resume.
"""
import argparse
import csv
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from scenes import expect  # noqa: E402
from slurm_cluster import Cluster, require_slurm  # noqa: E402

SRUN = "srun --mpi=pmix --exact -n {ranks}"
# Each step tells the seconds at which it begins and ends; a value above 5 stops it.
SCRIPT = """
variable value index 1
shell date +%s.%N > begins
shell sleep ${value}
print "quantity,value" file result.csv
print "answer,${value}" append result.csv
if "${value} > 5" then "no_such_command"
shell date +%s.%N > ends
"""
STUDY = """
script   = "in.steps"
launcher = "srun --mpi=pmix --exact -n {ranks}"
[sweep]
value = [2, 2.1, 0.1, 5.1]
[[quantity]]
name = "answer"
file = "result.csv"
"""
TANK = """
script = "SCENES/05_settling_sphere/in.settling_sphere"
ranks  = 2
[fixed]
case = "E2"
[sweep]
resolution = [3]
[[quantity]]
name = "peak_speed"
file = "settling_result.csv"
"""


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


class Allocation:
    """Commands inside an allocation of both cores of the node."""

    def __init__(self, program, folder, environment):
        self.program, self.folder, self.environment = program, folder, environment

    def study(self, *words, limit=None):
        ended = ["timeout", str(limit)] if limit else []
        done = subprocess.run(["salloc", "-Q", "-n", "2", *ended, self.program, *words, "--no-figure"], cwd=self.folder, env=self.environment,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=200)
        return done.returncode, done.stdout

    def steps(self):
        return subprocess.run(["squeue", "-s", "-h", "-o", "%j"], env=self.environment, capture_output=True, text=True).stdout.split()


def check_steps(slurm):
    """Ended after a second, gone on with: two at once, one failure."""
    (slurm.folder / "in.steps").write_text(SCRIPT)
    (slurm.folder / "steps.toml").write_text(STUDY)
    words = ("steps.toml", "--cores", "2", "--resume", "--out", "steps")
    _, out = slurm.study(*words, limit=1.5)
    expect("interrupted: 0 of 4 runs are done" in out, f"not interrupted: {out}")
    expect(slurm.steps() == [], f"steps are left: {slurm.steps()}")
    code, out = slurm.study(*words)
    expect(code == 0, out)
    found = rows(slurm.folder / "steps/study.csv")
    expect([row["status"] for row in found] == ["finished", "finished", "finished", "failed"], f"{found}")
    expect("no_such_command" in found[3]["reason"], f"{found[3]}")
    began, ended = ({row["value"]: float((slurm.folder / f"steps/runs/value={row['value']}" / name).read_text()) for row in found[:3]} for name in ("begins", "ends"))
    expect(began["2.1"] < ended["2"] and began["2"] < ended["2.1"], f"one after another: {began}, {ended}")
    # Ranks that are no children are counted as ranks x seconds.
    expect(all(abs(float(row["core_s"]) / float(row["wall_s"]) - 1) < 0.01 for row in found), f"{found}")


def check_ranks(slurm, scenes):
    (slurm.folder / "tank.toml").write_text(TANK.replace("SCENES", str(scenes)))
    code, out = slurm.study("tank.toml", "--launcher", SRUN, "--cores", "2", "--out", "tank")
    expect(code == 0, out)
    row = rows(slurm.folder / "tank/study.csv")[0]
    log = (slurm.folder / "tank/runs/resolution=3/log.liggghts").read_text()
    expect("MPI processor grid" in log and log.count("1 by 1 by 2") == 1, f"not on two ranks: {log[:800]}")
    expect(abs(float(row["core_s"]) / float(row["wall_s"]) - 2) < 0.01 and 0.04 < float(row["peak_speed"]) < 0.07, f"{row}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--study", required=True, type=pathlib.Path)
    parser.add_argument("--scenes", required=True, type=pathlib.Path)
    options = parser.parse_args()
    require_slurm("srun", "salloc", "squeue")
    with tempfile.TemporaryDirectory(prefix="suffuse-slurm-") as scratch:
        folder = pathlib.Path(scratch).resolve()
        (folder / "slurm").mkdir()
        cluster = Cluster(folder / "slurm")
        try:
            slurm = Allocation(str(options.study.resolve()), folder, cluster.environment)
            check_steps(slurm)
            check_ranks(slurm, options.scenes.resolve())
        finally:
            cluster.end()
    print("study_slurm: runs as steps of Slurm, beside each other, interrupted, resumed, on two ranks")


if __name__ == "__main__":
    main()
