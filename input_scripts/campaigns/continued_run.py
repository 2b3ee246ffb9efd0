#!/usr/bin/env python3
"""continued_run.py STEP --output FOLDER --suffuse PROGRAM [--mpirun SCRIPT --ranks N] [-- -var NAME VALUE ...]

Runs a step of a campaign, equilibrate (scene 01) or shear (scene 02), in FOLDER: from the beginning, or, where an earlier
run of it was stopped, from its last restart file that can be read. Time series of the parts are joined. The command
that was run stands in FOLDER/command.txt.
"""
import argparse
import fcntl
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
SCENES = {"equilibrate": HERE.parent / "01_isotropic_compression" / "in.isotropic_compression",
          "shear": HERE.parent / "02_constant_p_shear" / "in.constant_p_shear"}
SERIES = {"equilibrate": "compression.csv", "shear": "shear.csv"}
READING_TIMEOUT = 120  # s; LIGGGHTS may wait for ever on a damaged file


def step_of(path):
    return int(path.name.split(".")[-2])


def newest_first(folder, stem):
    return sorted(folder.glob(f"{stem}.*.restart"), key=step_of, reverse=True)


def keep_newest(step, folder, count):
    for stem in ("shear",) if step == "shear" else ("compression", "equilibrium"):
        for restart in newest_first(folder, stem)[count:]:
            restart.unlink()


def can_be_read(options, restart):
    """A run that was killed while it wrote leaves a file that is cut short."""
    try:
        done = subprocess.run([options.suffuse, "-in", str(HERE / "in.read_restart"), "-var", "restart", str(restart), "-log", "none"],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=READING_TIMEOUT)
    except subprocess.TimeoutExpired:
        return False
    return done.returncode == 0


def continuations(step, folder):
    """(restart file, variables) from the last state on."""
    if step == "shear":
        return [(restart, {"sample": restart}) for restart in newest_first(folder, "shear")]
    late = newest_first(folder, "equilibrium") + [path for path in [folder / "target.restart"] if path.exists()]
    found = [(restart, {"begin": "restart", "stage": "equilibrium", "restart": restart}) for restart in late]
    return found + [(restart, {"begin": "restart", "restart": restart}) for restart in newest_first(folder, "compression")]


def where_to_begin(options, folder):
    for restart, variables in continuations(options.step, folder):
        if can_be_read(options, restart):
            print(f"{folder}: goes on from {restart.name}", flush=True)
            return variables
        print(f"{folder}: {restart.name} cannot be read", flush=True)
    return {}


def rows_of(path):
    """Header and complete rows; a killed run may have left half a line."""
    lines = path.read_text().splitlines() if path.exists() else []
    if not lines:
        return "", []
    commas = lines[0].count(",")
    return lines[0], [line for line in lines[1:] if line.count(",") == commas and not line.endswith(",")]


def set_series_aside(series):
    header, rows = rows_of(series)
    if rows:
        number = len(list(series.parent.glob(series.stem + ".part_*.csv")))
        (series.parent / f"{series.stem}.part_{number}.csv").write_text("\n".join([header, *rows]) + "\n")
    series.unlink(missing_ok=True)


def join_series(series):
    """Of the parts' rows those before the next part begins."""
    parts = [series.parent / f"{series.stem}.part_{k}.csv" for k in range(len(list(series.parent.glob(series.stem + ".part_*.csv"))))]
    header, joined = rows_of(series)
    for part in reversed(parts):
        begins = float(joined[0].split(",")[0]) if joined else float("inf")
        joined = [row for row in rows_of(part)[1] if float(row.split(",")[0]) < begins * (1 - 1e-9)] + joined
    series.write_text("\n".join([header, *joined]) + "\n")
    for part in parts:
        part.unlink()


def main():
    words = sys.argv[1:]
    given = words[words.index("--") + 1:] if "--" in words else []
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("step", choices=SCENES)
    parser.add_argument("--output", required=True, type=pathlib.Path)
    parser.add_argument("--suffuse", required=True)
    parser.add_argument("--mpirun")
    parser.add_argument("--ranks", type=int, default=1)
    options = parser.parse_args(words[:words.index("--")] if "--" in words else words)
    folder = options.output
    folder.mkdir(parents=True, exist_ok=True)
    lock = open(folder / f"{options.step}.lock", "w")  # held until this run and its program are gone
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        sys.exit(f"continued_run: {folder}: another run of this step is still going on; end it first")
    variables = where_to_begin(options, folder)
    series = folder / SERIES[options.step]
    set_series_aside(series)
    command = [options.suffuse, "-in", str(SCENES[options.step]), "-log", str(folder / f"log.{options.step}"), "-echo", "none", "-var", "output", str(folder)]
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    command += given
    if options.ranks > 1:
        command = [options.mpirun, str(options.ranks)] + command
    (folder / "command.txt").write_text(" ".join(command) + "\n")
    with open(folder / f"screen.{options.step}", "a") as screen:
        running = subprocess.Popen(command, stdout=screen, stderr=subprocess.STDOUT, pass_fds=[lock.fileno()])
        while running.poll() is None:
            try:
                running.wait(timeout=20)
            except subprocess.TimeoutExpired:
                keep_newest(options.step, folder, 3)
    if running.returncode != 0:
        sys.exit(f"continued_run: {options.step} of {folder} ended with code {running.returncode}; see {folder}/screen.{options.step}")
    join_series(series)
    keep_newest(options.step, folder, 0)


if __name__ == "__main__":
    main()
