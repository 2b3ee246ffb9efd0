#!/usr/bin/env python3
"""campaign_slurm_test.py --programs FOLDER --campaigns DIR: the tiny campaign through the Slurm profile, on a cluster of one node.

Every step that is not local must have been a job that Slurm completed.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from slurm_cluster import Cluster, require_slurm  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programs", required=True, type=pathlib.Path)
    parser.add_argument("--campaigns", required=True, type=pathlib.Path)
    options = parser.parse_args()
    require_slurm("snakemake", "sbatch")
    with tempfile.TemporaryDirectory(prefix="suffuse-slurm-") as scratch:
        folder = pathlib.Path(scratch)
        (folder / "slurm").mkdir()
        (folder / "runs").mkdir()
        cluster = Cluster(folder / "slurm")
        try:
            command = ["snakemake", "-s", str(options.campaigns / "Snakefile"), "--profile", str(options.campaigns / "slurm"), "--directory", str(folder / "runs"),
                       "--configfile", str(options.campaigns / "tiny.yaml"), "--latency-wait", "10"]
            environment = dict(cluster.environment, SUFFUSE_PROGRAMS=str(options.programs.resolve()), XDG_CACHE_HOME=str(folder / "cache"))
            done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=900)
            if done.returncode != 0:
                sys.exit(done.stdout[-3000:])
            completed = (folder / "slurm/completed.txt").read_text()
        finally:
            cluster.end()
        for rule, count in (("equilibrate", 2), ("shear", 1), ("analyse", 2), ("analyse_shear", 1)):
            jobs = [line for line in completed.splitlines() if f"Name={rule} " in line and "JobState=COMPLETED" in line]
            if len(jobs) != count:
                sys.exit(f"{len(jobs)} jobs {rule} were completed, not {count}:\n{completed}")
        for name in ("results.csv", "figure_4_4.png", "figure_5_4.png"):
            if not (folder / "runs" / name).exists():
                sys.exit(f"no {name}")
    print("campaign_slurm: six jobs completed by Slurm, results complete")


if __name__ == "__main__":
    main()
