#!/usr/bin/env python3
"""one_rank_faults_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

What the last rank alone meets, while the others go on and wait for it, ends all of them within seconds, with a sentence and the exit
code of its kind: a file that only it cannot write, a force on one of its grains that is no number, a signal.
"""
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import Program, expect, program_from_command_line, scratch  # noqa: E402
from wet_scenes import WATER, wet_box  # noqa: E402

SECONDS = 60  # 20 s of patience and the start on a loaded machine


def wet(program):
    return wet_box(processors=f"{program.ranks} 1 1", restart="start") + WATER + "lbm boundary zlo noslip zhi noslip\n"


def last_rank(run, ranks):
    """Process of the last rank under a launcher."""
    for child in pathlib.Path(f"/proc/{run.pid}/task/{run.pid}/children").read_text().split():
        if f"OMPI_COMM_WORLD_RANK={ranks - 1}\0" in pathlib.Path(f"/proc/{child}/environ").read_text():
            return int(child)
    return None


def met(program, text, folder, name, codes, sentence, fault=None):
    """Once the run has taken steps the last rank meets the fault; all end by themselves, with one of the codes, and say why."""
    (folder / f"in.{name}").write_text(text)
    (folder / "m.csv").unlink(missing_ok=True)
    run = subprocess.Popen([program.mpirun, str(program.ranks), program.suffuse, "-in", f"in.{name}", "-log", "none", "-echo", "none"],
                           cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                           preexec_fn=lambda: signal.signal(signal.SIGXFSZ, signal.SIG_IGN))
    try:
        if fault:
            end = time.monotonic() + SECONDS
            while time.monotonic() < end and not ((folder / "m.csv").exists() and (folder / "m.csv").read_text().count("\n") > 2):
                time.sleep(0.05)
            fault(last_rank(run, program.ranks))
        screen = run.communicate(timeout=SECONDS)[0].decode(errors="replace")
    except subprocess.TimeoutExpired:
        run.send_signal(signal.SIGTERM)
        sys.exit(f"{name}: ranks are left hanging\n{run.communicate(timeout=SECONDS)[0].decode(errors='replace')[-2000:]}")
    expect(run.returncode in codes, f"{name}: ended with code {run.returncode}, not {codes}\n{screen[-2500:]}")
    expect(re.search(sentence, screen), f"{name}: no '{sentence}' in\n{screen[-2500:]}")
    expect("internal error" not in screen, f"{name}:\n{screen[-2500:]}")


def refused_files(program, folder):
    """Files that the last rank alone may not make longer: its part of an output in parallel."""
    text = wet(program) + "lbm monitor m every 1e-4 file m.csv mass\nlbm output o every 1e-4 file o.h5 velocity pressure\nlbm run 1000\n"
    met(program, text, folder, "output", {1}, "suffuse: error: .*o.h5",
        lambda process: resource.prlimit(process, resource.RLIMIT_FSIZE, (1000, 1000)))


def number_lost(program, folder):
    """Grain 1 belongs to one rank; a push makes its velocity no number there."""
    push = "group one id 1\nvariable push equal 1e308*1e10-1e308*1e10\nfix push one addforce v_push 0 0\n"
    met(program, wet(program) + push + "lbm run 1e-2\n", folder, "number", {4}, "suffuse: error: lbm run: motion of a grain at .* not a number")


def signals(program, folder):
    """SIGTERM: an orderly end of all with the state saved. SIGKILL: the launcher ends the others."""
    text = wet(program) + "lbm monitor m every 1e-4 file m.csv mass\nlbm restart write t every 1000\nlbm run 1000\n"
    for number, code, sentence in ((signal.SIGTERM, 143, "stopped by SIGTERM after fluid step .*the state is in"), (signal.SIGKILL, 137, "signal 9")):
        met(program, text, folder, f"signal {number}", {code}, sentence, lambda process: os.kill(process, number))  # noqa: B023


def main():
    program = program_from_command_line(__doc__)
    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        Program(program.suffuse, program.mpirun, 1).must_run(wet_box(grains=6) + "write_restart start\n", folder)
        for case in (refused_files, number_lost, signals):
            case(program, folder)
    print(f"{program.ranks} ranks: what one of them meets ends all, with a sentence")


if __name__ == "__main__":
    main()
