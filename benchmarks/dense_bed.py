#!/usr/bin/env python3
"""dense_bed.py --suffuse PROGRAM --bed PROGRAM [--fraction linear] [--precision double] [--ranks 1]
             [--grid "1 1 1"] [--mpirun "mpirun --bind-to core -np"] [--steps 200]
             [--line "lbm effect comoving on"]...

The dense moving bed of coupled_step_benchmark with grains that LIGGGHTS moves: 7,958 spheres of 5 cells diameter settle in
84 x 84 x 168 cells with no-slip walls, 10 DEM steps a fluid step. Prints each part of a step in milliseconds and as a
multiple of the bare update of the fluid's populations, which `lbm run` times at its end.
"""
import argparse
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "support"))
from scenes import HEADER, material  # noqa: E402

SPACING, CELLS = 2e-4, (84, 84, 168)
DIAMETER = 5 * SPACING
VISCOSITY, RELAXATION_TIME, SUBSTEPS = 1e-5, 0.6, 10
TIME_STEP = (RELAXATION_TIME - 0.5) / 3 * SPACING ** 2 / VISCOSITY

SCRIPT = HEADER.format(boundary="f f f") + """
processors {processors}
read_data bed.data
soft_particles yes
""" + material(1.5e-4, "5e6", 0.7, 0.3) + """
fix motion all nve/sphere
fix weight all gravity 9.81 vector 0 0 -1
fix xlo all wall/gran model hertz tangential history primitive type 1 xplane 0
fix xhi all wall/gran model hertz tangential history primitive type 1 xplane {high[0]}
fix ylo all wall/gran model hertz tangential history primitive type 1 yplane 0
fix yhi all wall/gran model hertz tangential history primitive type 1 yplane {high[1]}
fix zlo all wall/gran model hertz tangential history primitive type 1 zplane 0
fix zhi all wall/gran model hertz tangential history primitive type 1 zplane {high[2]}
fix hydrodynamic_force all hydrodynamic/force
timestep {grain_step:.12g}
thermo 1000000
lbm fluid density 1000 viscosity {viscosity}
lbm lattice spacing {spacing} relaxation_time {relaxation_time} precision {precision}
lbm boundary xlo noslip xhi noslip ylo noslip yhi noslip zlo noslip zhi noslip
lbm force gravity 0 0 -9.81
lbm solid fraction {fraction}
lbm effect lubrication off
{lines}
lbm run {warm_up:.12g}
lbm run {time:.12g}
"""


def write_data(centres, path):
    """LIGGGHTS's data file: id, type, diameter, density, position."""
    high = [SPACING * n for n in CELLS]
    lines = ["a dense bed", "", f"{len(centres)} atoms", "1 atom types", ""]
    lines += [f"0 {h:.12g} {axis}lo {axis}hi" for axis, h in zip("xyz", high)] + ["", "Atoms", ""]
    lines += [f"{n + 1} 1 {DIAMETER:.12g} 2650 " + " ".join(f"{SPACING * float(x):.12g}" for x in centre)
              for n, centre in enumerate(centres)]
    path.write_text("\n".join(lines) + "\n")
    return high


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--suffuse", default="build/release/bin/suffuse")
    parser.add_argument("--bed", default="build/release/bin/coupled_step_benchmark", help="writes the centres")
    parser.add_argument("--mpirun", default=str(ROOT / "scripts" / "mpirun"), help="what comes before the number of ranks")
    parser.add_argument("--fraction", default="linear")
    parser.add_argument("--precision", default="double")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--grid", help="ranks along x, y and z; default: all along z")
    parser.add_argument("--steps", type=int, default=200)
    parser.add_argument("--line", action="append", default=[], help="of the script, after those of the fluid")
    options = parser.parse_args()
    suffuse, bed = (str(pathlib.Path(p).resolve()) for p in (options.suffuse, options.bed))
    with tempfile.TemporaryDirectory(prefix="suffuse-") as name:
        folder = pathlib.Path(name)
        subprocess.run([bed, "--write_bed", "centres"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        centres = [line.split() for line in (folder / "centres").read_text().splitlines()]
        high = write_data(centres, folder / "bed.data")
        (folder / "in.bed").write_text(SCRIPT.format(
            high=high, grain_step=TIME_STEP / SUBSTEPS, viscosity=VISCOSITY, spacing=SPACING, fraction=options.fraction,
            relaxation_time=RELAXATION_TIME, precision=options.precision, warm_up=20 * TIME_STEP,
            time=options.steps * TIME_STEP, processors=options.grid or f"1 1 {options.ranks}",
            lines="\n".join(options.line)))
        run = [suffuse, "-in", "in.bed"]
        if options.ranks > 1:
            run = shlex.split(options.mpirun) + [str(options.ranks)] + run
        done = subprocess.run(run, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"ended with code {done.returncode}:\n{done.stdout[-2000:]}")
    last = done.stdout[done.stdout.rindex("time in"):]
    parts = re.findall(r"^(fluid|solid mapping|forces on grains|grains \(LIGGGHTS\)|monitors and output|rest) +\S+ +(\S+) ",
                       last, re.MULTILINE)
    share = float(re.search(r"(\d+) % of the memory", last).group(1)) / 100
    milliseconds = {part: float(value) for part, value in parts}
    bare = milliseconds["fluid"] * share
    print(f"{len(centres)} grains, {'; '.join([options.fraction] + options.line)}, {options.precision}, ranks: {options.grid or options.ranks}; bare update {bare:.2f} ms")
    for part, value in list(milliseconds.items()) + [("step", sum(milliseconds.values()))]:
        print(f"{part:22}{value:9.2f} ms{value / bare:8.2f} x bare")


if __name__ == "__main__":
    main()
