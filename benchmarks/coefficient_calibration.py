#!/usr/bin/env python3
"""Fits the coefficient of the viscosity-independent weighting, and reports it on packings that were not fitted.

    coefficient_calibration.py run  --program build/release/bin/coefficient_calibration --runs RUNS
    coefficient_calibration.py fit --runs RUNS --table zick_homsy_1982.csv --out docs/results/data [--figure FILE.png]

`run` makes RUNS/scans_OPERATOR.csv (drag against the coefficient, on arrays and random packings of equal
spheres) and RUNS/packings_OPERATOR.csv (automatic coefficient, random packings, at 5 to 12 cells): about an
hour on one core (an estimate: not yet run as a whole). `fit` finds the coefficient k* that gives the right drag in each (Zick & Homsy's in arrays,
the mean of the finest runs of both operators in random packings), fits CoefficientLaw to it, and writes
coefficient_scans.csv and coefficient_packings.csv. Seeds of 2 and graded packings are not fitted.
"""
import argparse
import collections
import csv
import pathlib
import subprocess

import numpy as np

ARRAYS = "sc:0.064,sc:0.216,fcc:0.343,sc:0.45,fcc:0.45,sc:0.5236,fcc:0.6"
FITTED = "random:0.2:16:1,random:0.3:16:1,random:0.4:16:1,random:0.5:16:1,random:0.58:16:1,random:0.62:32:1"
PACKINGS = FITTED + (
    ","
    "random:0.4:24:2,random:0.58:24:2,spread:0.45:16:1:0.3,spread:0.58:16:2:0.4,appendix_c:0.6:1,"
    "gap:0.62:4:1:3:0.3"
)
COEFFICIENTS = {"force": "1.5,2,3,4,6,8,11", "sc3": "0.8,1.2,1.8,2.7,4,6"}
DIAMETERS = {"force": "5,6.2,8,10,14,20", "sc3": "5,6.5,8,11"}
TAU = {"force": ("1", "1"), "sc3": ("0.8", "0.9")}  # of arrays and packings; `force` does not depend on it


def run(program, runs):
    runs.mkdir(parents=True, exist_ok=True)
    for operator, tau in TAU.items():
        common = ["--operator", operator]
        jobs = {
            "scans": ["--packing", ARRAYS + "," + FITTED, "--diameter", DIAMETERS[operator], "--coefficient", COEFFICIENTS[operator],
                       "--relaxation-time", tau[0]],
            "packings": ["--packing", PACKINGS, "--diameter", "5,6.5,8,12", "--relaxation-time", tau[1]],
        }
        for name, options in jobs.items():
            with open(runs / f"{name}_{operator}.csv", "w", encoding="utf-8") as out:
                subprocess.run([program, *common, *options], stdout=out, check=True)


def read(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def zick_homsy(path):
    drags = {}
    with open(path, encoding="utf-8") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        for row in rows:
            drag = row["K_zick_homsy_table"] or row["K_computed_here"]
            c = round(float(row["solid_fraction_c"]), 4)
            drags[f"{row['lattice'].lower()}:{c:g}"] = float(drag)
    return drags


def best_coefficients(rows, drags):
    """(packing, D, x, k*) of each packing: log k interpolated in log K, and the slope dlnK/dlnk there."""
    points = collections.defaultdict(list)
    for row in rows:
        key = row["packing"], float(row["diameter_cells"]), float(row["crowding"])
        points[key].append((float(row["drag_K"]), float(row["coefficient"])))
    best = []
    for (name, diameter, x), pairs in points.items():
        drag, k = (np.log(v) for v in np.array(sorted(pairs)).T)
        wanted = np.log(drags[name])
        if drag[0] <= wanted <= drag[-1]:
            nearest = np.argsort(abs(drag - wanted))[:3]
            quadratic = np.polyfit(drag[nearest], k[nearest], 2)
            slope = 1 / np.polyval(np.polyder(quadratic), wanted)
            best.append((name, diameter, x, float(np.exp(np.polyval(quadratic, wanted))), slope))
    return best


def terms(diameter, x):
    return np.array([1 + 0 * diameter, 1 / diameter, x / diameter, (x / diameter) ** 2]).T


def fit_law(best):
    """constant, single, crowded, narrow with the least squared error of the drag; random packings count twice."""
    diameter, x, k, slope = (np.array([b[i] for b in best]) for i in (1, 2, 3, 4))
    weight = (slope + 0.05) / k * np.array([2 if b[0].startswith("random") else 1 for b in best])
    return np.linalg.lstsq(terms(diameter, x) * weight[:, None], k * weight, rcond=None)[0]


def write(path, header, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)


def fit(runs, table, out, figure):
    drags = zick_homsy(table)
    rows = {operator: read(runs / f"packings_{operator}.csv") for operator in TAU}
    finest = collections.defaultdict(list)
    for operator in rows:
        for row in rows[operator]:
            if float(row["diameter_cells"]) > 11:
                finest[row["packing"]].append(float(row["drag_K"]))
    for name, values in finest.items():
        drags[name] = float(np.mean(values))
    scans, laws, packings = [], {}, []
    for operator in TAU:
        best = best_coefficients([row for row in read(runs / f"scans_{operator}.csv") if row["packing"] in drags],
                                 drags)
        law = laws[operator] = fit_law(best)
        print(f"{operator}: constant, single, crowded, narrow = " + ", ".join(f"{v:.3g}" for v in law))
        for name, diameter, x, k, _ in best:
            fitted = float(terms(np.array([diameter]), np.array([x]))[0] @ law)
            scans.append([operator, name, diameter, round(x, 4), round(k, 3), round(fitted, 3)])
        for row in rows[operator]:
            if row["packing"] not in drags:
                continue
            reference = drags[row["packing"]]
            error = 100 * (float(row["drag_K"]) / reference - 1)
            packings.append([operator, row["packing"], row["diameter_cells"], row["crowding"], row["drag_K"],
                             round(reference, 3), len(finest[row["packing"]]), round(error, 2)])
    write(out / "coefficient_scans.csv",
          ["operator", "packing", "diameter_cells", "crowding", "best_coefficient", "fitted_coefficient"], scans)
    write(out / "coefficient_packings.csv",
          ["operator", "packing", "diameter_cells", "crowding", "drag_K", "reference_K", "reference_runs",
           "error_percent"], packings)
    for row in packings:
        print("%-5s %-24s D=%-8s K=%-10s error %+5.1f %%" % (row[0], row[1], row[2], row[4], row[7]))
    if figure:
        draw(scans, laws, packings, figure)


def draw(scans, laws, packings, figure):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    fig, axes = plt.subplots(1, 3, figsize=(11, 3.6))
    for axis, operator in zip(axes, ("force", "sc3")):
        for color, diameter in zip(("C0", "C1", "C2", "C3"), (5, 6.5, 8, 11)):
            near = [a for a in scans if a[0] == operator and abs(a[2] / diameter - 1) < 0.06]
            for marker, lattice in (("o", "sc"), ("s", "fcc"), ("x", "random")):
                points = [a for a in near if a[1].startswith(lattice)]
                axis.plot([a[3] for a in points], [a[4] for a in points], marker, color=color, ms=4)
            x = np.linspace(0, 1.7, 50)
            axis.plot(x, terms(diameter + 0 * x, x) @ laws[operator], color=color, label=f"D = {diameter}")
        axis.set(xlabel="x = D/(6 m)", ylabel="k", title=operator, ylim=(0, None))
        axis.legend(fontsize=7)
    for color, operator in zip(("C0", "C1"), ("force", "sc3")):
        for marker, kinds in (("o", ("random",)), ("^", ("spread", "appendix_c", "gap"))):
            points = [p for p in packings if p[0] == operator and p[1].startswith(kinds)]
            axes[2].plot([float(p[2]) for p in points], [p[7] for p in points], marker, color=color, ms=4,
                         label=f"{operator}, {'equal' if marker == 'o' else 'graded'}")
    axes[2].axhspan(-3, 3, color="0.9", zorder=0)
    axes[2].set(xlabel="Sauter diameter in cells", ylabel="error of the drag, %", title="random packings")
    axes[2].legend(fontsize=7)
    fig.tight_layout()
    fig.savefig(figure, dpi=90)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("run", "fit"))
    parser.add_argument("--program", type=pathlib.Path)
    parser.add_argument("--runs", type=pathlib.Path, required=True)
    parser.add_argument("--table", type=pathlib.Path, default="tests/data/zick_homsy_1982.csv")
    parser.add_argument("--out", type=pathlib.Path, default=".")
    parser.add_argument("--figure", type=pathlib.Path)
    arguments = parser.parse_args()
    if arguments.what == "run":
        run(arguments.program, arguments.runs)
    else:
        fit(arguments.runs, arguments.table, arguments.out, arguments.figure)


if __name__ == "__main__":
    main()
