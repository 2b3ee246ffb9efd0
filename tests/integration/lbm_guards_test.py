#!/usr/bin/env python3
"""lbm_guards_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

Faults that one rank alone has (a grain that is driven out of all bounds): first a warning with number and place, then
the end on all ranks within seconds, with one sentence, exit code 4 and the name of a state that is whole and can be taken up. Each
quantity that is watched; a run that goes well says nothing. The wall-time limit ends a run with code 3 and a state.
"""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import Program, columns, expect, mistakes_not_named, program_from_command_line, read_sample, loose_sample, scratch  # noqa: E402
from wet_scenes import WATER, wet_box  # noqa: E402

# Grain 1 is driven along a periodic axis, ever stronger; the others are left to the water.
PUSH = "group one id 1\nvariable push equal 5e-3*step*dt\nfix push one addforce v_push 0 0\n"


def guarded(program, text, folder, name, code=4):
    ended, screen = program.run(text, folder, name, timeout=60)
    expect(ended == code, f"{name}: ended with code {ended}\n{screen[-2500:]}")
    lines = [line for line in screen.splitlines() if line.startswith("suffuse: error:")]
    expect(code != 4 or len(lines) == 1, f"{name}: {len(lines)} sentences\n{screen[-2000:]}")
    warnings = [line for line in screen.splitlines() if line.startswith("lbm run: warning:")]
    return lines[0] if lines else "", warnings, screen


def driven_grain(program, folder):
    """Warned of, saved while the state is good, ended; and taken up without the fault."""
    scene = wet_box(processors=f"{program.ranks} 1 1", restart="start") + WATER + "lbm boundary zlo noslip zhi noslip\n"
    text = scene + PUSH + "lbm monitor m every 1e-3 file m.csv kinetic_energy extremes\n" \
        "lbm restart write state every 100\nlbm run 10\n"
    line, warnings, _ = guarded(program, text, folder, "driven")
    expect(re.search(r"lbm run: (flow|motion of a grain) at .* must stay below .*; .*; the run ended after fluid step \d+, the last good state is in state \(fluid step \d+\)", line), line)
    expect(warnings and re.search(r"(Mach number|motion of a grain) at [-+.e\d]+ s = .* x y z = ", warnings[0]), f"no warning with place and number: {warnings}")
    expect(len(set(warnings)) == len(warnings) <= 3, f"warnings again and again: {warnings}")
    again = wet_box(processors=f"{program.ranks} 1 1", restart="state.grains") + WATER + "lbm boundary zlo noslip zhi noslip\n"
    program.must_run(again + "velocity all set 0 0 0\nlbm restart read state\nlbm run 1e-3\n", folder, "taken up")
    mach = columns(folder / "m.csv")["largest_mach"]
    expect(mach[-1] < 0.3, f"a row of a flow that is lost: Mach {mach[-1]}")


def each_quantity(program, folder):
    scene = wet_box(processors=f"{program.ranks} 1 1", restart="start") + WATER + "lbm boundary zlo pressure 1 zhi pressure 0\n"
    # Two grains that nothing moves, 0.88 of a diameter apart: 1 % of their volume.
    pair = wet_box(grains=0, processors=f"{program.ranks} 1 1").replace("fix motion all nve/sphere\n", "") + \
        "create_atoms 1 single 2e-3 2e-3 2e-3 units box\ncreate_atoms 1 single 2.88e-3 2e-3 2e-3 units box\n" \
        "set group all diameter 1e-3 density 2650\n" + WATER
    for limit, words in (("motion 1e-3", ["motion of a grain", "id ", "cells a fluid step", "timestep of the fluid below"]),
                         ("density 1e-4", ["density", "% from rest", "x y z = "]),
                         ("overlap 1e-3", ["overlap of the grains", "% of their volume", "stiffer contacts"])):
        line, _, _ = guarded(program, (pair if "overlap" in limit else scene) + f"lbm guard {limit}\nlbm run 0.1\n", folder, limit)
        for word in words:
            expect(word in line, f"{limit}: no '{word}' in {line}")
    _, warnings, _ = guarded(program, scene + "lbm run 4e-3\n", folder, "sound", code=0)
    expect(not warnings, f"a run that goes well is warned of: {warnings}")


def lost_grains(program, folder):
    """Through a fixed face that nothing closes, for LIGGGHTS in silence."""
    scene = wet_box(processors=f"{program.ranks} 1 1", restart="start").replace("lost error", "lost ignore")
    scene = re.sub("fix (floor|lid) .*", "", scene) + WATER + "lbm effect lubrication off\nvelocity all set 0 0 -0.05\n"
    _, warnings, screen = guarded(program, scene + "lbm run 0.1\n", folder, "lost", code=0)
    expect(len(warnings) == 1 and "left the box" in warnings[0], f"lost grains: {warnings}\n{screen[-2000:]}")
    line, _, _ = guarded(program, scene + "lbm guard lost stop\nlbm run 0.1\n", folder, "stopped")
    expect("lost grains at" in line and "must be none" in line, line)


def wall_time(program, folder):
    scene = wet_box(processors=f"{program.ranks} 1 1", restart="start") + WATER
    limited = scene + "lbm restart write timed every 1000\nlbm stop after 2s\nlbm run 1000\n"
    _, _, screen = guarded(program, limited, folder, "timed", code=3)
    expect("lbm run: stopped by its wall-time limit after fluid step" in screen and "the state is in timed" in screen, screen[-1500:])
    program.must_run(wet_box(processors=f"{program.ranks} 1 1", restart="timed.grains") + WATER + "lbm restart read timed\nlbm run 1e-3\n", folder)
    _, _, screen = guarded(program, read_sample("sample") + "restart_set dry every 1000000 stop after 1s\nrun 1000000000\n", folder, "dry", code=3)
    expect("run stopped by its wall-time limit after step" in screen, screen[-1500:])
    program.must_run(read_sample("dry.grains") + "run 10\n", folder)
    cases = [(scene + "lbm stop after 2s\nlbm run 1\n", ["lbm stop", "have a place for the state"]),
             (scene + "lbm stop after 2\n", ["lbm stop: time = 2,", "s, min, h or d"]), (scene + "lbm stop 2h\n", ["lbm stop"]),
             (scene + "lbm guard speed 1\n", ["lbm guard", "density, motion"]), (scene + "lbm guard motion 0\n", ["motion"]),
             (scene + "restart_set s every 100\nlbm run 1e-3\n", ["restart_set = on", "be off"]),
             (scene + "restart_set s each 100\n", ["restart_set", "every"]), (scene + "restart_set start every 100\n", ["restart_set: file = start"])]
    amiss = mistakes_not_named(program, cases, folder)
    expect(not amiss, "\n".join(amiss))


def main():
    program = program_from_command_line(__doc__)
    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        one = Program(program.suffuse, program.mpirun, 1)
        one.must_run(wet_box(grains=10) + "write_restart start\n", folder)
        one.must_run(loose_sample(grains=60) + "write_restart sample\n", folder)
        for case in (driven_grain, each_quantity, lost_grains, wall_time):
            case(program, folder)
    print(f"{program.ranks} ranks: guards warn, end all ranks, and leave a state")


if __name__ == "__main__":
    main()
