#!/usr/bin/env python3
"""analyse_program_test.py --analyse PROGRAM

`suffuse-analyse` as a program: help and version; one line and exit code 1 for every mistake, with nothing left behind, neither a
result nor a part of one; results as CSV, JSON and figures; and samples that no table has are refused, rows not run left out.
"""
import argparse
import csv
import json
import math
import pathlib
import subprocess
import tempfile

from program_under_test import Program, check, python_with_figures

RADIUS = 0.5e-3
SIDE = 3


def packing(step, force=0.25):
    """A periodic simple cubic packing: text of grains and contacts. Contacts along z push twice as hard."""
    length = 2 * RADIUS * SIDE
    head = f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF {{}}\n{{}}\nITEM: BOX BOUNDS pp pp pp\n" + 3 * f"0 {length}\n"
    cells = [(x, y, z) for x in range(SIDE) for y in range(SIDE) for z in range(SIDE)]
    number = {cell: k + 1 for k, cell in enumerate(cells)}
    place = lambda cell: [(c + 0.5) * 2 * RADIUS for c in cell]  # noqa: E731
    grains = [f"{number[c]} {' '.join(f'{v:g}' for v in place(c))} {RADIUS}" for c in cells]
    contacts = []
    for cell in cells:
        for axis in range(3):
            other = tuple((c + (a == axis)) % SIDE for a, c in enumerate(cell))
            push = [-force * (1 + (axis == 2)) if a == axis else 0 for a in range(3)]
            contacts.append(" ".join(f"{v:g}" for v in place(cell) + place(other) + [number[cell], number[other], 1] + push))
    return (head.format("ATOMS", len(grains)) + "ITEM: ATOMS id x y z radius\n" + "\n".join(grains) + "\n",
            head.format("ENTRIES", len(contacts)) + "ITEM: ENTRIES " + " ".join(f"c_1[{k}]" for k in range(1, 13)) + "\n" + "\n".join(contacts) + "\n")


def check_results(program):
    folder = program.folder
    out = program.must_run("contacts", "c.dump", "g.dump", "--output", "series.csv", "--json", "series.json", "--force-pdf", "pdf.csv", "--force-bin", "0.5")
    check("Z" in out and len(out.splitlines()) == 4, f"the table on the screen:\n{out}")
    rows = list(csv.DictReader(open(folder / "series.csv")))
    check([row["step"] for row in rows] == ["10", "20"], f"steps {rows}")
    stress = 0.25 / (4 * RADIUS ** 2)
    for row, other in zip(rows, json.load(open(folder / "series.json"))):
        check(set(row) == set(other), "CSV and JSON have other columns")
        for name, text in row.items():
            check((other[name] is None) if text == "" else float(text) == other[name], f"{name} is {text} in CSV and {other[name]} in JSON")
        # By hand: sigma_xx = F/(2r)^2, sigma_zz twice that; 1e-6: the dump's six digits.
        for name, expected in (("stress_xx_pa", stress), ("stress_zz_pa", 2 * stress), ("coordination_number", 6), ("strong_share", 1 / 3),
                               ("axial_deviatoric_stress_pa", stress), ("porosity", 1 - math.pi / 6)):
            check(abs(float(row[name]) / expected - 1) < 1e-6, f"{name} = {row[name]}, by hand {expected}")
        check(row["alpha_pair_halves"] == "" and row["time_s"] == "", "a number where there is none")
    pdf = [row for row in csv.DictReader(open(folder / "pdf.csv")) if row["step"] == "10"]
    # Two thirds of the contacts at 3/4 of the mean force, one third at 3/2: bins of 0.5.
    check([round(float(row["density_normal"]) * 0.5, 9) for row in pdf[:4]] == [0, round(2 / 3, 9), 0, round(1 / 3, 9)], f"force PDF {pdf[:4]}")


def check_split_by_share(program):
    """Layers of 0.9, 0.95 and 1 times the radius hold 28, 33 and 39 % of the solid: a share cuts where it comes nearest."""
    lines = packing(1)[0].splitlines()
    for k in range(9, len(lines)):
        words = lines[k].split()
        layer = int(float(words[3]) / (2 * RADIUS))
        lines[k] = " ".join([*words[:4], f"{RADIUS * (0.9, 0.95, 1)[layer]:.6g}"])
    (program.folder / "layers.dump").write_text("\n".join(lines) + "\n")
    (program.folder / "layers_contacts.dump").write_text(packing(1)[1])
    for share, diameter, fines in (("20%", 0.925e-3, 0.282), ("60%", 0.975e-3, 0.613), ("40%", 0.925e-3, 0.282), ("99%", 0.975e-3, 0.613)):
        rows = []
        for split in (share, diameter):
            program.must_run("contacts", "layers.dump", "layers_contacts.dump", "--split", split, "--output", "layers.csv", "--overwrite")
            rows += list(csv.DictReader(open(program.folder / "layers.csv")))
        check(rows[0] == rows[1] and rows[0]["alpha_pair_halves"] != "", f"--split {share} is not --split {diameter}: {rows}")
        check(abs(float(rows[0]["fines_solid_share"]) - fines) < 1e-3, f"--split {share}: {rows[0]['fines_solid_share']} are fines, not {fines}")
    program.must_refuse(["contacts", "c.dump", "g.dump", "--split", "20%"], "--split", "one")
    # Beside all sizes: metres were meant to be millimetres, or the grains have none that small.
    words = ["contacts", "layers.dump", "layers_contacts.dump", "--split"]
    program.must_refuse([*words, "0.95"], "--split = 0.95 m", "the largest grain, 0.001 m")
    out = program.must_run(*words, "0.95e-6", "--output", "layers.csv", "--overwrite")
    check("warning: no grain is smaller than --split = 9.5e-07 m (the grains have 0.0009 to 0.001 m)" in out, out)
    check(next(csv.DictReader(open(program.folder / "layers.csv")))["fines"] == "0", "fines of nothing")
    check("warning" not in program.must_run(*words, "0.95e-3"), "a warning for nothing")
    # Of a region whose own grains are all alike those around it count.
    check("warning" not in program.must_run(*words, "0.95e-3", "--region", 0, 3e-3, 0, 3e-3, 2e-3, 3e-3), "a warning for a part")
    for wrong in ("0%", "100%", "-5%", "%", "x%"):
        program.must_refuse(["contacts", "layers.dump", "layers_contacts.dump", "--split", wrong], "--split", wrong)


def check_shear(program):
    """A ramp of q/p' to 1 at 4 % and down, after two samples of waiting; in extension the same by magnitudes."""
    for sign in (1, -1):
        rows = [(0, 0), (0, 0)] + [(k * 1e-3, min(k, 80 - k) / 40) for k in range(1, 61)]
        text = "".join(f"{sign * e},200e3,{sign * 200e3 * ratio}\n" for e, ratio in rows)
        (program.folder / "shear.csv").write_text("axial_strain,mean_stress_pa,deviatoric_stress_pa\n" + text)
        program.must_run("shear", "shear.csv", "--output", "curves.csv", "--overwrite")
        found = {row["quantity"]: row["value"] for row in csv.DictReader(open(program.folder / "curves.csv"))}
        check(abs(float(found["peak_stress_ratio"]) - 1) < 0.02 and abs(float(found["axial_strain_at_peak"]) - 0.04) < 1e-9, f"{sign}: {found}")
        check(abs(float(found["stress_ratio_at_end"]) - 0.5) < 1e-9 and found["coordination_start"] == "", f"{sign}: {found}")
    (program.folder / "cycle.csv").write_text("axial_strain,mean_stress_pa,deviatoric_stress_pa\n0,1,0\n0.01,1,1\n0.005,1,0\n0.02,1,1\n")
    program.must_refuse(["shear", "cycle.csv"], "cycle.csv", "grow from sample to sample")
    (program.folder / "unsheared.csv").write_text("time_s,mean_stress_pa\n0,1\n1,1\n2,1\n")
    program.must_refuse(["shear", "unsheared.csv"], "axial_strain")


def check_undefined(program):
    """What is not defined is an empty cell in a table and a dash on the screen, never nan or inf."""
    # A sample without any stress or contact, and one that has lost both at the end.
    for name, lost_from in (("empty.csv", 0), ("lost.csv", 50)):
        rows = "".join(f"{k * 1e-3},{200e3 * (k < lost_from)},{2e3 * k * (k < lost_from)},{4.0 * (k < lost_from)},{1.0 * (k < lost_from)}\n" for k in range(61))
        (program.folder / name).write_text("axial_strain,mean_stress_pa,deviatoric_stress_pa,coordination_number,alpha_pair_halves\n" + rows)
        out = program.must_run("shear", name, "--output", "curves.csv", "--overwrite")
        text = (program.folder / "curves.csv").read_text()
        check(not any(word in (out + text).lower().replace(name, "") for word in ("nan", "inf")), f"{name}: {out}\n{text}")
        found = {row["quantity"]: row["value"] for row in csv.DictReader(text.splitlines())}
        check(found["stress_ratio_at_end"] == "" and found["peak_deviatoric_stress_pa"] != "", f"{name}: {found}")
        if lost_from:
            check(abs(float(found["peak_stress_ratio"]) - 0.49) < 0.01 and float(found["coordination_drop"]) == 1, f"{name}: {found}")
        else:
            check(found["peak_stress_ratio"] == found["axial_strain_at_peak"] == found["coordination_drop"] == "", f"{name}: {found}")


def check_suffusion(program):
    """Onsets by the gradient's magnitude, upwards and downwards; a layer without fines; and series that go back in time."""
    head = "time_s,applied_gradient,eroded_fines_share,fines_share_layer_1,fines_share_layer_2,hydraulic_gradient_layer_1,hydraulic_gradient_layer_2\n"
    for sign, note in ((1, ""), (-1, "downwards")):
        # A layer that loses a tenth of its fines from the sixth sample on, and one that never had any.
        rows = "".join(f"{k},{sign * 0.1 * k},{0.002 * max(0, k - 7)},0,{0.2 - 0.004 * max(0, k - 5)},{sign * 0.1 * k},{sign * 0.1 * k}\n" for k in range(20))
        (program.folder / "washed.csv").write_text(head + rows)
        out = program.must_run("suffusion", "washed.csv", "--output", "onsets.csv", "--overwrite")
        found = {row["quantity"]: row for row in csv.DictReader(open(program.folder / "onsets.csv"))}
        inside, few = found["gradient, fines begin to move inside"], found["gradient, 0.2 % of the fines have left"]
        check(abs(float(inside["value"]) - 0.8) < 1e-9 and abs(float(few["value"]) - 0.8) < 1e-9, f"{sign}: {found}")
        check(inside["note"] == note and ("downwards" in out) == bool(note) and "largest gradient 1.900" in out, out)
    lines = (program.folder / "washed.csv").read_text().splitlines()
    (program.folder / "again.csv").write_text("\n".join([*lines[:12], *lines[8:]]) + "\n")
    program.must_refuse(["suffusion", "again.csv"], "again.csv, line 13, time_s = 7 after 10", "not go back")
    (program.folder / "once_more.csv").write_text("\n".join([*lines[:12], *lines[11:]]) + "\n")
    program.must_run("suffusion", "once_more.csv")  # a sample that a restart has written again


def check_outputs(program):
    """No file is written twice or over one that is read, however it is spelled; --overwrite changes nothing of that."""
    folder = program.folder
    (folder / "soil.csv").write_text("sieve_mm,percent_passing\n0.1,0\n0.2,20\n1,25\n2,100\n")
    (folder / "link.csv").symlink_to("soil.csv")
    (folder / "sub").mkdir()
    before = {path: path.read_bytes() for path in folder.glob("*.*") if path.is_file()}
    here = folder.name
    for first, second in (("a.csv", "a.csv"), ("a.csv", "./a.csv"), ("sub/../a.csv", f"../{here}/a.csv"), (folder / "a.csv", "a.csv"), ("a.csv", "a.csv.part")):
        program.must_refuse(["contacts", "c.dump", "g.dump", "--output", first, "--json", second], f"--json = {second}", "that of --output")
        program.must_refuse(["grading", "soil.csv", "--output", first, "--shape", second, "--overwrite"], f"--shape = {second}", "that of --output")
    for words, name in ((["grading", "soil.csv", "--curve"], "./soil.csv"), (["grading", "link.csv", "--curve"], "soil.csv"), (["contacts", "c.dump", "g.dump", "--output"], "sub/../g.dump"),
                        (["contacts", "?.dump", "--json"], "c.dump"), (["shear", "shear.csv", "cycle.csv", "--output"], "cycle.csv"), (["suffusion", "washed.csv", "--output"], "washed.csv"),
                        (["rose", "c.dump", "g.dump", "--output", "r.csv", "--fits"], "c.dump"), (["hydraulic", "soil.csv", "--porosity", "0.3", "--output"], "soil.csv"),
                        (["constriction", "soil.csv", "--output"], "soil.csv"), (["verdict", "soil.csv", "--output"], "soil.csv"), (["reproduce", "table-4-1", "a", "--output"], "a/sample.toml")):
        program.must_refuse([*words, name, "--overwrite"], name, "not be a file that is read")
    program.must_refuse(["sample", "soil.csv", "--grains", "100", "--output", "soil", "--overwrite"], "soil.csv", "not be a file that is read")
    check(before == {path: path.read_bytes() for path in folder.glob("*.*") if path.is_file()}, "a file that is read has changed")
    program.must_run("grading", "soil.csv", "--output", "a.csv", "--shape", "sub/a.csv")


def check_rose(program, has_figures):
    words = ["rose", "c.dump", "g.dump", "--plane", "xz", "--output", "rose.csv", "--fits", "fits.csv", "--sphere", "sphere.csv", "--cells", "60"]
    out = program.must_run(*words, *(["--figure", "rose.svg", "--sphere-figure", "sphere.png"] if has_figures else []))
    check("step 20" in out, out)
    rows = list(csv.DictReader(open(program.folder / "rose.csv")))
    width = 2 * math.pi / 36
    check(len(rows) == 36 and abs(sum(float(r["contact_density_per_rad"]) for r in rows) * width - 1) < 1e-12, "the density does not add up to 1")
    check(sorted({float(r["contacts"]) for r in rows}) == [0, 27], "normals along x and z only, 27 each way")
    ratio = float(rows[9]["normal_force_density_per_rad"]) / float(rows[0]["normal_force_density_per_rad"])
    check(abs(ratio - 2) < 1e-12, f"the normal force along z is {ratio} times that along x, not 2")
    sphere = list(csv.DictReader(open(program.folder / "sphere.csv")))
    total = sum(float(r["contact_density_per_sr"]) * float(r["solid_angle_sr"]) for r in sphere)
    check(abs(total - 1) < 1e-12 and sum(float(r["contacts"]) for r in sphere) == 162, "the spherical histogram does not hold all contacts")
    if has_figures:
        check((program.folder / "rose.svg").stat().st_size > 5000 and (program.folder / "sphere.png").stat().st_size > 5000, "no figures")


def check_reproduce(program):
    folder = program.folder
    (folder / "a").mkdir()
    (folder / "a" / "grains.dump").write_text(packing(5)[0])
    (folder / "a" / "contacts.dump").write_text(packing(5)[1])
    toml = folder / "a" / "sample.toml"
    toml.write_text('table_4_1 = "1"\nstate = "loose"\nsplit_m = 1e-4\n')
    out = program.must_run("reproduce", "table-4-1", ".", "--output", "table.csv")
    check("1 loose" in out and "1 of 63 rows" in out and "8b" not in out, out)
    check("0 of 1 samples have the thesis's verdict" in out, out)  # stable there; here, without fines, unknown
    rows = {row["quantity"]: row for row in csv.DictReader(open(folder / "table.csv"))}
    check(float(rows["coordination_number"]["measured"]) == 6 and rows["coordination_number"]["thesis"] == "4.317", f"{rows}")
    check(rows["kenney_lau_ratio"]["thesis"] == "" and rows["alpha_pair_halves"]["measured"] == "", "a number where there is none")
    program.must_refuse(["reproduce", "table-5-1", "a"], "table-5-1", "no folder")
    # A second sample, of another row: both, each with its own numbers of the thesis, and none of the others.
    (folder / "more" / "b").mkdir(parents=True)
    for name in ("grains.dump", "contacts.dump"):
        (folder / "more" / "b" / name).write_text((folder / "a" / name).read_text())
    (folder / "more" / "b" / "sample.toml").write_text('table_4_1 = "11a"\nstate = "dense"\nsplit_m = 1e-4\n')
    out = program.must_run("reproduce", "table-4-1", "a", "more", "--output", "two.csv")
    check("1 loose" in out and "11a dense" in out and "2 of 63 rows" in out, out)
    two = {(row["sample"], row["state"], row["quantity"]): row["thesis"] for row in csv.DictReader(open(folder / "two.csv"))}
    check({key[:2] for key in two} == {("1", "loose"), ("11a", "dense")}, f"{sorted(two)}")
    check([two[sample + ("coordination_number",)] for sample in (("1", "loose"), ("11a", "dense"))] == ["4.317", "0.082"], f"{two}")
    for text, words in (('table_4_1 = "99"\nstate = "loose"\n', ("99", "sample of the table")), ('table_4_1 = "1"\n', ("state",)),
                        ('table_4_1 = "1"\nstate = "soft"\n', ("soft", "loose, medium or dense")), ('table_4_1 = "1\n', ("sample.toml", "line 1")),
                        ('table_4_1 = "1"\nfriction_compression = 0.2\n', ("0.2",)), ('tabel = "1"\n', ("tabel", "table_4_1")),
                        ('state = "loose"\n', ("table_4_1",)), ('table_4_1 = "1"\nstate = "loose"\ngrains = "none.dump"\n', ("none.dump",)),
                        ('table_4_1 = "1"\nstate = "loose"\n', ("--split", "gap"))):
        toml.write_text(text)
        program.must_refuse(["reproduce", "table-4-1", "a", "--output", "other.csv"], "reproduce table-4-1", *words)
    program.must_refuse(["reproduce", "table-4-1", "nowhere"], "nowhere", "folder")


def write_gap_graded(folder, coarse, fines):
    """Spheres on a lattice, of 2 and 0.5 mm, one contact; a sample of row 11b."""
    folder.mkdir(parents=True)
    sizes = [2e-3] * coarse + [0.5e-3] * fines
    box = "0 0.048\n" * 3
    rows = "".join(f"{k + 1} 1 {k % 12 * 0.004 + 0.002:.6g} {k // 12 % 12 * 0.004 + 0.002:.6g} {k // 144 * 0.004 + 0.002:.6g} {radius}\n" for k, radius in enumerate(sizes))
    (folder / "grains.dump").write_text(f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{len(sizes)}\nITEM: BOX BOUNDS pp pp pp\n{box}ITEM: ATOMS id type x y z radius\n{rows}")
    columns = " ".join(f"c_pairs[{k}]" for k in range(1, 19))
    (folder / "contacts.dump").write_text(f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n1\nITEM: BOX BOUNDS pp pp pp\n{box}ITEM: ENTRIES {columns}\n"
                                          "0.002 0.002 0.002 0.006 0.002 0.002 1 2 0 -1e-3 0 0 -1e-3 0 0 0 0 0\n")
    (folder / "sample.toml").write_text('table_4_1 = "11b"\nstate = "dense"\nfriction = 0.3\n')


def check_mean_of_samples(program):
    """Of a row whose samples lie on both sides of the fines share beyond which there are two more quantities: each with its own kind."""
    write_gap_graded(program.folder / "several" / "a", 30, 620)
    write_gap_graded(program.folder / "several" / "b", 30, 639)
    for order in (("several/a", "several/b"), ("several/b", "several/a")):
        mean = program.must_run("reproduce", "table-4-1", *order).split("mean of 2 samples")[1].splitlines()
        values = {line.split()[0]: float(line.split()[1]) for line in mean if "+-" in line}
        check(values["grains"] == 659.5 and 0.98 < values["porosity"] < 1 and values["coordination_number"] < 0.01, f"{order}: {values}")
        check(all(abs(value) < 1e4 for value in values.values()), f"{order}: {values}")


def check_mistakes(program):
    folder = program.folder
    good = (folder / "c.dump").read_text()
    (folder / "cut.dump").write_text(good[:len(good) - 200])
    (folder / "nan.dump").write_text(good[:good.rfind(" ")] + " nan\n")
    outputs = ["--output", "o.csv", "--json", "o.json", "--force-pdf", "o.pdf.csv"]
    # The first snapshot is whole: what was written of it goes again.
    program.must_refuse(["contacts", "cut.dump", "g.dump", *outputs], "cut.dump, line", "cut short")
    program.must_refuse(["contacts", "nan.dump", "g.dump", *outputs], "nan.dump, line", "nan at step 20")
    program.must_refuse(["rose", "cut.dump", "g.dump", "--output", "o.csv"], "rose: cut.dump")
    for words, told in ((["contacts"], ("files",)), ([], ("subcommand",)), (["contacts", "c.dump", "g.dump", "--outptu", "x"], ("--outptu",)),
                        (["contacts", "none.dump"], ("none.dump", "readable")), (["contacts", "c.dump", "g.dump", "--split", "-1"], ("--split", "-1")),
                        (["contacts", "c.dump", "g.dump", "--split", "gap"], ("--split", "gap")), (["contacts", "c.dump", "g.dump", "--friction", "-1"], ("--friction",)),
                        (["contacts", "c.dump", "g.dump", "--strong", "most"], ("--strong", "most")), (["contacts", "c.dump", "g.dump", "--axis", "w"], ("--axis", "w")),
                        (["contacts", "c.dump", "g.dump", "--column", "radius"], ("--column", "OURS=THEIRS")),
                        (["contacts", "c.dump", "g.dump", "--column", "raduis=radius"], ("--column = raduis", "did you mean radius?")),
                        (["contacts", "c.dump", "g.dump", "--column", "friction_limt=c_1[7]", "spring_force=c_1[8]"], ("--column = friction_limt", "did you mean friction_limit?")),
                        (["contacts", "c.dump", "g.dump", "--column", "delta=c_11[7]"], ("--column delta of the dump of contacts = c_11[7]", "did you mean c_1[7]?")),
                        (["contacts", "c.dump", "g.dump", "--column", "diameter=diamter"], ("--column diameter of the dump of grains = diamter", "id, x, y, z, radius")),
                        (["contacts", "c.dump", "g.dump", "--column", "radius=x", "radius=radius"], ("--column = radius twice",)),
                        (["contacts", "c.dump", "g.dump", "--output", "no/folder/o.csv"], ("no/folder/o.csv",)),
                        (["contacts", "c.dump", "g.dump", "--volume", "1e-12"], ("volume",)), (["rose", "c.dump", "g.dump", "--plane", "zx"], ("--plane", "zx")),
                        (["rose", "c.dump", "g.dump", "--bins", "7"], ("--bins", "7")), (["rose", "c.dump", "g.dump", "--order", "3"], ("--order", "3")),
                        (["rose", "c.dump", "g.dump", "--step", "15"], ("--step", "15")), (["rose", "c.dump", "g.dump", "--figure", "r.png"], ("--figure", "--output"))):
        program.must_refuse(words, *told)


def check_hostile(program):
    """Contacts that cannot be, counts that no file holds, names that no disk takes, and results that are there already."""
    folder = program.folder
    lines = (folder / "c.dump").read_text().splitlines()
    head = next(k for k, line in enumerate(lines) if line.startswith("ITEM: ENTRIES")) + 1
    counted = next(k for k, line in enumerate(lines) if line.startswith("ITEM: NUMBER OF ENTRIES")) + 1

    def write(name, rows, claimed=None):
        end = next((k for k in range(head, len(lines)) if lines[k].startswith("ITEM: TIMESTEP")), len(lines))
        text = lines[:head] + rows + lines[end:]
        text[counted] = str(claimed or len(rows))
        (folder / name).write_text("\n".join(text) + "\n")
        return name

    end = next((k for k in range(head, len(lines)) if lines[k].startswith("ITEM: TIMESTEP")), len(lines))
    rows = lines[head:end]
    words = rows[0].split()
    swapped = [*words[3:6], *words[:3], words[7], words[6], *words[8:9], *(str(-float(w)) for w in words[9:])]
    for name, changed, told in (("twice.dump", rows + rows[:1], "is there twice"), ("turned.dump", rows + [" ".join(swapped)], "is there twice"),
                                ("self.dump", [" ".join([*words[:7], words[6], *words[8:]])] + rows[1:], "in contact with itself"),
                                ("half.dump", [" ".join([*words[:6], words[6] + ".5", *words[7:]])] + rows[1:], "identifier")):
        program.must_refuse(["contacts", write(name, changed), "g.dump"], name, told)
    # 4e12 rows of 18 values would be 300 TB: refused for what is missing, not for the memory.
    program.must_refuse(["contacts", write("huge.dump", rows, 4 * 10**12), "g.dump"], "huge.dump")

    program.must_run("contacts", "c.dump", "g.dump", "--output", "kept.csv")
    kept = (folder / "kept.csv").read_text()
    program.must_refuse(["contacts", "c.dump", "g.dump", "--json", "new.json", "--output", "kept.csv"], "--output = kept.csv", "--overwrite")
    program.must_refuse(["rose", "c.dump", "g.dump", "--output", "kept.csv"], "--output = kept.csv", "--overwrite")
    check((folder / "kept.csv").read_text() == kept, "an earlier result has changed")
    program.must_run("contacts", "c.dump", "g.dump", "--output", "kept.csv", "--overwrite", "--axis", "x")
    check((folder / "kept.csv").read_text() != kept, "--overwrite leaves the old result")

    (folder / "loop").symlink_to("loop")
    long = "n" * 300
    for words, told in ((["--output", long], "File name too long"), (["--output", "loop"], "symbolic links"), (["--output", "/dev/full"], "must not be there yet"), (["--output", "/dev/full", "--overwrite"], "regular file"),
                        (["--output", "loop/x.csv"], "loop/x.csv")):
        program.must_refuse(["contacts", "c.dump", "g.dump", *words], told)
    for name, told in ((long, "long"), ("loop", "symbolic links")):
        program.must_refuse(["contacts", name, "g.dump"], told)
        program.must_refuse(["grading", name], name)
        program.must_refuse(["reproduce", "table-4-1", name], name)
    for line in (f"cd gone && rmdir ../gone && {program.path} reproduce table-4-1 .", f"{program.path} contacts c.dump g.dump > /dev/full"):
        (folder / "gone").mkdir()
        done = subprocess.run(["sh", "-c", line], cwd=folder, capture_output=True, text=True, timeout=60)
        check(done.returncode == 1 and "internal" not in done.stderr and done.stderr.startswith("suffuse-analyse: error: "), f"{line}: {done.returncode}, {done.stderr}")
    (folder / "loop").unlink()


def check_numbers(program):
    """Every option that takes a number takes a finite one, in every subcommand; what does not apply is not passed over; no input
    without an end is read."""
    (program.folder / "soil.csv").write_text("sieve_mm,percent_passing\n0.1,0\n0.2,20\n1,25\n2,100\n")
    (program.folder / "noise.csv").write_bytes(bytes(range(256)) * 4)
    asked = 0
    for command in ("contacts", "grading", "sample", "constriction", "hydraulic", "fluidisation", "rose", "verdict"):
        for line in program.must_run(command, "--help").splitlines():
            words = line.split()
            if len(words) < 2 or not words[0].startswith("--") or words[1].split("=")[0] not in ("FLOAT", "INT", "UINT"):
                continue
            option, count = words[0].split(",")[0], int(words[words.index("x") + 1]) if "x" in words[2:4] else 1
            for value in ("nan", "inf", "1e999", "", "0x10"):
                program.must_refuse([command, "soil.csv", option, *[value] * count], option, "must be a finite number")
                asked += 1
    check(asked > 150, f"only {asked} numbers were tried")
    for words, told in ((["contacts", "c.dump", "g.dump", "--volume", "0"], ("--volume", "> 0")),
                        (["contacts", "c.dump", "g.dump", "--sliding-tolerance", "-1"], ("--sliding-tolerance", ">= 0")),
                        (["sample", "soil.csv", "--grains", "10.5"], ("--grains = 10.5", "whole number")), (["sample", "soil.csv", "--coarse", "99.5"], ("--coarse = 99.5", "whole number")),
                        (["sample", "soil.csv", "--seed", "-1"], ("--seed", ">= 0")), (["sample", "soil.csv", "--scale", "1e300"], ("--scale", "grains of")),
                        (["sample", "soil.csv", "--grains", "100", "--box-edge", "1e6"], ("--box-edge", "millionth")), (["sample", "soil.csv", "--output", ""], ("--output", "names")),
                        (["constriction", "soil.csv", "--coarser-than", "1e-4"], ("--coarser-than", "--packing")),
                        (["fluidisation", "soil.csv", "--friction", "0.2"], ("--friction", "--dumps")), (["verdict", "soil.csv", "--volume", "1"], ("--volume", "--sample")),
                        (["verdict", "soil.csv", "--gravity", "-1"], ("--gravity", "> 0")), (["grading", "/dev/zero"], ("/dev/zero", "device")),
                        (["contacts", "/dev/zero"], ("/dev/zero", "device")), (["grading", "noise.csv"], ("noise.csv",))):
        program.must_refuse(words, *told)
    program.must_run("sample", "soil.csv", "--grains", "100", "--output", "made")
    program.must_refuse(["sample", "soil.csv", "--grains", "100", "--output", "made"], "made.inc", "--overwrite")
    program.must_run("sample", "soil.csv", "--grains", "100", "--output", "made", "--overwrite")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--analyse", required=True)
    path = parser.parse_args().analyse
    has_figures = python_with_figures() is not None
    with tempfile.TemporaryDirectory(prefix="suffuse-test-") as folder:
        program = Program(path, pathlib.Path(folder))
        for words in (["--help"], ["contacts", "--help"], ["rose", "--help"], ["reproduce", "table-4-1", "--help"]):
            check("Usage" in program.must_run(*words), f"{words} does not help")
        check(program.must_run("--version").startswith("suffuse-analyse "), "no version")
        first, second = packing(10), packing(20)
        (program.folder / "g.dump").write_text(first[0] + second[0])
        (program.folder / "c.dump").write_text(first[1] + second[1])
        check_results(program)
        check_rose(program, has_figures)
        check_mistakes(program)
        check_hostile(program)
        check_split_by_share(program)
        check_shear(program)
        check_undefined(program)
        check_suffusion(program)
        check_numbers(program)
        check_reproduce(program)
        check_outputs(program)
        check_mean_of_samples(program)
    print("suffuse-analyse: results, mistakes and samples as they should be" + ("" if has_figures else "; no matplotlib, no figures"))


if __name__ == "__main__":
    main()
