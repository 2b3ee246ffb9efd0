#!/usr/bin/env python3
"""continued_run.py STEP --output FOLDER --suffuse PROGRAM [--mpirun SCRIPT --ranks N] [-- -var NAME VALUE ...]

Runs a step of a campaign, equilibrate (scene 01) or shear (scene 02), in FOLDER: from the beginning, or, where an earlier
run of it with the same settings and the same grains was stopped, from its last restart file that can be read. Time series
of the parts are joined. What was stopped with other settings or grains is moved to FOLDER/earlier_1, earlier_2, ...; moved
back, it goes on with its own settings. The command that was run stands in FOLDER/command.txt.
"""
import argparse
import fcntl
import hashlib
import itertools
import json
import pathlib
import shlex
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
SCENES = {"equilibrate": HERE.parent / "01_isotropic_compression" / "in.isotropic_compression",
          "shear": HERE.parent / "02_constant_p_shear" / "in.constant_p_shear"}
SERIES = {"equilibrate": "compression.csv", "shear": "shear.csv"}
READING_TIMEOUT = 120  # s; LIGGGHTS may wait for ever on a damaged file
# What a run leaves besides the results that Snakemake knows of.
TRACES = {"equilibrate": ("compression.*.restart", "equilibrium.*.restart", "target.restart", "compression.csv", "compression.part_*.csv"),
          "shear": ("shear.*.restart", "sheared.restart", "shear_start.inc", "shear.csv", "shear.part_*.csv", "shear_*.grains.dump", "shear_*.contacts.dump")}
# Variables that change no result, or whose file counts and not its name.
NEUTRAL = ("begin", "stage", "restart", "restart_every", "output", "sample")


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


def variables_of(words):
    """Name to value of -var NAME VALUE ...; a name that stands there twice has its first value, as in LIGGGHTS."""
    found = {}
    starts = [place for place, word in enumerate(words) if word == "-var"]
    for start, end in zip(starts, [*starts[1:], len(words)]):
        name, *values = words[start + 1:end] or [""]
        found.setdefault(name, " ".join(values))
    return found


def as_number(word):
    try:
        return f"{float(word):.12g}"
    except ValueError:
        return word


def settings_of(words):
    return {name: " ".join(map(as_number, value.split())) for name, value in variables_of(words).items() if name not in NEUTRAL}


def first_state(step, folder, given):
    """Files of the grains that the step begins with."""
    if step == "shear":
        return [pathlib.Path(variables_of(given).get("sample", "isotropic.restart"))]
    return [folder / "sample.data", folder / "sample.inc"]


def digest(paths):
    """Of what stands in the files, but for the title of a text, which names the grading's folder."""
    whole = hashlib.sha256()
    for path in paths:
        content = path.read_bytes() if path.exists() else b""
        whole.update(content if path.suffix == ".restart" else content.partition(b"\n")[2])
    return whole.hexdigest()


def record_of(step, folder):
    return folder / f"{step}.settings.json"


def what_differs(step, folder, given):
    """What the stopped run in the folder has otherwise than this one, in words; nothing where it may go on."""
    record, command, grains = record_of(step, folder), folder / "command.txt", first_state(step, folder, given)
    if record.exists():
        before = json.loads(record.read_text())
        other_grains = [] if before["grains"] == digest(grains) else ["other grains"]
    elif command.exists():  # work of a version that left no record: its command, and no restart file older than its grains
        before = {"settings": settings_of(shlex.split(command.read_text()))}
        began = max((path.stat().st_mtime for path in grains if path.exists()), default=0)
        other_grains = [] if all(restart.stat().st_mtime >= began for restart, _ in continuations(step, folder)) else ["restart files older than its grains"]
    else:
        return ["settings that nothing tells of"]
    now = settings_of(given)
    names = sorted(name for name in {*now, *before["settings"]} if now.get(name) != before["settings"].get(name))
    different = [f"{name} {before['settings'].get(name, 'not given')} (now {now.get(name, 'not given')})" for name in names]
    return different + other_grains


def begin_anew(step, folder, why):
    """Nothing of an earlier run may get into this one: what was stopped, for which there is a reason why, is kept elsewhere."""
    traces = [path for pattern in TRACES[step] for path in folder.glob(pattern)]
    traces += [path for path in (record_of(step, folder), folder / "command.txt") if path.exists()]
    if not why:
        for path in traces:
            path.unlink()
        return
    aside = next(path for path in (folder / f"earlier_{number}" for number in itertools.count(1)) if not path.exists())
    aside.mkdir()
    for path in traces:
        path.rename(aside / path.name)
    print(f"{folder}: begins anew, since what was stopped there has {why}; that is kept in {aside}", flush=True)


def where_to_begin(options, folder, given):
    stopped = continuations(options.step, folder)
    different = what_differs(options.step, folder, given) if stopped else []
    for restart, variables in [] if different else stopped:
        if can_be_read(options, restart):
            print(f"{folder}: goes on from {restart.name}", flush=True)
            return variables
        print(f"{folder}: {restart.name} cannot be read", flush=True)
    begin_anew(options.step, folder, ", ".join(different) or ("no restart file that can be read" if stopped else ""))
    return {}


def rows_of(path):
    """Header and complete rows; a killed run may have left half a line, which has no end."""
    text = path.read_text() if path.exists() else ""
    header, *rows = text[:text.rfind("\n") + 1].splitlines() or [""]
    return header, [row for row in rows if row.count(",") == header.count(",")]


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
        header, earlier = rows_of(part)
        joined = [row for row in earlier if float(row.split(",")[0]) < begins * (1 - 1e-9)] + joined
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
    variables = where_to_begin(options, folder, given)
    record = record_of(options.step, folder)
    record.write_text(json.dumps({"settings": settings_of(given), "grains": digest(first_state(options.step, folder, given))}, indent=1) + "\n")
    series = folder / SERIES[options.step]
    set_series_aside(series)
    command = [options.suffuse, "-in", str(SCENES[options.step]), "-log", str(folder / f"log.{options.step}"), "-echo", "none", "-var", "output", str(folder)]
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    command += given
    if options.ranks > 1:
        command = [options.mpirun, str(options.ranks)] + command
    (folder / "command.txt").write_text(shlex.join(command) + "\n")
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
    # A step that is done again begins at its beginning.
    keep_newest(options.step, folder, 0)
    (folder / "target.restart").unlink(missing_ok=True)
    record.unlink()


if __name__ == "__main__":
    main()
