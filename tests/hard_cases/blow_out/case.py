"""Three critical gradients at once, and then the other way

Physics: a bed of 60 grains on a floor gets 3 times its critical gradient from one step to the next, flies, and is then pressed down by
as much. Up it may not become faster than the water that carries it; down it comes to rest on the floor.
Went wrong: the load of one step at the jump moves grains through each other or through the floor.
Criterion: no grain faster than 1.5 times the largest Darcy velocity over its porosity of 0.4; at the end every grain above the floor by
its radius less 2 % and below the lid, no overlap above 5 % of a diameter, kinetic energy below a thousandth of its largest.
"""
from wet_grains import DUMP, Water, last_dump, scattered, scene, weight_pressure

PRESETS = ("default", "thesis")


def run(bench, preset, full):
    water = Water((16, 16, 60), 0.506, {"zlo": "pressure v_p", "zhi": "pressure 0"}, 9.81, preset)
    diameter, size = 4 * water.spacing, water.size
    grains = scattered(60, diameter, [size[0], size[1], 0.6 * size[2]], walls="ppf")
    critical = weight_pressure(60, diameter, size)
    after = f"""variable speed atom sqrt(vx^2+vy^2+vz^2)
compute fastest all reduce max v_speed
lbm run 0.05
lbm monitor flow every {25 * water.step:.12g} file flow.csv superficial_velocity kinetic_energy c_fastest as fastest_m_per_s extremes grains
variable p equal {3 * critical:.8g}
lbm run 0.015
variable p equal {-3 * critical:.8g}
lbm run 0.08
{DUMP}run 0
"""
    bench.must_run(scene(bench, water, grains, after, periodic="ppf", extra="variable p equal 0"))
    flow, end = bench.series(), last_dump(bench.folder / "grains.dump")
    carrier = max(map(abs, flow["superficial_velocity_z_m_per_s"])) / 0.4
    fastest = max(flow["fastest_m_per_s"])
    bench.expect(fastest < 1.5 * carrier, f"a grain at {fastest:.3f} m/s in water of {carrier:.3f} m/s")
    bench.expect(len(end["z"]) == 60 and min(end["z"]) > 0.48 * diameter and max(end["z"]) < size[2], f"grains at {min(end['z'])} to {max(end['z'])} m")
    overlap = 0.0
    for i in range(60):
        for j in range(i):
            square = sum(min(abs(a[i] - a[j]), length - abs(a[i] - a[j]) if periodic else 9) ** 2
                         for a, length, periodic in zip((end["x"], end["y"], end["z"]), size, (True, True, False)))
            overlap = max(overlap, 1 - square ** 0.5 / diameter)
    bench.expect(overlap < 0.05, f"grains overlap by {100 * overlap:.1f} % of a diameter")
    energy = flow["grains_kinetic_energy_j"]
    bench.expect(energy[-1] < 1e-3 * max(energy), f"at the end {energy[-1] / max(energy):.1e} of the largest kinetic energy")
    return f"fastest grain {fastest / carrier:.2f} of the water between grains, overlap at the end {100 * overlap:.2f} % of a diameter"
