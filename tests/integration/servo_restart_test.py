#!/usr/bin/env python3
"""servo_restart_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

A run that was stopped and continued from its restart file agrees to the last digit with one that went on: grains,
box and what the servo reports, while compressing and while shearing. Both sides start the second part with LIGGGHTS's
own set-up of a run, which evaluates the forces anew; a run without that pause differs in the last digits of the damping.
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import columns, expect, loose_sample, program_from_command_line, read_sample, scratch  # noqa: E402

# What decides the order of sums: the order of the grains, and how the box is shared among ranks, which LIGGGHTS
# chooses anew for the shape of the box that it reads.
SAME_ORDER = "atom_modify sort 0 0\nprocessors 1 1 *\n"
OUTPUT = """
variable p equal f_s[1]
variable q equal f_s[2]
variable e equal f_s[3]
variable strain equal f_s[4]
variable rate equal f_s[7]
variable axial equal f_s[9]
variable phase equal f_s[10]
fix series all print {interval} "$(step),${{p}},${{q}},${{e}},${{strain}},${{rate}},${{axial}},${{phase}}" file {name}.csv screen no title "step,p,q,e,strain,rate,axial,phase"
fix_modify series
dump grains all custom 100000 {name}.dump id x y z vx vy vz omegax omegay omegaz fx fy fz
dump_modify grains format "%d %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g" sort id first no
""".replace("fix_modify series\n", "")
FINAL = "dump_modify grains every 1\nrun 0\n"


def last_frame(path):
    text = pathlib.Path(path).read_text()
    return text[text.rindex("ITEM: TIMESTEP"):]


def compare(program, folder, name, start, servo, first_part, second_part):
    """`start` is script text that sets the scene; the servo's words are the same on both sides."""
    interval = 7 if first_part % 50 else 100
    fix = f"fix s all stress/servo {servo}\n"
    program.must_run(start + fix + f"run {first_part}\nwrite_restart {name}.middle\n" + OUTPUT.format(name=f"{name}_through", interval=interval) +
                     f"run {second_part}\n" + FINAL, folder, f"{name}_through")
    program.must_run(read_sample(f"{name}.middle", SAME_ORDER) + fix + OUTPUT.format(name=f"{name}_continued", interval=interval) +
                     f"run {second_part}\n" + FINAL, folder, f"{name}_continued")
    through, continued = columns(folder / f"{name}_through.csv"), columns(folder / f"{name}_continued.csv")
    expect(len(through["p"]) > 10, f"{name}: too few samples")
    difference = next(((k, a, b) for k in through for a, b in zip(through[k], continued[k]) if a != b), None)
    expect(through == continued, f"{name}: the series differ, first in {difference}")
    expect(last_frame(folder / f"{name}_through.dump") == last_frame(folder / f"{name}_continued.dump"), f"{name}: the grains differ")
    return through


def main():
    program = program_from_command_line(__doc__)
    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        compression = loose_sample(friction=0.3).replace("newton off", "newton off\n" + SAME_ORDER)
        through = compare(program, folder, "compression", compression, "isotropic 100e3", 24000, 4000)
        expect(1e3 < through["p"][-1] < 99e3, f"the compared part is not the compression: it ends at p' = {through['p'][-1]}")
        program.must_run(compression + "fix s all stress/servo isotropic 100e3 until target\nrun 400000\nwrite_restart sample.restart\n", folder, "prepare")
        through = compare(program, folder, "shear", read_sample("sample.restart", SAME_ORDER), "triaxial 100e3 axis z rate 1", 10000, 5000)
        expect(through["phase"][-1] == 1 and through["strain"][-1] > 1e-3, "the compared shearing did not shear")
        # Between two control steps: the box goes on at the rates of before.
        through = compare(program, folder, "between", read_sample("sample.restart", SAME_ORDER), "constant_p 100e3 axis z rate 1", 10037, 5000)
        expect(min(through["axial"]) > 0.1, f"the axis stood still after the restart: {min(through['axial'])} 1/s")
        # A path that had come to its end goes on to a later one.
        shear = "fix s all stress/servo triaxial 100e3 axis z rate 1 until axial_strain {strain}\nrun 40000\n"
        program.must_run(read_sample("sample.restart") + shear.format(strain=0.002) + "write_restart ended.restart\n", folder, "ended")
        screen = program.must_run(read_sample("ended.restart") + shear.format(strain=0.004) + "variable strain equal f_s[4]\nprint \"strain ${strain}\"\n", folder, "further")
        strain = float(next(line for line in screen.splitlines() if line.startswith("strain ")).split()[1])
        expect(abs(strain - 0.004) < 1e-4, f"a continued path ended at {strain}")
        print(f"{program.ranks} ranks: continued runs agree with uninterrupted ones to the last digit")


if __name__ == "__main__":
    main()
