"""A grain driven into the inlet's and the outlet's pressure face, and held in it

Physics: grains that stand across a face with a given pressure, held or driven against it by the flow, leave the water a way around.
Went wrong: the face's equilibrium ignores the solid in its cells: the density there drifts, or the Mach number passes every bound.
Criterion: Mach below 0.1 throughout, the density within 3 %, the flow in the direction of the gradient, and as large with the grains in the
faces as without within a factor of 3.
"""
from wet_grains import Water, grain, scene

PRESETS = ("default", "thesis")


def flow_of(bench, preset, grains, held, pressure):
    water = Water((16, 16, 40), 0.6, {"zlo": f"pressure {pressure}", "zhi": "pressure 0"}, 0, preset)
    after = f"lbm monitor flow every {50 * water.step:.12g} file flow.csv superficial_velocity extremes\nlbm run {1500 * water.step:.12g}\n"
    bench.must_run(scene(bench, water, grains, after, periodic="ppf", held=held))
    flow = bench.series()
    bench.expect(max(flow["largest_mach"]) < 0.1, f"Mach {max(flow['largest_mach'])}")
    density = max(abs(1 - d) for name in ("smallest_density_lattice", "largest_density_lattice") for d in flow[name])
    bench.expect(density < 0.03, f"density off by {density}")
    return flow["superficial_velocity_z_m_per_s"][-1]


def run(bench, preset, full):
    dx = 1e-4
    free = [grain((8 * dx, 8 * dx, 20 * dx), 5 * dx)]
    across = [grain((8 * dx, 8 * dx, 0.4 * dx), 5 * dx), grain((8 * dx, 8 * dx, 39.7 * dx), 5 * dx)]
    without = flow_of(bench, preset, free, True, 0.01)
    held = flow_of(bench, preset, across, True, 0.01)
    driven = flow_of(bench, preset, [grain((8 * dx, 8 * dx, 30 * dx), 5 * dx, velocity=(0, 0, 0.005)), grain((3 * dx, 8 * dx, 6 * dx), 5 * dx, velocity=(0, 0, -0.005))], False, 0.01)
    for name, flow in (("held across", held), ("driven", driven)):
        bench.expect(without / 3 < flow < 3 * without, f"{name}: {flow} m/s, without grains in the faces {without}")
    return f"flow with grains held across the faces {held / without:.2f}, driven into them {driven / without:.2f} of that without"
