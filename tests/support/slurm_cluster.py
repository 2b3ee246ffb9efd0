"""A cluster of one node by Slurm, for tests: munged, slurmctld and slurmd with a configuration of its own, started and ended as root."""
import os
import pathlib
import secrets
import shutil
import signal
import socket
import subprocess
import sys
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
        sys.exit(f"{pathlib.Path(sys.argv[0]).stem}: {what}\n{logs}")

    def end(self):
        for daemon in reversed(self.daemons):
            daemon.send_signal(signal.SIGTERM)
            try:
                daemon.wait(timeout=20)
            except subprocess.TimeoutExpired:
                daemon.kill()


def require_slurm(*programs):
    """Skips the test where it cannot be done, and lets the daemons be found."""
    os.environ["PATH"] += ":/usr/sbin"
    missing = [name for name in ("munged", "slurmctld", "slurmd", *programs) if shutil.which(name) is None]
    if missing or os.getuid() != 0:
        print(f"skipped: {'needs root' if not missing else 'no ' + ', '.join(missing) + '; scripts/install_packages check long'}")
        sys.exit(SKIPPED)
