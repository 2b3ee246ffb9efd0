#!/usr/bin/env python3
"""servo_between_runs_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

What a script does between two runs of a servo, and other fixes within one: `run N pre no`; diameters and densities that are set
after `read_restart`; steps that are numbered anew; fixes further down that scale masses; grains that an insertion adds.
"""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import expect, log_text, loose_sample, program_from_command_line, read_sample, scratch, thermo_rows  # noqa: E402

TARGET = 100e3
SERVO = f"fix s all stress/servo isotropic {TARGET:g}"
GRAINS = """
dump grains all custom 1 {name}.dump id x y z vx vy vz fx fy fz radius density
dump_modify grains format "%d %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g" sort id first yes
run 0
"""


def series(values, every):
    """Of the servo's values of these numbers."""
    words = " ".join(f"f_s[{k}]" for k in values)
    return f"thermo_style custom step vol {words}\nthermo_modify format float %.17g lost error norm no\nthermo {every}\n"


def rows_of(folder, name, values):
    return thermo_rows(log_text(folder, name), 2 + len(values))


def grains_of(path):
    lines = pathlib.Path(path).read_text().splitlines()
    start = max(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
    return [[float(word) for word in line.split()] for line in lines[start + 1:]]


def check_without_set_up(program, folder):
    """`run 0` and `run N pre no` are `run N`; where sets of states are asked for in between, too."""
    values = (1, 2, 3, 7, 8, 9, 11)
    start = read_sample("sample.restart") + SERVO + "\n" + series(values, 10)
    ways = {"whole": "run 120\n", "parts": "run 0\nrun 120 pre no\n", "sets": "run 0\nrestart_set states every 1000\nrun 120 pre no\nrestart_set off\n"}
    for name, runs in ways.items():
        program.must_run(start + runs + GRAINS.format(name=name), folder, name)
    # Of steps that two runs print the last: the first line of the second run stands for the same state.
    rows = {name: {row[0]: row for row in rows_of(folder, name, values)} for name in ways}
    expect(len(rows["whole"]) >= 12, f"{len(rows['whole'])} rows")
    for name in ("parts", "sets"):
        expect(rows[name] == rows["whole"], f"{name}: the series differ")
        expect(grains_of(folder / f"{name}.dump") == grains_of(folder / "whole.dump"), f"{name}: the grains differ")


def check_sums(folder, name, row):
    """Void ratio and inertial number of a row (volume, e, I, rates) are those of the grains that there are."""
    volume, void_ratio, inertial_number, pressure = row[1], row[2], row[3], row[4]
    rate = max(abs(value) for value in row[5:8])
    grains = [(2 * grain[10], math.pi / 6 * (2 * grain[10])**3, grain[11]) for grain in grains_of(folder / f"{name}.dump")]
    solid, mass = sum(v for _, v, _ in grains), sum(v * density for _, v, density in grains)
    diameter = sum(d * v * density for d, v, density in grains) / mass
    reference = pressure if pressure > 0.01 * TARGET else TARGET
    # Rounding alone.
    expect(abs(void_ratio / (volume / solid - 1) - 1) < 1e-9, f"{name}: e = {void_ratio}, {volume / solid - 1} by the grains")
    wanted = rate * diameter * math.sqrt(mass / solid / reference)
    expect(wanted > 0 and abs(inertial_number / wanted - 1) < 1e-9, f"{name}: I = {inertial_number}, {wanted} by the grains")
    return len(grains)


SUMS = (3, 6, 1, 7, 8, 9, 2)


def check_other_grains(program, folder):
    """Diameters or densities set after `read_restart`: as many grains, and another sample."""
    for name, words in (("diameter", "diameter 0.45e-3"), ("density", "density 5300")):
        program.must_run(read_sample("sample.restart") + SERVO + f"\nset group all {words}\n" + series(SUMS, 1) + GRAINS.format(name=name), folder, name)
        check_sums(folder, name, rows_of(folder, name, SUMS)[-1])


def check_inserted_grains(program, folder):
    """Grains of another size and density that come during a run."""
    insertion = """
region middle block 1e-3 2.5e-3 1e-3 2.5e-3 1e-3 2.5e-3 units box
fix heavy all particletemplate/sphere 11593 atom_type 1 density constant 7800 radius constant 0.15e-3
fix more all particledistribution/discrete 32452843 1 heavy 1.0
fix later all insert/pack seed 32452867 distributiontemplate more insert_every once start 140 overlapcheck yes particles_in_region 20 region middle ntry_mc 20000
"""
    program.must_run(loose_sample(grains=150, friction=0.3) + SERVO + " static_window 1000\n" + insertion + series(SUMS, 100) + "run 400\n" + GRAINS.format(name="inserted"),
                     folder, "inserted")
    rows = rows_of(folder, "inserted", SUMS)
    grains = check_sums(folder, "inserted", rows[-2])  # the last row of the run: that of `run 0` is summed anew
    expect(rows[-2][0] == rows[-1][0], f"rows of steps {rows[-2][0]} and {rows[-1][0]}")
    before = len(grains_of(folder / "whole.dump"))
    expect(grains > before + 5, f"{grains} grains after the insertion, {before} before")


def steps_until_static(program, folder, name, changes=""):
    """Steps that `static` still waits in a window of 4,000 of which 3,000 are over."""
    words = SERVO + " static_window 4000 tolerance 0.2 unbalanced off until static\n"
    if not (folder / "waiting.restart").exists():
        program.must_run(read_sample("sample.restart") + words + "run 3000\nwrite_restart waiting.restart\n", folder, "waiting")
    program.must_run(read_sample("waiting.restart") + words + changes + "variable begun equal $(step)\nrun 6000\n"
                     "variable waited equal $(step)-${begun}\nprint \"${waited}\" file waited.txt screen no\n", folder, name)
    return float((folder / "waited.txt").read_text())


def check_static_window(program, folder):
    """It goes on after a restart of the same grains; steps numbered anew, or other grains, begin a new one."""
    expect((waited := steps_until_static(program, folder, "same")) < 1300, f"the window did not go on: {waited} steps")
    for name, changes in (("numbered", "reset_timestep 0\n"), ("denser", "set group all density 2700\n")):
        waited = steps_until_static(program, folder, name, changes)
        expect(4000 <= waited < 4500, f"{name}: static after {waited} steps of a window of 4000")


def check_order_of_lines(program, folder):
    """Masses that a fix further down scales decide how often the network is looked at."""
    values = (1, 3, 7, 11)
    scaling = "fix scaled all density/scaling size 1e-3\n"
    for name, lines in (("scaled_first", scaling + SERVO + "\n"), ("servo_first", SERVO + "\n" + scaling)):
        program.must_run(read_sample("sample.restart") + lines + series(values, 50) + "run 1000\n" + GRAINS.format(name=name), folder, name)
    one, other = (rows_of(folder, name, values) for name in ("scaled_first", "servo_first"))
    expect(len({row[5] for row in one}) > 2, "the network was looked at once")
    different = [pair for pair in zip(one, other) if pair[0] != pair[1]]
    expect(len(one) == len(other) and not different, f"the order of lines changes the series, first {different[:1]}")
    expect(grains_of(folder / "scaled_first.dump") == grains_of(folder / "servo_first.dump"), "the order of lines changes the grains")


def check_measured_rate(program, folder):
    """compute inertial/number after steps have been numbered anew: the last rate until the box has moved."""
    script = loose_sample(grains=150, friction=0.3) + SERVO + "\ncompute i all inertial/number\nthermo_style custom step vol c_i[2] f_s[7]\n" \
        "thermo_modify format float %.17g lost error norm no\nthermo 50\nrun 200\nreset_timestep 100000\nrun 0\nrun 50\nreset_timestep 0\nrun 50\n"
    program.must_run(script, folder, "rate")
    rows = rows_of(folder, "rate", (7, 9))
    expect([row[0] for row in rows[-6:]] == [201, 100000, 100000, 100050, 0, 50], f"steps {[row[0] for row in rows]}")
    for before, now in zip(rows[-7:], rows[-6:]):
        wanted = before[2] if now[1] == before[1] else math.log(before[1] / now[1]) / 3 / ((now[0] - before[0]) * 8e-7)
        expect(wanted > 0 and abs(now[2] / wanted - 1) < 1e-9, f"step {now[0]}: measured rate {now[2]} 1/s, {wanted} of the box")


def main():
    program = program_from_command_line(__doc__)
    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        program.must_run(loose_sample(grains=150, friction=0.3) + SERVO + " inertial_number 1e-3 until target\nrun 400000\nwrite_restart sample.restart\n", folder, "sample")
        for check in (check_without_set_up, check_other_grains, check_inserted_grains, check_static_window, check_order_of_lines, check_measured_rate):
            check(program, folder)
        print(f"{program.ranks} ranks: the servo follows what changes between runs and within them")


if __name__ == "__main__":
    main()
