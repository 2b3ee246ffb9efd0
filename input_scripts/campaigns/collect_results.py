#!/usr/bin/env python3
"""collect_results.py --analyse PROGRAM --samples FOLDER --output results.csv [--series series.csv]

One row a number of every sample of a campaign: from Tables 4.1 and 5.1 beside what was measured (`suffuse-analyse
reproduce`), then what else was measured at rest and in shear; each with the command that made the sample. With --series
the curves of all shear tests too, a row every 0.1 % of axial strain (as docs/results/data/chapter_5_series.csv).
"""
import argparse
import csv
import pathlib
import subprocess
import sys
import tempfile

COLUMNS = ("source", "case", "quantity", "measured", "thesis", "relative_difference", "command")
AT_REST = ("unconnected_fines_share", "coordination_mechanical", "alpha_sufian_pair_halves", "fines_solid_share", "sliding_share", "rattler_share")

SERIES = ("axial_strain", "deviatoric_stress_pa", "volumetric_strain", "coordination_number", "coordination_fine_coarse", "coordination_coarse_coarse",
          "alpha_pair_halves", "sliding_share")
STRAIN_BETWEEN = 0.001


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def command_of(folder):
    path = folder / "command.txt"
    return path.read_text().strip() if path.exists() else ""


def table_rows(options, table):
    with tempfile.TemporaryDirectory() as scratch:
        output = pathlib.Path(scratch) / "table.csv"
        done = subprocess.run([options.analyse, "reproduce", table, str(options.samples), "--output", str(output)], capture_output=True, text=True)
        if done.returncode != 0:
            if "no folder has a sample.toml of this table" in done.stderr:
                return []
            sys.exit(f"collect_results: {done.stderr.strip()}")
        print(done.stdout)
        rows = rows_of(output)
    return [{"source": table, "case": pathlib.Path(row["folder"]).name, "quantity": row["quantity"], "measured": row["measured"], "thesis": row["thesis"],
             "relative_difference": row["relative_difference"], "command": command_of(pathlib.Path(row["folder"]))} for row in rows]


def read_off(series, analyse):
    """What chapter 5 reads off the curves of a shear test; nothing from one too short for that."""
    with tempfile.TemporaryDirectory() as scratch:
        output = pathlib.Path(scratch) / "shear.csv"
        done = subprocess.run([analyse, "shear", str(series), "--output", str(output)], capture_output=True, text=True)
        if done.returncode != 0:
            print(f"collect_results: {done.stderr.strip()}")
            return []
        return [(row["quantity"], row["value"]) for row in rows_of(output)]


def other_rows(folder, analyse):
    def rows(source, values, command):
        return [{"source": source, "case": folder.name, "quantity": name, "measured": value, "thesis": "", "relative_difference": "", "command": command}
                for name, value in values if value != ""]

    found = []
    if (folder / "contacts.csv").exists():
        last = rows_of(folder / "contacts.csv")[-1]
        found += rows("at rest", [(name, last[name]) for name in AT_REST if name in last], command_of(folder))
    if (folder / "shear" / "shear_result.csv").exists():
        # A shear that was continued does not know where it started: that is the state at rest.
        values = [(row["quantity"], row["value"]) for row in rows_of(folder / "shear" / "shear_result.csv") if not row["quantity"].endswith("_start")]
        found += rows("shear", values, command_of(folder / "shear"))
        found += rows("shear curves", read_off(folder / "shear" / "shear.csv", analyse), command_of(folder / "shear"))
    return found


def curve_of(folder):
    """The first row of a shear test, then the next one that is STRAIN_BETWEEN further."""
    rows, last = [], None
    for row in rows_of(folder / "shear" / "shear.csv"):
        if last is None or float(row["axial_strain"]) >= last + STRAIN_BETWEEN:
            last = float(row["axial_strain"])
            rows.append({"case": folder.name, **{name: f"{float(row[name]):.5g}" for name in SERIES}})
    return rows


def write(path, columns, rows):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        writer.writerows(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--analyse", default="suffuse-analyse")
    parser.add_argument("--samples", required=True, type=pathlib.Path)
    parser.add_argument("--output", required=True, type=pathlib.Path)
    parser.add_argument("--series", type=pathlib.Path)
    options = parser.parse_args()
    rows = table_rows(options, "table-4-1") + table_rows(options, "table-5-1")
    folders = sorted(path.parent for path in options.samples.glob("*/sample.toml"))
    for folder in folders:
        rows += other_rows(folder, options.analyse)
    write(options.output, COLUMNS, rows)
    if options.series:
        write(options.series, ("case", *SERIES), [row for folder in folders if (folder / "shear" / "shear_result.csv").exists() for row in curve_of(folder)])


if __name__ == "__main__":
    main()
