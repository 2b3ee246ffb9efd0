#!/usr/bin/env python3
"""check_installation.py BUILD_FOLDER VERSION: `cmake --install` into an empty prefix gives a program that runs from there."""
import pathlib
import subprocess
import sys
import tempfile

EXPECTED_FILES = ["share/doc/suffuse/LICENSE", "share/doc/suffuse/README.md", "share/doc/suffuse/index.md",
                  "share/doc/suffuse/references.bib", "share/suffuse/figures/compression.py", "share/suffuse/figures/rose.py",
                  "share/suffuse/data/thesis_table_4_1.csv", "bin/suffuse-analyse", "bin/suffuse-study"]


def main():
    build, version = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        prefix = pathlib.Path(folder) / "prefix with a blank"
        subprocess.run(["cmake", "--install", build, "--prefix", prefix], check=True, stdout=subprocess.DEVNULL)
        missing = [name for name in EXPECTED_FILES if not (prefix / name).is_file()]
        if missing:
            sys.exit(f"not installed: {missing}")
        if not list((prefix / "share/suffuse/input_scripts").glob("*/in.*")):
            sys.exit("no input script installed")
        answer = subprocess.run([prefix / "bin/suffuse", "--version"], cwd=folder, check=True, capture_output=True, text=True).stdout
        if version not in answer:
            sys.exit(f"suffuse --version answers '{answer.strip()}', without the project's version {version}")
        print(answer.strip())


if __name__ == "__main__":
    main()
