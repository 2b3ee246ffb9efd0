#!/usr/bin/env python3
"""contact_dump_reading.py --analyse PROGRAM [--megabytes 1000] [--cells 18 | --one-snapshot] [--least MB_PER_S] [--most MB]

How fast `suffuse-analyse contacts` reads and analyses a long dump of contacts on one core, as a ratio to `wc -l` on the same
file in the same run, and how much memory it takes, for the whole series and for a quarter of its snapshots (the same, or it
would grow with their number). With --one-snapshot all of it is one snapshot, of as many contacts as fit. The dump has the 18 columns of `compute pair/gran/local pos id force force_normal
force_tangential` in six digits, of a periodic face-centred cubic packing of 4 cells³ grains with random forces.
"""
import argparse
import math
import multiprocessing
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import time

RADIUS = 0.5e-3
BYTES_OF_A_CONTACT = 172  # about


def lattice(cells):
    """Grains of a periodic face-centred cubic packing, and for each the offsets to half of its twelve neighbours."""
    edge = 2 * math.sqrt(2) * RADIUS
    basis = ((0, 0, 0), (0, 1, 1), (1, 0, 1), (1, 1, 0))  # in half edges
    points = [(2 * x + bx, 2 * y + by, 2 * z + bz) for x in range(cells) for y in range(cells) for z in range(cells) for bx, by, bz in basis]
    number = {point: k + 1 for k, point in enumerate(points)}
    half = ((0, 1, 1), (0, 1, -1), (1, 0, 1), (1, 0, -1), (1, 1, 0), (1, -1, 0))
    return edge, points, number, half


def snapshot(cells, rng):
    """Text of the grains and of the contacts, each without its step."""
    edge, points, number, half = lattice(cells)
    place = lambda point: [(c + 0.5) * edge / 2 for c in point]  # noqa: E731
    box = "ITEM: BOX BOUNDS pp pp pp\n" + 3 * f"0 {cells * edge:.10g}\n"
    grains = [f"{k} {' '.join(f'{c:.6g}' for c in place(point))} {RADIUS:g}" for point, k in number.items()]
    contacts = []
    for point, k in number.items():
        for offset in half:
            other = tuple((a + b) % (2 * cells) for a, b in zip(point, offset))
            normal = [-o / math.sqrt(2) for o in offset]  # from the other grain to this one
            side = rng.random(), rng.random(), rng.random()
            along = sum(s * n for s, n in zip(side, normal))
            force = rng.expovariate(50)
            push = [force * n for n in normal]
            shear = [0.2 * force * (s - along * n) for s, n in zip(side, normal)]
            row = place(point) + place(other) + [k, number[other], 1] + [p + s for p, s in zip(push, shear)] + push + shear
            contacts.append(" ".join(f"{v:.6g}" for v in row))
    head = lambda what, rows: f"ITEM: NUMBER OF {what}\n{rows}\n{box}"  # noqa: E731
    columns = " ".join(f"c_pairs[{k}]" for k in range(1, 19))
    return (f"{head('ATOMS', len(grains))}ITEM: ATOMS id x y z radius\n" + "\n".join(grains) + "\n",
            f"{head('ENTRIES', len(contacts))}ITEM: ENTRIES {columns}\n" + "\n".join(contacts) + "\n")


def write_series(path, text, snapshots):
    with open(path, "w", encoding="ascii") as file:
        for step in range(snapshots):
            file.write(f"ITEM: TIMESTEP\n{1000 * step}\n{text}")


def in_another_process(action, *arguments):
    """Keeps this process small: the system counts the memory of a program's parent at its start into the program's peak."""
    worker = multiprocessing.Process(target=action, args=arguments)
    worker.start()
    worker.join()
    if worker.exitcode != 0:
        sys.exit("the dumps could not be written")


def write_files(files, cells, megabytes, share, told):
    grains, contacts = snapshot(cells, random.Random(1))
    count = max(4, round(megabytes * 1e6 / len(contacts))) // share if share else 1
    for path, text in zip(files, (grains, contacts)):
        write_series(path, text, count)
    told.value = count


def timed(command):
    """Seconds of the processor and of the wall, and the peak memory in MB."""
    start = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    output = process.stdout.read().decode()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{' '.join(map(str, command))} ended with {status}:\n{output}")
    return usage.ru_utime + usage.ru_stime, time.monotonic() - start, usage.ru_maxrss / 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--analyse", required=True, help="the program suffuse-analyse")
    parser.add_argument("--megabytes", type=float, default=1000, help="size of the dump of contacts")
    parser.add_argument("--cells", type=int, default=18, help="unit cells along a side: 4 cells³ grains, 24 cells³ contacts")
    parser.add_argument("--least", type=float, help="fail below so many MB/s of processor time")
    parser.add_argument("--one-snapshot", action="store_true", help="one snapshot of all megabytes")
    parser.add_argument("--most", type=float, help="fail above so many MB of memory")
    options = parser.parse_args()
    if options.one_snapshot:
        options.cells = round((options.megabytes * 1e6 / (24 * BYTES_OF_A_CONTACT)) ** (1 / 3))
    count = multiprocessing.Value("i", 0)
    with tempfile.TemporaryDirectory(prefix="suffuse-benchmark-") as folder:
        memory = {}
        files = [pathlib.Path(folder) / name for name in ("grains.dump", "contacts.dump")]
        for share in (0,) if options.one_snapshot else (4, 1):
            in_another_process(write_files, files, options.cells, options.megabytes, share, count)
            timed(["wc", "-l", *files])  # brings the files into the system's memory
            count_cpu, count_wall, _ = timed(["wc", "-l", *files])
            cpu, wall, memory[share] = timed([options.analyse, "contacts", *files, "--split", "0.5e-3", "--output", f"{folder}/series.csv", "--overwrite"])
        megabytes = sum(path.stat().st_size for path in files) / 1e6
    print(f"{count.value} snapshots of {24 * options.cells ** 3} contacts, {megabytes:.0f} MB")
    print(f"suffuse-analyse contacts: {megabytes / cpu:.0f} MB/s of processor time ({megabytes / wall:.0f} MB/s by the clock)")
    print(f"wc -l: {megabytes / count_cpu:.0f} MB/s; ratio of the times {cpu / count_cpu:.1f}")
    if options.one_snapshot:
        print(f"memory: {memory[0]:.0f} MB")
    else:
        print(f"memory: {memory[1]:.0f} MB; for a quarter of the snapshots {memory[4]:.0f} MB")
        if memory[1] > 1.2 * memory[4] + 5:
            sys.exit("the memory grows with the number of snapshots")
    if options.most and max(memory.values()) > options.most:
        sys.exit(f"more than {options.most:g} MB")
    if options.least and megabytes / cpu < options.least:
        sys.exit(f"slower than {options.least:g} MB/s")


if __name__ == "__main__":
    main()
