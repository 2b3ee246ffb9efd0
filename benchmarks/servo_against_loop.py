#!/usr/bin/env python3
"""servo_against_loop.py --suffuse PROGRAM [--grains 300] [--stiffness_scale 0.001] [--work DIR]

Compresses the same grains of Appendix A to 200 kPa twice: by the thesis's fixed-rate loop (in.appendix_loop) and by
`fix stress/servo` (in.isotropic_compression), at the same contact stiffness. Prints the steps to the target, their
ratio, the wall time, and the states that were reached.
"""
import argparse
import csv
import pathlib
import subprocess
import sys
import tempfile
import time

SCENE = pathlib.Path(__file__).resolve().parents[1] / "input_scripts" / "01_isotropic_compression"
COMPARED = ("coordination_number", "alpha_pair_halves", "mean_stress", "volume")


def compress(options, script, result, folder):
    start = time.time()
    done = subprocess.run([options.suffuse, "-in", str(SCENE / script), "-var", "grains", str(options.grains),
                           "-var", "stiffness_scale", str(options.stiffness_scale), "-var", "equilibrium_steps", "40000",
                           "-log", f"log.{result}"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        sys.exit(f"{script} ended with code {done.returncode}:\n{done.stdout.decode(errors='replace')[-2000:]}")
    with open(pathlib.Path(folder) / result) as file:
        values = {row["quantity"]: float(row["value"]) for row in csv.DictReader(file)}
    return values, time.time() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--suffuse", default="build/release/bin/suffuse")
    parser.add_argument("--grains", type=int, default=300)
    parser.add_argument("--stiffness_scale", type=float, default=0.001)
    options = parser.parse_args()
    options.suffuse = str(pathlib.Path(options.suffuse).resolve())
    with tempfile.TemporaryDirectory(prefix="suffuse-") as folder:
        servo, servo_time = compress(options, "in.isotropic_compression", "isotropic.csv", folder)
        loop, loop_time = compress(options, "in.appendix_loop", "isotropic_loop.csv", folder)
    print(f"{options.grains} grains, Young's modulus {70e9 * options.stiffness_scale:g} Pa")
    print(f"{'':24}{'loop':>14}{'servo':>14}{'servo/loop':>12}")
    for name in ("steps_to_target",) + COMPARED:
        print(f"{name:24}{loop[name]:14.6g}{servo[name]:14.6g}{servo[name] / loop[name]:12.4f}")
    print(f"{'wall time (s)':24}{loop_time:14.1f}{servo_time:14.1f}{servo_time / loop_time:12.4f}")
    if servo["steps_to_target"] > 0.5 * loop["steps_to_target"]:
        sys.exit("the servo needed more than half of the loop's steps")


if __name__ == "__main__":
    main()
