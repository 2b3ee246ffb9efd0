#!/usr/bin/env python3
"""loading_platen_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

Platens above and below a sample: they carry the stress asked for, let fines through their opening and hold coarse grains, weigh what
passes so that nothing is lost by class, go on from a restart file to the last digit, and refuse bad words.
"""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import HEADER, columns, expect, material, mistakes_not_named, program_from_command_line, scratch  # noqa: E402

WIDTH, HEIGHT, LOW, HIGH = 2e-3, 9e-3, 0.6e-3, 8.4e-3
STRESS = 1e3
COARSE, FINE, DENSITY = 8e-4, 2e-4, 2650
MATERIAL = material(skin=5e-5, modulus="5e7", friction=0.3)
SETTING = HEADER.format(boundary="p p f") + "processors 1 1 *\natom_modify sort 0 0\n"
GRAINS = f"""
region box block 0 {WIDTH} 0 {WIDTH} 0 {HEIGHT} units box
create_box 1 box
{MATERIAL}
fix motion all nve/sphere
region sample block 0 {WIDTH} 0 {WIDTH} {LOW + COARSE / 2} {HIGH - COARSE / 2} units box
fix coarse all particletemplate/sphere 11593 atom_type 1 density constant {DENSITY} radius constant {COARSE / 2}
fix fine all particletemplate/sphere 11701 atom_type 1 density constant {DENSITY} radius constant {FINE / 2}
fix grading all particledistribution/discrete 32452843 2 coarse 0.9 fine 0.1
fix insertion all insert/pack seed 32452867 distributiontemplate grading maxattempt 1000 insert_every once overlapcheck yes particles_in_region 220 region sample ntry_mc 20000
timestep 1e-6
run 1
unfix insertion
"""
PLATENS = f"""
fix lower all loading/platen lower zplane {LOW} fixed collect {FINE} classes {FINE / 2} {COARSE / 2}
fix upper all loading/platen upper zplane {HIGH} stress {STRESS} speed 0.3 collect {FINE} classes {FINE / 2} {COARSE / 2}
timestep 1e-6
thermo_modify lost ignore norm no
"""
OPEN = "fix weight all gravity 9.81 vector 0 0 -1\nfix_modify lower opening 4e-4\n"
SERIES = """
variable position equal f_upper[1]
variable stress equal f_upper[4]
variable fines equal f_lower[2][2]
variable fines_kg equal f_lower[2][3]
variable coarse equal f_lower[3][2]+f_upper[3][2]+f_lower[1][2]+f_upper[7]
variable kept equal mass(all)
fix series all print 500 "$(step),${{position}},${{stress}},${{fines}},${{fines_kg}},${{coarse}},${{kept}},$(atoms)" file {name}.csv screen no title "step,position,stress,fines,fines_kg,coarse,kept_kg,grains"
"""
PAIRS = """dump pairs all local 1 pairs.dump c_pairs[3] c_pairs[6] c_pairs[12]
dump_modify pairs format "%.12g %.12g %.12g"
run 0
variable top equal f_upper[1]
print "${top}" file top.txt screen no
"""
SMALL = GRAINS.replace("in_region 220", "in_region 20")
PLATEN = "fix p all loading/platen "
# (script after the sample, words that the message must hold)
CASES = [
    (PLATEN + "top zplane 1e-3 fixed\n", ["keyword = top", "upper, lower"]),
    (PLATEN + "upper z 1e-3 fixed\n", ["keyword = z", "zplane"]),
    (PLATEN + "upper zplane 1e-3\n", ["stress = nothing", "fixed"]),
    (PLATEN + "upper zplane 1e-3 stress -5\n", ["stress = -5", "> 0"]),
    (PLATEN + "upper zplane 1e-3 stress 5 fixed\n", ["fixed", "stress"]),
    (PLATEN + "upper zplane 1 fixed\n", ["position = 1", "lie in the box"]),
    (PLATEN + "upper xplane 1e-3 fixed\n", ["periodic along x"]),
    (PLATEN + "upper zplane 1e-3 fixed opening -1e-4\n", ["opening = -0.0001", ">= 0"]),
    (PLATEN + "upper zplane 1e-3 fixed classes 1e-4\n", ["classes", "collect"]),
    (PLATEN + "upper zplane 1e-3 fixed collect 1e-4 classes 2e-4 1e-4\n", ["classes", "rise"]),
    (PLATEN + "upper zplane 1e-3 fixed type 2\n", ["type = 2"]),
    (PLATEN + "upper zplane 1e-3 fixed colour red\n", ["keyword = colour"]),
    (PLATEN + "upper zplane 8e-3 stress 1e3 mass 1e-15 speed 1\nrun 30000\n", ["mass = 1e-15", "timestep"]),
]


def section_stress(dump, height):
    """Vertical force of the contacts between centres below and above a height, over the area, Pa."""
    lines = dump.read_text().splitlines()
    start = next(k for k, line in enumerate(lines) if line.startswith("ITEM: ENTRIES"))
    rows = [[float(word) for word in line.split()] for line in lines[start + 1:]]
    return sum(abs(force) for first, second, force in rows if (first - height) * (second - height) < 0) / WIDTH ** 2


def sample_masses(screen_dump):
    lines = screen_dump.read_text().splitlines()
    start = max(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
    diameters = [2 * float(line.split()[1]) for line in lines[start + 1:]]
    weigh = lambda some: sum(DENSITY * math.pi / 6 * d ** 3 for d in some)  # noqa: E731
    fine = [d for d in diameters if d < COARSE / 2]
    return len(fine), weigh(fine), weigh([d for d in diameters if d >= COARSE / 2])


def main():
    program = program_from_command_line(__doc__)
    dump = "dump {0} all custom 1 {0}.dump id radius\ndump_modify {0} format \"%d %.17g\" first yes\nrun 0\nundump {0}\n"
    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        # Compressed without weight: the sample's own stress is the platen's.
        program.must_run(SETTING + GRAINS + PLATENS + "run 60000\n" + dump.format("start") + "write_restart compressed\n", folder, "compress")
        fines_at_start, fines_kg, coarse_kg = sample_masses(folder / "start.dump")
        expect(fines_at_start > 150, f"only {fines_at_start} fines")
        setting = SETTING + "read_restart {}\n" + MATERIAL + "fix motion all nve/sphere\n" + PLATENS
        program.must_run(setting.format("compressed") + "compute pairs all pair/gran/local pos id force\nrun 6000\n" + PAIRS, folder, "stress")
        top = float((folder / "top.txt").read_text().split()[0])
        sections = [section_stress(folder / "pairs.dump", LOW + share * (top - LOW)) for share in (0.3, 0.5, 0.7)]
        # 1 %: the claim, of what still moves. Through a section go the forces of the contacts that cross it, and nothing else.
        for value in sections:
            expect(abs(value / STRESS - 1) < 0.01, f"stress in sections across the sample: {sections} Pa of {STRESS}")
        # The lower platen opens: fines fall through, and go on doing so after a restart.
        opened = setting.format("compressed") + OPEN + SERIES + "run 20000\nwrite_restart middle\nrun 20000\n" + dump.format("left")
        program.must_run(opened.format(name="through"), folder, "through")
        program.must_run((setting.format("middle") + OPEN + SERIES).format(name="continued") + "run 20000\n", folder, "continued")
        through, continued = columns(folder / "through.csv"), columns(folder / "continued.csv")
        expect(through["fines"][-1] > 20, f"only {through['fines'][-1]} of {fines_at_start} fines have passed")
        expect(through["coarse"][-1] == 0, f"{through['coarse'][-1]} grains passed that should be held")
        for row in range(len(through["step"])):
            sum_kg = through["fines_kg"][row] + through["kept_kg"][row]
            expect(abs(sum_kg / (fines_kg + coarse_kg) - 1) < 1e-12, f"mass at step {through['step'][row]}: {sum_kg} of {fines_kg + coarse_kg} kg")
        fines_left, fines_left_kg, coarse_left_kg = sample_masses(folder / "left.dump")
        expect(fines_left + through["fines"][-1] == fines_at_start, f"{fines_left} fines left, {through['fines'][-1]} passed, {fines_at_start} at the start")
        expect(abs((fines_left_kg + through["fines_kg"][-1]) / fines_kg - 1) < 1e-12 and abs(coarse_left_kg / coarse_kg - 1) < 1e-12, "masses by class")
        later = {name: values[-len(continued["step"]):] for name, values in through.items()}
        first = next((row for row in range(len(continued["step"])) if any(later[name][row] != continued[name][row] for name in later)), None)
        expect(first is None, f"the continued run differs from row {first}: {[(later[name][first or 0], continued[name][first or 0]) for name in later]}")
        # `dem_timestep` leaves the platens what the restart file holds, above their lines and below.
        # From a set saved within a run, whose mass is that of the grains at its beginning.
        check = "timestep 1e-6\ndem_timestep check pressure 1e3\n"
        program.must_run((setting.format("middle") + OPEN + SERIES).format(name="saving") + "restart_set states every 2000\nrun 4000\n", folder, "saving")
        rows = {name: values[-4:] for name, values in columns(folder / "saving.csv").items()}
        for place in ("fix lower", "fix weight"):
            text = (setting.format("states.1/grains") + OPEN + SERIES).format(name="checked").replace(place, check + place)
            program.must_run(text + "restart_set more every 2000\nrun 2000\n", folder, "checked")
            again = {name: values[-4:] for name, values in columns(folder / "checked.csv").items()}
            expect(rows["step"][0] % 2000 == 500 and rows["grains"][0] < columns(folder / "saving.csv")["grains"][0], f"no grain has left: {rows}")
            expect(again == rows, f"dem_timestep before `{place}`: {again}, {rows} of the run that saved")
        amiss = mistakes_not_named(program, [(SETTING + SMALL + words_of, words) for words_of, words in CASES], folder)
        expect(not amiss, "\n".join(amiss))
        print(f"{program.ranks} ranks: stresses {[round(value, 1) for value in sections]} Pa, {through['fines'][-1]:.0f} of {fines_at_start} fines passed, none lost")


if __name__ == "__main__":
    main()
