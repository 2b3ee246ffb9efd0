"""Frictional fines between large grains: where they come to rest, and that they stay

Physics: a fine grain is dropped into the pocket of three large ones that touch, 3 or 5 times its size; it rests on them. One a tenth of
their size falls through, sliding and rolling along them, to the floor. No water.
Went wrong: tangential velocities split with the normal of another instant: a small grain sticks where it should fall, and its path
depends on the time step (vyas2025); springs that creep under gravity.
Criterion: at rest slower than 1e-7 m/s, and displaced by less than 1e-8 of a diameter within 20,000 further steps; with half the step it ends
within 2 % of its diameter of the same place, or, through the hole, on the floor too.
"""
import math

from scenes import HEADER, material
from wet_grains import DUMP, last_dump

LARGE = 1e-3  # m, radius


def script(ratio, step):
    pocket = LARGE * 2 / math.sqrt(3)  # from the middle to the centres of the three
    fine = LARGE / ratio
    centres = [(5e-3 + pocket * math.cos(a), 5e-3 + pocket * math.sin(a)) for a in (math.pi / 2, math.pi * 7 / 6, math.pi * 11 / 6)]
    start = LARGE + math.sqrt(max(0.0, (LARGE + fine) ** 2 - pocket ** 2)) + 1.05 * fine
    if ratio > 6:  # over the hole, off its middle
        start = 2 * LARGE
    large = "\n".join(f"create_atoms 1 single {x:.12g} {y:.12g} {LARGE} units box" for x, y in centres)
    return HEADER.format(boundary="f f f") + f"""
region box block 0 1e-2 0 1e-2 0 1e-2 units box
create_box 1 box
{large}
set group all diameter {2 * LARGE} density 2650
group large id 1 2 3
create_atoms 1 single {5e-3 + 0.04 * fine:.12g} {5e-3 + 0.03 * fine:.12g} {start:.12g} units box
group fine id 4
set group fine diameter {2 * fine:.12g} density 2650
{material(0.5 * fine, 7e7, 0.3, 0.3)}fix floor all wall/gran model hertz tangential history primitive type 1 zplane 0
fix weight fine gravity 9.81 vector 0 0 -1
fix motion fine nve/sphere
timestep {step:.12g}
thermo 10000000
run {int(0.15 / step)}
{DUMP}run 0
undump grains
run 20000
""" + DUMP.replace("grains.dump", "later.dump") + "run 0\n"


def end(bench, ratio, step):
    bench.must_run(script(ratio, step))
    rest, later = last_dump(bench.folder / "grains.dump"), last_dump(bench.folder / "later.dump")
    places = [[state[axis][3] for axis in "xyz"] for state in (rest, later)]
    speed = math.sqrt(sum(later["v" + axis][3] ** 2 for axis in "xyz"))
    return places[1], math.dist(*places), speed


def run(bench, preset, full):
    reached = []
    for ratio in (3, 5, 10):
        fine = LARGE / ratio
        places = {}
        for step in (2e-6 / ratio, 1e-6 / ratio):
            places[step], creep, speed = end(bench, ratio, step)
            if ratio < 6:
                bench.expect(speed < 1e-7 and creep < 1e-8 * 2 * fine, f"ratio {ratio}: {speed:.1e} m/s at rest, creeps by {creep / (2 * fine):.1e} of its diameter")
            else:
                bench.expect(places[step][2] < 1.01 * fine, f"ratio {ratio}: stuck at {places[step][2] / fine:.2f} radii above the floor")
        apart = math.dist(*places.values()) / (2 * fine)
        if ratio < 6:
            bench.expect(apart < 0.02, f"ratio {ratio}: half the step ends {apart:.3f} diameters away")
            reached.append(f"ratio {ratio}: at rest, half the step {apart:.1e} diameters away")
        else:
            reached.append(f"ratio {ratio}: falls through")
    return "; ".join(reached)
