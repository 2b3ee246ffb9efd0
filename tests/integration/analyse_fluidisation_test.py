#!/usr/bin/env python3
"""analyse_fluidisation_test.py --analyse PROGRAM --figures DIR --gradings DIR: `suffuse-analyse fluidisation` and its figures on made-up runs with known answers.

Good: conductivity and critical gradients of a ramp, of held stages, under noise; contacts of layers from dumps; figures.
Bad: one line, exit code 1, no file left behind.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import fluidisation_series as bed  # noqa: E402
from analyse_runs import PROBLEMS, Runner, expect, rows  # noqa: E402


class FluidisationRunner(Runner):
    def results(self, *words):
        done = self(*words, "--csv", "results.csv", "--json", "results.json", "--overwrite")
        expect(done.returncode == 0, f"{words}: {done.stderr}")
        table = rows(self.folder / "results.csv")
        return {row["quantity"]: float(row["value"]) for row in table if row["layer"] == "" and row["value"]}, table


def near(value, target, share):
    return math.isclose(value, target, rel_tol=share)


MOVES, VANISHES = "critical gradient, bed begins to move", "critical gradient, stress vanishes"
# The lowest layer's stress vanishes where its own and the gradients above have reached theirs: not quite the bed's.
SHARES = [bed.BED_CONDUCTIVITY / bed.conductivity(n) for n in bed.POROSITIES]
WEIGHTS = [1, 1, 1, 0.5]
LOWEST = sum(w * bed.critical(n) for w, n in zip(WEIGHTS, bed.POROSITIES)) / 3.5


def good_series(run, gradings):
    # Terzaghi to round-off; k to round-off; the bed's onset within the ramp's own delay; see the unit tests for noise.
    for name, driving, noise, share in (("ramp.csv", bed.ramp(), 0, 1e-6), ("noise.csv", bed.ramp(), 0.01, 0.01), ("stages.csv", bed.stages(), 0, 1e-6)):
        run.write(name, bed.text(bed.rows(driving, noise)))
        found, table = run.results(name, "--grading", gradings / "appendix_C.csv")
        expect(near(found["critical gradient, Terzaghi"], bed.BED_CRITICAL, 1e-9), f"{name}: Terzaghi's gradient")
        expect(near(found["conductivity, measured"], bed.BED_CONDUCTIVITY, share), f"{name}: conductivity {found['conductivity, measured']}")
        # Grains of the grading are of the size that the series was made with within 0.02 %, so Carman and Kozeny fit but for the layers.
        expect(near(found["conductivity, Carman and Kozeny (180)"], found["conductivity, measured"], 0.01 + share), f"{name}: Carman and Kozeny")
        expect(near(found[VANISHES], LOWEST, share), f"{name}: stress vanishes at {found[VANISHES]}, not {LOWEST}")
        expect(near(found[MOVES], bed.BED_CRITICAL, 0.01), f"{name}: moves at {found[MOVES]}")
        if noise == 0:
            layers = [row for row in table if row["layer"] and row["quantity"] == "critical gradient, stress over the gradient above"]
            expect(len(layers) == bed.LAYERS and near(float(layers[0]["value"]), bed.critical(bed.POROSITIES[0]), 1e-6), f"{name}: layers")
            expect(near(found["constraint ratio at rest"], 1.35, 1e-9), f"{name}: R at rest")
    written = json.loads((run.folder / "results.json").read_text(encoding="utf-8"))
    values = {row["quantity"]: row["value"] for row in written["results"]}
    expect(values[MOVES] == found[MOVES] and len(written["layers"]) == bed.LAYERS, "JSON says the same as CSV")
    short = run.results(run.write("short.csv", bed.text(bed.rows(bed.ramp(end=0.9)))))[0]
    expect(MOVES not in short and VANISHES in short, "no onset where there is none")
    gas = run.results("ramp.csv", "--fluid-density", 500, "--porosity", 0.4)[0]
    expect(near(gas["critical gradient, Terzaghi"], 4.3 * 0.6, 1e-9), "densities and porosity are options")


DUMP_HEAD = "ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF {what}\n{count}\nITEM: BOX BOUNDS ff ff ff\n0 2e-3\n0 1e-3\n0 9e-3\n"


def grains_dump(step):
    """Two columns of eight grains of 1 mm; those of the second are a little smaller, below d50."""
    lines = []
    for column in range(2):
        for k in range(8):
            lines.append(f"{8 * column + k + 1} {0.5e-3 if column == 0 else 0.499e-3} {0.5e-3 + 1e-3 * column} 0.5e-3 {(k + 0.5) * 1e-3}")
    return DUMP_HEAD.format(step=step, what="ATOMS", count=16) + "ITEM: ATOMS id radius x y z\n" + "\n".join(lines) + "\n"


def contacts_dump(step, pairs):
    """Pairs with (normal, tangential) force, N."""
    place = {i + 1: (0.5e-3 + 1e-3 * (i // 8), 0.5e-3, (i % 8 + 0.5) * 1e-3) for i in range(16)}
    lines = []
    for (a, b), (normal, tangential) in pairs.items():
        vertical = abs(place[a][2] - place[b][2]) > 1e-4
        fn = (0, 0, -normal) if vertical else (-normal, 0, 0)
        ft = (tangential, 0, 0) if vertical else (0, 0, tangential)
        values = [*place[a], *place[b], a, b, 0, *(n + t for n, t in zip(fn, ft)), *fn, *ft]
        lines.append(" ".join(map(str, values)))
    names = " ".join(f"c_pairs[{k + 1}]" for k in range(18))
    return DUMP_HEAD.format(step=step, what="ENTRIES", count=len(pairs)) + f"ITEM: ENTRIES {names}\n" + "\n".join(lines) + "\n"


def onset_of_dumps(run):
    """The table of the onset: the last snapshot before it, beside the thesis's numbers for its own soil only."""
    table = {(row["quantity"], row["layer"]): row for row in rows(run.folder / "onset.csv")}
    broken = table["broken contacts, gross", "all"]
    expect(near(float(broken["at_onset"]), 1 / 14, 1e-4) and float(broken["at_rest"]) == 0, f"onset: {broken}")
    expect(float(table["mechanically stable grains", "1"]["at_rest"]) == 0 and ("constraint ratio", "4") in table, "onset: top and lowest layer")
    expect(all(row["thesis_at_onset"] == "" for row in table.values()), "another soil than the thesis's")
    gradient = float(table["hydraulic gradient of the bed", "all"]["at_onset"])
    expect(near(gradient, bed.BED_CRITICAL, 0.01), f"onset: gradient {gradient}")


def dumped_layers(run):
    table = bed.rows(bed.ramp())
    for k, row in enumerate(table):
        row |= {"dem_step": 10.0 * k, "layers_height_m": 8e-3}
    run.write("dumped.csv", bed.text(table))
    rest = {(8 * c + k, 8 * c + k + 1): (1e-3 * (8 - k) ** 1.5, 0.0) for c in range(2) for k in range(1, 8)}
    later = dict(rest)
    del later[(6, 7)]            # at 6 mm: layer 1 of four, the top one
    later[(7, 15)] = (1e-3, 0.0)  # across, at 6.5 mm
    later[(1, 2)] = (1e-3, 0.3e-3)  # slides, and has become weak; at 1 mm, layer 4
    for step, pairs in ((0, rest), (2000, later)):
        run.write(f"grains.{step}.dump", grains_dump(step))
        run.write(f"contacts.{step}.dump", contacts_dump(step, pairs))
    done = run("dumped.csv", "--dumps", "grains.*.dump", "contacts.*.dump", "--measures", "measures.csv", "--distributions", "shares.csv", "--onset", "onset.csv")
    expect(done.returncode == 0, f"dumps: {done.stderr}")
    found = {(row["step"], row["layer"]): row for row in rows(run.folder / "measures.csv")}
    expect(len(found) == 2 * (bed.LAYERS + 1), "two snapshots of four layers and all of them")
    whole = found["2000", "all"]
    expect(near(float(whole["broken_contacts_gross"]), 1 / 14, 1e-4) and abs(float(whole["broken_contacts_net"])) < 1e-12, "one of 14 lost, one formed")
    # Layer 1 is 6 to 8 mm; the contact at 6 mm is on the boundary, in layer 2 (rounding may put it into either).
    lost = [float(found["2000", layer]["broken_contacts_gross"]) for layer in "1234"]
    expect(sorted(lost)[:3] == [0, 0, 0] and max(lost) > 0.2, f"contacts lost by layers: {lost}")
    expect(near(float(whole["coordination_number"]), 2 * 14 / 16, 1e-4), "Z = 2 N_c/N_p")
    expect(near(float(whole["sliding_share"]), 1 / 14, 1e-4), "one of 14 slides")
    # Forces at rest are j^1.5 mN, j = 1 ... 7, of mean 8.77: j = 5, 6, 7 are strong, and one of the sevens no more later.
    expect(near(float(found["0", "all"]["strong_share"]), 6 / 14, 1e-4), "strong contacts at rest")
    expect(near(float(whole["strong_share"]), 5 / 14, 1e-4), "and later, by the mean at rest")
    expect(near(float(whole["constraint_ratio"]), 1.75 * (3 - 2 / 14) / 12, 1e-4) and whole["verdict"] == "fluid-like", "R = Z(3 - 2 S_c)/12")
    # Layers may begin above the floor: then what lies below is in none of them.
    lifted = run.write("lifted.csv", bed.text([row | {"layers_floor_m": 2e-3, "layers_top_m": 6e-3} for row in table]))
    done = run(lifted, "--dumps", "grains.*.dump", "contacts.*.dump", "--measures", "lifted_measures.csv")
    counted = {row["layer"]: float(row["grains"]) for row in rows(run.folder / "lifted_measures.csv") if row["step"] == "0"}
    expect(done.returncode == 0 and counted["all"] == 8 and "without the bottom layer" not in done.stdout, f"a floor layer left out: {counted}")
    gradient = float(whole["bed_gradient"])
    expect(near(gradient, sum(table[200][f"hydraulic_gradient_layer_{k}"] for k in (1, 2, 3, 4)) / 4, 1e-9), "gradient at the dump's step")
    # Of the first column's contacts, 1 to 7 mm: forces are carried over 1 mm each, so the stress is shared as they are.
    forces = [1e-3 * j**1.5 for j in range(1, 8)]
    expect(near(float(found["0", "all"]["strong_stress_share"]), sum(forces[4:]) / sum(forces), 1e-3), "stress that strong contacts carry")
    onset_of_dumps(run)
    shares = [row for row in rows(run.folder / "shares.csv") if row["step"] == "2000" and row["layer"] == "all"]
    slipping = [float(row["share"]) for row in shares if row["distribution"] == "slipping_index"]
    expect(near(slipping[-1], 1 / 14, 1e-4) and near(sum(slipping), 1, 1e-4), "S_i: one of 14 in the last bin")
    large = [float(row["share"]) for row in shares if row["distribution"] == "contacts_of_d85_and_larger"]
    # The larger column: ends 1 and 8 have one contact, 6 lost one, 7 lost one and gained one; 2, 3, 4, 5, 7 have two.
    expect([round(8 * share) for share in large[:3]] == [0, 3, 5], f"contacts of the larger grains: {large}")


def python_that_draws():
    """This Python, or Debian's, or None."""
    for python in (sys.executable, "/usr/bin/python3"):
        if pathlib.Path(python).exists() and subprocess.run([python, "-c", "import matplotlib, h5py"], capture_output=True).returncode == 0:
            return python
    return None


def figures(run, folder, python):
    def draw(*words):
        return subprocess.run([python, folder / "fluidisation.py", *map(str, words)], cwd=run.folder, capture_output=True, text=True, timeout=120)

    for name in ("ramp", "stages"):
        run(f"{name}.csv", "--csv", "results.csv", "--overwrite")
        done = draw(f"{name}.csv", "--results", "results.csv", "--output", f"{name}.png", f"{name}.pdf")
        expect(done.returncode == 0 and (run.folder / f"{name}.png").stat().st_size > 10000, f"figure of {name}: {done.stderr}")
    done = draw("--measures", "measures.csv", "--distributions", "shares.csv", "--output", "contacts.png")
    expect(done.returncode == 0 and (run.folder / "contacts.png").stat().st_size > 10000, f"figure of contacts: {done.stderr}")
    made = subprocess.run([python, "-c", FIELDS, run.folder], capture_output=True, text=True)
    expect(made.returncode == 0, f"fields: {made.stderr}")
    done = draw("--fields", "flow.h5", "--output", "slice.png")
    expect(done.returncode == 0 and (run.folder / "slice.png").stat().st_size > 5000, f"slice: {done.stderr}")
    for words, says in ((("--fields", "ramp.csv"), "lbm output"), (("short_row.csv",), "values"), (("--fields", "flow.h5", "--position", 1), "between")):
        run.write("short_row.csv", "a,b\n1\n")
        done = draw(*words, "--output", "none.png")
        expect(done.returncode != 0 and says in done.stderr and "Traceback" not in done.stderr, f"figure of {words}: {done.stderr}")


FIELDS = """
import pathlib, sys, h5py, numpy
folder = pathlib.Path(sys.argv[1])
with h5py.File(folder / "flow.h5", "w") as file:
    group = file.create_group("step_000000000001")
    group.attrs["time_s"] = 0.1
    group["velocity"] = numpy.full((12, 6, 8, 3), 1e-3, dtype="f4")
    group["pressure"] = numpy.linspace(10, 0, 12 * 48, dtype="f4").reshape(12, 6, 8)
with h5py.File(folder / "flow_grains.h5", "w") as file:
    group = file.create_group("step_000000000001")
    group.attrs["time_s"] = 0.1
    group["grains/position"] = numpy.array([[0.2e-3, 0.3e-3, 0.3e-3], [0.7e-3, 0.1e-3, 0.5e-3]])
    group["grains/radius"] = numpy.array([0.15e-3, 0.1e-3])
(folder / "flow.xdmf").write_text('<Xdmf><Domain><Grid Name="fluid"><Grid Name="step_000000000001"><Geometry GeometryType="ORIGIN_DXDYDZ">'
                                  "<DataItem>0 0 0</DataItem><DataItem>1e-4 1e-4 1e-4</DataItem></Geometry></Grid></Grid></Domain></Xdmf>")
"""


def refused(run, what, says, *words):
    done = run(*words, "--csv", "no.csv", "--json", "no.json")
    lines = done.stderr.strip().splitlines()
    expect(done.returncode == 1, f"{what}: exit code {done.returncode}")
    expect(len(lines) == 1 and says in lines[0], f"{what}: says {done.stderr!r}, not {says!r} in one line")
    expect(done.stdout == "" and not list(run.folder.glob("no.*")), f"{what}: prints or leaves something")


def bad_input(run):
    table = bed.rows(bed.ramp())
    lines = bed.text(table).splitlines()

    def broken(name, changed):
        return run.write(name, "\n".join(changed) + "\n")

    refused(run, "no such file", "nowhere.csv", "nowhere.csv")
    refused(run, "empty", "no rows", run.write("bad.csv", ""))
    refused(run, "only a header", "no rows", broken("bad.csv", lines[:1]))
    refused(run, "cut short", "line 300", broken("bad.csv", [*lines[:299], lines[299][:40]]))
    refused(run, "nan", "finite", broken("bad.csv", [*lines[:50], lines[50].replace(lines[50].split(",")[3], "nan"), *lines[51:]]))
    refused(run, "a word", "'fast'", broken("bad.csv", [*lines[:50], "fast" + lines[50][lines[50].index(","):], *lines[51:]]))
    refused(run, "a name twice", "twice", broken("bad.csv", [lines[0].replace("bed_porosity", "time_s"), *lines[1:]]))
    for column in ("hydraulic_gradient_layer_1", "superficial_velocity_z_m_per_s", "time_s"):
        refused(run, f"no {column}", f"no column {column}", broken("bad.csv", [lines[0].replace(column, "x_" + column), *lines[1:]]))
    refused(run, "too short a run", "at least three", broken("bad.csv", lines[:40]))
    refused(run, "a porosity above 1", "between 0 and 1", broken("bad.csv", bed.text([row | {"bed_porosity": 1.2} for row in table]).splitlines()))
    refused(run, "bad grading", "diameter_m", "ramp.csv", "--grading", "ramp.csv")
    refused(run, "window the wrong way round", "LOW HIGH", "ramp.csv", "--window", 0.8, 0.2)
    refused(run, "heavier fluid", "above the fluid's", "ramp.csv", "--fluid-density", 3000)
    refused(run, "measures without dumps", "--dumps", "ramp.csv", "--measures", "no.m.csv")
    refused(run, "onset without dumps", "--dumps", "ramp.csv", "--onset", "no.o.csv")
    refused(run, "record without steps", "dem_step", "ramp.csv", "--dumps", "grains.*.dump", "contacts.*.dump", "--measures", "no.m.csv")
    rows_elsewhere = [row | {"dem_step": 1e6 + k, "layers_height_m": 8e-3} for k, row in enumerate(table)]
    refused(run, "dumps of another run", "no snapshot", run.write("elsewhere.csv", bed.text(rows_elsewhere)), "--dumps", "grains.*.dump", "contacts.*.dump")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--analyse", type=pathlib.Path, required=True)
    parser.add_argument("--figures", type=pathlib.Path, required=True)
    parser.add_argument("--gradings", type=pathlib.Path, required=True)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        run = FluidisationRunner(options.analyse.resolve(), pathlib.Path(folder), "fluidisation")
        good_series(run, options.gradings.resolve())
        dumped_layers(run)
        python = python_that_draws()
        if python:
            figures(run, options.figures.resolve(), python)
        else:
            print("figures are not drawn: no Python here has matplotlib and h5py")
        bad_input(run)
    if PROBLEMS:
        sys.exit(f"{len(PROBLEMS)} failed")
    print("all as expected")


if __name__ == "__main__":
    main()
