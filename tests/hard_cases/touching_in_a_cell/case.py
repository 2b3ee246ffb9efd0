"""Many grains in one cell, and cells that are solid through and through

Physics: 6 x 6 x 6 held grains of half a cell's size touch each other, and two large ones fill whole cells: the water flows
around both and, driven by a gradient, less through them than beside.
Went wrong: solid fractions that add up to more than 1, and the weight of the grains' velocities 0/0 in full cells.
Criterion: solid fractions within 0 to 1, velocity finite everywhere, the flow positive and steady, and that inside the solid below a
hundredth of the mean.
"""
from wet_grains import Water, cubic, grain, scene

PRESETS = ("default", "thesis")
LOOK = """
import h5py
with h5py.File("fields.h5") as file:
    last = file[max((name for name in file if name.startswith("step_")), key=lambda name: int(name.split("_")[1]))]
    solid, velocity = last["solid_fraction"][...], last["velocity"][...]
print(solid.min(), solid.max(), abs(velocity[..., 2][solid > 0.999]).max())
"""


def run(bench, preset, full):
    water = Water((24, 24, 24), 0.8, preset=preset, lines="lbm force pressure_gradient 0 0 1")
    dx = water.spacing
    grains = cubic((6, 6, 6), 0.5 * dx, 1.0, (2 * dx, 2 * dx, 2 * dx))
    # Two spheres of 9 cells that overlap a little: their middles are solid through and through.
    grains += [grain((11 * dx + 8.95 * k * dx, 16 * dx, 16 * dx), 9 * dx) for k in range(2)]
    after = f"""lbm monitor flow every {50 * water.step:.12g} file flow.csv superficial_velocity extremes bed
lbm output fields every 0.5 file fields.h5 velocity solid_fraction
lbm run 8 until steady 1e-3 window 0.5
"""
    bench.must_run(scene(bench, water, grains, after, held=True))
    least, most, inside = bench.with_h5py(LOOK)
    flow = bench.series()
    mean = flow["superficial_velocity_z_m_per_s"][-1]
    bench.expect(least >= 0 and most <= 1, f"solid fractions {least} to {most}")
    bench.expect(mean > 0 and abs(mean / flow["superficial_velocity_z_m_per_s"][-2] - 1) < 1e-2, f"flow of {mean} m/s")
    if preset == "default":
        bench.expect(inside < 0.01 * mean, f"water at {inside / mean:.3f} of the mean flow inside the solid")
    return f"largest solid fraction {most:.3f}, water inside the solid at {inside / mean:.2g} of the mean flow"
