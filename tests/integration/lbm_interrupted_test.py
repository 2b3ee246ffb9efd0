#!/usr/bin/env python3
"""lbm_interrupted_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

A run that SIGTERM, SIGINT or SIGUSR1 ends: it finishes its fluid step, saves the state where the script asked for restarts, closes its
files, says where it stopped, and ends with 128 and the signal's number; a dry `run` does so, too. Taken up again it leaves the monitor's rows of a run
that was never interrupted. What a state cannot be taken up with is refused. A plan and held grains beside it.
"""
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import QUICK_STARTS_AND_ENDS, Program, columns, expect, mistakes_not_named, program_from_command_line, scratch  # noqa: E402
from wet_scenes import WATER, wet_box  # noqa: E402

FLOW = """
variable inlet equal 2*sin(step*dt/5e-3)
lbm boundary zlo pressure v_inlet zhi pressure 0
variable highest equal bound(all,zmax)
"""
MONITOR = "lbm monitor flow every 5e-4 file {file} superficial_velocity mass grains grains_left 0.8e-3 relative v_highest as rise\n"
# Slow enough for the signal to come while it lasts; ended by it.
LONG = "lbm restart write state.h5 every 1000\nlbm run 1000\n"


def one_program(launcher):
    """The process of one rank, whose parent is mpirun."""
    children = pathlib.Path(f"/proc/{launcher}/task/{launcher}/children").read_text().split()
    programs = [int(child) for child in children if "suffuse" in pathlib.Path(f"/proc/{child}/comm").read_text()]
    expect(programs, f"no rank among {children}")
    return programs[-1]


def interrupted(program, text, folder, sent):
    """Runs the script and sends the signal once the monitor has six rows; (exit code, screen). SIGUSR1 goes to mpirun, which
    passes it on; the others to one rank alone, as all must stop together (mpirun kills its ranks one second after a SIGTERM of
    its own, which a busy machine may not grant)."""
    (folder / "in.stopped").write_text(text)
    launcher = [program.mpirun, str(program.ranks)] if program.ranks > 1 else []
    series = folder / "stopped.csv"
    series.unlink(missing_ok=True)
    with open(folder / "screen", "w") as screen:
        run = subprocess.Popen(launcher + [program.suffuse, "-in", "in.stopped", "-log", "log.stopped", "-echo", "none"], cwd=folder,
                               stdout=screen, stderr=subprocess.STDOUT, env=os.environ | QUICK_STARTS_AND_ENDS)
        start = time.monotonic()
        while run.poll() is None and time.monotonic() - start < 100:
            if series.exists() and series.read_text().count("\n") >= 7:
                break
            time.sleep(0.02)
        expect(run.poll() is None, "ended by itself:\n" + (folder / "screen").read_text()[-2000:])
        os.kill(run.pid if not launcher or sent == signal.SIGUSR1 else one_program(run.pid), sent)
        try:
            code = run.wait(timeout=100)
        except subprocess.TimeoutExpired:
            run.kill()
            sys.exit("the signal does not end the run")
    return code, (folder / "screen").read_text()


def check_exit(code, screen, sent):
    expect(code == 128 + sent, f"exit code {code} after signal {sent}\n{screen[-1500:]}")
    found = re.findall(rf"lbm run: stopped by {signal.Signals(sent).name} after fluid step (\d+) \(([-+.e\d]+) s\)", screen)
    expect(len(found) == 1, f"no one line that says where it stopped:\n{screen[-1500:]}")
    expect(screen.count("solid mapping") == 1, f"no table of times:\n{screen[-1500:]}")
    return int(found[0][0]), float(found[0][1])


def check_continues(program, folder):
    """Interrupted and taken up again against a run of the same length: the same columns and rows. LIGGGHTS sorts grains anew
    when it starts, so sums have another order, which collisions of grains would let grow: they are few. A reference that is lost
    changes a column by all of its range."""
    grid = f"{program.ranks} 1 1"
    start = wet_box(processors=grid, restart="start") + WATER + FLOW
    code, screen = interrupted(program, start + MONITOR.format(file="stopped.csv") + LONG, folder, signal.SIGUSR1)
    step, moment = check_exit(code, screen, signal.SIGUSR1)
    expect("go on with" in screen and (folder / "state.h5").exists() and (folder / "state.h5.grains").exists(),
           f"nothing saved:\n{screen[-1500:]}")
    left = columns(folder / "stopped.csv")
    expect(len(left["time_s"]) >= 6 and left["time_s"][-1] <= moment * (1 + 1e-9), "rows beyond the end, or too few")
    rest = 4e-3
    program.must_run(start + MONITOR.format(file="whole.csv") + f"lbm run {moment + rest}\n", folder, timeout=300)
    whole = columns(folder / "whole.csv")
    again = wet_box(processors=grid, restart="state.h5.grains") + WATER + FLOW + MONITOR.format(file="stopped.csv")
    program.must_run(again + f"lbm restart read state.h5\nlbm run {rest}\n", folder, "again", timeout=300)
    both = columns(folder / "stopped.csv")
    expect(both.keys() == whole.keys() and len(both["time_s"]) == len(whole["time_s"]),
           f"{len(both['time_s'])} rows, not {len(whole['time_s'])}")
    worst = 0.
    for name, values in whole.items():
        size = max(max(values) - min(values), 1e-12 * max(abs(v) for v in values)) or 1
        worst = max(worst, max(abs(a - b) for a, b in zip(values, both[name])) / size)
        expect(worst < 1e-6, f"{name} differs by {worst} of its range after a restart")
    expect(whole["rise"][0] == 1 and whole["rise"][-1] != 1, "nothing changes that a restart could lose")
    expect(whole["mass_change_kg"][-1] != 0 and left["mass_change_kg"][0] == 0, "no mass comes in")
    return step, worst, again


def check_without_restart(program, folder):
    text = wet_box(restart="start") + WATER + FLOW + MONITOR.format(file="stopped.csv") + "lbm run 1000\nprint 'went on'\n"
    for sent in (signal.SIGTERM, signal.SIGINT):
        code, screen = interrupted(program, text, folder, sent)
        check_exit(code, screen, sent)
    expect("nothing saved: `lbm restart write FILE every T`" in screen, f"no remedy:\n{screen[-1500:]}")
    expect("went on" not in screen, "the script goes on after the signal")
    expect("stopped by" in (folder / "log.stopped").read_text(), "the log does not say it")


def check_dry(program, folder):
    """A dry `run` of a script that saves nothing: LIGGGHTS's restart file of the step at which the signal ends it, and how to go on."""
    grid = f"{program.ranks} 1 1"
    print_rows = "variable now equal step\nfix rows all print 20 '${now}' file stopped.csv screen no\n"
    for sent in (signal.SIGUSR1, signal.SIGINT):
        code, screen = interrupted(program, wet_box(processors=grid, restart="start") + print_rows + "run 2000000000\nprint 'went on'\n", folder, sent)
        found = re.findall(rf"^run: stopped by {signal.Signals(sent).name} after step (\d+); the state is in (\S+): go on with `read_restart \2`", screen, re.MULTILINE)
        expect(code == 128 + sent and len(found) == 1 and found[0][1] == f"stopped_{found[0][0]}.restart" and "went on" not in screen,
               f"dry: exit code {code} after signal {sent}\n{screen[-1500:]}")
        screen = program.must_run(wet_box(processors=grid, restart=found[0][1]) + "run 10\nprint 'at step $(step)'\n", folder, "dry")
        expect(f"at step {int(found[0][0]) + 10}" in screen and not list(folder.glob("*.part")), f"not gone on with:\n{screen[-1500:]}")


def check_refusals(program, folder, again):
    """Whatever `lbm clear` would be needed for within a run; values that may change are taken."""
    read = "lbm restart read state.h5\n"
    cases = [(again.replace("relaxation_time 0.515", "relaxation_time 0.53") + read + "lbm run 1e-3\n",
              ["relaxation_time = 0.53", "be 0.515, as it was saved", "may differ"]),
             (again.replace("viscosity 1e-6", "viscosity 2e-6") + read + "lbm run 1e-3\n", ["fluid viscosity = 2e-06", "be 1e-06"])]
    for line, words in (("lbm collision bgk", ["collision operator = bgk", "be trt"]),
                        ("lbm collision trt magic 0.25", ["collision magic = 0.25", "be 0.1875"]),
                        ("lbm solid operator sc3", ["solid operator = sc3", "be force"]),
                        ("lbm solid coefficient 3", ["solid coefficient = 3", "be auto"]),
                        ("lbm solid fraction linear", ["solid fraction = linear", "be exact"]),
                        ("lbm effect turbulence on 0.15", ["effect turbulence = on 0.15", "be auto 0.1"])):
        cases.append((again + line + "\n" + read + "lbm run 1e-3\n", words))
    amiss = mistakes_not_named(program, cases, folder, lambda text: text.splitlines()[-3])
    expect(not amiss, "\n".join(amiss))
    program.must_run(again + "lbm boundary zlo pressure 5 zhi pressure 0\nlbm force gravity 0 0 -9\nlbm couple average_force yes\n" +
                     read + "lbm run 1e-3\n", folder, "values")


def check_plan_and_held(program, folder):
    """A plan leaves the time step and the fixes; grains that nothing moves are warned about once, and in the singular."""
    bare = wet_box(grains=3).replace("fix hydrodynamic_force all hydrodynamic/force\n", "")
    plan = bare + WATER + "variable before equal $(dt)\nlbm plan 0.1\nvariable same equal $(dt==v_before)\n" \
        "print \"step kept: ${same}\"\nfix own all hydrodynamic/force\nlbm run 1e-3\n"
    screen = program.must_run(plan, folder, "plan")
    expect("step kept: 1" in screen, f"a plan changes the time step:\n{screen[-1500:]}")
    held = bare.replace("fix motion all nve/sphere\n", "") + WATER + "group one id 1\nvelocity one set 0.01 0 0\n"
    screen = program.must_run(held + "lbm run 1e-4\nlbm run 1e-4\n", folder, "held")
    expect(screen.count("note: 1 grain that no fix moves still has a velocity (up to 0.01 m/s)") == 1, f"no one warning:\n{screen[-3000:]}")
    expect("velocity GROUP set 0 0 0" in screen, "no remedy")
    expect(("on 1 rank," in screen) == (program.ranks == 1) and "1 ranks" not in screen, "plural of one")
    screen = program.must_run(held + "velocity all set 0 0 0\nlbm run 1e-4\n", folder, "still")
    expect("still ha" not in screen, "a warning about grains at rest")


def main():
    program = program_from_command_line(__doc__)
    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        Program(program.suffuse, program.mpirun, 1).must_run(wet_box(grains=6) + "write_restart start\n", folder)
        step, worst, again = check_continues(program, folder)
        check_refusals(program, folder, again)
        check_without_restart(program, folder)
        check_dry(program, folder)
        check_plan_and_held(program, folder)
    print(f"{program.ranks} ranks: stopped at step {step}; rows after a restart within {worst:.1e} of each column's range")


if __name__ == "__main__":
    main()
