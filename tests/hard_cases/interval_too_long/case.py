"""A coupling interval ten times too long

Physics: a grain that moves by two cells in each fluid step is seen by the water at a few places on its way only; a lattice Boltzmann fluid
cannot follow, and must say so instead of going on.
Went wrong: a blown-up field, or a plausible wrong one.
Criterion: the run ends by the program's own sentence, which names the step, with exit code 1 on all ranks; with a tenth of the
interval it runs and the grain is slower than in free fall.
"""
from wet_grains import DUMP, Water, grain, last_dump, scene


def run(bench, preset, full):
    speed = 0.1  # m/s
    for tau, ranks, good in ((1.1, 1, False), (1.1, 2, False), (0.52, 1, True)):
        water = Water((16, 16, 40), tau)
        text = scene(bench, water, [grain([0.5 * s for s in water.size], 5 * water.spacing, 8000, (0, 0, -speed))], f"lbm run 0.01\n{DUMP}run 0\n")
        code, screen = bench.run(text, ranks)
        if good:
            bench.expect(code == 0 and -speed < last_dump(bench.folder / "grains.dump")["vz"][0] < 0, screen[-1500:])
        else:
            lines = [line for line in screen.splitlines() if line.startswith("suffuse: error:")]
            bench.expect(code == 4 and len(lines) == 1 and "timestep" in lines[0], f"{ranks} ranks: code {code}, {lines}")
    return "stopped with the time step to take; at a tenth of it the run ends"
