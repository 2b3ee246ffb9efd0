#!/usr/bin/env python3
"""grain_loop.py --sample FILE [--suffuse PROGRAM] [--modulus PA] [--skins M ...] [--steps N] [--repeats N] [--ranks N] [--csv FILE]

A step of a dense sample (restart file of scene 01) with our contact loop and neighbour lists, as a share of LIGGGHTS's own
(`-suffix off`), in runs that take turns. Processor time of the whole process, less that of a run of no steps, so that other work on
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
SCRIPT = """
units si
atom_style granular
atom_modify map array
communicate single vel yes
boundary p p p
newton off
read_restart {sample}
neighbor {skin} bin
neigh_modify delay 0
hard_particles yes
fix modulus all property/global youngsModulus peratomtype {modulus}
fix ratio all property/global poissonsRatio peratomtype 0.3
fix restitution all property/global coefficientRestitution peratomtypepair 1 0.7
fix friction all property/global coefficientFriction peratomtypepair 1 0.3
pair_style gran model hertz tangential history
pair_coeff * *
fix motion all nve/sphere
timestep {step}
thermo_style custom step atoms
thermo_modify lost error norm no
run {steps}
"""
VARIANTS = {"stock": ["-suffix", "off"], "ours": []}


def run(options, folder, variant, skin, steps):
    """Processor seconds of all ranks, and what LIGGGHTS says: shares of its loop, lists, memory (MB, the largest process)."""
    text = SCRIPT.format(sample=options.sample.resolve(), modulus=options.modulus, skin=skin, step=options.time_step, steps=steps)
    (folder / "in.benchmark").write_text(text)
    launcher = [str(ROOT / "scripts" / "mpirun"), str(options.ranks)] if options.ranks > 1 else []
    with open(folder / "screen", "w") as screen:
        child = subprocess.Popen([*launcher, options.suffuse, *VARIANTS[variant], "-in", "in.benchmark", "-log", "log.benchmark"],
                                 cwd=folder, stdout=screen, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    log = (folder / "log.benchmark").read_text(errors="replace")
    if child.returncode != 0:
        sys.exit(f"{variant} ended with code {child.returncode}:\n{(folder / 'screen').read_text(errors='replace')[-2000:]}")
    seconds = usage.ru_utime + usage.ru_stime
    parts = {name: float(value) for name, value in re.findall(r"^(Pair|Neigh|Comm|Other|Modify) +time \(%\) = (\S+)", log, re.MULTILINE)}
    found = re.findall(r"Neighbor list builds = (\d+)", log)
    return seconds, parts, int(found[-1]), usage.ru_maxrss / 1024, int(re.findall(r"with (\d+) atoms", log)[-1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sample", type=pathlib.Path, required=True)
    parser.add_argument("--suffuse", default=str(ROOT / "build" / "release" / "bin" / "suffuse"))
    parser.add_argument("--modulus", type=float, default=0.7e9)
    parser.add_argument("--time-step", type=float, default=5.9e-8)
    parser.add_argument("--skins", type=float, nargs="+", default=[2e-5, 5e-6])
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--csv", type=pathlib.Path)
    options = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for skin in options.skins:
            start = {variant: run(options, folder, variant, skin, 0)[0] for variant in VARIANTS}
            seen = {variant: [run(options, folder, variant, skin, options.steps) for _ in range(1)] for variant in VARIANTS}
            for _ in range(options.repeats - 1):
                for variant in VARIANTS:
                    seen[variant].append(run(options, folder, variant, skin, options.steps))
            a_step = {v: [1e3 * (r[0] - start[v]) / options.steps for r in seen[v]] for v in VARIANTS}
            ratio = statistics.median(o / s for o, s in zip(a_step["ours"], a_step["stock"]))
            least = {v: {part: min(r[1].get(part, 0) for r in seen[v]) * 1e3 / options.steps for part in ("Pair", "Neigh", "Comm", "Other", "Modify")}
                     for v in VARIANTS}
            last = {v: seen[v][-1] for v in VARIANTS}
            row = {"grains": last["ours"][4], "ranks": options.ranks, "skin_m": skin, "step_stock_ms": min(a_step["stock"]), "step_ours_ms": min(a_step["ours"]),
                   "ratio": ratio, "pair_ratio": least["ours"]["Pair"] / least["stock"]["Pair"], "lists": last["ours"][2], "lists_stock": last["stock"][2],
                   "memory_ratio": last["ours"][3] / last["stock"][3]}
            rows.append(row)
            print("  ".join(f"{key} {value:.4g}" for key, value in row.items()), flush=True)
            for v in VARIANTS:
                print(f"    {v}: ms a step " + ", ".join(f"{part} {value:.2f}" for part, value in least[v].items()), flush=True)
    if options.csv:
        with open(options.csv, "w", newline="") as file:
            writer = csv.DictWriter(file, rows[0].keys())
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main()
