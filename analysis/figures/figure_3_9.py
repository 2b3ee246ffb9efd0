#!/usr/bin/env python3
"""Figure 3.9 of the thesis: conductivity of beds of one size after another beside what formulas say.

  figure_3_9.py STUDY.csv --output FIGURE.pdf

STUDY.csv is what suffuse-study leaves of input_scripts/studies/conductivity_sizes.toml. Filled: beds of equal spheres; open: Appendix C's grading.
Lines for equal spheres at the beds' mean porosity: Hazen, 1e4 d10^2 (SI), and Carman and Kozeny's with 180, in water of 1e-6 m2/s.
"""
import argparse
import csv

GRAVITY, VISCOSITY = 9.81, 1e-6
MARKS = {"default": "o", "thesis": "^", "thesis_appendix": "s"}
NAMES = {"default": "default operators", "thesis": "of the thesis's text", "thesis_appendix": "of its code"}


def draw(rows, options):
    import suffuse_style as style
    from matplotlib import pyplot

    figure, panel = pyplot.subplots(figsize=(style.width_of(options), 3.6))
    equal = [row for row in rows if row["grading"] == "equal"]
    sizes = sorted({float(row["size"]) for row in equal})
    porosity = sum(float(row["porosity"]) for row in equal) / len(equal)
    panel.loglog([1e3 * d for d in sizes], [1e4 * d ** 2 for d in sizes], label="Hazen", **style.REFERENCE)
    panel.loglog([1e3 * d for d in sizes], [GRAVITY / VISCOSITY * d ** 2 * porosity ** 3 / (180 * (1 - porosity) ** 2) for d in sizes],
                 color="#606060", linewidth=1.0, label="Carman and Kozeny")
    for preset, mark in MARKS.items():
        of_it = [row for row in rows if row["preset"] == preset]
        line = panel.loglog([1e3 * float(row["size"]) for row in of_it if row["grading"] == "equal"],
                            [float(row["conductivity"]) for row in of_it if row["grading"] == "equal"], mark, label=NAMES[preset])[0]
        panel.loglog([1e3 * float(row["size"]) for row in of_it if row["grading"] != "equal"],
                     [float(row["conductivity"]) for row in of_it if row["grading"] != "equal"], mark, markerfacecolor="none", color=line.get_color())
    style.plain_log_ticks(panel.xaxis)
    panel.set(xlabel="diameter, Sauter's of the graded bed (mm)", ylabel="conductivity (m/s)")
    panel.legend()
    style.save(figure, options.output)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study")
    parser.add_argument("--output", required=True, help="figure to write; its ending says the format")
    parser.add_argument("--width", type=float, help="inches")
    options = parser.parse_args()
    with open(options.study, newline="") as file:
        rows = [row for row in csv.DictReader(line for line in file if not line.startswith("#")) if row["status"] == "finished"]
    draw(rows, options)


if __name__ == "__main__":
    main()
