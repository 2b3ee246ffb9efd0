"""Grains of 0.5, 0.9, 1.0, 1.1 and 2.65 times the water's density

Physics: in water under gravity a grain of the water's density stays where it is, lighter ones rise and heavier ones sink; as long as
inertia is small the speed goes with the difference of the densities.
Went wrong: explicit coupling of forces is unstable for light grains, whose added mass is larger than their own.
Criterion: at 1.0 no faster than 1e-6 of the speed at 1.1; those at 0.9 and 1.1 alike within 1 %, those at 0.5 and 2.65 in proportion to
the difference within 10 % (the Reynolds number is 0.3 there); default settings. The thesis's preset has no virtual mass: it may be stopped
by the program.
"""
from wet_grains import DUMP, Water, grain, last_dump, scene

PRESETS = ("default", "thesis")


def speed(bench, preset, ratio):
    water = Water((24, 24, 40), 0.8, {"zlo": "noslip", "zhi": "noslip"}, 0.0981, preset)
    diameter = 5 * water.spacing
    code, screen = bench.run(scene(bench, water, [grain([0.5 * s for s in water.size], diameter, 1000 * ratio)], f"lbm run 0.15\n{DUMP}run 0\n", periodic="ppf"))
    if code != 0:
        bench.expect(preset == "thesis" and code == 4 and "suffuse: error:" in screen, f"density ratio {ratio}: code {code}\n{screen[-1500:]}")
        return None
    return last_dump(bench.folder / "grains.dump")["vz"][0]


def run(bench, preset, full):
    v = {ratio: speed(bench, preset, ratio) for ratio in (0.5, 0.9, 1.0, 1.1, 2.65)}
    if None not in v.values():
        bench.expect(v[1.1] < 0 < v[0.9] and v[2.65] < 0 < v[0.5], f"{v}")
        bench.expect(abs(v[1.0]) < 1e-6 * abs(v[1.1]), f"a neutral grain moves at {v[1.0]} m/s")
    if preset == "default":
        bench.expect(abs(v[0.9] / -v[1.1] - 1) < 0.01, f"0.9 and 1.1: {v[0.9]} and {v[1.1]} m/s")
        for ratio in (0.5, 2.65):
            proportion = v[ratio] / v[1.1] * 0.1 / (ratio - 1)
            bench.expect(abs(proportion - 1) < 0.1, f"{ratio}: {proportion:.3f} of the speed in proportion")
    return ", ".join(f"{ratio}: " + ("stopped" if x is None else f"{1e3 * x:+.3g} mm/s") for ratio, x in v.items())
