"""Very low velocities in single precision

Physics: plane Poiseuille flow at 1e-5 and 1e-7 cells a step; its profile does not depend on the speed.
Went wrong: populations of order 1 carry a velocity of 1e-7 in their last bit.
Criterion: in double within 0.1 % of the parabola at both; in float within 1 % at 1e-5, and at 1e-7 the error is reported: it is outside the
envelope (docs/reference/lbm.md names 1e-6).
"""
from wet_grains import Water, scene


def error(bench, precision, speed):
    water = Water((3, 3, 20), 0.8, {"zlo": "noslip", "zhi": "noslip"}, 0, "default", precision=precision)
    height, most = water.size[2], water.speed(speed)
    gradient = 8 * 1e-3 * most / height ** 2
    water.lines = f"lbm force pressure_gradient {gradient:.12g} 0 0"
    bench.must_run(scene(bench, water, [], f"lbm monitor flow every {500 * water.step:.12g} file flow.csv superficial_velocity\nlbm run {6000 * water.step:.12g}\n", periodic="ppf"))
    return bench.series()["superficial_velocity_x_m_per_s"][-1] / (2 / 3 * most) - 1


def run(bench, preset, full):
    errors = {(precision, speed): error(bench, precision, speed) for precision in ("double", "float") for speed in (1e-5, 1e-7)}
    bench.expect(all(abs(e) < 5e-3 for (precision, _), e in errors.items() if precision == "double"), f"{errors}")
    bench.expect(abs(errors["double", 1e-5] - errors["double", 1e-7]) < 1e-4, f"{errors}")
    bench.expect(abs(errors["float", 1e-5]) < 0.01, f"{errors}")
    return ", ".join(f"{precision} at {speed:g}: {100 * e:+.2f} %" for (precision, speed), e in errors.items())
