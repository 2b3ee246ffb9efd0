#!/usr/bin/env python3
"""analyse_gradings_test.py --analyse PROGRAM --gradings DIR: `suffuse-analyse grading` and `constriction` on good and bad files.

Good: the criteria of the thesis's samples, the same from CSV forms and from a dump of grains, a cubic array's constrictions.
Bad: one line, exit code 1, no file left behind.
"""
import argparse
import csv
import gzip
import math
import pathlib
import re
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from analyse_runs import PROBLEMS, Runner, expect, rows  # noqa: E402


def criteria(run, *words):
    result = run("grading", *words, "--output", "criteria.csv", "--overwrite")
    expect(result.returncode == 0, f"grading {words}: {result.stderr}")
    return {row["criterion"]: row for row in rows(run.folder / "criteria.csv")}


def close(text, value, tolerance=1e-6):
    return math.isclose(float(text), value, rel_tol=tolerance)


def good_gradings(run, gradings):
    found = criteria(run, gradings / "appendix_A.csv")
    expect(len(found) == 14, "14 criteria")
    expect(abs(float(found["Kenney and Lau"]["value"]) - 1.590) < 5e-4, "(H/F)min of 8b is Table 4.1's 1.590")
    expect(found["Wan and Fell, slopes"]["value"] == "", "no value where a criterion does not apply")
    # The same soil as kilograms, in mm, from the largest size down.
    table = rows_without_comments(gradings / "appendix_A.csv")
    text = "mass_kg,diameter_mm\n" + "".join(f"{3 * float(row['mass_fraction'])},{1e3 * float(row['diameter_m'])}\n" for row in reversed(table))
    again = criteria(run, run.write("kilograms.csv", text))
    expect(all(row["value"] == "" or close(again[name]["value"], float(row["value"])) for name, row in found.items()),
           "kilograms and millimetres give the same criteria")
    strict = criteria(run, gradings / "appendix_A.csv", "--limit", "kenney_lau=1.6")
    expect(strict["Kenney and Lau"]["verdict"] == "unstable", "a limit can be set")


def ended_curve(run):
    # 33 % finer than the last sieve: sizes and formulas that need them have no value, and say why.
    name = run.write("ended.csv", "sieve_mm;percent_passing\n0,074;33\n0,25;42\n0,84;59\n2;77\n4,76;100\n")
    found = criteria(run, name)
    for criterion in ("Istomina", "Kenney and Lau", "Burenkova"):
        expect(found[criterion]["value"] == "" and "the curve ends at 0.074 mm with 33 % finer" in found[criterion]["note"], f"{criterion} needs what is not known")
    screen = run("grading", name).stdout
    expect("d10 -, d15 -, d30 -, d50 0.4" in screen and "nan" not in screen, f"no sizes below the end: {screen}")
    result = run("hydraulic", name, "--porosity", 0.3, "--output", "hydraulic.csv")
    expect(result.returncode == 0 and "nan" not in result.stdout, result.stdout)
    of_d10 = [row for row in rows(run.folder / "hydraulic.csv") if "Hazen" in row["quantity"]]
    expect(of_d10[0]["value"] == "" and "the curve ends" in of_d10[0]["note"], "Hazen's formula needs d10")
    report = run("verdict", name)
    expect(report.returncode == 0 and "nan" not in report.stdout and "the curve ends" in report.stdout, "a report on what is known")


def rows_without_comments(path):
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


def dump(grains, edge):
    """A LIGGGHTS dump of (x, y, z, radius), periodic, of two steps: an empty-handed first one and the grains."""
    head = "ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{count}\nITEM: BOX BOUNDS pp pp pp\n" + f"0 {edge}\n" * 3
    head += "ITEM: ATOMS id radius x y z\n"
    body = "".join(f"{i + 1} {r} {x} {y} {z}\n" for i, (x, y, z, r) in enumerate(grains))
    return head.format(step=0, count=1) + "1 0.1 0 0 0\n" + head.format(step=10, count=len(grains)) + body


def good_packings(run):
    # Coarse 1 mm simple cubic; a fine grain of 0.2 mm off the constrictions in every pore.
    coarse = [(i * 1e-3, j * 1e-3, k * 1e-3, 0.5e-3) for i in range(4) for j in range(4) for k in range(4)]
    fine = [(x + 0.5e-3, y + 0.5e-3, z + 0.5e-3, 0.1e-3) for x, y, z, _ in coarse]
    with gzip.open(run.folder / "grains.gz", "wt") as file:
        file.write(dump(coarse + fine, 4e-3))
    result = run("constriction", "--packing", "grains.gz", "--coarser-than", 0.5e-3, "--discs", "discs.csv", "--distribution", "d.csv")
    expect(result.returncode == 0, f"packing: {result.stderr}")
    discs = rows(run.folder / "discs.csv")
    expect(len(discs) == 192 and all(close(disc["diameter_m"], (math.sqrt(2) - 1) * 1e-3) for disc in discs),
           "192 constrictions of (sqrt 2 - 1) D in 4 x 4 x 4 grains")
    expect(close(rows(run.folder / "d.csv")[35]["packing_m"], (math.sqrt(2) - 1) * 1e-3), "and their distribution")
    found = criteria(run, "grains.gz")
    share = 1 / (1 + 125)  # fines 0.2³ of the coarse grain's 1³ each
    expect(found["Honjo"]["value"] == "" and share < 0.01, "0.8 % of fines are no gap")
    both = run("constriction", "grains.gz", "--split", 0.005, "--packing", "grains.gz", "--step", 10, "--distribution", "both.csv")
    expect(both.returncode == 0 and "packing_m" in rows(run.folder / "both.csv")[0], f"grading and packing side by side: {both.stderr}")


def bed_with_a_free_surface(run):
    # Flat tetrahedra between the topmost grains have void spheres far above them, which ask for no images of the box.
    side = 4
    grains = "".join(f"{x + side * (y + side * z) + 1} {(x + .5 + .04 * ((7 * x + 3 * y + 5 * z) % 5)) * 1e-3} {(y + .5 + .04 * ((3 * x + 5 * y + 7 * z) % 5)) * 1e-3} "
                     f"{(z + .5 + .001 * ((x + 2 * y) % 3)) * 1e-3} 4.5e-4\n" for z in range(3) for y in range(side) for x in range(side))
    name = run.write("bed.dump", f"ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n{3 * side * side}\nITEM: BOX BOUNDS pp pp ff\n0 {side}e-3\n0 {side}e-3\n0 6e-3\n"
                     f"ITEM: ATOMS id x y z radius\n{grains}")
    start = time.monotonic()
    result = run("constriction", "--packing", name)
    expect(result.returncode == 0 and "48 of 48 grains" in result.stdout, result.stdout + result.stderr)
    expect(time.monotonic() - start < 20, "48 grains take a fraction of a second")  # it was a minute, and all memory


WIDE = "sieve_mm,percent_passing\n0.125,0\n0.25,12\n0.5,24\n2,25\n8,60\n31.5,100\n"


def samples(run, gradings):
    result = run("sample", "7b", "--grains", 2000, "--output", "b20")
    expect(result.returncode == 0 and "500 coarse grains take 32188 grains" in result.stdout, result.stdout + result.stderr)
    classes = rows_without_comments(run.folder / "b20.csv")
    masses = [float(row["grains"]) * float(row["diameter_m"]) ** 3 for row in classes]
    expect(all(close(mass / sum(masses), float(row["mass_fraction"]), 1e-4) for mass, row in zip(masses, classes)), "grains have the masses of their classes")
    expect(close(sum(float(row["grains"]) for row in classes), 2000, 1e-4), "2,000 grains")
    given = rows_without_comments(gradings / "B20.csv")
    expect([row["mass_fraction"] for row in classes] == [f"{float(row['mass_fraction']):.12g}" for row in given], "the classes of B20 as they are")
    variables = dict(line.split(" index ") for line in (run.folder / "b20.inc").read_text().replace("variable ", "").splitlines()[1:])
    expect(variables["sample_grains"] == "2000" and "B(20%)" in variables["row_table_5_1"] and 1.6e-4 < float(variables["split"]) < 4.5e-4, f"{variables}")
    templates = (run.folder / "b20_templates.inc").read_text()
    expect(templates.count("particletemplate/sphere") == 20 and "particledistribution/discrete ${distribution_seed} 20" in templates, templates)
    grains = [line.split() for line in (run.folder / "b20.data").read_text().split("Atoms\n\n")[1].splitlines()]
    expect(len(grains) == 2000 and len({tuple(grain[4:]) for grain in grains}) == 2000, "2,000 grains in places of their own")
    for row in classes:
        count = sum(close(grain[2], float(row["diameter_m"])) for grain in grains)
        expect(abs(count - float(row["grains"])) < 1, f"{count} grains for {row['grains']}")
    found, again = criteria(run, "B20"), criteria(run, "b20.csv")
    expect(found["Kezdi"]["value"] == again["Kezdi"]["value"], "a name is a grading everywhere, and the classes are one")
    # The split lies in the gap of every sample of the thesis, few as its fines may be: classes of 1.7 % each are no part of it.
    for row in rows_without_comments(gradings / "samples.csv"):
        run("sample", row["name"], "--grains", 2000, "--output", "share", "--variables-only", "--overwrite")
        share = dict(line.split(" index ") for line in (run.folder / "share.inc").read_text().replace("variable ", "").splitlines()[1:])
        expect(close(share["fines_share"], float(row["fines_share"]), 1e-4), f"{row['name']}: fines are {share['fines_share']}, not {row['fines_share']}")
    # 201:1 and 24 % of fines.
    wide = run.write("wide.csv", WIDE)
    result = run("sample", wide, "--output", "wide_sample", "--variables-only")
    expect("take 1.209e+06 grains, more than 150000" in result.stdout and "cut at --smallest 0.000243" in result.stdout, result.stdout)
    # Sizes that so few grains do not hold are told, and the cut that is told holds them.
    result = run("sample", wide, "--grains", 3000, "--output", "wide_sample", "--variables-only", "--overwrite")
    rare = re.search(r"sizes, (\S+) % of the mass, have less than one grain: with one of each there are (\S+) grains; cut at --smallest (\S+) \(m\) 3000 hold every size", result.stdout)
    expect(rare and float(rare[1]) > 20 and float(rare[2]) > 1e6, result.stdout)
    result = run("sample", wide, "--grains", 3000, "--smallest", 1.01 * float(rare[3]), "--output", "wide_sample", "--variables-only", "--overwrite")
    expect("less than one grain" not in result.stdout, result.stdout)
    result = run("sample", wide, "--smallest", 5.2e-4, "--output", "cut", "--grains", 3000, "--scale", 10)
    expect("24 % of the mass are finer and left out" in result.stdout, result.stdout)
    sizes = [float(row["diameter_m"]) for row in rows_without_comments(run.folder / "cut.csv")]
    expect(len(sizes) == 20 and 5.2e-3 < sizes[0] < sizes[-1] < 0.315, f"ten times the sizes: {sizes}")
    refused(run, "sample too dense", ("sample", run.write("equal.csv", "diameter_mm,mass_fraction\n1,0.5\n1.001,0.5\n"), "--split", 1.0005e-3, "--grains", 200, "--solid-fraction", 0.6, "--output", "no_o"), "lower --solid-fraction", ("no_o",))
    for words, says in ((("nowhere",), "the names are A10"), ((wide, "--smallest", 0.04), "leave more than one size"),
                        ((wide, "--grains", 1), "2 to 1e9"), ((wide, "--split", 1), "below the largest grain"),
                        ((run.write("open.csv", WIDE.replace("0.125,0\n", "")),), "cut it there with --smallest 0.00025")):
        refused(run, f"sample {words}", ("sample", *words, "--output", "no_o"), says, ("no_o",))


def equal_spheres(run):
    # Nearly equal grains: Dc35 is the three-grain size in the dense state.
    run.write("equal.csv", "diameter_mm,mass_fraction\n1,0.5\n1.0000001,0.5\n")
    result = run("constriction", "equal.csv", "--relative-density", 1, "--split", 0.5, "--distribution", "d.csv", "--overwrite")
    expect(result.returncode == 0, f"equal grains: {result.stderr}")
    row = rows(run.folder / "d.csv")[35]
    expect(close(row["dense_by_surface_area_m"], (2 / math.sqrt(3) - 1) * 1e-3, 1e-5), "0.1547 D dense")
    expect(close(row["loose_by_surface_area_m"], (math.sqrt(2) - 1) * 1e-3, 1e-5), "0.4142 D loose, inscribed")
    run("constriction", "equal.csv", "--loose-pore", "equal-area", "--split", 0.5, "--distribution", "d.csv", "--overwrite")
    expect(close(rows(run.folder / "d.csv")[35]["loose_by_surface_area_m"], math.sqrt(4 / math.pi - 1) * 1e-3, 1e-5), "0.5227 D loose, by area")


BAD_FILES = {
    "not summing": ("diameter_m,mass_fraction\n1e-3,0.5\n2e-3,0.4\n", "sum of mass_fraction = 0.9"),
    "curve not to 100": ("diameter_mm,percent_finer\n1,0\n2,80\n", "100 %"),
    "curve falls": ("diameter_mm,percent_finer\n1,0\n2,80\n3,70\n4,100\n", "cumulative"),
    "not sorted": ("diameter_m,mass_fraction\n1e-3,0.3\n3e-3,0.3\n2e-3,0.4\n", "sort"),
    "size twice": ("diameter_m,mass_fraction\n1e-3,0.3\n1e-3,0.3\n2e-3,0.4\n", "larger than the one before"),
    "negative mass": ("diameter_m,mass_fraction\n1e-3,-0.5\n2e-3,1.5\n", "positive"),
    "negative size": ("diameter_m,mass_fraction\n-1e-3,0.5\n2e-3,0.5\n", "positive"),
    "one class": ("diameter_m,mass_fraction\n1e-3,1\n", "at least two"),
    "no number": ("diameter_m,mass_fraction\n1e-3,0.5\n2e-3,nan\n", "line 3"),
    "a word": ("diameter_m,mass_fraction\n1e-3,0.5\ntwo,0.5\n", "'two'"),
    "short row": ("diameter_m,mass_fraction\n1e-3,0.5\n2e-3\n", "line 3"),
    "empty": ("", "row of names"),
    "header only": ("diameter_m,mass_fraction\n", "at least two"),
    "no sizes": ("name,mass_fraction\n1,1\n", "diameter_m"),
    "two amounts": ("diameter_m,mass_fraction,mass_kg\n1e-3,1,1\n", "2 columns of amounts"),
}


def refused(run, what, words, says, outputs):
    result = run(*words)
    expect(result.returncode == 1, f"{what}: exit code {result.returncode}")
    lines = result.stderr.strip().splitlines()
    expect(len(lines) == 1 and says in lines[0], f"{what}: says {result.stderr!r}, not {says!r} in one line")
    expect(result.stdout == "", f"{what}: prints {result.stdout!r}")
    for name in outputs:
        left = list(run.folder.glob(name + "*"))
        expect(not left, f"{what}: leaves {left}")


def constriction_limits(run, gradings):
    # Dc35/d85 of 8b at Rd = 0.5 is 0.491.
    for limit, verdict in (("chapter_4=0.49", "unstable"), ("chapter_4=0.5", "stable")):
        run("constriction", gradings / "appendix_A.csv", "--relative-density", 0.5, "--limit", limit, "--output", "criteria.csv", "--overwrite")
        found = {row["criterion"]: row for row in rows(run.folder / "criteria.csv")}
        expect(found["Chapter 4 of the thesis"]["verdict"] == verdict, f"{limit} makes 8b {verdict}")
    result = run("constriction", gradings / "appendix_A.csv", "--limit", "fines_split=0.31")
    expect("split at 30 % (at the gap)" in result.stdout, "the rule of the split is a limit, too")
    refused(run, "a constriction's limit for a grading", ("grading", gradings / "appendix_A.csv", "--limit", "chapter_4=1"), "kezdi", ())


def bad_input(run, gradings):
    outputs = ("no_o.csv", "no_c.csv", "no_s.csv")
    for what, (text, says) in BAD_FILES.items():
        name = run.write("bad.csv", text)
        refused(run, f"grading, {what}", ("grading", name, "--output", "no_o.csv", "--curve", "no_c.csv", "--shape", "no_s.csv"), says, outputs)
        refused(run, f"constriction, {what}", ("constriction", name, "--output", "no_o.csv", "--prediction", "no_c.csv"), says, outputs)
    sample = gradings / "appendix_A.csv"
    refused(run, "no such file", ("grading", "nowhere.csv"), "nowhere.csv", ())
    refused(run, "unknown limit", ("grading", sample, "--limit", "kezdy=5", "--output", "no_o.csv"), "kezdi", outputs)
    refused(run, "limit without number", ("grading", sample, "--limit", "kezdi=much"), "name=number", ())
    refused(run, "density in per cent", ("constriction", sample, "--relative-density", 95, "--output", "no_o.csv"), "share", outputs)
    refused(run, "split of everything", ("constriction", sample, "--split", 1), "between 0 and 1", ())
    refused(run, "unknown fractions", ("constriction", sample, "--fractions", "volume"), "volume", ())
    refused(run, "nothing to read", ("constriction",), "--packing", ())
    refused(run, "criteria without grading", ("constriction", "--packing", "grains.gz", "--output", "no_o.csv"), "grading", outputs)
    refused(run, "one file cannot be written", ("grading", sample, "--output", "no_o.csv", "--curve", "no/where.csv"), "no/where.csv", outputs)
    run.write("cut.dump", dump([(0, 0, 0, 1e-3)] * 4, 4e-3)[:-12])
    refused(run, "dump cut short", ("constriction", "--packing", "cut.dump", "--discs", "no_o.csv"), "cut", outputs)
    run.write("bare.dump", dump([(0, 0, 0, 1e-3)], 4e-3).replace("radius", "size"))
    refused(run, "dump without radius", ("grading", "bare.dump"), "radius", ())
    refused(run, "no such step", ("constriction", "--packing", "grains.gz", "--step", 11), "step 11", ())


def hydraulic(run, gradings):
    bed = gradings / "appendix_C.csv"
    result = run("hydraulic", bed, "--porosity", 0.376, "--alpha", 0.5, "--top-stress", 1000, "--thickness", 0.012, "--output", "h.csv")
    expect(result.returncode == 0, f"hydraulic: {result.stderr}")
    found = {row["source"]: float(row["value"]) for row in rows(run.folder / "h.csv")}
    expect(close(found["terzaghi1943"], 1.65 * 0.624), "Terzaghi at n = 0.376")
    expect(close(found["skemptonbrogan1994"], 0.5 * 1.65 * 0.624), "half of it for alpha = 0.5")
    expect(close(found["lifannin2012"], 0.5 * (1000 / (9810 * 0.012) + 1.65 * 0.624)), "and under stress")
    # Carman and Kozeny with the Sauter size of the 20 classes themselves.
    sauter = 1 / sum(float(row["mass_fraction"]) / float(row["diameter_m"]) for row in rows_without_comments(bed))
    expect(close(found["carman1939"], 9.81e6 * sauter**2 * 0.376**3 / (180 * 0.624**2)), "Carman and Kozeny")
    refused(run, "porosity in per cent", ("hydraulic", bed, "--porosity", 37.6, "--output", "no_o.csv"), "between 0 and 1", ("no_o.csv",))
    refused(run, "light grains", ("hydraulic", bed, "--porosity", 0.4, "--grain-density", 900), "above the fluid", ())
    refused(run, "stress without layer", ("hydraulic", bed, "--porosity", 0.4, "--top-stress", 1000), "together", ())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--analyse", required=True)
    parser.add_argument("--gradings", required=True, type=pathlib.Path)
    options = parser.parse_args()
    gradings = options.gradings.resolve()
    with tempfile.TemporaryDirectory() as folder:
        run = Runner(str(pathlib.Path(options.analyse).resolve()), pathlib.Path(folder))
        good_gradings(run, gradings)
        ended_curve(run)
        bed_with_a_free_surface(run)
        samples(run, gradings)
        good_packings(run)
        equal_spheres(run)
        constriction_limits(run, gradings)
        bad_input(run, gradings)
        hydraulic(run, gradings)
    if PROBLEMS:
        raise SystemExit(f"analyse_gradings: {len(PROBLEMS)} failed")
    print("analyse_gradings: in order")


if __name__ == "__main__":
    main()
