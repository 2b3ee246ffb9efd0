#!/usr/bin/env python3
"""dry_sampling.py --suffuse PROGRAM [--liggghts PROGRAM] [--sample FILE] [--ranks N] [--steps N] [--repeats N] [--csv FILE]

What our computes and the servo cost, as ratios within one invocation. Runs of the same dense sample (Appendix A's grading at
200 kPa) take turns:

  plain     suffuse without any style of ours
  defined   every compute defined, none output
  sampled   every compute evaluated every 100 steps; a tenth of what it adds is what sampling every 1,000 steps adds
  servo     fix stress/servo holding 200 kPa;  deform: LIGGGHTS's fix deform at a rate near nothing
  stock     the program liggghts, with the script of `plain`

Each is reported by the median of its loop times over those of `plain` beside them, and by its grain steps a second. Without --sample, a
sample is made first (--grains, E = 0.7 GPa). Exits with 1 where `defined`, or sampling every 1,000 steps, exceeds --limit.
"""
import argparse
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "support"))
from scenes import HEADER, material  # noqa: E402

SCENE = ROOT / "input_scripts" / "01_isotropic_compression" / "in.isotropic_compression"
SPLIT = 0.3e-3

SCRIPT = HEADER.format(boundary="p p p") + "read_restart {sample}\n" + material(2e-5, "0.7e9", 0.7, 0.3) + """
fix motion all nve/sphere
timestep 5.9e-8
thermo_style custom step atoms
thermo 100000
thermo_modify lost error norm no
{extra}
run {warm_up}
run {steps}
"""
COMPUTES = f"""
compute c1 all coordination split {SPLIT}
compute c2 all stress/reduction split {SPLIT}
compute c3 all constraint/ratio
compute c4 all sliding/contacts
compute c5 all slipping/index
compute c6 all fabric
compute c7 all strong/contacts
compute c8 all broken/contacts
compute c9 all inertial/number
compute c10 all stress/layer z 10
"""
GLOBAL = ("c1", "c2", "c3", "c4", "c6", "c7", "c8", "c9", "c10")
VARIANTS = {
    "plain": "",
    "defined": COMPUTES,
    "sampled": COMPUTES + f"fix sampling all ave/time 100 1 100 {' '.join(f'c_{name}' for name in GLOBAL)} file sampled.txt\n"
                          "compute count all reduce sum c_c5[1]\nfix contacts all ave/time 100 1 100 c_count file contacts.txt\n",
    "servo": "fix servo all stress/servo isotropic 200e3 progress 0\n",
    "deform": "fix box all deform 1 x erate -1e-9 y erate -1e-9 z erate -1e-9 remap x units box\n",
}


def loop_time(program, text, folder, ranks):
    """Seconds of the last run's loop, and its grains."""
    (folder / "in.benchmark").write_text(text)
    launcher = [str(ROOT / "scripts" / "mpirun"), str(ranks)] if ranks > 1 else []
    done = subprocess.run(launcher + [program, "-in", "in.benchmark", "-log", "log.benchmark"], cwd=folder, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT)
    found = re.findall(r"Loop time of (\S+) on \d+ procs for \d+ steps with (\d+) atoms", (folder / "log.benchmark").read_text(errors="replace"))
    if done.returncode != 0 or len(found) != 2:
        sys.exit(f"a run ended with code {done.returncode}:\n{done.stdout.decode(errors='replace')[-2000:]}")
    return float(found[-1][0]), int(found[-1][1])


def make_sample(options, folder):
    print(f"making a sample of {options.grains} grains", flush=True)
    launcher = [str(ROOT / "scripts" / "mpirun"), str(options.ranks)] if options.ranks > 1 else []
    subprocess.run(launcher + [options.suffuse, "-in", str(SCENE), "-var", "grains", str(options.grains), "-var", "stiffness_scale", "0.01"],
                   cwd=folder, check=True, stdout=subprocess.DEVNULL)
    return folder / "isotropic.restart"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--suffuse", default=str(ROOT / "build" / "release" / "bin" / "suffuse"))
    parser.add_argument("--liggghts", default="liggghts")
    parser.add_argument("--sample", help="restart file of a sample at 200 kPa with E = 0.7 GPa")
    parser.add_argument("--grains", type=int, default=20000)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--limit", type=float, default=1.02)
    parser.add_argument("--csv", help="file to write the table to")
    options = parser.parse_args()
    options.suffuse = str(pathlib.Path(options.suffuse).resolve())

    with tempfile.TemporaryDirectory(prefix="suffuse-") as name:
        folder = pathlib.Path(name)
        sample = pathlib.Path(options.sample).resolve() if options.sample else make_sample(options, folder)
        times = {variant: [] for variant in (*VARIANTS, "stock")}
        grains = 0
        for _ in range(options.repeats):
            for variant in times:
                text = SCRIPT.format(sample=sample, extra=VARIANTS.get(variant, ""), warm_up=200, steps=options.steps)
                program = options.liggghts if variant == "stock" else options.suffuse
                seconds, grains = loop_time(program, text, folder, options.ranks)
                times[variant].append(seconds)

    # A ratio of neighbours in time: other work on the machine slows both alike.
    rows = []
    for variant, seconds in times.items():
        ratios = [own / plain for own, plain in zip(seconds, times["plain"])]
        rows.append((variant, statistics.median(ratios), min(seconds) / min(times["plain"]), grains * options.steps / min(seconds)))
    ratio = {variant: min(median, least) for variant, median, least, _ in rows}
    every_thousand = 1 + (ratio["sampled"] - 1) * 100 / 1000
    lines = ["variant,median_of_ratios_to_plain,ratio_of_minima,grain_steps_per_s"]
    lines += [f"{variant},{median:.4f},{least:.4f},{speed:.4g}" for variant, median, least, speed in rows]
    print(f"{grains} grains, {options.ranks} ranks, {options.steps} steps, {options.repeats} repeats")
    print("\n".join(lines))
    print(f"every compute every 1,000 steps: {every_thousand:.4f} of plain (a sample costs {100 * (ratio['sampled'] - 1):.1f} steps)")
    if options.csv:
        pathlib.Path(options.csv).write_text("\n".join(lines) + "\n")
    if max(ratio["defined"], every_thousand) > options.limit:
        sys.exit(f"slower than {options.limit} of plain")


if __name__ == "__main__":
    main()
