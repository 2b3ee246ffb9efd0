"""Hindered settling at solid fractions of 0.1 and 0.3

Physics: grains that settle in a periodic box hinder each other: their mean speed is that of one alone times (1 - phi)^n, n = 4.65 in creeping
flow (richardsonzaki1954), with finite boxes and few grains some 20 % off.
Went wrong: grains that approach each other in single cells are drawn together and fall as clusters; the load of shared cells counts twice.
Criterion: within 30 % of that, each grain slower than twice the speed of one alone, Mach below 0.1.
"""
import math

from wet_grains import DUMP, Water, grain, last_dump, scattered, scene

PRESETS = ("default", "thesis")


def mean_speed(bench, preset, count):
    water = Water((24, 24, 24), 0.8, preset=preset)
    diameter, size = 5 * water.spacing, water.size
    box, volume, weight = size[0] * size[1] * size[2], math.pi / 6 * diameter ** 3, 9.81e-3
    pull = 1650 * volume * weight
    # The flux of grains and water together is none: a gradient balances the weight.
    water.lines = f"lbm force pressure_gradient 0 0 {count * pull / box:.12g}"
    grains = scattered(count, diameter, size, clear=1.02) if count > 1 else [grain([0.5 * s for s in size], diameter)]
    (bench.folder / "flow.csv").unlink(missing_ok=True)
    after = f"""compute mean all reduce ave vz
variable speed atom sqrt(vx^2+vy^2+vz^2)
compute fastest all reduce max v_speed
lbm monitor flow every {20 * water.step:.12g} file flow.csv c_mean as mean_m_per_s c_fastest as fastest_m_per_s extremes
lbm run {1200 * water.step:.12g}
"""
    bench.must_run(scene(bench, water, grains, after, extra=f"fix pull all addforce 0 0 {-pull:.12g}"))
    flow = bench.series()
    half = len(flow["mean_m_per_s"]) // 2
    bench.expect(max(flow["largest_mach"]) < 0.1, f"{count} grains: Mach {max(flow['largest_mach'])}")
    return -sum(flow["mean_m_per_s"][half:]) / (len(flow["mean_m_per_s"]) - half), max(flow["fastest_m_per_s"][half:]), count * volume / box


def run(bench, preset, full):
    alone, _, phi_alone = mean_speed(bench, preset, 1)
    free = alone / (1 - 1.7601 * phi_alone ** (1 / 3) + phi_alone - 1.5593 * phi_alone ** 2)  # Hasimoto's array
    reached = []
    for count in (21, 63):
        mean, fastest, phi = mean_speed(bench, preset, count)
        ratio = mean / free / (1 - phi) ** 4.65
        bench.expect(fastest < 2 * free, f"phi {phi:.2f}: a grain at {fastest / free:.2f} of the speed of one alone")
        if preset == "default":
            bench.expect(abs(ratio - 1) < 0.3, f"phi {phi:.2f}: {ratio:.2f} of Richardson and Zaki's speed")
        reached.append(f"phi {phi:.2f}: {ratio:.2f} of Richardson and Zaki's speed")
    return ", ".join(reached)
