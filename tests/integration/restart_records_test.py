#!/usr/bin/env python3
"""restart_records_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

What a restart file holds of a servo, of scaled densities and of computes that count from a reference is found by their lines
before `dem_timestep` and after it: both scripts go on as the run that was not stopped, to the last digit. (That of a platen:
loading_platen_test.)
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import expect, log_text, loose_sample, program_from_command_line, read_sample, scratch, thermo_rows  # noqa: E402

SAME_ORDER = "atom_modify sort 0 0\nprocessors 1 1 *\n"
# `rayleigh` goes by the time step in force at its first line, not by that of the script that goes on.
LINES = """
fix scaled all density/scaling rayleigh 0.25
fix s all stress/servo constant_volume axis z rate 20
compute lost all broken/contacts
compute strong all strong/contacts threshold frozen
"""
CHECK = "dem_timestep check pressure 100e3\n"
VALUES = "f_s[1] f_s[2] f_s[4] f_s[7] f_s[9] f_scaled[1] f_scaled[6] c_lost[2] c_lost[4] c_strong[2]"
REST = f"""
thermo_style custom step {VALUES}
thermo_modify format float %.17g lost error norm no
thermo 25
run 150
dump grains all custom 1 {{name}}.dump id x y z vx vy vz omegax omegay omegaz fx fy fz
dump_modify grains format "%d{' %.17g' * 12}" sort id
run 0
"""


def results(program, folder, name, script):
    """Rows of the series of the last two runs, and the grains at the end."""
    program.must_run(script + REST.format(name=name), folder, name)
    return thermo_rows(log_text(folder, name), 1 + len(VALUES.split()))[-8:], (folder / f"{name}.dump").read_text()


def main():
    program = program_from_command_line(__doc__)
    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        program.must_run(loose_sample(grains=150, friction=0.3) + "fix s all stress/servo isotropic 100e3 inertial_number 1e-3 until target\nrun 400000\n"
                         "write_restart sample.restart\n", folder, "sample")
        # Sheared until contacts have been lost; 37 steps: between two control steps.
        sheared = read_sample("sample.restart", SAME_ORDER) + LINES + "thermo_style custom step c_lost[2] c_strong[2]\nthermo 500\nrun 4037\nwrite_restart middle.restart\n"
        rows, grains = results(program, folder, "through", sheared + "timestep 4e-7\n")
        expect(len(rows) == 8 and rows[0][3] > 1e-4 and rows[0][8] > 0, f"nothing to go on with: {rows[:1]}")
        for name, lines in (("before", LINES + CHECK), ("after", CHECK + LINES)):
            again, same_grains = results(program, folder, name, read_sample("middle.restart", SAME_ORDER) + "timestep 4e-7\n" + lines)
            amiss = [pair for pair in zip(rows, again) if pair[0] != pair[1]]
            expect(len(again) == 8 and not amiss, f"lines {name} dem_timestep: the series differ, first {amiss[:1]}")
            expect(same_grains == grains, f"lines {name} dem_timestep: the grains differ")
        print(f"{program.ranks} ranks: lines before and after dem_timestep go on from the restart file, to the last digit")


if __name__ == "__main__":
    main()
