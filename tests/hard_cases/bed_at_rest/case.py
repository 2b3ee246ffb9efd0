"""A bed at rest for a long time

Physics: grains that lie in water at rest stay where they are: no creep, no heating, no change of the water's mass.
Went wrong: the load of a step shakes contacts; round-off in float drifts.
Criterion: over 20,000 fluid steps (1e6 with --full) after settling no grain moves by more than 1e-4 of a diameter, the kinetic energy of
grains does not grow, the mass of the lattice stays to 1e-10 (double) and 1e-6 (float).
"""
from wet_grains import DUMP, Water, last_dump, scattered, scene


def creep(bench, precision, steps):
    water = Water((12, 12, 30), 0.53, {"zlo": "noslip", "zhi": "noslip"}, 9.81, "default", precision=precision)
    diameter, size = 4 * water.spacing, water.size
    grains = scattered(24, diameter, size, walls="ppf")
    after = f"lbm run 0.6\n{DUMP}run 0\nundump grains\n" + DUMP.replace("grains.dump", "after.dump") + \
        "dump_modify grains every 1000000000\n" + f"lbm monitor flow every {steps / 10 * water.step:.12g} file flow.csv mass kinetic_energy\n" \
        f"lbm run {steps * water.step:.12g}\ndump_modify grains every 1\nrun 0\n"
    bench.must_run(scene(bench, water, grains, after, periodic="ppf", friction=0.5), timeout=3000)
    flow, start, end = bench.series(), last_dump(bench.folder / "grains.dump"), last_dump(bench.folder / "after.dump")
    moved = max(abs(a - b) for axis in "xyz" for a, b in zip(start[axis], end[axis]) if abs(a - b) < 0.5 * size["xyz".index(axis)]) / diameter
    mass = max(map(abs, flow["mass_change_kg"])) / (1000 * size[0] * size[1] * size[2])
    energy = flow["grains_kinetic_energy_j"]
    bench.expect(moved < 1e-4, f"{precision}: a grain creeps by {moved:.1e} of a diameter")
    bench.expect(energy[-1] <= 2 * max(energy[1:4]), f"{precision}: the energy grows: {energy}")
    bench.expect(mass < (1e-10 if precision == "double" else 1e-6), f"{precision}: the mass drifts by {mass:.1e}")
    return moved, mass


def run(bench, preset, full):
    steps = 1000000 if full else 20000
    return "; ".join(f"{precision}: creep {moved:.1e} of a diameter, mass {mass:.1e}" for precision in ("double", "float")
                     for moved, mass in [creep(bench, precision, steps)])
