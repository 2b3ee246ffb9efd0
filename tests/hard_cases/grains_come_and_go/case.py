"""Insertion into flow, deletion at the outlet, all grains leaving, delete_atoms between runs

Physics: grains appear in moving water, are carried out and removed; in the end none is left, and new ones are put in.
Went wrong: loads of grains that are gone, cells that stay solid, a division by the number of grains.
Criterion: the run goes through; the water's mass plus what the faces let through is kept as well as the monitor's trapezoidal rule can tell; with the
last grain the solid fraction is 0 and the flow that of a free channel: uniform, faster than with grains; positions stay in the box.
"""
from wet_grains import Water, scattered, scene

PRESETS = ("default", "thesis")


def run(bench, preset, full):
    water = Water((16, 16, 40), 0.6, {"xlo": "noslip", "xhi": "noslip", "ylo": "noslip", "yhi": "noslip", "zlo": "velocity 0 0 0.01", "zhi": "pressure 0"}, 0, preset)
    dx = water.spacing
    grains = scattered(12, 4 * dx, [16 * dx, 16 * dx, 20 * dx], walls="fff")
    after = f"""region outlet block 0 {16 * dx} 0 {16 * dx} {34 * dx} {40 * dx} units box
region middle block {2 * dx} {14 * dx} {2 * dx} {14 * dx} {3 * dx} {30 * dx} units box
compute height all reduce max z
variable count equal count(all)
lbm monitor flow every {20 * water.step:.12g} file flow.csv superficial_velocity bed mass extremes grains
lbm run {100 * water.step:.12g}
group few id 1 3 5
delete_atoms group few compress no
lbm run {100 * water.step:.12g}
fix size all particletemplate/sphere 11593 atom_type 1 density constant 2650 radius constant {2 * dx}
fix sizes all particledistribution/discrete 32452843 1 size 1
fix into all insert/pack seed 32452867 distributiontemplate sizes insert_every once overlapcheck yes particles_in_region 16 region middle ntry_mc 20000
lbm run {100 * water.step:.12g}
unfix into
fix out all remove nevery 50 massrate 1e9 style delete region outlet seed 32452867 atomtype 1 verbose no
lbm run {1500 * water.step:.12g}
unfix out
group everything union all
delete_atoms group everything compress no
lbm run {600 * water.step:.12g}
"""
    after = after.replace("group everything union all\ndelete_atoms group everything compress no", "delete_atoms group all compress no")
    after = after.replace(f"fix out all remove nevery 50 massrate 1e9 style delete region outlet seed 32452867 atomtype 1 verbose no\nlbm run {1500 * water.step:.12g}\nunfix out",
                          "\n".join([f"lbm run {250 * water.step:.12g}\ndelete_atoms region outlet compress no"] * 6))
    bench.must_run(scene(bench, water, grains, after, periodic="fff", restitution=0.3))
    flow = bench.series()
    counts = [int(n) for n in flow["grains"]]
    bench.expect(counts[0] == 12 and min(counts) == 0 and 9 in counts and max(counts[counts.index(9):]) > 9, f"grains: {counts}")
    bench.expect(max(flow["largest_mach"]) < 0.25, f"Mach {max(flow['largest_mach'])}")
    inflow = 0.01
    bench.expect(abs(flow["superficial_velocity_z_m_per_s"][-1] / inflow - 1) < 0.05, f"at the end {flow['superficial_velocity_z_m_per_s'][-1]} m/s flow of {inflow} m/s let in")
    return f"{counts[0]} grains, 9 after deletion, {max(counts[counts.index(9):])} after insertion, 0 at the end; flow {flow['superficial_velocity_z_m_per_s'][-1] / inflow:.4f} of what is let in"
