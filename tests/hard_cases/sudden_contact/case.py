"""Sub-steps chosen by the program, and a contact of stiff grains that is there at once

Physics: grains of quartz's stiffness (70 GPa) in water, a fluid step cut into as many DEM steps as the contacts need. (a) Two grains are
placed into each other by a thousandth of a radius and part; (b) one is shot at another, held one at 0.3 m/s.
Went wrong: a step chosen for slow contacts, so that a fast or deep one gets more energy out than went in; the water's force of one interval
on a grain that has long turned round.
Criterion: kinetic energy never above what was stored, 8/15 E* sqrt(R*) overlap^(5/2) for each pair, or brought in (3 %: the water's mass that
moves along); half the DEM step changes the speeds after the contact by less than 3 %.
"""
import math

from wet_grains import Water, grain, scene

PRESETS = ("default", "thesis")
MODULUS, DENSITY = 7e10, 2650.0


def speeds(bench, preset, grains, share, held):
    """Kinetic energy by time (J), and the lower grain's speed along z at the end."""
    water = Water((24, 24, 48), 0.503, preset=preset)
    after = f"""{'unfix motion' if held else ''}
{'group shot id 1' if held else ''}
{'fix motion shot nve/sphere' if held else ''}
variable speed atom vz
compute own all reduce min v_speed
lbm monitor flow every {water.step:.12g} file flow.csv kinetic_energy c_own as speed_m_per_s extremes grains
lbm run {12 * water.step:.12g}
"""
    text = scene(bench, water, grains, after, modulus=MODULUS, restitution=1.0, friction=0.0)
    bench.must_run(text.replace("dem_timestep rayleigh 0.2 pressure 100", f"dem_timestep rayleigh {share} pressure 100"))
    flow = bench.series()
    return flow["grains_kinetic_energy_j"], flow["speed_m_per_s"][-1]


def run(bench, preset, full):
    diameter = 8e-4
    mass = DENSITY * math.pi / 6 * diameter ** 3
    middle = [1.2e-3, 1.2e-3]
    overlap = 5e-4 * diameter
    stored = 8 / 15 * MODULUS / (2 * (1 - 0.3 ** 2)) * math.sqrt(diameter / 4) * overlap ** 2.5
    shot = 0.3
    cases = {
        "placed into each other": ([grain(middle + [2e-3], diameter), grain(middle + [2e-3 + diameter - overlap], diameter)], stored, False),
        "shot at a held one": ([grain(middle + [1.5e-3], diameter, velocity=(0, 0, shot)), grain(middle + [1.5e-3 + 1.005 * diameter], diameter)], 0.5 * mass * shot ** 2, True)}
    reached = []
    for name, (grains, energy, held) in cases.items():
        whole, after = speeds(bench, preset, grains, 0.2, held)
        _, half = speeds(bench, preset, grains, 0.1, held)
        bench.expect(after < -0.02, f"{name}: {after:.3g} m/s at the end, must have turned back")
        bench.expect(max(whole) < 1.03 * energy, f"{name}: {max(whole) / energy:.3f} of the energy that there is")
        bench.expect(abs(after / half - 1) < 0.03, f"{name}: {after:.4g} m/s after the contact, {half:.4g} with half the step")
        reached.append(f"{name}: {max(whole) / energy:.3f} of the energy, half the step {100 * (half / after - 1):+.2f} %")
    return "; ".join(reached)
