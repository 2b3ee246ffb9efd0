#!/usr/bin/env python3
"""campaign_slurm.py --programs FOLDER --campaigns DIR: the tiny campaign through the Slurm profile, on a cluster of one node.

Starts munged, slurmctld and slurmd with a configuration of its own, as root, and ends them. Every step that is not local must
have been a job that Slurm completed.
"""
import argparse
import os
import pathlib
import secrets
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
CONFIGURATION = """
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={port}
SlurmdPort={port_of_node}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
MpiDefault=none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
JobCompType=jobcomp/filetxt
JobCompLoc={folder}/completed.txt
MinJobAge=600
NodeName=one NodeHostname={host} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=one Default=YES MaxTime=INFINITE State=UP
"""


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Cluster:
    def __init__(self, folder):
        self.folder, self.daemons = folder, []
        for name in ("state", "spool"):
            (folder / name).mkdir()
        (folder / "munge.key").write_bytes(secrets.token_bytes(128))
        (folder / "munge.key").chmod(0o400)
        (folder / "slurm.conf").write_text(CONFIGURATION.format(folder=folder, host=socket.gethostname().split(".")[0], user="root", port=free_port(),
                                                                port_of_node=free_port()))
        self.environment = dict(os.environ, SLURM_CONF=str(folder / "slurm.conf"))
        self.start("munged", "--foreground", "--force", f"--key-file={folder}/munge.key", f"--socket={folder}/munge.socket",
                   f"--pid-file={folder}/munged.pid", f"--log-file={folder}/munged.log", f"--seed-file={folder}/munged.seed")
        self.wait(lambda: (folder / "munge.socket").exists(), "munged makes no socket")
        self.start("slurmctld", "-D")
        self.start("slurmd", "-D", "-N", "one")
        self.wait(lambda: "idle" in subprocess.run(["sinfo", "-h", "-o", "%t"], env=self.environment, capture_output=True, text=True).stdout,
                  "the node does not become idle")

    def start(self, *command):
        with open(self.folder / f"{command[0]}.out", "w") as out:
            self.daemons.append(subprocess.Popen(command, env=self.environment, stdout=out, stderr=subprocess.STDOUT, start_new_session=True))

    def wait(self, true, what):
        for _ in range(300):
            if true():
                return
            time.sleep(0.1)
        logs = "\n".join(f"{path}:\n{path.read_text()[-800:]}" for path in sorted(self.folder.glob("*.log")) + sorted(self.folder.glob("*.out")))
        self.end()
        sys.exit(f"campaign_slurm: {what}\n{logs}")

    def end(self):
        for daemon in reversed(self.daemons):
            daemon.send_signal(signal.SIGTERM)
            try:
                daemon.wait(timeout=20)
            except subprocess.TimeoutExpired:
                daemon.kill()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programs", required=True, type=pathlib.Path)
    parser.add_argument("--campaigns", required=True, type=pathlib.Path)
    options = parser.parse_args()
    missing = [name for name in ("snakemake", "munged", "slurmctld", "slurmd", "sbatch") if shutil.which(name, path=os.environ["PATH"] + ":/usr/sbin") is None]
    if missing or os.getuid() != 0:
        print(f"skipped: {'needs root' if not missing else 'no ' + ', '.join(missing) + '; scripts/install_packages check long'}")
        sys.exit(SKIPPED)
    os.environ["PATH"] += ":/usr/sbin"
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
