#!/usr/bin/env python3
"""Fits the law of the automatic coefficient, and reports it on packings that were not fitted.

    coefficient_calibration.py references --program build/release/bin/coefficient_calibration
    coefficient_calibration.py fit        --program build/release/bin/coefficient_calibration [--operator sc3]
    coefficient_calibration.py report     --program build/release/bin/coefficient_calibration [--operator sc3]
    coefficient_calibration.py figure --figure docs/decisions/solid-operator.png

Files are in --data (docs/results/data). `references` makes packing_references.csv: the drag of every packing at 12 to 32
cells a Sauter diameter by the link-wise method, half an hour on one core. `fit` is Gauss-Newton on the error of the drag
itself, from the constants in START: all packings of FITTED and ARRAYS are run at 2.5 to 20 cells with the law as it is, and
once with each constant made larger, which gives the slopes for all rounds. Its last round is coefficient_fit_OPERATOR.csv;
the constants are printed. With --settled PERCENT the settled samples of GRADED are fitted too, at 5 to 8 cells, allowed that error
at five and 2.5 % at eight. `report` runs the program's own law on HELD_OUT at 5 and 8 cells:
coefficient_held_out_OPERATOR.csv.
"""
import argparse
import csv
import hashlib
import pathlib
import subprocess

import numpy as np

# The first is there so that the law holds for lone spheres too; it is not among the reference runs.
ARRAYS = ["sc:0.064", "sc:0.216", "sc:0.45", "sc:0.5236", "fcc:0.343", "fcc:0.45", "fcc:0.6"]
FITTED = [f"random:{phi}:{count}" for count in ("64:21", "16:1", "16:11") for phi in (0.2, 0.3, 0.4, 0.5, 0.58, 0.62)] + [
    "spread:0.55:64:21:0.4", "spread:0.5:16:1:0.4", "spread:0.45:16:11:0.25", "spread:0.58:16:11:0.4"]
# Fines 3 to 5 times smaller, 10 to 30 % of the solid.
GAPS = ["gap:0.62:4:11:3:0.3", "gap:0.62:4:12:3:0.3", "gap:0.58:6:21:4:0.25", "gap:0.55:8:21:5:0.1", "gap:0.66:4:21:5:0.3"]
# Of the thesis's gradings: A(10 %), unstable, and Appendix A, placed without contacts; and 400 grains each as scene 01
# compresses them, to porosities of 0.22 to 0.28.
SETTLED = [f"dump:tests/data/settled_{grading}.dump" for grading in ("A30", "A20", "A10", "11c", "B30")]
GRADED = ["grading:0.62:400:input_scripts/gradings/A10.csv:31", "grading:0.66:800:input_scripts/gradings/appendix_A.csv:31"] + SETTLED
HELD_OUT = [f"random:{phi}:64:31" for phi in (0.2, 0.3, 0.4, 0.5, 0.58, 0.62)] + [
    "spread:0.5:64:31:0.25", "spread:0.58:64:31:0.4", "appendix_c:0.6:11",
    "gap:0.62:6:31:3:0.3", "gap:0.6:8:31:5:0.1", "gap:0.65:4:31:4:0.35"] + GRADED
TAU = {"force": "1", "sc3": "0.8", "interpolated": "1"}  # `force` and `interpolated` do not depend on it
START = {"force": [1.7, 2.3, 15.2, 36, 124], "sc3": [0.6, 2.5, 6, 35]}
HELD = {"force": [1.5, 0.012], "sc3": [0, 0, 0]}  # the terms after those, which are not fitted: `reach` and `swept`; `sc3` was fitted without the last two
# Errors allowed at these diameters, per cent, with which the fit's residuals are weighed: what is asked of packings, and
# of arrays, which no soil is.
ALLOWED = {"packing": [(2.5, 6.0), (3, 4.0), (4, 3.0), (5, 2.5), (8, 1.8), (12, 1.5)], "array": [(5, 10.0), (8, 4.5), (12, 2.5), (20, 0.9)]}


def kind(packing):
    return "settled" if packing in SETTLED else "array" if packing in ARRAYS else "packing"


# Arrays that are run at 20 cells too, for `constant`: the other terms fall with the resolution.
FINE = ["sc:0.216", "sc:0.45", "fcc:0.45"]


# A lone sphere: the mean of this array over four places on the lattice, between which the drag scatters by 2 % at five
# cells, with a weight of its own, per cent.
LONE, LONE_PLACES, LONE_ALLOWED = "sc:0.064", "0.3,0.8,0.05,0.55", 1.5

CACHE = None


def run(program, packings, diameters, operator, law=None, offsets="0.3"):
    command = [str(program), "--operator", operator, "--packing", ",".join(packings), "--diameter", diameters,
               "--relaxation-time", TAU[operator], "--offset", offsets]
    if law is not None:
        command += ["--law", ",".join(f"{v:.6g}" for v in [*law, *HELD[operator]])]
    kept = CACHE / hashlib.sha256(" ".join(command[1:]).encode()).hexdigest()[:20] if CACHE else None
    if kept and kept.exists():
        return list(csv.DictReader(kept.read_text().splitlines()))
    text = subprocess.run(command, stdout=subprocess.PIPE, check=True, text=True).stdout
    if kept:
        kept.write_text(text)
    return list(csv.DictReader(text.splitlines()))


def read(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def write(path, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def zick_homsy(path):
    return {f"{row['lattice'].lower()}:{round(float(row['solid_fraction_c']), 4):g}":
            float(row["K_zick_homsy_table"] or row["K_computed_here"]) for row in read(path)}


def resolutions(packing):
    """Of the reference runs: dense packings are extrapolated, the open ones are too large for more."""
    if packing.startswith("dump"):
        return "16,24"
    phi = float(packing.split(":")[1])
    if packing.startswith("appendix_c"):
        return "16,24"
    if packing.startswith("grading"):
        return "16,24" if "A10" in packing else "12,16"
    if packing.startswith("gap"):
        return "16,24,32"
    return "16,24,32" if phi > 0.55 else "12" if phi < 0.35 and packing != "random:0.3:16:1" else "16"


def references(program, data):
    rows = [row for p in ARRAYS[1:] for row in run(program, [p], "12,16,24,32", "interpolated")]
    for packing in FITTED + GAPS + HELD_OUT:
        rows += run(program, [packing], resolutions(packing), "interpolated")
    write(data / "packing_references.csv", rows)


def drag_at(rows, packing, diameters):
    """Of the link-wise runs, at one resolution; from the coarsest and the finest extrapolated, with an error that falls as
    D^-1.5."""
    found = [(float(r["diameter_cells"]), float(r["drag_K"])) for r in rows if r["packing"] == packing]
    chosen = [min(found, key=lambda f: abs(f[0] / d - 1)) for d in diameters]
    if len(chosen) == 1:
        return chosen[0][1]
    (coarse, first), (fine, second) = chosen[0], chosen[-1]
    return second - (first - second) / ((fine / coarse) ** 1.5 - 1)


def reference_drags(data, table):
    """K and its doubt (a share): Zick & Homsy's for arrays; for packings the link-wise method's, less the mean error
    that the same procedure has in arrays; the doubt is the scatter of those errors."""
    rows = read(data / "packing_references.csv")
    known = zick_homsy(table)
    drags = {name: (drag, 0.) for name, drag in known.items()}
    for packing in FITTED + GAPS + HELD_OUT:
        diameters = [float(d) for d in resolutions(packing).split(",")]
        # At one resolution narrow pores are out of reach, at 12 cells those of c = 0.45 too.
        arrays = [a for a in ARRAYS[1:] if len(diameters) > 1 or float(a.split(":")[1]) < (0.35 if diameters[0] < 16 else 0.5)]
        errors = [drag_at(rows, a, diameters) / known[a] - 1 for a in arrays]
        if sum(r["packing"] == packing for r in rows) >= len(diameters):
            drags[packing] = drag_at(rows, packing, diameters) / (1 + np.mean(errors)), float(np.std(errors))
    return drags


def fit_round(program, operator, law):
    """Arrays at 5 to 12 or 20 cells, packings at 2.5 to 8, gap-graded ones where fines have two cells or more, and LONE at all its places."""
    def cells(packing):
        if packing in ARRAYS:
            return "5,8,12,20" if packing in FINE and operator == "force" else "5,8,12"
        if packing in GAPS:
            return "8" if packing.split(":")[4] == "5" else "5,8"
        return "2.5,3,4,5,8" if operator == "force" else "5,8"
    rows = [row for p in ARRAYS + FITTED + (GAPS if operator == "force" else []) for row in run(program, [p], cells(p), operator, law)]
    if "settled" in ALLOWED:
        rows += [row for p in SETTLED for row in run(program, [p], "5,6,8", operator, law, "0.3,0.8")]
    finest = [row for row in rows if row["packing"] == LONE and float(row["diameter_cells"]) > 10]
    return [row for row in rows if row["packing"] != LONE] + finest + run(program, [LONE], "5,8", operator, law, LONE_PLACES)


def column(rows, name):
    return np.array([float(r[name]) for r in rows])


def is_lone(row):
    return row["packing"] == LONE and float(row["diameter_cells"]) < 10


def groups_of(rows):
    """A matrix that takes means over places on the lattice (of LONE and the settled samples), and leaves the other rows as they are."""
    keys = [(r["packing"], round(float(r["diameter_cells"]))) for r in rows]
    unique = list(dict.fromkeys(keys))
    groups = np.array([[key == other for other in keys] for key in unique], float)
    return groups / groups.sum(axis=1, keepdims=True)


def fit(program, operator, data, table, rounds):
    law = np.array(START[operator], float)
    drags = reference_drags(data, table)

    def errors(rows):
        return np.log(column(rows, "drag_K") / np.array([drags[r["packing"]][0] for r in rows]))

    slopes, best = None, None
    for n in range(rounds + 1):
        rows = fit_round(program, operator, law)
        error = errors(rows)
        groups = groups_of(rows)
        allowed = groups @ [LONE_ALLOWED if is_lone(r) else np.interp(
            float(r["diameter_cells"]), *zip(*ALLOWED[kind(r["packing"])])) for r in rows] / 100
        cost = float(np.mean((groups @ error / allowed) ** 2))
        print(f"{operator} round {n}: {', '.join(f'{v:.4g}' for v in law)}  cost {cost:.4f}", flush=True)
        if best is None or cost < best[0]:
            best = cost, law, rows, error
        if n == rounds:
            break
        if slopes is None:
            larger = law * (1 + 0.1 * np.eye(law.size))
            slopes = np.array([(errors(fit_round(program, operator, other)) - error) / np.sum(other - law) for other in larger]).T
        law = law - np.linalg.lstsq(groups @ slopes / allowed[:, None], groups @ error / allowed, rcond=None)[0]
    _, law, rows, error = best
    for row, e in zip(rows, error):
        row["reference_K"] = f"{drags[row['packing']][0]:.4f}"
        row["error_percent"] = f"{100 * (np.exp(e) - 1):.2f}"
    write(data / f"coefficient_fit_{operator}.csv", rows)
    print("constants: " + ", ".join(f"{v:.4g}" for v in law))


def report(program, operator, data, table):
    drags = reference_drags(data, table)
    held_out = [p for p in HELD_OUT if p in drags]
    rows = [row for p in held_out for row in run(program, [p], "5,8", operator, None, "0.3,0.8")]
    for row in rows:
        drag, doubt = drags[row["packing"]]
        row["reference_K"], row["reference_doubt_percent"] = f"{drag:.4f}", f"{100 * doubt:.2f}"
        row["error_percent"] = f"{100 * (float(row['drag_K']) / drag - 1):.2f}"
        print("%-24s D=%-8s K=%-10s error %6s %%" % (row["packing"], row["diameter_cells"], row["drag_K"], row["error_percent"]))
    for diameter in (5, 8):
        errors = np.array([float(r["error_percent"]) for r in rows if abs(float(r["diameter_cells"]) / diameter - 1) < 0.05])
        print(f"at {diameter}: root mean square {np.sqrt(np.mean(errors ** 2)):.2f} %, largest {abs(errors).max():.2f} %")
    write(data / f"coefficient_held_out_{operator}.csv", rows)
    with open(table.parent / "packing_drags.csv", "w", encoding="utf-8") as file:
        file.write("packing,drag_K,doubt_percent\n")
        for name in FITTED + GAPS + held_out:
            file.write(f"{name},{drags[name][0]:.4f},{100 * drags[name][1]:.2f}\n")


def figure(data, out):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    fig, axis = plt.subplots(figsize=(5, 3.4))
    groups = (("fit", ARRAYS, "+", "0.6", "arrays, fitted"), ("fit", FITTED, "x", "C0", "random, fitted"),
              ("held_out", HELD_OUT, "o", "C3", "random, not fitted"))
    for name, packings, marker, color, label in groups:
        rows = [r for r in read(data / f"coefficient_{name}_force.csv") if r["packing"] in packings]
        axis.plot(column(rows, "diameter_cells"), column(rows, "error_percent"), marker, color=color, ms=4, label=label)
    axis.fill_between([4, 6.5, 6.5, 13], [-3, -3, -2, -2], [3, 3, 2, 2], color="0.9", zorder=0)
    axis.set(xlabel="Sauter diameter in cells", title="force", ylabel="error of the drag, %", ylim=(-8, 8))
    axis.legend(fontsize=7)
    fig.tight_layout()
    fig.savefig(out, dpi=80)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("references", "fit", "report", "figure"))
    parser.add_argument("--program", type=pathlib.Path)
    parser.add_argument("--operator", choices=("force", "sc3"), default="force")
    parser.add_argument("--rounds", type=int, default=2)
    parser.add_argument("--settled", type=float, help="fit settled samples too: error allowed at five cells, per cent")
    parser.add_argument("--table", type=pathlib.Path, default="tests/data/zick_homsy_1982.csv")
    parser.add_argument("--data", type=pathlib.Path, default="docs/results/data")
    parser.add_argument("--figure", type=pathlib.Path, default="docs/decisions/solid-operator.png")
    parser.add_argument("--cache", type=pathlib.Path, help="folder that keeps what runs printed, to go on after an interruption")
    arguments = parser.parse_args()
    global CACHE
    CACHE = arguments.cache
    if arguments.settled:
        ALLOWED["settled"] = [(5, arguments.settled), (8, 2.5)]
    if arguments.what == "references":
        references(arguments.program, arguments.data)
    elif arguments.what == "fit":
        fit(arguments.program, arguments.operator, arguments.data, arguments.table, arguments.rounds)
    elif arguments.what == "report":
        report(arguments.program, arguments.operator, arguments.data, arguments.table)
    else:
        figure(arguments.data, arguments.figure)


if __name__ == "__main__":
    main()
