"""Hindered settling at solid fractions of 0.1 and 0.3

Physics: grains that settle in a periodic box hinder each other. Where no volume flows in the mean their speed is that of one alone times
(1 - phi)^4.65 (richardsonzaki1954), less 1.76 S(0) (phi/N)^(1/3) over the relative viscosity in a box of N grains (ladd1990; S of Carnahan
and Starling's hard spheres); and no less than that of a fixed bed under the same force (vanderhoef2005), as grains that may move apart
find easier ways. That speed is the Darcy velocity between water and grains in any frame.
Went wrong: grains that approach each other in single cells are drawn together and fall as clusters; the load of shared cells counts twice.
Criterion: between the two, 5 % below the lower and 25 % above the upper; each grain slower than twice the speed of one alone, Mach below 0.1.
How near to the upper one is reported. (Rotne and Prager's mobilities, summed periodically, beenakker1986, give 1.12 and 1.15 for
the ratio of the two at the places of these grains.)
"""
import math

from wet_grains import Water, array_speed, grain, pulled_in_a_periodic_box, scattered, scene

PRESETS = ("default", "thesis")


def mean_speed(bench, preset, count):
    water = Water((24, 24, 24), 0.8, preset=preset)
    diameter, size = 5 * water.spacing, water.size
    pull = pulled_in_a_periodic_box(water, count, diameter, 9.81e-3)
    grains = scattered(count, diameter, size, clear=1.02) if count > 1 else [grain([0.5 * s for s in size], diameter)]
    after = f"""compute mean all reduce ave vz
variable speed atom sqrt(vx^2+vy^2+vz^2)
compute fastest all reduce max v_speed
lbm monitor flow every {20 * water.step:.12g} file flow.csv superficial_velocity c_mean as mean_m_per_s c_fastest as fastest_m_per_s extremes
lbm run {1200 * water.step:.12g}
"""
    bench.must_run(scene(bench, water, grains, after, extra=pull))
    flow = bench.series()
    phi = count * math.pi / 6 * diameter ** 3 / math.prod(size)
    darcy = [water - (1 - phi) * grains for water, grains in zip(flow["superficial_velocity_z_m_per_s"], flow["mean_m_per_s"])]
    half = len(darcy) // 2
    bench.expect(max(flow["largest_mach"]) < 0.1, f"{count} grains: Mach {max(flow['largest_mach'])}")
    return sum(darcy[half:]) / (len(darcy) - half), max(flow["fastest_m_per_s"][half:]), phi


def run(bench, preset, full):
    alone, _, phi_alone = mean_speed(bench, preset, 1)
    free = alone / array_speed(phi_alone)
    reached = []
    for count in (21, 63):
        mean, fastest, phi = mean_speed(bench, preset, count)
        structure = (1 - phi) ** 4 / ((1 + 2 * phi) ** 2 + phi ** 3 * (phi - 4))
        ratio = mean / free / ((1 - phi) ** 4.65 - 1.7601 * structure * (phi / count) ** (1 / 3) * (1 - phi / 0.64) ** 1.6)
        bench.expect(fastest < 2 * free, f"phi {phi:.2f}: a grain at {fastest / free:.2f} of the speed of one alone")
        fixed = (1 - phi) / (10 * phi / (1 - phi) ** 2 + (1 - phi) ** 2 * (1 + 1.5 * math.sqrt(phi)))
        if preset == "default":
            bench.expect(0.95 * fixed < mean / free and ratio < 1.25, f"phi {phi:.2f}: {mean / free:.3f} of the free speed, fixed bed {fixed:.3f}, {ratio:.2f} of Richardson and Zaki's")
        reached.append(f"phi {phi:.2f}: {mean / free / fixed:.2f} of a fixed bed's speed, {ratio:.2f} of Richardson and Zaki's")
    return ", ".join(reached)
