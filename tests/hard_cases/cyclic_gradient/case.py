"""A gradient that goes up and down for cycle after cycle

Physics: a bed of 60 grains under 0.7 times its critical gradient and back, 20 times (100 with --full): it stays a bed.
Went wrong: rounding and lag of the load pump energy in, and the bed creeps up or compacts without end.
Criterion: in the second half of the cycles the bed's centre rises by less than 0.5 % of a diameter and falls by less than one grain that finds a
place a diameter lower makes it fall (1/60 of a diameter: shaken beds compact); at the ends of cycles the mean of the grains' speeds is below
0.5 mm/s, a hundredth of their terminal speed. Which grains find other places, and which lie loose and are still falling at a cycle's end (at
0.5 to 3 mm/s), a rounding of the last digits decides: beds of 57 to 63 grains by AVX-512 and by portable kernels have means of 0.05 to 0.25 mm/s
and fall by 0.09 to 1.2 % of a diameter. Energy that is pumped in shows in all of the grains.
"""
from wet_grains import Water, scattered, scene, weight_pressure


def run(bench, preset, full):
    cycles, period = (100 if full else 20), 0.01
    water = Water((16, 16, 40), 0.53, {"zlo": "pressure v_p", "zhi": "pressure 0"}, 9.81, preset)
    diameter, size = 4 * water.spacing, water.size
    grains = scattered(60, diameter, [size[0], size[1], 0.9 * size[2]], walls="ppf")
    critical = weight_pressure(60, diameter, size)
    after = f"""compute height all reduce ave z
variable speed atom sqrt(vx^2+vy^2+vz^2)
compute mean all reduce ave v_speed
lbm run 0.3
variable begun equal $(step*dt)
variable p equal {0.35 * critical:.8g}*(1-cos(2*PI*(step*dt-v_begun)/{period}))
lbm monitor flow every {period} file flow.csv c_height as height_m c_mean as mean_speed
lbm run {cycles * period}
"""
    bench.must_run(scene(bench, water, grains, after, periodic="ppf", extra="variable p equal 0"))
    flow = bench.series()
    half = cycles // 2
    drift, speed = (flow["height_m"][-1] - flow["height_m"][half]) / diameter, max(flow["mean_speed"][half:])
    bench.expect(-1 / 60 < drift < 0.005, f"the bed's centre moves by {100 * drift:.2f} % of a diameter")
    bench.expect(speed < 5e-4, f"grains at {speed} m/s between the cycles (mean)")
    return f"centre of the bed moves by {100 * drift:+.3f} % of a diameter in {cycles - half} cycles; mean speed {1e3 * speed:.3f} mm/s at their ends"
