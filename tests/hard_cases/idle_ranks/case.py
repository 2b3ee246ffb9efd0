"""Seven ranks in a row, most of them without grains

Physics: how the box is cut must not matter.
Went wrong: ranks without grains or with a few planes hang, or sum other numbers.
Criterion: after 40 steps positions on 1 x 1 x 7 and 7 x 1 x 1 ranks are those on one rank to 1e-6 of a diameter: loads along a row of
cells are added up in single precision, in another grouping where the row is cut, and collisions amplify that.
"""
from wet_grains import DUMP, Water, last_dump, scattered, scene


def run(bench, preset, full):
    water = Water((28, 12, 28), 0.6, {"zlo": "noslip", "zhi": "noslip"}, 9.81)
    grains = scattered(6, 4 * water.spacing, [0.35 * water.size[0], water.size[1], 0.35 * water.size[2]], walls="fpf")
    ends = {}
    for ranks, parts in ((1, "1 1 1"), (7, "1 1 7"), (7, "7 1 1")):
        bench.must_run(scene(bench, water, grains, f"lbm run {40 * water.step:.12g}\n{DUMP}run 0\n", periodic="ppf", processors=parts), ranks)
        ends[parts] = last_dump(bench.folder / "grains.dump")
    largest = max(abs(a - b) for parts in ends for axis in "xyz" for a, b in zip(ends["1 1 1"][axis], ends[parts][axis]))
    bench.expect(largest < 4e-10, f"positions differ by {largest} m")
    return f"positions on 7 ranks alike to {largest:.1e} m"
