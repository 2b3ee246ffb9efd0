"""Across rank borders and periodic faces at speed; a grain larger than a rank's part

Physics: a heavy grain flies 3 times round a periodic box through water, another, of 14 cells, spans several ranks' parts of the lattice.
Went wrong: half-mapped grains at borders, loads summed twice or not at all, the velocity of the wrong image.
Criterion: positions on 2 and 4 ranks are those on one rank to 1e-10 m; energy never rises by
more than the sound waves in the box hold (1e-3 of the start).
"""
from wet_grains import DUMP, Water, grain, last_dump, scene


def run(bench, preset, full):
    water = Water((24, 24, 32), 0.6)
    dx = water.spacing
    grains = [grain((6 * dx, 5 * dx, 9 * dx), 5 * dx, 8000, (water.speed(0.02), water.speed(0.01), water.speed(0.05))),
              grain((14 * dx, 15 * dx, 20 * dx), 14 * dx, 1500, (0, 0, -water.speed(0.01)))]
    ends = {}
    for ranks, parts in ((1, "1 1 1"), (2, "1 1 2"), (4, "1 2 2")):
        text = scene(bench, water, grains, f"lbm monitor flow every {20 * water.step:.12g} file flow.csv kinetic_energy mass\nlbm run {800 * water.step:.12g}\n{DUMP}run 0\n",
                     processors=parts)
        bench.must_run(text, ranks)
        ends[parts] = last_dump(bench.folder / "grains.dump")
        flow = bench.series()
        energy = [a + b for a, b in zip(flow["fluid_kinetic_energy_j"], flow["grains_kinetic_energy_j"])]
        rise = max(b - a for a, b in zip(energy, energy[1:])) / energy[0]
        bench.expect(rise <= 1e-3, f"{parts}: the energy rises by {rise:.2e} of its start")
    largest = max(abs(a - b) for parts in ends for axis in "xyz" for a, b in zip(ends["1 1 1"][axis], ends[parts][axis]))
    bench.expect(largest < 1e-10, f"positions differ by {largest} m")
    return f"positions on 1, 2 and 4 ranks alike to {largest:.1e} m"
