"""Grains of 2, 1 and 0.5 cells, alone and beside a large one

Physics: a grain settles in a periodic box; in Stokes flow at the speed that Hasimoto's array gives. Ten fines beside a grain ten
times their size fall no faster than the large one would.
Went wrong: a grain below a cell takes its moment with the arms of whole cells and spins up without bound; a virtual mass that is too
large for it gives energy to every collision (fines of 0.6 cells reached 38 m/s); its drag, a point force, was a fifth of Stokes'.
Criterion: alone within 45 % of Hasimoto's speed (default; 0.3 to 2 cells, wherever in its cell: a point force scatters by as much);
beside the large grain no fine ever moves faster than 1.5 times as fast as that, at tau 0.505, 0.515 and 0.53.
"""
import math

from wet_grains import DUMP, Water, array_speed, cubic, grain, last_dump, pulled_in_a_periodic_box, scene

PRESETS = ("default", "thesis")


def alone(bench, preset, cells, shift):
    """Terminal speed over Hasimoto's; `shift` from the corner of a cell."""
    water = Water((20, 20, 20), 0.6, preset=preset, lines="lbm effect lubrication off")
    diameter, size = cells * water.spacing, water.size
    weight = 9.81e-2
    pull = pulled_in_a_periodic_box(water, 1, diameter, weight)
    bench.must_run(scene(bench, water, [grain([0.5 * s + shift * water.spacing for s in size], diameter)],
                         f"lbm run 0.3\n{DUMP}run 0\n", extra=pull))
    speed = last_dump(bench.folder / "grains.dump")["vz"][0]
    hasimoto = array_speed(math.pi / 6 * diameter ** 3 / math.prod(size)) * 1650 * weight * diameter ** 2 / (18 * 1e-3)
    return -speed / hasimoto


def beside(bench, preset, tau):
    """Fastest fine over the fastest that the large grain becomes, in a column with a floor; None where the program stops the run."""
    water = Water((24, 24, 40), tau, {"zlo": "noslip", "zhi": "noslip"}, 9.81, preset, spacing=1.5e-4)
    grains = [grain((1.8e-3, 1.8e-3, 4.5e-3), 9e-4)] + cubic((6, 6, 4), 9e-5, 1.5, (1.4e-3, 1.4e-3, 2.5e-3))
    after = f"""variable speed atom sqrt(vx^2+vy^2+vz^2)
group large id 1
group fines id > 1
compute fastest fines reduce max v_speed
compute large large reduce max v_speed
lbm monitor flow every {5 * water.step:.12g} file flow.csv c_fastest as fines_m_per_s c_large as large_m_per_s extremes
lbm run 0.06
"""
    code, screen = bench.run(scene(bench, water, grains, after, periodic="ppf"))
    if code != 0:
        bench.expect(preset == "thesis" and code == 4 and "suffuse: error:" in screen, f"tau {tau}: code {code}\n{screen[-1500:]}")
        return None
    flow = bench.series()
    return max(flow["fines_m_per_s"]) / max(flow["large_m_per_s"])


def run(bench, preset, full):
    shifts = (0, 0.25, 0.5) if full or preset == "default" else (0,)  # of the thesis's only that it does not rise
    ratios = {cells: [alone(bench, preset, cells, shift) for shift in shifts] for cells in (2, 1, 0.5, 0.3)}
    fastest = {tau: beside(bench, preset, tau) for tau in ((0.505, 0.515, 0.53) if full or preset == "default" else (0.505,))}
    for cells, found in ratios.items():
        bench.expect(min(found) > 0, f"{cells} cells: rises at {found} of Hasimoto's speed")
        if preset == "default":
            bench.expect(max(abs(math.log(ratio)) for ratio in found) < math.log(1.45), f"{cells} cells: {found} of Hasimoto's speed")
    for tau, ratio in fastest.items():
        bench.expect(preset == "thesis" or ratio < 1.5, f"tau {tau}: a fine reached {ratio} times the speed of the large grain")
    return ", ".join(f"{cells} cells: {min(found):.2f} to {max(found):.2f} of Hasimoto's speed" for cells, found in ratios.items()) + "; fines beside a large grain, over its speed: " + \
        ", ".join(f"tau {tau} " + (f"{ratio:.2f}" if ratio is not None else "stopped") for tau, ratio in fastest.items())
