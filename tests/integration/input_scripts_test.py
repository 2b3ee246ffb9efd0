#!/usr/bin/env python3
"""input_scripts_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

The scenes of input_scripts/ run to their ends on very small, very soft samples, leave what their READMEs say, and keep the
stresses that they impose; the isotropic one goes on from its restart file, and its final state is found by `suffuse-analyse reproduce`
(the program $SUFFUSE_ANALYSE) with the numbers that the run had. Their dumps are what OVITO reads, by the rules of its manual.
"""
import ast
import csv
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
import ovito_rules  # noqa: E402
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
    for name, relative in (("porosity", 1e-4), ("coordination_number", 1e-9), ("alpha_pair_halves", 3e-5), ("alpha_contact_point", 3e-5), ("mean_stress", 3e-5)):
        near(values, name, float(rows[name if name in rows else name + "_pa"]["measured"]), relative)
    for name in ("constriction_ratio", "constriction_ratio_25"):  # the text's cut of a dense soil at 20 %, and the table's at 25
        expect(rows[name]["thesis"] == "0.361", f"{name}: {rows}")
    near({"constriction_ratio_25": float(rows["constriction_ratio_25"]["measured"])}, "constriction_ratio_25", 0.361, 0.1)  # whole grains of 500; 20,000 have 0.367
    expect(rows["alpha_finest_fraction"]["thesis"] == "1.789" and rows["alpha_pair_halves"]["thesis"] == "" and rows["porosity"]["state"] == "dense", f"another row: {rows}")


def grains_of(path):
    """Of a dump: rows of id, type, x, y, z, radius."""
    lines = path.read_text().splitlines()
    return [[float(word) for word in line.split()] for line in lines[9:]]


def check_snapshots(folder, strains):
    for strain in strains:
        expect(len(grains_of(folder / f"shear_{strain}.grains.dump")) > 150, f"no grains at {strain}")
        expect((folder / f"shear_{strain}.contacts.dump").stat().st_size > 1000, f"no contacts at {strain}")
    ovito_rules.check_grains_and_contacts(folder / f"shear_{strains[0]}.grains.dump", folder / f"shear_{strains[0]}.contacts.dump", ovito_columns())


def ovito_columns():
    """What docs/how_to.md says the columns of contacts are in OVITO."""
    page = (ROOT / "docs/how_to.md").read_text(encoding="utf-8")
    return ast.literal_eval(re.search(r"columns=(\[.*?\])\)", page, re.DOTALL)[1])


def check_dumps_of_scenes():
    """Every scene's dump of grains has what OVITO takes by itself."""
    wanted = {"Particle Identifier", "Particle Type", "Position.X", "Position.Y", "Position.Z", "Radius"}
    dumps = [(script, line.split()[5:]) for script in SCENES.rglob("*") if script.name.startswith("in.") or script.suffix == ".inc"
             for line in script.read_text(encoding="utf-8").splitlines() if re.match(r"dump\s+\S+ \S+ custom ", line)]
    expect(len(dumps) >= 3, f"{len(dumps)} dumps of grains in the scenes")
    for script, words in dumps:
        missing = wanted - set(ovito_rules.properties_of(words))
        expect(not missing, f"{script}: its dump of grains has no {missing}")


def check_continued_shear(run, folder):
    """From a restart file in mid-shear the strains go on, and the rest of the way is the same."""
    restarts = sorted((folder / "shear").glob("shear.*.restart"), key=lambda path: int(path.name.split(".")[1]))
    run("02_constant_p_shear/in.constant_p_shear", folder / "shear_continued", sample=f"../shear/{restarts[-1].name}", stiffness_scale=0.001,
        inertial_number=1e-3, axial_strain=0.02, snapshots="0 0.01 0.02 1e9", snapshot_steps=1000)
    begun_at = columns(folder / "shear_continued" / "shear.csv")["axial_strain"][0]
    expect(begun_at > 0.25 * 0.02, f"the continued shear begins at {begun_at}, not where the restart file was written")
    expect(not (folder / "shear_continued" / "shear_0.grains.dump").exists(), "a strain that has passed is dumped again")
    near(results(folder / "shear_continued" / "shear_result.csv"), "volumetric_strain", results(folder / "shear" / "shear_result.csv")["volumetric_strain"], 0.2)


def check_own_grading(run, folder):
    """A sieve curve, loose, at rest in a box that stands still: the grains have its masses, and no row of the thesis is claimed."""
    (folder / "soil.csv").write_text("sieve_mm;percent_passing\n0,25;0\n0,5;40\n1;100\n")
    screen = run("01_isotropic_compression/in.isotropic_compression", folder / "own", grading="../soil.csv", grains=150, state="loose",
                 equilibrium="constant_volume", equilibrium_steps=2000, stiffness_scale=0.001)
    expect("soil_loose against" in screen, "the sample has another name")
    values = results(folder / "own" / "isotropic.csv")
    expect(values["void_ratio"] > 0.3 and abs(values["mean_stress"] / 200e3 - 1) < 0.3, f"{values}")
    expect('table_4_1 = "none"' in (folder / "own" / "sample.toml").read_text() and 'state = "loose"' in (folder / "own" / "sample.toml").read_text(), "sample.toml")
    with open(folder / "own" / "sample.csv") as file:
        classes = list(csv.DictReader(line for line in file if not line.startswith("#")))
    found = [2 * grain[5] for grain in grains_of(folder / "own" / "isotropic.grains.dump")]
    for row in classes:
        count = sum(abs(d / float(row["diameter_m"]) - 1) < 1e-6 for d in found)
        expect(abs(count - float(row["grains"])) < 1, f"{count} grains of {row['diameter_m']} m, not {row['grains']}")
    expect(len(classes) == 20 and all(abs(float(row["mass_fraction"]) - 0.05) < 1e-9 for row in classes), "twenty classes of equal mass")


def check_own_column(run, folder):
    """Scene 03 with a sieve curve: a column of 5 cells per Sauter diameter, as wide as the bed is high."""
    (folder / "soil.csv").write_text("sieve_mm,percent_passing\n1.0,100\n0.71,82\n0.5,55\n0.355,25\n0.3,0\n")
    screen = run("03_fluidisation/in.fluidisation", folder / "column", scale="own", grading=folder / "soil.csv", grains=150, drive="plan", settle_time=0.03,
                 rest_time=1e-3, ramp_time=0.1)
    found = re.search(r"lbm plan: .*? (\d+) x (\d+) x (\d+) cells", screen) or re.search(r"(\d+) x (\d+) x (\d+) cells", screen)
    across, _, up = map(int, found.groups())
    expect(up == 3.5 * across, f"{found.group(0)}: not 3.5 times as high as wide")
    expect("Sauter mean 5" in screen or "Sauter mean 4.9" in screen, "not five cells per Sauter diameter")
    # The same sample again, its water by the accuracy asked for: what lifts a bed is known by the averaged flow.
    screen = run("03_fluidisation/in.fluidisation", folder / "column", scale="own", grading=folder / "soil.csv", grains=150, drive="plan", rest_time=1e-3,
                 ramp_time=0.1, begin="restart", restart="settled.restart", accuracy="10%", accuracy_of="critical_gradient")
    expect("10 % of the critical gradient asked for" in screen and "the same is `lbm method averaged" in screen, f"no averaged flow: {screen[-2000:]}")


def main():
    check_dumps_of_scenes()
    program = program_from_command_line(__doc__)

    def run(scene, folder, **variables):
        folder.mkdir(exist_ok=True)
        return program.run_scene(SCENES / scene, folder, variables)

    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        # E = 70 MPa: 33 diameters to an overlap, far softer than soil, and quick.
        small = {"grains": 200, "stiffness_scale": 0.001}
        screen = run("01_isotropic_compression/in.isotropic_compression", folder / "new", restart_every=5000, **small)
        expect("Table 5.1" in screen, "no table of expected values")
        values = results(folder / "new" / "isotropic.csv")
        near(values, "mean_stress", 200e3, 0.005)
        expect(values["unbalanced_force_ratio"] < 1e-3, f"unbalanced: {values['unbalanced_force_ratio']}")
        expect(values["alpha_pair_halves"] > values["alpha_contact_point"] > 0, "alpha by pair halves is the larger for a gap-graded sample")

        check_reproduction(folder / "new", values)

        written = sorted((folder / "new").glob("compression.*.restart"), key=lambda path: int(path.suffixes[-2][1:]))
        expect(len(written) > 3, f"{len(written)} restart files of the compression")
        run("01_isotropic_compression/in.isotropic_compression", folder / "continued", begin="restart",
            restart=f"../new/{written[len(written) // 2].name}", **small)
        # The same sample by another order of sums: differences grow along the way, the state does not differ.
        near(results(folder / "continued" / "isotropic.csv"), "void_ratio", values["void_ratio"], 0.02)

        run("02_constant_p_shear/in.constant_p_shear", folder / "shear", sample="../new/isotropic.restart", stiffness_scale=0.001,
            inertial_number=1e-3, axial_strain=0.02, restart_every=5000, snapshots="0 0.01 0.02 1e9", snapshot_steps=1000)
        series = columns(folder / "shear" / "shear.csv")
        late = [p for p, strain in zip(series["mean_stress_pa"], series["axial_strain"]) if strain > 0]
        # Ten times the default inertial number on a sample of 200 grains: twice the servo's band.
        expect(len(late) > 5 and max(abs(p / 200e3 - 1) for p in late) < 0.01, "constant p' was not kept")
        near(results(folder / "shear" / "shear_result.csv"), "axial_strain", 0.02, 0.01)
        check_snapshots(folder / "shear", ("0", "0.01", "0.02"))
        check_continued_shear(run, folder)
        check_own_grading(run, folder)

        run("08_triaxial/in.triaxial", folder / "triaxial", grains=100, cell_pressure="50e3", axial_strain=0.01)
        near(results(folder / "triaxial" / "triaxial_result.csv"), "lateral_stress", 50e3, 0.01)
        for path in ("extension", "cyclic"):
            run("08_triaxial/in.triaxial", folder / path, grains=100, cell_pressure="50e3", axial_strain=0.01, path=path, cycles=1, insertion_seed=7)
        near(results(folder / "extension" / "triaxial_result.csv"), "axial_strain", -0.01, 0.01)
        near(results(folder / "cyclic" / "triaxial_result.csv"), "cycles", 1, 1e-9)
        check_own_column(run, folder)
        print(f"{program.ranks} ranks: the input scripts run to their ends")


if __name__ == "__main__":
    main()
