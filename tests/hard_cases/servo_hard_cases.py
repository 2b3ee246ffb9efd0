#!/usr/bin/env python3
"""servo_hard_cases.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

Stress paths that a servo may lose: unloading to a tenth, loading fourfold at once, an approach ten times too fast, a sample
sheared from an anisotropic state, control steps ten times rarer. Each must end at its target, within its band, and finite.
"""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import columns, expect, loose_sample, program_from_command_line, read_sample, scratch  # noqa: E402

SERIES = """
variable p equal f_s[1]
variable e equal f_s[3]
variable phase equal f_s[10]
fix series all print 50 "${{p}},${{e}},${{phase}}" file {name}.csv screen no title "p,e,phase"
run {steps}
unfix series
"""


def run(program, folder, name, start, servo, target, steps=400000, band=0.005):
    program.must_run(start + f"fix s all stress/servo {servo}\n" + SERIES.format(name=name, steps=steps) + f"write_restart {name}.restart\n",
                     folder, name)
    data = columns(folder / f"{name}.csv")
    expect(all(math.isfinite(p) for p in data["p"]), f"{name}: not finite")
    held = [p for p, phase in zip(data["p"], data["phase"]) if phase >= 1]
    expect(held, f"{name}: never reached {target} Pa, ended at {data['p'][-1]}")
    worst = max(abs(p / target - 1) for p in held)
    expect(worst <= band, f"{name}: {100 * worst:.2f} % off its target while holding")
    return data


def main():
    program = program_from_command_line(__doc__)
    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        run(program, folder, "base", loose_sample(grains=200, friction=0.3), "isotropic 100e3 until static", 100e3)
        run(program, folder, "unload", read_sample("base.restart"), "isotropic 10e3 until static", 10e3)
        run(program, folder, "reload", read_sample("unload.restart"), "isotropic 40e3 until static", 40e3)
        # Ten times the default max_rate: grains are thrown at each other before the network forms. Once it does, the rate is
        # quasi-static, so that the target is met as gently.
        run(program, folder, "rushed", loose_sample(grains=200), "isotropic 100e3 max_rate 500 until static", 100e3)
        # Control every 500 steps: the same law, ten times slower.
        run(program, folder, "rare", loose_sample(grains=200, friction=0.3), "isotropic 100e3 every 500 until static", 100e3, steps=800000)
        # From the end of a compression along z to an extension along x at the same mean stress.
        run(program, folder, "sheared", read_sample("base.restart"), "constant_p 100e3 axis z rate 1 until axial_strain 0.01", 100e3)
        run(program, folder, "turned", read_sample("sheared.restart"), "constant_p 100e3 axis x extension rate 1 until axial_strain 0.01", 100e3)
        print(f"{program.ranks} ranks: the hard cases end at their targets")


if __name__ == "__main__":
    main()
