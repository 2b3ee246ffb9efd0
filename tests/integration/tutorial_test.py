#!/usr/bin/env python3
"""tutorial_test.py --source FOLDER --build FOLDER: docs/tutorial.md as written: its commands one after the other, in a folder that looks like
the repository's; then what the page says of the results."""
import argparse
import csv
import pathlib
import re
import subprocess
import sys
import tempfile

LEAVES = ["verdict.html", "grains.data", "isotropic.restart", "shear.png", "permeability_result.csv", "column/results.csv", "column/fluidisation.png",
          "column/slice.png"]


def value_of(path, quantity):
    with open(path) as file:
        return next(float(row["value"]) for row in csv.DictReader(file) if row["quantity"] == quantity)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--source", type=pathlib.Path, required=True)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    options = parser.parse_args()
    page = (options.source / "docs/tutorial.md").read_text(encoding="utf-8")
    commands = "\n".join(re.findall(r"^```sh\n(.*?)^```", page, re.MULTILINE | re.DOTALL))
    with tempfile.TemporaryDirectory(prefix="suffuse-tutorial-") as name:
        root = pathlib.Path(name)
        for folder in ("input_scripts", "analysis", "scripts", "docs"):
            (root / folder).symlink_to(options.source / folder)
        (root / "build").mkdir()
        (root / "build/release").symlink_to(options.build)
        (root / "commands.sh").write_text(commands)  # by standard input mpirun would take them
        done = subprocess.run(["bash", "-euo", "pipefail", "commands.sh"], cwd=root, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0:
            sys.exit(f"the tutorial ends with code {done.returncode}:\n{done.stdout[-3000:]}")
        there = root / "runs/tutorial"
        missing = [path for path in LEAVES if not (there / path).is_file()]
        if missing:
            sys.exit(f"the tutorial does not leave {missing}")
        # What the page says: 0.99 of Carman and Kozeny's in a sample of 400 grains, the weight of the grains within a few per cent.
        numbers = {"k over Carman and Kozeny's": (value_of(there / "permeability_result.csv", "over_carman_kozeny"), 0.99, 0.1),
                   "critical gradient over that of the weight": (value_of(there / "column/fluidisation_result.csv", "critical_over_terzaghi"), 1.003, 0.05),
                   "conductivity of the column over Carman and Kozeny's": (value_of(there / "column/fluidisation_result.csv", "conductivity_over_carman_kozeny"), 0.85, 0.1)}
        print(numbers)
        wrong = [f"{what}: {value}, the page says {said}" for what, (value, said, within) in numbers.items() if abs(value - said) > within]
        if "internally stable" not in done.stdout.lower() or "500 coarse grains take 1959 grains" not in done.stdout:
            wrong.append("the verdict or the sample is not what the page says")
        sys.exit("\n".join(wrong) if wrong else 0)


if __name__ == "__main__":
    main()
