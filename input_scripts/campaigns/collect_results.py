#!/usr/bin/env python3
"""collect_results.py --analyse PROGRAM --samples FOLDER --output results.csv

One row a number of every sample of a campaign: from Tables 4.1 and 5.1 beside what was measured (`suffuse-analyse
reproduce`), then what else was measured at rest and in shear; each with the command that made the sample.
"""
import argparse
import csv
import pathlib
import subprocess
import sys
import tempfile

COLUMNS = ("source", "case", "quantity", "measured", "thesis", "relative_difference", "command")
AT_REST = ("unconnected_fines_share", "coordination_mechanical", "alpha_sufian_pair_halves", "fines_solid_share", "sliding_share", "rattler_share")


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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--analyse", default="suffuse-analyse")
    parser.add_argument("--samples", required=True, type=pathlib.Path)
    parser.add_argument("--output", required=True, type=pathlib.Path)
    options = parser.parse_args()
    rows = table_rows(options, "table-4-1") + table_rows(options, "table-5-1")
    for folder in sorted(path.parent for path in options.samples.glob("*/sample.toml")):
        rows += other_rows(folder, options.analyse)
    with open(options.output, "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
