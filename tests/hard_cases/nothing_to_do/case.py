"""No gravity, no gradient, no grains, one grain, one cell thick

Physics: without a cause nothing moves.
Went wrong: divisions by the number of grains, the flow or the height; faces that meet in a lattice one cell thick.
Criterion: the water's speed is exactly 0, all numbers of the monitor are finite, the mass does not change.
"""
import math

from wet_grains import Water, grain, scene

PRESETS = ("default", "thesis")
QUANTITIES = "superficial_velocity hydraulic_gradient solid_force mass kinetic_energy extremes grains"


def run(bench, preset, full):
    done = 0
    for cells in ((8, 8, 8), (1, 8, 8), (8, 1, 1)):
        for count in (0, 1):
            water = Water(cells, 0.8, {}, 0, preset)
            grains = [grain([0.5 * s for s in water.size], 0.8 * water.spacing)] * count
            bench.must_run(scene(bench, water, grains, f"lbm monitor flow every {10 * water.step:.12g} file flow.csv {QUANTITIES}\nlbm run {40 * water.step:.12g}\n"))
            flow = bench.series()
            bench.expect(all(math.isfinite(value) for column in flow.values() for value in column), f"{cells}, {count} grains: {flow}")
            bench.expect(max(flow["largest_mach"]) == 0 and max(map(abs, flow["mass_change_kg"])) == 0, f"{cells}, {count} grains: something moves: {flow}")
            done += 1
    return f"{done} boxes at rest to the last digit"
