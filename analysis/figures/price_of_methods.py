#!/usr/bin/env python3
"""What each way to compute the water costs and errs by: permeability and force on each grain against core seconds.

  price_of_methods.py PRICE_OF_METHODS.csv --output FIGURE.pdf

Of the table that the benchmark price_of_methods prints. A column a packing; above the error of the permeability, below the root mean
square of the error of single grains' forces; the line joins what nothing else beats in time and error. Formulas take microseconds and
stand at the left edge.
"""
import argparse
import csv
import re

NAMES = {"random": "equal spheres, φ = 0.58", "appendix_c": "Appendix C's grading, φ = 0.6"}
LEAST_SECONDS = 1e-3  # where formulas are drawn
ERRORS = {"k_error_percent": "error of k (%)", "force_error_rms_percent": "error of grains' forces (%)"}


def kind_of(method):
    return "averaged" if method.startswith("averaged") else "formula" if method.startswith("formula") else \
        "pore network (YADE)" if method.startswith("pore_network") else "resolved, float" if method.endswith("float") else "resolved, double"


def label_of(method):
    cells = re.match(r"(?:resolved|averaged_\w+?)_(\d+)_", method)
    return cells.group(1) if cells and method.startswith("resolved") else ""


def front_of(points):
    """Points (seconds, error) that no other is both faster and nearer than, by seconds."""
    best, front = float("inf"), []
    for seconds, error in sorted(points):
        if error < best:
            best = error
            front.append((seconds, error))
    return front


def draw(rows, options):
    import suffuse_style as style
    from matplotlib import pyplot

    packings = list(dict.fromkeys(row["packing"] for row in rows))
    figure, panels = pyplot.subplots(2, len(packings), sharex=True, sharey="row", squeeze=False, figsize=(style.width_of(options), 5.0))
    looks = {"formula": ("x", "vermilion"), "averaged": ("^", "purple"), "pore network (YADE)": ("D", "green"), "resolved, double": ("o", "blue"), "resolved, float": ("s", "sky")}
    for column, packing in enumerate(packings):
        of_it = [row for row in rows if row["packing"] == packing]
        for line, (quantity, title) in enumerate(ERRORS.items()):
            panel, points = panels[line][column], []
            for kind, (mark, colour) in looks.items():
                found = [row for row in of_it if kind_of(row["method"]) == kind and abs(float(row[quantity])) > 0]
                xy = [(max(LEAST_SECONDS, float(row["core_seconds"])), abs(float(row[quantity]))) for row in found]
                points += xy
                panel.loglog([x for x, _ in xy], [y for _, y in xy], mark, color=style.COLOURS[colour], markersize=4, label=kind)
                for row, place in zip(found, xy):
                    if kind == "resolved, double":
                        panel.annotate(label_of(row["method"]), place, xytext=(3, 3), textcoords="offset points", fontsize=7)
            front = front_of(points)
            panel.plot([x for x, _ in front], [y for _, y in front], color="#606060", linewidth=0.8, zorder=0)
            panel.margins(y=0.12)
            style.plain_log_ticks(panel.yaxis)
            if column == 0:
                panel.set(ylabel=title)
        panels[0][column].set_title(NAMES.get(packing.split(":")[0], packing))
        panels[1][column].set(xlabel="core seconds")
    panels[0][0].legend(fontsize=7)
    style.save(figure, options.output)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("table")
    parser.add_argument("--output", required=True, help="figure to write; its ending says the format")
    parser.add_argument("--width", type=float, default=7.0, help="inches")
    options = parser.parse_args()
    with open(options.table, newline="", encoding="utf-8") as file:
        # The finest run is what forces are held against.
        draw([row for row in csv.DictReader(file) if not row["method"].startswith("resolved_14")], options)


if __name__ == "__main__":
    main()
