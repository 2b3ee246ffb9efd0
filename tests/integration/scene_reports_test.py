#!/usr/bin/env python3
"""scene_reports_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

What the scenes with water make of their records: 04_single_sphere on a coarse lattice in a narrow box, and the lines that
`suffuse-analyse fluidisation` draws through a made-up flow.csv whose critical gradient and conductivity are known, as 03_fluidisation
takes them.
"""
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
import fluidisation_series as made_up  # noqa: E402
from scenes import expect, program_from_command_line, scratch  # noqa: E402

SCENES = ROOT / "input_scripts"


def check_sphere(program, folder):
    """Five diameters between free-slip sides: 1/(1 - 0.75 * 3.90026 a/w) = 1.414 by point forces, which leave out terms of
    (a/w)^3 and higher; three cells a diameter. Together some per cent."""
    screen = program.run_scene(SCENES / "04_single_sphere" / "in.single_sphere", folder, {"resolution": 3, "box": 5, "re": 0.1})
    lines = (folder / "single_sphere_result.csv").read_text().splitlines()
    values = {line.split(",")[1]: float(line.split(",")[2]) for line in lines[1:]}
    expect(abs(values["drag_over_stokes"] / 1.414 - 1) < 0.08, f"drag {values['drag_over_stokes']} of Stokes'")
    expect(abs(values["drag_coefficient"] / (240 * values["drag_over_stokes"]) - 1) < 1e-6, "c_D is not 24/Re times that")
    # The flow has become steady: three times the slowest part's time leave 5 % of a few per cent.
    expect(abs(values["change_in_last_tenth"]) < 0.005, f"still changing by {values['change_in_last_tenth']}")
    expect("re0.1_box5 against" in screen, "no table")
    return values["drag_over_stokes"]


def check_lines(program, folder):
    rows = made_up.rows(made_up.ramp())
    layers = made_up.LAYERS
    for row in rows:
        for k in range(1, layers + 1):
            row[f"effective_stress_ratio_{k}"] = row[f"vertical_stress_pa_{k}"] / rows[0][f"vertical_stress_pa_{k}"]
            row[f"coordination_layer_{k}"] = 5 + 0.1 * k
        row["sauter_diameter_m"] = made_up.DIAMETER
    (folder / "flow.csv").write_text(made_up.text(rows))
    analyse = pathlib.Path(program.suffuse).parent / "suffuse-analyse"
    subprocess.run([analyse, "fluidisation", "flow.csv", "--variables", "results.inc"], cwd=folder, stdout=subprocess.DEVNULL, check=True)
    values = {line.split()[1]: float(line.split()[3]) for line in (folder / "results.inc").read_text().splitlines()}
    weights = [made_up.critical(n) for n in made_up.POROSITIES]
    above = (sum(weights) - 0.5 * weights[-1]) / (layers - 0.5)  # what carries the middle of the lowest layer
    for name, expected in (("stress_gradient", above), ("conductivity", made_up.BED_CONDUCTIVITY), ("coordination_top", 5.1),
                           ("coordination_bottom", 5.4), ("measured_porosity", sum(made_up.POROSITIES) / layers)):
        expect(abs(values[name] / expected - 1) < 1e-6, f"{name} = {values[name]}, not {expected}")  # eight digits are printed
    expect(values["samples"] == sum(0.2 <= row["applied_gradient"] / made_up.BED_CRITICAL <= 0.8 for row in rows), "other samples in the lines")


def main():
    program = program_from_command_line(__doc__)
    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        check_lines(program, folder)
        drag = check_sphere(program, folder)
    print(f"{program.ranks} ranks: drag of a sphere between near sides {drag:.4f} of Stokes'")


if __name__ == "__main__":
    main()
