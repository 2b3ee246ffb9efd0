#!/usr/bin/env python3
"""lbm_lost_data_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N [--kills K]

What is saved is whole, whatever happens while it is written. A disk that is full (a small file system of its own) while a state, a
monitor or an output is written ends the run on all ranks with a sentence and exit code 1, and what was written before can be
read; a run that SIGKILL ends at any instant leaves a state of water and grains of the same step that can be taken up;
a damaged one is refused. Mounting needs root: without it the full disk is left out, and said.
"""
import contextlib
import ctypes
import os
import pathlib
import random
import re
import shutil
import signal
import struct
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import QUICK_STARTS_AND_ENDS, Program, columns, expect, loose_sample, read_sample, scratch  # noqa: E402
from wet_scenes import WATER, wet_box  # noqa: E402

RUN = "lbm boundary zlo pressure 0.5 zhi pressure 0\n"


@contextlib.contextmanager
def small_disk(folder, megabytes):
    """A file system of a few megabytes mounted under the folder."""
    place = folder / "small"
    place.mkdir(exist_ok=True)
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={int(megabytes * 1024)}k", "tmpfs", str(place)], check=True)
    try:
        yield place
    finally:
        subprocess.run(["umount", str(place)], check=True)


def can_mount(folder):
    try:
        with small_disk(folder, 1):
            return True
    except (subprocess.CalledProcessError, FileNotFoundError):
        return False


def fill(place, leave_kilobytes):
    """Leaves so much room on the disk."""
    room = os.statvfs(place)
    with open(place / "ballast", "wb") as file:
        file.write(bytes(max(0, room.f_bavail * room.f_frsize - leave_kilobytes * 1024)))


def ends_with_a_sentence(program, text, folder, name, words):
    code, screen = program.run(text, folder, name, timeout=60)
    lines = [line for line in screen.splitlines() if line.startswith("suffuse: error:")]
    expect(code == 1 and len(lines) == 1, f"{name}: code {code}, {len(lines)} error lines\n{screen[-2000:]}")
    for word in words:
        expect(re.search(word, lines[0]), f"{name}: no '{word}' in: {lines[0]}")
    expect("internal error" not in screen, screen[-2000:])


def take_up(program, folder, state, name="again"):
    """Goes on from a state; its step."""
    text = wet_box(restart=f"{state}/grains") + WATER + RUN + f"lbm restart read {state}\nlbm run 1e-4\n"
    program.must_run(text, folder, name)


def check_full_state(program, folder):
    """Every kind of shortage: no room for the water, for the grains, for the last bytes."""
    with small_disk(folder, 16) as place:
        start = wet_box(restart=str(folder / "start")) + WATER + RUN
        program.must_run(start + f"lbm run 1e-3\nlbm restart write {place}/state\n", folder, "good")
        used = sum(file.stat().st_size for file in (place / "state").iterdir())
        expect((place / "state").is_symlink() and used > 1e6, f"a state of {used} bytes")
        take_up(program, folder, f"{place}/state")
        fluid = (place / "state" / "fluid.h5").stat().st_size // 1024
        for left in (8, fluid // 2, fluid - 4, fluid + 8, fluid + 16):
            fill(place, left)
            ends_with_a_sentence(program, start + f"lbm run 1e-3\nlbm restart write {place}/state\n", folder, f"room for {left} kB",
                                 ["take what is written|have room for"])
            (place / "ballast").unlink()
            take_up(program, folder, f"{place}/state")
            shutil.rmtree(place / "state.new", ignore_errors=True)
        program.must_run(start + f"lbm run 1e-3\nlbm restart write {place}/state\n", folder, "good again")
        take_up(program, folder, f"{place}/state.1")
        take_up(program, folder, f"{place}/state.2")
        fill(place, 0)
        ends_with_a_sentence(program, start + f"write_restart {place}/dry\n", folder, "write_restart", ["take what is written"])


def check_full_dry(program, folder):
    """The set of before stays, and can be taken up; what `write_restart` replaces stays, too."""
    with small_disk(folder, 2) as place:
        start = read_sample("sample")
        program.must_run(start + f"restart_set {place}/state every 20\nrun 40\nwrite_restart {place}/alone\n", folder, "dry")
        alone = (place / "alone").read_bytes()
        for left in (0, 8, 16):
            fill(place, left)
            ends_with_a_sentence(program, start + f"restart_set {place}/state every 20\nrun 100000\n", folder, f"dry, {left} kB",
                                 ["restart_set", "take what is written|have room for"])
            ends_with_a_sentence(program, start + f"write_restart {place}/alone\n", folder, "write_restart", ["write_restart", "take what is written"])
            (place / "ballast").unlink()
            program.must_run(read_sample(f"{place}/state.grains") + "run 10\n", folder, "dry again")
            expect((place / "alone").read_bytes() == alone, "write_restart has spoilt the file of before")
            shutil.rmtree(place / "state.new", ignore_errors=True)


def check_full_series(program, folder):
    """Rows are whole up to the last; snapshots that were written can be read."""
    with small_disk(folder, 4) as place:
        start = wet_box(restart=str(folder / "start")) + WATER + RUN
        fill(place, 16)
        ends_with_a_sentence(program, start + f"lbm monitor m every 2e-5 file {place}/m.csv superficial_velocity mass bed\nlbm run 1\n",
                             folder, "monitor", ["lbm monitor m", "m.csv", "is the disk full"])
        rows = (place / "m.csv").read_text()
        expect(rows.endswith("\n") and len(columns(place / "m.csv")["time_s"]) > 20, f"the last row is not whole: {rows[-200:]}")
        (place / "ballast").unlink()
        for kind in ("velocity pressure solid_fraction", "grains contacts"):
            text = start + f"lbm output o every 1e-4 file {place}/o.h5 {kind}\nlbm run 1\n"
            if "grains" in kind:
                (place / "o.h5").unlink(missing_ok=True)
                text = text.replace(kind, "solid_fraction " + kind)
            ends_with_a_sentence(program, text, folder, f"output of {kind}", ["file = ", "what was written before is whole"])
            files = [place / "o.h5"] + ([place / "o_grains.h5"] if "grains" in kind else [])
            for file in files:
                look = f"import h5py; f = h5py.File('{file}'); print(sum(len(f[s]) > 0 for s in f))"
                done = subprocess.run(["/usr/bin/python3", "-c", look], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
                expect(done.returncode == 0 and int(done.stdout) > 3, f"{file}: {done.stdout[-300:]}")


def check_semaphore(program, folder):
    """What Open MPI of a killed run left under the name of a file in memory that all see keeps no later run waiting."""
    library = ctypes.CDLL("libpthread.so.0", use_errno=True)
    library.sem_open.restype = ctypes.c_void_p
    name = b"/OMPIO_fluid.h5"
    expect(library.sem_open(name, os.O_CREAT, 0o600, 0), "no semaphore could be made")
    try:
        program.must_run(wet_box(restart="start") + WATER + RUN + "lbm run 1e-3\nlbm restart write waited\n", folder, "semaphore", timeout=60)
    finally:
        library.sem_unlink(name)


def check_damaged(program, folder):
    """Truncated, longer or changed: refused before LIGGGHTS reads it; the same for a restart file of LIGGGHTS alone."""
    start = wet_box(restart="start") + WATER + RUN
    program.must_run(start + "lbm run 1e-3\nlbm restart write bad\n", folder, "bad")
    grains = folder / "bad" / "grains"
    whole = grains.read_bytes()
    read = wet_box(restart="bad.grains") + "run 0\n"
    changed = bytearray(whole)
    changed[len(whole) // 2] ^= 1
    for damaged in (whole[:100], whole[:-1], whole[:len(whole) // 2], whole + b"\0", bytes(changed)):
        grains.write_bytes(damaged)
        ends_with_a_sentence(program, read, folder, "damaged", ["read_restart", "be whole"])
    grains.write_bytes(whole)
    program.must_run(read, folder, "mended")
    (folder / "bad" / "fluid.h5").write_bytes((folder / "bad" / "fluid.h5").read_bytes()[:-100])
    ends_with_a_sentence(program, start + "lbm restart read bad\nlbm run 1e-4\n", folder, "fluid", ["lbm restart read", "be whole"])
    dry = (folder / "start").read_bytes()
    for length in (0, 10, 200, len(dry) // 3, len(dry) - 8):
        (folder / "short").write_bytes(dry[:length])
        ends_with_a_sentence(program, wet_box(restart="short"), folder, "short", ["read_restart", "be a whole restart file"])
    for name in ("/dev/null", "taken", "nowhere/state"):
        (folder / "taken").write_text("mine")
        ends_with_a_sentence(program, start + f"lbm run 1e-4\nlbm restart write {name}\n", folder, "taken", ["lbm restart write", name])
        ends_with_a_sentence(program, start + f"lbm restart write {name} every 1e-4\nlbm run 1e-3\n", folder, "taken", [name])
    expect((folder / "taken").read_text() == "mine" and not os.path.isfile("/dev/null"), "a file is gone")


def check_foreign_records(program, folder):
    """A fix's record of another version, of another length, or changed: one line, on all ranks, whoever has the grains."""
    whole = (folder / "start").read_bytes()
    mark = whole.index(b"suffuse\n")
    grain = whole.index(struct.pack("<dd", 46, 2))  # the length of a grain's record, and its version
    text = wet_box(restart="foreign") + "run 0\n"

    def with_bytes(at, new):
        changed = bytearray(whole)
        changed[at:at + len(new)] = new
        return bytes(changed)

    for changed, words in ((with_bytes(mark, b"Suffuse\n"), ["without a version", "be of version 1"]),
                           (with_bytes(mark + 8, struct.pack("<q", 7)), ["= version 7,", "be of version 1"]),
                           (with_bytes(mark + 24, struct.pack("<q", 3)), ["3 values, not 1"]),
                           (with_bytes(mark + 40, struct.pack("<d", 0.5)), ["damaged"]),
                           (with_bytes(grain + 8, struct.pack("<d", 1)), ["of another layout for 1 grains", "be of version 2"])):
        (folder / "foreign").write_bytes(changed)
        ends_with_a_sentence(program, text, folder, "foreign", ["fix hydrodynamic/force: record", *words])
    (folder / "foreign").write_bytes(whole)
    program.must_run(text, folder, "own")


def killed_scenes(program):
    """Scenes by name: what begins, and what takes the state up and goes on, saving every few steps."""
    grid = f"{program.ranks} 1 1"

    def coupled(state):
        start = wet_box(processors=grid, restart="killed.grains" if state else "start") + WATER + RUN
        return start + "lbm restart write killed every 2e-5\n" + ("lbm restart read killed\n" if state else "")

    def dry(state):
        scene = wet_box(processors=grid, restart="killed.grains" if state else "start")
        return scene.replace("fix hydrodynamic_force all hydrodynamic/force\n", "") + "restart_set killed every 20\n"

    def servo(state):
        return read_sample("killed.grains" if state else "sample") + "fix s all stress/servo isotropic 100e3\nrestart_set killed every 20\n"

    return {"coupled": (coupled, "lbm run {}\n", "1000", "1e-5"), "dry": (dry, "run {}\n", "1000000000", "10"),
            "servo": (servo, "run {}\n", "1000000000", "10")}


def check_killed(program, folder, kills, kind):
    """Killed at random instants while it saves every few steps, and taken up by the next one: the state under the name is whole
    and of one step, and what is taken up runs on."""
    scene, run_line, for_ever, shortly = killed_scenes(program)[kind]
    seen, instants = set(), random.Random(1)
    for n in range(kills):
        state = (folder / "killed").exists()
        (folder / "in.killed").write_text(scene(state) + run_line.format(for_ever))
        before = os.stat(folder / "killed").st_mtime_ns if state else 0
        run = subprocess.Popen([program.mpirun, str(program.ranks), program.suffuse, "-in", "in.killed", "-log", "none", "-echo", "none"],
                               cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=os.environ | QUICK_STARTS_AND_ENDS)
        end = time.monotonic() + 60
        while time.monotonic() < end and (not (folder / "killed").exists() or os.stat(folder / "killed").st_mtime_ns == before):
            time.sleep(0.01)
        time.sleep(0.2 * instants.random())
        children = pathlib.Path(f"/proc/{run.pid}/task/{run.pid}/children").read_text().split()
        expect(children, f"{kind}: the run ended by itself")
        for child in children:
            os.kill(int(child), signal.SIGKILL)
        run.wait(timeout=60)
        if n % 10 == kills % 10 - 1 or n + 1 == kills:  # the next run takes it up, too
            program.must_run(scene(True) + run_line.format(shortly), folder, "look")
        expect((folder / "killed").exists(), f"{kind}: no state after kill {n}")
        seen.add(os.readlink(folder / "killed"))
    expect(kills < 8 or seen == {"killed.1", "killed.2"}, f"states of {seen} only")
    for name in ("killed", "killed.grains"):
        (folder / name).unlink()
    for name in ("killed.1", "killed.2", "killed.new"):
        shutil.rmtree(folder / name, ignore_errors=True)


def check_killed_series(program, folder, kills):
    """Killed while monitors and outputs are written, most of the time: the next run takes them up, and in the end rows and states are
    those of a run without an end, none missing and none twice; every state can be read."""
    grid = f"{program.ranks} 1 1"
    interval, instants = 3.90625e-4, random.Random(2)  # five fluid steps
    for n in range(kills + 1):
        state = (folder / "series").exists()
        text = wet_box(processors=grid, restart="series.grains" if state else "start") + WATER + RUN + \
            f"lbm monitor m every {interval} file series.csv mass\nlbm output o every {interval} file series.h5 solid_fraction grains\n" \
            f"lbm restart write series every {4 * interval}\n" + ("lbm restart read series\n" if state else "")
        if n == kills:
            program.must_run(text + f"lbm run {10 * interval}\n", folder, "series")
            break
        (folder / "in.series").write_text(text + "lbm run 1000\n")
        run = subprocess.Popen([program.mpirun, str(program.ranks), program.suffuse, "-in", "in.series", "-log", "none", "-echo", "none"],
                               cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=os.environ | QUICK_STARTS_AND_ENDS)
        before = os.stat(folder / "series").st_mtime_ns if state else 0
        end = time.monotonic() + 60
        while time.monotonic() < end and (not (folder / "series").exists() or os.stat(folder / "series").st_mtime_ns == before):
            time.sleep(0.01)
        time.sleep(0.2 * instants.random())
        children = pathlib.Path(f"/proc/{run.pid}/task/{run.pid}/children").read_text().split()
        expect(children, "the run with outputs ended by itself")
        for child in children:
            os.kill(int(child), signal.SIGKILL)
        run.wait(timeout=60)
    times = columns(folder / "series.csv")["time_s"]
    expect(all(abs(t - k * interval) < 1e-6 * interval for k, t in enumerate(times)), f"rows missing or twice: {times}")
    look = "import h5py, sys\nf = h5py.File(sys.argv[1])\nprint(*[int(s[5:]) for s in sorted(f)])\nf.visititems(lambda n, a: (a[...], None)[1] if isinstance(a, h5py.Dataset) else None)"
    for name in ("series.h5", "series_grains.h5"):
        done = subprocess.run(["/usr/bin/python3", "-c", look, name], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        expect(done.returncode == 0, f"{name}: {done.stdout[-300:]}")
        steps = [int(word) for word in done.stdout.split()]
        expect(steps == [5 * k for k in range(len(times))], f"{name}: states {steps}")
        expect(not (folder / f"{name}.undo").exists(), f"{name}.undo is left")


def main():
    arguments = sys.argv[1:]
    value = {name: arguments[arguments.index(name) + 1] for name in ("--suffuse", "--mpirun", "--ranks", "--kills") if name in arguments}
    program = Program(value["--suffuse"], value["--mpirun"], int(value["--ranks"]))
    kills = int(value.get("--kills", 2))
    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        Program(program.suffuse, program.mpirun, 1).must_run(wet_box(grains=6) + "write_restart start\n", folder)
        Program(program.suffuse, program.mpirun, 1).must_run(loose_sample(grains=100) + "write_restart sample\n", folder)
        mounts = can_mount(folder)
        check_semaphore(program, folder)
        check_damaged(program, folder)
        check_foreign_records(program, folder)
        if mounts:
            check_full_state(program, folder)
            check_full_dry(program, folder)
            check_full_series(program, folder)
        check_killed_series(program, folder, kills)
        for kind in killed_scenes(program):
            check_killed(program, folder, kills, kind)
    print(f"{program.ranks} ranks: whole after {kills} kills each of runs with water, dry, and with a servo" + ("" if mounts else "; no full disk: mounting needs root"))


if __name__ == "__main__":
    main()
