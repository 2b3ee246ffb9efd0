#!/usr/bin/env python3
"""own_sample_test.py --suffuse PROGRAM --mpirun SCRIPT: the scene of docs/examples runs as the README says."""
import argparse
import csv
import pathlib
import re
import subprocess
import sys
import tempfile

SCENE = pathlib.Path(__file__).resolve().parents[2] / "docs/examples/in.own_sample"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--suffuse", required=True)
    parser.add_argument("--mpirun", required=True)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([options.mpirun, "2", options.suffuse, "-in", SCENE], cwd=folder, capture_output=True, text=True, errors="replace")
        if done.returncode:
            sys.exit(f"ended with code {done.returncode}: {done.stdout[-1500:]}{done.stderr[-1500:]}")
        with open(pathlib.Path(folder) / "own_sample.csv", newline="") as file:
            rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
    # The servo's own tolerance of p' is 0.5 %.
    if abs(rows[-1]["mean_stress_pa"] / 100e3 - 1) > 0.005:
        sys.exit(f"p' = {rows[-1]['mean_stress_pa']} Pa at the end, not 100 kPa within 0.5 %")
    # Equal spheres pack between 0.36 (dense) and 0.46 (loosest, with friction): e between 0.56 and 0.85.
    if not 0.56 < rows[-1]["void_ratio"] < 0.85:
        sys.exit(f"void ratio {rows[-1]['void_ratio']} is none of a packing of equal spheres")
    printed = re.search(r"^sheared: q/p = (\S+), e = \S+$", done.stdout, re.MULTILINE)
    # q/p = 6 sin(phi) / (3 - sin(phi)): 0.5 to 1.2 is a friction angle of 13 to 30 degrees, outside of which no packing of
    # spheres with an interparticle friction of 0.3 (17 degrees) lies; 500 grains scatter within it.
    if not printed or not 0.5 < float(printed.group(1)) < 1.2:
        sys.exit(f"the stress ratio at 5 % axial strain is not that of sheared spheres: {printed and printed.group(0)}")
    print(printed.group(0), f"after {len(rows)} rows")


if __name__ == "__main__":
    main()
