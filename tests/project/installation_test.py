#!/usr/bin/env python3
"""installation_test.py BUILD_FOLDER VERSION: `cmake --install` into an empty prefix gives a program that runs from there."""
import pathlib
import subprocess
import sys
import tempfile

EXPECTED_FILES = ["share/doc/suffuse/LICENSE", "share/doc/suffuse/README.md", "share/doc/suffuse/index.md",
                  "share/doc/suffuse/references.bib", "share/suffuse/figures/compression.py", "share/suffuse/figures/rose.py",
                  "share/suffuse/data/thesis_table_4_1.csv", "bin/suffuse-analyse", "bin/suffuse-study", "bin/suffuse-flow", "bin/suffuse-mpirun",
                  "share/suffuse/python/suffuse_data.py"]


def python_with_figures():
    script = pathlib.Path(__file__).resolve().parents[2] / "scripts/python_with_figures"
    return subprocess.run([script], check=True, capture_output=True, text=True).stdout.strip()


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
        # Figures run from there, with what stands beside them.
        figure = prefix / "share/suffuse/figures/fluidisation.py"
        done = subprocess.run([python_with_figures(), figure, "--help"], cwd=folder, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{figure} does not run: {done.stderr}")
        page = subprocess.run([prefix / "bin/suffuse", "--styles"], check=True, capture_output=True, text=True).stdout.splitlines()[0]
        if str(prefix / "share/doc/suffuse/reference") not in page:
            sys.exit(f"suffuse --styles finds its pages elsewhere: {page}")
        answer = subprocess.run([prefix / "bin/suffuse", "--version"], cwd=folder, check=True, capture_output=True, text=True).stdout
        if version not in answer:
            sys.exit(f"suffuse --version answers '{answer.strip()}', without the project's version {version}")
        print(answer.strip())


if __name__ == "__main__":
    main()
