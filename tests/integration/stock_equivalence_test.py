#!/usr/bin/env python3
"""stock_equivalence_test.py --liggghts PROGRAM --suffuse PROGRAM --mpirun SCRIPT --ranks N

Runs in.stock_equivalence, which has no command of ours, with both programs (suffuse with `-suffix off`, LIGGGHTS's own
neighbour lists and contact loop) and compares what they leave:
every thermo value (all but the processor time) and printed line of the log, and every byte of the other files.
No tolerance: both programs run the same library, so that the smallest difference means that suffuse did something.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

SCRIPT = pathlib.Path(__file__).resolve().parent / "in.stock_equivalence"
WRITTEN = ["grains.dump", "grains.xyz", "averaged.txt", "restarted.dump"]
FIRST_WORDS_OF_TIMINGS = ("Loop", "Pair", "Neigh", "Comm", "Outpt", "Other", "Fix", "Modify")


def run(program, options, folder, extra=()):
    command = [options.mpirun, str(options.ranks), program, *extra, "-in", str(SCRIPT), "-var", "steps", "500", "-log", "log.run", "-echo", "none"]
    with open(folder / "screen", "w") as screen:
        code = subprocess.run(command, cwd=folder, stdout=screen, stderr=subprocess.STDOUT).returncode
    if code:
        sys.exit(f"{program} ended with code {code}:\n{(folder / 'screen').read_text(errors='replace')[-2000:]}")


def comparable_log(folder):
    """The log without what differs between two runs of the same program: timings and the build's date."""
    kept, timed_column, rows = [], None, 0
    for line in (folder / "log.run").read_text(errors="replace").splitlines():
        words = line.split()
        if words[:1] == ["Step"]:
            timed_column = words.index("CPU")
        elif timed_column is not None and re.match(r"\s*\d+\s", line) and len(words) > timed_column:
            rows += 1
            words[timed_column] = "-"
            line = " ".join(words)
        elif line.startswith("Loop time"):
            timed_column = None
        if not line.startswith(("LIGGGHTS (Version", "Setting up run at", "Loop time")) and not re.match(rf"({'|'.join(FIRST_WORDS_OF_TIMINGS)})\s+time \(%\)", line):
            kept.append(line)
    return kept, rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("liggghts", "suffuse", "mpirun"):
        parser.add_argument("--" + name, required=True)
    parser.add_argument("--ranks", type=int, required=True)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        stock, ours = pathlib.Path(folder) / "stock", pathlib.Path(folder) / "ours"
        stock.mkdir()
        ours.mkdir()
        run(options.liggghts, options, stock)
        run(options.suffuse, options, ours, ["-suffix", "off"])

        (expected, rows), (found, _) = comparable_log(stock), comparable_log(ours)
        # The script prints thermo every 100 of some 3,000 steps; fewer rows would mean that it ended early.
        if rows < 30:
            sys.exit(f"only {rows} thermo rows in the stock program's log")
        for number, (left, right) in enumerate(zip(expected, found), start=1):
            if left != right:
                sys.exit(f"log line {number} differs:\n  liggghts: {left}\n  suffuse:  {right}")
        if len(expected) != len(found):
            sys.exit(f"the stock program's log has {len(expected)} lines, suffuse's {len(found)}")
        size = 0
        for name in WRITTEN:
            left, right = (stock / name).read_bytes(), (ours / name).read_bytes()
            if not left or left != right:
                sys.exit(f"{name} differs, or is empty: {len(left)} and {len(right)} bytes")
            size += len(left)
        names = [sorted(path.name for path in side.iterdir()) for side in (stock, ours)]
        if names[0] != names[1]:
            sys.exit(f"liggghts leaves the files {names[0]}, suffuse {names[1]}")
        print(f"{options.ranks} ranks: {rows} thermo rows, {len(expected)} lines of log and {size} bytes of output are the same")


if __name__ == "__main__":
    main()
