#!/usr/bin/env python3
"""input_scripts.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

The scenes of input_scripts/ run to their ends on very small, very soft samples, leave what their READMEs say, and keep the
stresses that they impose; the isotropic one goes on from its restart file, and its final state is found by `suffuse-analyse reproduce`
(the program $SUFFUSE_ANALYSE) with the numbers that the run had.
"""
import csv
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
from scenes import columns, expect, program_from_command_line, scratch  # noqa: E402

SCENES = ROOT / "input_scripts"


def results(path):
    with open(path) as file:
        return {row["quantity"]: float(row["value"]) for row in csv.DictReader(file)}


def near(values, name, expected, relative):
    expect(abs(values[name] / expected - 1) <= relative, f"{name} = {values[name]}, not within {100 * relative} % of {expected}")


def check_reproduction(folder, values):
    command = [os.environ["SUFFUSE_ANALYSE"], "reproduce", "table-4-1", folder, "--output", folder / "table.csv"]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=60)
    expect(done.returncode == 0 and b"1 of 63 rows" in done.stdout, done.stdout.decode())
    with open(folder / "table.csv") as file:
        rows = {row["quantity"]: row for row in csv.DictReader(file)}
    # The dump's box has six digits: up to 5e-6 of each side, 1.5e-5 of the volume, and (1 - n)/n = 4 times that of the porosity.
    for name, relative in (("porosity", 1e-4), ("coordination_number", 1e-9), ("alpha_pair_halves", 2e-5), ("alpha_contact_point", 2e-5), ("mean_stress", 3e-5)):
        near(values, name, float(rows[name if name in rows else name + "_pa"]["measured"]), relative)
    expect(rows["alpha_pair_halves"]["thesis"] == "1.789" and rows["porosity"]["state"] == "dense", f"another row: {rows}")


def main():
    program = program_from_command_line(__doc__)

    def run(scene, folder, **variables):
        folder.mkdir(exist_ok=True)
        return program.run_scene(SCENES / scene, folder, variables)

    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        # E = 70 MPa: 33 diameters to an overlap, far softer than soil, and quick.
        small = {"grains": 200, "stiffness_scale": 0.001}
        screen = run("01_isotropic_compression/in.isotropic_compression", folder / "new", restart_every=50000, **small)
        expect("Table 5.1" in screen, "no table of expected values")
        values = results(folder / "new" / "isotropic.csv")
        near(values, "mean_stress", 200e3, 0.005)
        expect(values["unbalanced_force_ratio"] < 1e-3, f"unbalanced: {values['unbalanced_force_ratio']}")
        expect(values["alpha_pair_halves"] > values["alpha_contact_point"] > 0, "alpha by pair halves is the larger for a gap-graded sample")

        check_reproduction(folder / "new", values)

        run("01_isotropic_compression/in.isotropic_compression", folder / "continued", begin="restart",
            restart="../new/compression.50000.restart", **small)
        # The same sample by another order of sums: differences grow along the way, the state does not differ.
        near(results(folder / "continued" / "isotropic.csv"), "void_ratio", values["void_ratio"], 0.03)

        run("02_constant_p_shear/in.constant_p_shear", folder / "shear", sample="../new/isotropic.restart", stiffness_scale=0.001,
            inertial_number=1e-3, axial_strain=0.02)
        series = columns(folder / "shear" / "shear.csv")
        late = [p for p, strain in zip(series["mean_stress_pa"], series["axial_strain"]) if strain > 0]
        # Ten times the default inertial number on a sample of 200 grains: twice the servo's band.
        expect(len(late) > 5 and max(abs(p / 200e3 - 1) for p in late) < 0.01, "constant p' was not kept")
        near(results(folder / "shear" / "shear_result.csv"), "axial_strain", 0.02, 0.01)

        run("08_triaxial/in.triaxial", folder / "triaxial", grains=100, cell_pressure="50e3", axial_strain=0.01)
        near(results(folder / "triaxial" / "triaxial_result.csv"), "lateral_stress", 50e3, 0.01)
        print(f"{program.ranks} ranks: the input scripts run to their ends")


if __name__ == "__main__":
    main()
