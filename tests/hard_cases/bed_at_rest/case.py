"""A bed at rest for a long time

Physics: grains that lie in water at rest stay where they are: no creep, no heating, no change of the water's mass.
Went wrong: the load of a step shakes contacts; round-off in float drifts.
Criterion: over 20,000 fluid steps (1e6 with --full) after settling no grain with three contacts moves by more than 2e-6 of a diameter (1e-5). One
with fewer rolls over the floor under the least push, as long as it lasts: its distance says nothing, its speed says how large the push is. It rolls
at less than a millionth of its Stokes velocity, so that the push is less than about a millionth of its weight in water (in five beds 2e-7 at most,
for the one grain that touches the floor alone). The kinetic energy of all grains stays below 1e-12 of what it is at that velocity, for the same reason
(growth from one sample to another says nothing there: a grain that rolls is faster here and slower there). The mass of the lattice stays to 1e-10 (double) and
1e-6 (float).
"""
import math

from wet_grains import DUMP, Water, last_dump, scattered, scene, stokes_velocity


# s. A grain that lies on the edge between two others takes its time to tip over it: in this bed 2.8 s, by the coefficient of its cells.
SETTLED = 3.2


def displacements(start, end, size, diameter):
    """The largest of the grains with three contacts or more, the floor's among them, and of the others; in diameters."""
    count = len(start["x"])

    def apart(one, i, other, j):
        square = 0.0
        for axis, length in zip("xyz", size):
            step = abs(one[axis][i] - other[axis][j])
            square += (min(step, length - step) if axis != "z" else step) ** 2
        return math.sqrt(square) / diameter

    largest = {True: 0.0, False: 0.0}
    for i in range(count):
        contacts = sum(apart(start, i, start, j) < 1 for j in range(count) if j != i) + (start["z"][i] < 0.5 * diameter)
        largest[contacts >= 3] = max(largest[contacts >= 3], apart(start, i, end, i))
    return largest[True], largest[False]


def creep(bench, precision, steps, full):
    water = Water((12, 12, 30), 0.53, {"zlo": "noslip", "zhi": "noslip"}, 9.81, "default", precision=precision)
    diameter, size = 4 * water.spacing, water.size
    grains = scattered(24, diameter, size, walls="ppf")
    after = f"lbm run {SETTLED}\n{DUMP}run 0\nundump grains\n" + DUMP.replace("grains.dump", "after.dump") + \
        "dump_modify grains every 1000000000\n" + f"lbm monitor flow every {steps / 10 * water.step:.12g} file flow.csv mass kinetic_energy\n" \
        f"lbm run {steps * water.step:.12g}\ndump_modify grains every 1\nrun 0\n"
    bench.must_run(scene(bench, water, grains, after, periodic="ppf", friction=0.5), timeout=3000)
    flow, start, end = bench.series(), last_dump(bench.folder / "grains.dump"), last_dump(bench.folder / "after.dump")
    held, free = displacements(start, end, size, diameter)
    rolling = free * diameter / (steps * water.step) / stokes_velocity(diameter, water.gravity)
    mass = max(map(abs, flow["mass_change_kg"])) / (1000 * size[0] * size[1] * size[2])
    energy = flow["grains_kinetic_energy_j"]
    bench.expect(held < (1e-5 if full else 2e-6), f"{precision}: a grain with three contacts creeps by {held:.1e} of a diameter")
    bench.expect(rolling < 1e-6, f"{precision}: a grain rolls at {rolling:.1e} of its Stokes velocity")
    falling = sum(g["density"] * math.pi / 12 * g["diameter"] ** 3 for g in grains) * stokes_velocity(diameter, water.gravity) ** 2
    bench.expect(max(energy[1:]) < 1e-12 * falling, f"{precision}: the energy rises to {max(energy[1:]) / falling:.1e} of that of falling grains")
    bench.expect(mass < (1e-10 if precision == "double" else 1e-6), f"{precision}: the mass drifts by {mass:.1e}")
    return held, rolling, mass


def run(bench, preset, full):
    steps, reached = 1000000 if full else 20000, []
    for precision in ("double", "float"):
        held, rolling, mass = creep(bench, precision, steps, full)
        reached.append(f"{precision}: grains with three contacts creep by {held:.1e} of a diameter, others roll at {rolling:.1e} of their Stokes velocity, mass {mass:.1e}")
    return "; ".join(reached)
