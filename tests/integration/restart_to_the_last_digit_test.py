#!/usr/bin/env python3
"""restart_to_the_last_digit_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N [--only NAME]

A run that saves sets and goes on, and runs that take one of its sets up on the same ranks: positions, velocities, spins and
forces of the grains, and every row of the series, are the same to the last digit. Grains collide, pass from rank to rank and through
periodic faces; nothing of LIGGGHTS's order (sorting, ranks, lists) is fixed by the script.
"""
import pathlib
import shutil
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import Program, expect, loose_sample, program_from_command_line, read_sample, scratch  # noqa: E402
from wet_scenes import WATER, wet_box  # noqa: E402

DUMP = """
dump grains all custom 1000000 {name}.dump id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz
dump_modify grains format "%d{numbers}" sort id first no
"""
FINAL = "dump_modify grains every 1\nrun 0\n"


def dump_text(name):
    return DUMP.format(name=name, numbers=" %.17g" * 15)


def last_frame(path):
    text = pathlib.Path(path).read_text()
    return text[text.rindex("ITEM: TIMESTEP"):].splitlines()


def compare_frames(one, other, what):
    a, b = last_frame(one), last_frame(other)
    expect(len(a) == len(b), f"{what}: {len(a)} and {len(b)} lines")
    different = [(x, y) for x, y in zip(a, b) if x != y]
    expect(not different, f"{what}: {len(different)} of {len(a)} lines differ, first\n{different[0] if different else ''}")


def coupled(program, folder):
    """40 grains in a swirl of water that collide, in a box with a pressure gradient."""
    free = wet_box(restart="start").replace("atom_modify sort 0 0\n", "")
    flow = WATER + "lbm boundary zlo pressure 5 zhi pressure 0\nlbm force pressure_gradient 300 200 0\n" \
        "compute contacts all coordination\nlbm monitor m every 2.5e-3 file {name}.csv superficial_velocity mass kinetic_energy solid_force grains_left 0.8e-3 c_contacts[1] as Z\n"
    rest = "lbm restart write {name}.state every 2.5e-2\nlbm run until 0.07\n"
    program.must_run(free + flow.format(name="whole") + dump_text("whole") + rest.format(name="whole") + FINAL, folder, "whole")
    whole = (folder / "whole.csv").read_text()
    for n in (1, 2):
        name = f"again{n}"
        shutil.copy(folder / "whole.csv", folder / f"{name}.csv")
        text = free.replace("read_restart start", f"read_restart whole.state.{n}/grains") + flow.format(name=name) + dump_text(name) + \
            f"lbm restart read whole.state.{n}\n" + rest.format(name=name) + FINAL
        program.must_run(text, folder, name)
        compare_frames(folder / "whole.dump", folder / f"{name}.dump", f"coupled, from set {n}")
        rows, more = whole.splitlines(), (folder / f"{name}.csv").read_text().splitlines()
        amiss = [(a, b) for a, b in zip(rows, more) if a != b]
        expect(len(rows) == len(more) and not amiss, f"rows of the monitor: {len(rows)} and {len(more)}, {len(amiss)} differ, first\n{amiss[:1]}")
    touching = [line.split(",")[-1] for line in whole.splitlines()[1:]]
    expect(max(float(z) for z in touching) > 0.1, f"the grains do not collide: Z up to {max(touching)}")


def series(name, values):
    """LIGGGHTS's own series of a few values of the script."""
    lines = "".join(f"variable s{n} equal {value}\n" for n, value in enumerate(values))
    words = ",".join(f"${{{{s{n}}}}}".replace("{{", "{").replace("}}", "}") for n in range(len(values)))
    return lines + f'fix series all print 500 "$(step),{words}" file {name}.csv screen no\n'


def dry(program, folder, what, start, begin_again, values, every, steps):
    """Sets in the steps that are multiples of `every`; taken up from both that are left."""
    def rest(name):
        return series(name, values) + dump_text(name) + f"restart_set {name}.set every {every}\n"
    program.must_run(start + rest(f"{what}_whole") + f"run {steps} upto\nrestart_set off\n" + FINAL, folder, f"{what}_whole")
    whole = (folder / f"{what}_whole.csv").read_text().splitlines()
    for n in (1, 2):
        name = f"{what}_again{n}"
        program.must_run(begin_again(f"{what}_whole.set.{n}/grains") + rest(name) + f"run {steps} upto\nrestart_set off\n" + FINAL, folder, name)
        compare_frames(folder / f"{what}_whole.dump", folder / f"{name}.dump", f"{what}, from set {n}")
        rows = (folder / f"{name}.csv").read_text().splitlines()[1:]
        known = dict(line.split(",", 1) for line in whole[1:])
        amiss = [(line, known.get(line.split(",", 1)[0])) for line in rows if known.get(line.split(",", 1)[0]) != line.split(",", 1)[1]]
        expect(len(rows) > 3 and not amiss, f"{what}, from set {n}: {len(amiss)} of {len(rows)} rows differ, first\n{amiss[:1]}")


def falling(program, folder):
    """Grains that fall on a floor and on each other, without water."""
    def scene(restart):
        return wet_box(restart=restart).replace("atom_modify sort 0 0\n", "").replace("fix hydrodynamic_force all hydrodynamic/force\n", "")
    dry(program, folder, "falling", scene("start"), scene, ["ke", "bound(all,zmax)"], 8000, 30000)


def servo(program, folder):
    """A sample that a servo compresses, and shears: the box changes its shape, and LIGGGHTS would share it otherwise among ranks."""
    fix = "fix s all stress/servo {path}\n"
    values = [f"f_s[{n}]" for n in (1, 2, 3, 4, 6, 7, 9, 10, 11)]
    compress, shear = fix.format(path="isotropic 100e3"), fix.format(path="triaxial 100e3 axis z rate 1")
    dry(program, folder, "compressed", loose_sample(friction=0.3) + compress, lambda file: read_sample(file) + compress, values, 7037, 24000)
    program.must_run(loose_sample(friction=0.3) + fix.format(path="isotropic 100e3 until target") + "run 400000\nreset_timestep 0\nwrite_restart sample\n", folder, "sample")
    dry(program, folder, "sheared", read_sample("sample") + shear, lambda file: read_sample(file) + shear, values, 3000, 11000)


def main():
    program = program_from_command_line(__doc__)
    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        Program(program.suffuse, program.mpirun, 1).must_run(wet_box() + "write_restart start\n", folder)
        for case in (falling, servo, coupled):
            case(program, folder)
    print(f"{program.ranks} ranks: continued runs are those that went on, to the last digit")


if __name__ == "__main__":
    main()
