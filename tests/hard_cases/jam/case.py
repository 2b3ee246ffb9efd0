"""A dense jam under flow

Physics: grains of two sizes pressed together to 65 % and more of the volume, held and free, with water driven through.
Went wrong: cells without any pore between many grains; forces that do not add up to the gradient.
Criterion: held: the water's force on the grains is the gradient's on the box within 2 %; free: no grain moves by more than a tenth of its
diameter, Mach below 0.1.
"""
from wet_grains import DUMP, Water, cubic, grain, last_dump, scene

PRESETS = ("default", "thesis")


def run(bench, preset, full):
    dx, n = 1e-4, 4
    diameter = 6 * dx
    small = 0.72 * diameter  # fits the hole of a simple cubic array: 0.5236 (1 + 0.72^3) = 0.719 of the volume
    water = Water((6 * n,) * 3, 0.8, preset=preset, lines="lbm force pressure_gradient 0 0 1")
    grains = cubic((n, n, n), diameter) + [grain([(k + 1) % n * diameter for k in (i, j, l)], small) for i in range(n) for j in range(n) for l in range(n)]
    after = f"lbm monitor flow every {50 * water.step:.12g} file flow.csv superficial_velocity solid_force extremes\nlbm run {600 * water.step:.12g}\n{DUMP}run 0\n"
    text = scene(bench, water, grains, after, held=True)
    bench.must_run(text)
    flow = bench.series()
    share = flow["solid_force_z_n"][-1] / (water.size[0] * water.size[1] * water.size[2])
    bench.expect(abs(share - 1) < 0.02, f"the water's force is {share:.3f} of the gradient's")
    # The same, free, with the gradient's push taken off each grain in proportion to its volume.
    bench.must_run(scene(bench, water, grains, after, modulus=5e7))
    flow, end = bench.series(), last_dump(bench.folder / "grains.dump")
    bench.expect(max(flow["largest_mach"]) < 0.1, f"Mach {max(flow['largest_mach'])}")
    mean = sum(end["vz"]) / len(end["vz"])
    spread = max(abs(v - mean) for v in end["vz"])
    bench.expect(mean > 0 and spread < 0.1 * mean, f"free grains at {mean} m/s, apart by {spread}")
    return f"held: {share:.4f} of the gradient's force; free: speeds alike to {spread / mean:.1e}"
