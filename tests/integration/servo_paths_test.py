#!/usr/bin/env python3
"""servo_paths_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

Takes a small sample through every stress path of `fix stress/servo` and checks what the servo promises: the
controlled stress within 0.5 %, strains, cycles and volume as ordered, an early end of `run` after which the script
goes on, and its last thermo line.
"""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import columns, expect, loose_sample, program_from_command_line, read_sample, scratch  # noqa: E402

SERIES = """
variable p equal f_s[1]
variable q equal f_s[2]
variable strain equal f_s[4]
variable volumetric equal f_s[5]
variable inertial equal f_s[6]
variable phase equal f_s[10]
variable cycles equal f_s[12]
variable sx equal f_s[13]
variable sy equal f_s[14]
variable sz equal f_s[15]
fix series all print {every} "${{p}},${{q}},${{strain}},${{volumetric}},${{inertial}},${{phase}},${{cycles}},${{sx}},${{sy}},${{sz}},$(vol)" file {name}.csv screen no &
    title "p,q,strain,volumetric,inertial,phase,cycles,sx,sy,sz,volume"
thermo 1000
thermo_style custom step atoms f_s[1] f_s[4] vol
run 400000
print "the script goes on"
"""


def prepare(program, folder):
    """An isotropic sample at 100 kPa in equilibrium with friction."""
    screen = program.must_run(loose_sample() + """
fix s all stress/servo isotropic 100e3 until target
""" + SERIES.format(name="compression", every=50) + """
unfix friction
fix friction all property/global coefficientFriction peratomtypepair 1 0.3
fix s all stress/servo isotropic 100e3 until static
unfix series
""" + SERIES.format(name="equilibrium", every=50) + "write_restart sample.restart\n", folder, "prepare")
    expect(screen.count("the script goes on") == 2, "a run that ended early ended the script")
    compression, equilibrium = columns(folder / "compression.csv"), columns(folder / "equilibrium.csv")
    for p, inertial in zip(compression["p"], compression["inertial"]):
        # I is that of the present p', and the rate is raised in inverse proportion to p' up to the target.
        expect(p < 0.05 * 100e3 or inertial < 7.9e-5 * max(1, 100e3 / p) ** 1.5 * 1.01, f"inertial number {inertial} at p' = {p}")
    holding = [p for p, phase in zip(equilibrium["p"], equilibrium["phase"]) if phase >= 1]
    expect(len(holding) > 20, "no holding phase")
    expect(max(abs(p / 100e3 - 1) for p in holding) < 0.005, f"p' left its 0.5 % band: {min(holding)}..{max(holding)}")
    # The loop time line counts the steps that were run, and the last thermo line is the last step.
    steps = [int(n) for n in re.findall(r"Loop time of \S+ on \d+ procs for (\d+) steps", screen)]
    expect(all(0 < n < 400000 for n in steps[1:]), f"runs did not end early: {steps}")
    return screen


def shear(program, folder, name, words):
    program.must_run(read_sample("sample.restart") + f"fix s all stress/servo {words}\n" + SERIES.format(name=name, every=5), folder, name)  # control may come every 5 steps
    data = columns(folder / f"{name}.csv")
    held = [k for k, phase in enumerate(data["phase"]) if phase == 1]
    expect(len(held) > 20, f"{name}: only {len(held)} samples of the shearing phase")
    return data, held


def main():
    program = program_from_command_line(__doc__)
    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        prepare(program, folder)

        data, held = shear(program, folder, "constant_p", "constant_p 100e3 axis x rate 2 until axial_strain 0.015")
        expect(max(abs(data["p"][k] / 100e3 - 1) for k in held) < 0.005, "constant_p: p' left its band")
        # Compressed at equal rates, the sample starts with unequal stresses; once sheared, both follow one target.
        lateral = max(abs(data["sy"][k] - data["sz"][k]) for k in held if data["strain"][k] > 0.002)
        expect(lateral < 0.01 * 100e3, f"constant_p: lateral stresses differ by {lateral} Pa")  # 0.5 % each
        expect(abs(data["strain"][-1] - 0.015) < 5e-4, f"constant_p: ended at strain {data['strain'][-1]}")
        expect(max(data["q"]) > 30e3, "constant_p: the sample carried no deviator")

        for direction, sign in (("compression", 1), ("extension", -1)):
            data, held = shear(program, folder, direction, f"triaxial 100e3 axis z {direction} rate 2 until axial_strain 0.01")
            worst = max(max(abs(data["sx"][k] / 100e3 - 1), abs(data["sy"][k] / 100e3 - 1)) for k in held)
            expect(worst < 0.005, f"triaxial {direction}: cell pressure off by {100 * worst:.2f} %")
            expect(sign * data["q"][-1] > 20e3, f"triaxial {direction}: q = {data['q'][-1]}")

        data, held = shear(program, folder, "cyclic", "cyclic 100e3 axis z deviator -20e3 30e3 rate 1 until cycles 2")
        expect(data["cycles"][-1] == 2, f"cyclic: {data['cycles'][-1]} cycles")
        q = [data["q"][k] for k in held]
        # The turn comes at the control step after the bound: at 1 1/s and 50 steps the strain passes it by 4e-5.
        expect(28e3 < max(q) < 36e3 and -26e3 < min(q) < -18e3, f"cyclic: q between {min(q)} and {max(q)}")

        data, held = shear(program, folder, "undrained", "constant_volume axis z rate 1 until axial_strain 0.01")
        spread = max(data["volume"]) / min(data["volume"]) - 1
        expect(spread < 1e-10, f"constant_volume: volume changed by {spread}")
        print(f"{program.ranks} ranks: every stress path keeps what it promises")


if __name__ == "__main__":
    main()
