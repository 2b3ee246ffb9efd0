#!/usr/bin/env python3
"""grain_loop.py --sample FILE [--copies NX NY NZ] [--only ours] [--suffuse PROGRAM] [--modulus PA] [--skins M ...] [--steps N] [--repeats N]
[--ranks N] [--csv FILE] [--lammps PROGRAM]

A step of a sample (restart file of scene 01, or its dump of grains, which may stand side by side as copies; springs are zero then)
with our contact loop and neighbour lists, as a share of LIGGGHTS's own (`-suffix off`), in runs that take turns; with --lammps (Debian's `lammps`, program lmp) also with its gran/hertz/history, from a dump. Processor time of the whole process, less that of a run of no steps, so that other work on
the machine counts little; the median of the pairs' ratios. Also: the contact loop alone, the lists alone, and memory.
"""
import argparse
import csv
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "support"))
from scenes import HEADER, material  # noqa: E402

SCRIPT = HEADER.format(boundary="p p p") + """
{read}
hard_particles yes
""" + material("{skin}", "{modulus}", 0.7, 0.3, law="hertz tangential history {contact_options}") + """
fix motion all nve/sphere
timestep {step}
thermo_style custom step atoms
thermo_modify lost error norm no
run {steps}
"""
# The same springs, masses and lists; LAMMPS's damping is by a coefficient, here one of about the same restitution.
LAMMPS_SCRIPT = """
units si
atom_style sphere
atom_modify map array
comm_modify vel yes
boundary p p p
newton off
{read}
neighbor {skin} {lists}
neigh_modify delay 0
pair_style gran/hertz/history {normal} {tangential} {damping} NULL 0.3 1
pair_coeff * *
fix motion all nve/sphere
timestep {step}
thermo_style custom step atoms
run {steps}
"""
VARIANTS = {"stock": ["-suffix", "off"], "ours": []}


def run(options, folder, variant, skin, steps):
    """Processor seconds of all ranks, and what LIGGGHTS says: shares of its loop, lists, memory (MB, the largest process)."""
    if variant == "lammps":
        shear = options.modulus / (2 * 1.3)
        text = LAMMPS_SCRIPT.format(read=options.read, skin=skin, lists="multi", normal=2 / 3 * options.modulus / (1 - 0.3 ** 2), tangential=4 * shear / (2 - 0.3),
                                    damping=options.lammps_damping, step=options.time_step, steps=steps)
    else:
        text = SCRIPT.format(read=options.read, modulus=options.modulus, skin=skin, step=options.time_step, steps=steps,
                             contact_options=options.contact_options if variant == "ours" else "")
    (folder / "in.benchmark").write_text(text)
    launcher = [str(ROOT / "scripts" / "mpirun"), str(options.ranks)] if options.ranks > 1 else []
    with open(folder / "screen", "w") as screen:
        program = options.lammps if variant == "lammps" else options.suffuse
        child = subprocess.Popen([*launcher, program, *VARIANTS[variant], "-in", "in.benchmark", "-log", "log.benchmark"],
                                 cwd=folder, stdout=screen, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    log = (folder / "log.benchmark").read_text(errors="replace")
    if child.returncode != 0:
        sys.exit(f"{variant} ended with code {child.returncode}:\n{(folder / 'screen').read_text(errors='replace')[-2000:]}")
    seconds = usage.ru_utime + usage.ru_stime
    parts = {name: float(value) for name, value in re.findall(r"^(Pair|Neigh|Comm|Other|Modify) +(?:time \(%\) = |\| [^|]+\| )(\S+)", log, re.MULTILINE)}
    found = re.findall(r"Neighbor list builds = (\d+)", log)
    return seconds, parts, int(found[-1]), usage.ru_maxrss / 1024, int(re.findall(r"with (\d+) atoms", log)[-1])


def copied_dump(dump, copies, data):
    """LIGGGHTS's data file of the last snapshot of a dump `id type x y z radius`, copied side by side."""
    lines = dump.read_text().splitlines()
    begin = max(k for k, line in enumerate(lines) if line.startswith("ITEM: TIMESTEP"))
    count = int(lines[begin + 3])
    low, high = zip(*([float(word) for word in line.split()[:2]] for line in lines[begin + 5:begin + 8]))
    length = [b - a for a, b in zip(low, high)]
    grains = [[float(word) for word in line.split()] for line in lines[begin + 9:begin + 9 + count]]
    images = [(i, j, k) for i in range(copies[0]) for j in range(copies[1]) for k in range(copies[2])]
    with open(data, "w") as file:
        file.write(f"copies of {dump.name}\n\n{count * len(images)} atoms\n1 atom types\n\n")
        for axis, name in enumerate("xyz"):
            file.write(f"{low[axis]:.17g} {low[axis] + copies[axis] * length[axis]:.17g} {name}lo {name}hi\n")
        file.write("\nAtoms\n\n")
        for number, image in enumerate(images):
            for grain in grains:
                place = " ".join(f"{grain[2 + axis] + image[axis] * length[axis]:.17g}" for axis in range(3))
                file.write(f"{number * count + int(grain[0])} 1 {2 * grain[5]:.17g} 2650 {place}\n")


PARTS = ("Pair", "Neigh", "Comm", "Other", "Modify")


def measured(options, folder, skin):
    """A row of the table: least time of a step, and where both loops ran the median ratio of the pairs."""
    start = {variant: run(options, folder, variant, skin, 0)[0] for variant in VARIANTS}
    seen = {variant: [] for variant in VARIANTS}
    for _ in range(options.repeats):
        for variant in VARIANTS:
            seen[variant].append(run(options, folder, variant, skin, options.steps))
    a_step = {v: [1e3 * (r[0] - start[v]) / options.steps for r in seen[v]] for v in VARIANTS}
    least = {v: {part: min(r[1].get(part, 0) for r in seen[v]) * 1e3 / options.steps for part in PARTS} for v in VARIANTS}
    last = {v: seen[v][-1] for v in VARIANTS}
    any_one = next(iter(last.values()))
    row = {"grains": any_one[4], "ranks": options.ranks, "skin_m": skin}
    for v in VARIANTS:
        row |= {f"step_{v}_ms": min(a_step[v]), f"grain_step_{v}_ns": 1e6 * min(a_step[v]) / any_one[4], f"lists_{v}": last[v][2], f"memory_{v}_mb": last[v][3]}
    if {"ours", "stock"} <= VARIANTS.keys():
        row |= {"ratio": statistics.median(o / s for o, s in zip(a_step["ours"], a_step["stock"])),
                "pair_ratio": least["ours"]["Pair"] / least["stock"]["Pair"], "memory_ratio": last["ours"][3] / last["stock"][3]}
    if "lammps" in VARIANTS:
        row |= {"ratio_to_lammps": statistics.median(o / s for o, s in zip(a_step["ours"], a_step["lammps"]))}
    print("  ".join(f"{key} {value:.4g}" for key, value in row.items()), flush=True)
    for v in VARIANTS:
        print(f"    {v}: ms a step " + ", ".join(f"{part} {value:.2f}" for part, value in least[v].items()), flush=True)
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sample", type=pathlib.Path, required=True)
    parser.add_argument("--copies", type=int, nargs=3, default=[1, 1, 1], help="of a dump, side by side")
    parser.add_argument("--only", choices=VARIANTS, help="no ratio: one variant alone")
    parser.add_argument("--suffuse", default=str(ROOT / "build" / "release" / "bin" / "suffuse"))
    parser.add_argument("--modulus", type=float, default=0.7e9)
    parser.add_argument("--time-step", type=float, default=5.9e-8)
    parser.add_argument("--skins", type=float, nargs="+", default=[2e-5, 5e-6])
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--csv", type=pathlib.Path)
    parser.add_argument("--contact-options", default="", help='of our loop, such as "lost_springs keep normal_at full_step": LIGGGHTS\'s and LAMMPS\'s rules')
    parser.add_argument("--lammps", help="its program, such as lmp; needs a dump as --sample")
    parser.add_argument("--lammps-damping", type=float, default=1e6, help="its gamma_n, 1/(s m)")
    options = parser.parse_args()
    rows = []
    if options.lammps:
        VARIANTS["lammps"] = []
    if options.only:
        for variant in [v for v in VARIANTS if v != options.only]:
            del VARIANTS[variant]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        options.read = f"read_restart {options.sample.resolve()}"
        if options.sample.suffix == ".dump":
            copied_dump(options.sample, options.copies, folder / "copies.data")
            options.read = "read_data copies.data"
        for skin in options.skins:
            rows.append(measured(options, folder, skin))
    if options.csv:
        with open(options.csv, "w", newline="") as file:
            writer = csv.DictWriter(file, rows[0].keys())
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main()
