#!/usr/bin/env python3
"""analyse_verdict_test.py --analyse PROGRAM --gradings DIR --figures DIR --documents DIR

`suffuse-analyse verdict`: the words on soils whose answer is known (unstable, stable, divided), a sample that can be computed by
hand, the HTML page (well-formed, self-contained), figures that their printed command draws again, and bad input.
"""
import argparse
import base64
import html.parser
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "support"))
import fluidisation_series as bed  # noqa: E402
from program_under_test import Program, check, python_with_figures  # noqa: E402

COARSE, FINE = 0.5e-3, 0.05e-3  # radii, m
SIDE = 3
VOID_ELEMENTS = {"meta", "img"}


class Verdict(Program):
    """`suffuse-analyse verdict`; it says nothing before it refuses."""

    def must_refuse(self, words, *told):
        out = super().must_refuse(words, *told)
        check(out == "", f"{words}: prints {out!r}")


def must_say(report, *texts):
    for text in texts:
        check(text in report, f"the report does not say {text!r}:\n{report}")


def check_words(program, gradings):
    # The thesis's 11a (Appendix B): a gap of 5.5 and 20 % of fines, unstable in its Table 4.1 in all states.
    unstable = program.must_run(gradings / "appendix_B.csv")
    must_say(unstable, "Internally unstable: the pores' controlling constriction over the larger fine grains (Dc35/d85) is 1.55 in the loosest, 0.975 in the densest", "No sample was measured",
             "Agreed on unstable: sizes of both parts of the grading; shape of the curve",
             "Divided on gap, fines, uniformity: stable by Istomina; unstable by Honjo, Liu.",
             "Indraratna 2015 depends on the density, which is not given: unstable in the loosest state (1.55), stable in the densest (0.975)",
             "| Kenney and Lau | unstable | 0 | stable > 1 | (H/F)min | kenneylau1985 |",
             "Shire's zones (25 and 35 % of fines): 20 % of the grading, underfilled", "They need the porosity")
    # Well graded, Cu = 5: what every criterion was made to pass, but for Kovacs's, which needs the porosity.
    program.folder.joinpath("well.csv").write_text("diameter_mm,percent_finer\n0.1,0\n0.15,10\n0.3,35\n0.6,60\n1.2,82\n2.4,100\n")
    stable = program.must_run("well.csv", "--relative-density", 0.7)
    must_say(stable, "Internally stable: the pores' controlling constriction", "19 criteria apply: stable 19, transitional 0, unstable 0",
             "None: all groups of criteria are of one mind.", "this one has no gap")
    # 8b (Appendix A): stable by Table 4.1, but some criteria on sizes say otherwise, and Kovacs's.
    divided = program.must_run(gradings / "appendix_A.csv", "--relative-density", 0.5, "--porosity", 0.25, "--top-stress", 1e4, "--thickness", 0.1)
    must_say(divided, "Internally stable: the pores' controlling constriction over the larger fine grains (Dc35/d85) is 0.491; unstable from 0.73",
             "Divided on shape of the curve: stable by Kenney and Lau", "unstable by Lubochkov. Why:", "unstable by Kovacs. Why:",
             "Agreed on unstable: ratios of coarse and fine sizes", "transitional by Liu", "alpha = 1.279 (predicted by a fit), taken as 1",
             f"| critical gradient, Terzaghi | {1.65 * 0.75:.4g} |", "Li and Fannin")
    strict = program.must_run(gradings / "appendix_A.csv", "--limit", "chapter_4=0.4", "--limit", "kezdi=2", "--relative-density", 0.5)
    must_say(strict, "Internally unstable: the pores' controlling constriction over the larger fine grains (Dc35/d85) is 0.491", "| Kezdi | unstable |")


def check_splits(program, gradings):
    """A verdict that the rule of the split decides is none: the same words on both sides of its thresholds."""
    for density in (0.64, 0.65):  # where the thesis's rule goes from 25 to 20 %
        must_say(program.must_run("11b", "--relative-density", density), "It depends on the split", "(unstable), cut at 25 % (at the gap)",
                 "(stable), cut at 20 % (as it does in dense ones)", "hangs on the split")
    classes = [(d, m) for d, m in (line.split(",") for line in (gradings / "11b.csv").read_text().splitlines()[2:])]
    for fines in (0.249, 0.250):  # where it goes from the gap to 25 %
        share = {True: fines / 0.25, False: (1 - fines) / 0.75}
        program.folder.joinpath("near.csv").write_text("diameter_m,mass_fraction\n" + "".join(
            f"{d},{float(m) * share[float(d) < 3e-4]:.12g}\n" for d, m in classes))
        must_say(program.must_run("near.csv", "--relative-density", 0.95), "It depends on the split", "(unstable), cut at", "(stable), cut at 20 %")
    given = program.must_run("11b", "--relative-density", 0.95, "--cut", 0.25)
    must_say(given, "Internally unstable")
    check("depends on the split" not in given, "the user gave the split")


def write_sample(folder, fines_each):
    """Coarse grains in a simple cubic array that push on each other, and fines without contacts in its voids."""
    length = 2 * COARSE * SIDE
    cells = [(x, y, z) for x in range(SIDE) for y in range(SIDE) for z in range(SIDE)]
    number = {cell: k + 1 for k, cell in enumerate(cells)}
    head = "ITEM: TIMESTEP\n7\nITEM: NUMBER OF {}\n{}\nITEM: BOX BOUNDS pp pp pp\n" + 3 * f"0 {length}\n"
    place = lambda cell: [(c + 0.5) * 2 * COARSE for c in cell]  # noqa: E731
    grains = [(number[c], place(c), COARSE) for c in cells]
    for cell in cells:
        for k in range(fines_each):
            corner = [(c + 1) % SIDE * 2 * COARSE + 2.2 * FINE * (k - fines_each / 2) * (a == 0) for a, c in enumerate(cell)]
            grains.append((len(grains) + 1, [v % length for v in corner], FINE))
    contacts = []
    for cell in cells:
        for axis in range(3):
            other = tuple((c + (a == axis)) % SIDE for a, c in enumerate(cell))
            push = [-0.25 if a == axis else 0 for a in range(3)]
            contacts.append(" ".join(f"{v:.10g}" for v in place(cell) + place(other) + [number[cell], number[other], 1] + push))
    text = head.format("ATOMS", len(grains)) + "ITEM: ATOMS id x y z radius\n"
    text += "".join(f"{i} {' '.join(f'{v:.10g}' for v in p)} {r:.10g}\n" for i, p, r in grains)
    (folder / "grains.dump").write_text(text)
    (folder / "contacts.dump").write_text(head.format("ENTRIES", len(contacts)) + "ITEM: ENTRIES " + " ".join(f"c_1[{k}]" for k in range(1, 13)) +
                                          "\n" + "\n".join(contacts) + "\n")


def check_sample(program, gradings):
    sample = ("--sample", "grains.dump", "contacts.dump", "--split", 0.5e-3)
    grading = gradings / "appendix_B.csv"
    # Seven fines a coarse grain: Z = 6/8 and alpha = 0, beyond both limits; R = Z 3/12.
    write_sample(program.folder, 7)
    report = program.must_run(grading, *sample)
    must_say(report, "Internally unstable, measured on the sample: 0.75 contacts a grain (Z), fines under 0 of the mean stress (alpha). The limits are 1 and 0.5.",
             "| measured, by pair halves (the thesis's) | 0.75 | 0 | unstable | unstable |", "| measured, by contact point | 0.75 | 0 | unstable | unstable |",
             "Fabric case I, alpha by pair halves: Z_fc = 0, alpha = 0: fines lie loose", "| R | 0.1875 | fluid-like |",
             "| critical gradient of the fines, Skempton and Brogan | 0 |", "alpha = 0 (the sample, pair halves)", "| sliding contacts, share | 0 |")
    # One: Z = 6/2 is above its limit, alpha is not; the two wordings part.
    write_sample(program.folder, 1)
    report = program.must_run(grading, *sample)
    must_say(report, "Between stable and unstable, measured on the sample: 3 contacts a grain (Z), fines under 0 of the mean stress (alpha)",
             "where either low number makes it unstable the sample is unstable, where it takes both stable", "| R | 0.75 | fluid-like |")
    # A stable grading in this state: the criteria say one thing, the sample another.
    must_say(program.must_run(gradings / "appendix_A.csv", *sample), "The measured numbers count.",
             "The sample is unstable by Z and alpha (either is low), most criteria on constrictions say stable")
    # A split below all grains: there are no fines whose stress could be measured, and the headline is the grading's.
    must_say(program.must_run(grading, *sample[:3], "--split", 1e-6), "Internally unstable: the pores' controlling constriction",
             "The sample was measured, but has no alpha with this split between fines and coarse grains: see --split.")
    # Without a PSD: the sample's own grains.
    must_say(program.must_run(*sample), "Grading: the grains of the sample", "Relative density: not given")


class Page(html.parser.HTMLParser):
    """Elements close in the order in which they were opened; what the page refers to."""

    def __init__(self):
        super().__init__()
        self.open, self.pictures, self.text = [], [], ""

    def handle_starttag(self, tag, attributes):
        check(len({name for name, _ in attributes}) == len(attributes), f"<{tag}> has an attribute twice")
        values = dict(attributes)
        check(tag not in ("script", "link", "iframe", "object"), f"<{tag}> in the page")
        check("href" not in values, f"<{tag} href> in the page")
        if tag == "img":
            check(values.get("alt"), "a picture without words for those who do not see it")
            self.pictures.append(values["src"])
        if tag not in VOID_ELEMENTS:
            self.open.append(tag)

    def handle_endtag(self, tag):
        check(self.open and self.open[-1] == tag, f"</{tag}> closes {self.open[-1:]}")
        self.open.pop()

    def handle_data(self, data):
        self.text += data


def check_page(program, gradings, figures, python):
    write_sample(program.folder, 7)
    words = (gradings / "appendix_B.csv", "--sample", "grains.dump", "contacts.dump", "--split", 0.5e-3, "--name", "a <b> & \"c\" $x_{ $5")
    program.must_run(*words, "--html", "report.html", "--output", "report.md", "--figures", "kept")
    text = (program.folder / "report.html").read_text(encoding="utf-8")
    check(text.startswith("<!DOCTYPE html>"), "the page begins with its type")
    check("http:" not in text and "https:" not in text and "url(" not in text, "the page refers to nothing outside")
    check('name="viewport"' in text, "the page fits a phone")
    page = Page()
    page.feed(text)
    page.close()
    check(not page.open, f"left open: {page.open}")
    must_say(page.text, "a <b> & \"c\" $x_{ $5", "Internally unstable, measured on the sample", "Fabric case I", "fluid-like")
    check(len(page.pictures) == 5, f"five figures, not {len(page.pictures)}")
    for picture in page.pictures:
        kind, _, data = picture.partition(",")
        check(kind == "data:image/svg+xml;base64" and b"<svg" in base64.b64decode(data, validate=True), "a figure is an SVG in the page")
    markdown = (program.folder / "report.md").read_text(encoding="utf-8")
    links = re.findall(r"^!\[.*\]\((.+)\)$", markdown, re.MULTILINE)
    check(len(links) == 5 and all((program.folder / link).is_file() for link in links), f"Markdown's figures are there: {links}")
    # One of the commands in the captions draws the same figure again from its CSV.
    command = re.search(r"analysis/figures/(forces\.py [^`]+)`", markdown)[1].split()
    again = [python, figures / command[0], *command[1:-1], "again.svg"]
    done = subprocess.run(again, cwd=program.folder / "kept", capture_output=True, text=True, timeout=120)
    check(done.returncode == 0, f"{again}: {done.stderr}")
    check((program.folder / "kept/again.svg").read_bytes() == (program.folder / "kept/forces.svg").read_bytes(), "the same figure again")
    program.must_run(*words, "--html", "bare.html", "--no-figures")
    check("<img" not in (program.folder / "bare.html").read_text(encoding="utf-8"), "--no-figures leaves figures out")


def check_flow(program, gradings, figures, python):
    """A run with upward flow in the report: what `fluidisation` finds, and two figures that their commands draw again."""
    (program.folder / "ramp.csv").write_text(bed.text(bed.rows(bed.ramp())))
    words = (gradings / "appendix_C.csv", "--flow", "ramp.csv")
    report = program.must_run(*words)
    found = {cells[1].strip(): cells[2].strip() for cells in (line.split("|") for line in report.split("## Upward flow")[1].splitlines()) if len(cells) > 5}
    # Known of the series to round-off; four digits are printed.
    check(found["critical gradient, Terzaghi"] == f"{bed.BED_CRITICAL:.4g}" and found["conductivity, measured"] == f"{bed.BED_CONDUCTIVITY:.4g}", f"{found}")
    check("Upward flow" not in program.must_run(gradings / "appendix_C.csv"), "no flow where there is none")
    check(f"Porosity: {float(found['porosity at rest']):.4g}, of the bed at rest in `ramp.csv`" in report, "the porosity of the run's bed")
    check("Porosity: 0.31, as given" in program.must_run(*words, "--porosity", "0.31"), "but a given one first")
    if python:
        # Of an installation, whose figure scripts lie elsewhere.
        installed = pathlib.Path(shutil.copytree(figures, program.folder / "share/suffuse/figures"))
        before = os.environ.get("SUFFUSE_FIGURES")
        os.environ["SUFFUSE_FIGURES"] = str(installed)
        program.must_run(*words, "--output", "flow.md", "--figures", "flowing")
        os.environ.pop("SUFFUSE_FIGURES")
        if before is not None:
            os.environ["SUFFUSE_FIGURES"] = before
        markdown = (program.folder / "flow.md").read_text(encoding="utf-8")
        for name in ("flow", "layers"):
            # As it stands, the Python that has matplotlib included.
            command = re.search(rf"`([^`\n]*{re.escape(str(installed))}/\w+\.py [^`]+ --output {name}\.svg)`", markdown)[1].split()
            again = [*command[:-1], "again.svg"]
            done = subprocess.run(again, cwd=program.folder / "flowing", capture_output=True, text=True, timeout=120)
            check(done.returncode == 0, f"{again}: {done.stderr}")
            check((program.folder / "flowing/again.svg").read_bytes() == (program.folder / f"flowing/{name}.svg").read_bytes(), f"{name}: the same figure again")
    # A sample with it is judged as it stands at rest, in its first snapshot: contacts in that one, none in the lifted last.
    write_sample(program.folder, 1)
    for name in ("grains", "contacts"):
        rest = (program.folder / f"{name}.dump").read_text()
        lifted = rest.replace("ITEM: TIMESTEP\n7", "ITEM: TIMESTEP\n9")
        if name == "contacts":
            lifted = re.sub(r"(NUMBER OF ENTRIES\n)\d+", r"\g<1>0", lifted)
            lifted = lifted[:lifted.index("\n", lifted.index("ITEM: ENTRIES c")) + 1]
        (program.folder / f"two_{name}.dump").write_text(rest + lifted)
    sample = ("--sample", "two_grains.dump", "two_contacts.dump", "--split", 0.5e-3)
    must_say(program.must_run(*words, *sample), "measured on the sample at rest: 3 contacts a grain", "First snapshot.", "step 7")
    must_say(program.must_run(words[0], *sample), "| contacts | 0 |", "Last snapshot.", "step 9")
    (program.folder / "no_flow.csv").write_text("time_s,grains\n0,1\n1,1\n")
    program.must_refuse((gradings / "appendix_C.csv", "--flow", "no_flow.csv"), "no_flow.csv", "column")
    program.must_refuse((gradings / "appendix_C.csv", "--flow", "nowhere.csv"), "nowhere.csv")


def check_example(program, gradings, documents):
    """The report in the documentation is what its command gives."""
    page = (documents / "verdict.md").read_text(encoding="utf-8")
    options = re.search(r"verdict input_scripts/gradings/appendix_B.csv (.*) --output docs/analysis/verdict_example.md", page)[1]
    report = program.must_run(gradings / "appendix_B.csv", *shlex.split(options))
    check(report == (documents / "verdict_example.md").read_text(encoding="utf-8"), "docs/analysis/verdict_example.md is out of date")


def check_layers(program, figures, python):
    """Profiles from a monitor's columns; what has no layers is told."""
    (program.folder / "flow.csv").write_text("time_s,porosity_layer_1,porosity_layer_2,pressure_layer_1_pa,pressure_layer_2_pa,bed_1\n"
                                             "0,0.4,0.38,0,100,1\n0.1,0.45,0.39,0,90,1\n")
    draw = [python, figures / "layers.py", "flow.csv", "--output", "layers.svg"]
    done = subprocess.run(draw, cwd=program.folder, capture_output=True, text=True, timeout=120)
    check(done.returncode == 0 and (program.folder / "layers.svg").is_file(), f"layers.py: {done.stderr}")
    for quantity in ("bed", "stress"):
        done = subprocess.run([*draw, "--quantities", quantity], cwd=program.folder, capture_output=True, text=True, timeout=120)
        check(done.returncode == 1 and "porosity_layer, pressure_layer_pa" in done.stderr, f"layers.py without {quantity}: {done.stderr}")


def check_mistakes(program, gradings):
    good = gradings / "appendix_A.csv"
    outputs = ("--output", "no.md", "--html", "no.html", "--figures", "no")
    (program.folder / "bad.csv").write_text("diameter_m,mass_fraction\n1e-3,0.5\n2e-3,0.4\n")
    program.must_refuse(["bad.csv", *outputs], "sum of mass_fraction")
    program.must_refuse([*outputs], "--sample")
    program.must_refuse(["nowhere.csv", *outputs], "nowhere.csv")
    program.must_refuse([good, "--porosity", 25, *outputs], "--porosity", "share")
    program.must_refuse([good, "--relative-density", -1, *outputs], "--relative-density")
    program.must_refuse([good, "--cut", 1, *outputs], "--cut")
    program.must_refuse([good, "--alpha", -0.1, *outputs], "--alpha")
    program.must_refuse([good, "--split", "gap", *outputs], "--sample")
    program.must_refuse([good, "--limit", "kezdy=3", *outputs], "chapter_4")
    program.must_refuse([good, "--porosity", 0.3, "--top-stress", 100, *outputs], "together")
    program.must_refuse([good, "--grain-density", 900, "--porosity", 0.3, *outputs], "above the fluid")
    program.must_refuse([good, "--output", "no/where.md", "--html", "no.html"], "no/where.md")
    program.must_refuse([good, "--no-figures", "--figures", "no"], "--no-figures")
    program.must_refuse([good, "--html", "no.html", "--figures", "bad.csv"], "--figures")
    write_sample(program.folder, 1)
    cut = (program.folder / "contacts.dump").read_text()
    (program.folder / "contacts.dump").write_text(cut[:-40])
    program.must_refuse([good, "--sample", "grains.dump", "contacts.dump", *outputs], "contacts.dump")
    program.must_refuse([good, "--sample", "grains.dump", *outputs], "contacts")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--analyse", required=True)
    parser.add_argument("--gradings", required=True, type=pathlib.Path)
    parser.add_argument("--figures", required=True, type=pathlib.Path)
    parser.add_argument("--documents", required=True, type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        program = Verdict(str(pathlib.Path(options.analyse).resolve()), pathlib.Path(folder), "verdict")
        gradings = options.gradings.resolve()
        check_words(program, gradings)
        check_splits(program, gradings)
        check_sample(program, gradings)
        check_example(program, gradings, options.documents.resolve())
        python = python_with_figures()
        if python:
            check_page(program, gradings, options.figures.resolve(), python)
            check_layers(program, options.figures.resolve(), python)
        check_flow(program, gradings, options.figures.resolve(), python)
        check_mistakes(program, gradings)
    print("analyse_verdict: in order" + ("" if python else "; no matplotlib, no figures"))


if __name__ == "__main__":
    main()
