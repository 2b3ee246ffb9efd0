#!/usr/bin/env python3
"""suffusion_scene_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

Scene 09 on a few grains: water washes the fines out through the upper platen and leaves the coarse grains, nothing is lost by class, the
platen keeps its stress, the lower one feels what the water takes off; a run that is cut goes on; held, swinging and downward gradients.
"""
import csv
import math
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
from scenes import columns, expect, program_from_command_line, scratch  # noqa: E402

SCENE = ROOT / "input_scripts" / "09_suffusion" / "in.suffusion"
# Wide enough that no two grains touch on both sides, through the periodic faces.
GRADING = "diameter_m,mass_fraction\n8e-5,0.07\n9e-5,0.05\n4e-4,0.46\n4.2e-4,0.42\n"
SMALLEST = 8e-5
TINY = {"grains": 200, "aspect": 0.5, "rest_time": 0.02, "largest_gradient": 12, "ramp_time": 0.1, "output_time": 0.05, "dump_time": 0.05, "layers": 2}
STRESS, DENSITY = 100, 2650


def masses(path):
    """Of a dump: fines below and above the middle of their sizes, coarse grains, kg."""
    sums = [0, 0, 0]
    split = float(next(line for line in (path.parent / "sample.inc").read_text().splitlines() if line.startswith("variable split ")).split()[-1])
    middle = math.sqrt(0.55 * SMALLEST * split)
    for line in path.read_text().splitlines()[9:]:
        diameter = 2 * float(line.split()[5])
        sums[(diameter >= middle) + (diameter >= split)] += DENSITY * math.pi / 6 * diameter ** 3
    return sums


def result(folder, name):
    with open(folder / "suffusion_result.csv") as file:
        return next(float(row["value"]) for row in csv.DictReader(file) if row["quantity"] == name)


def check_kept(folder, name):
    # 2e-6: digits of the report.
    expect(abs(result(folder, "mass_balance") - 1) < 1e-9, f"{name}: mass balance {result(folder, 'mass_balance')}")
    flow, before, after = columns(folder / "flow.csv"), masses(folder / "at_rest.grains.dump"), masses(folder / "left.grains.dump")
    for k, name_of_class in enumerate(("finer_fines", "larger_fines", "coarse")):
        out = result(folder, f"eroded_{name_of_class}_kg")
        expect(abs(after[k] + out - before[k]) < 2e-6 * sum(before), f"{name}, {name_of_class}: {before[k]} kg became {after[k]} and {out}")
        expect(k < 2 or out == 0, f"{name}: coarse grains have left")
    return flow


def check_balance(folder, flow):
    """What the lower platen loses in a gradient that is held, before grains leave, is the drop of head: 2 % for what still moves."""
    thickness = float((folder / "layers.inc").read_text().split()[-1]) - 6 * SMALLEST / 2
    drop, lost = 9810 * (flow["applied_gradient"][-1] - flow["applied_gradient"][0]) * thickness, flow["base_stress_pa"][0] - flow["base_stress_pa"][-1]
    expect(abs(flow["applied_gradient"][-1] - 0.5) < 1e-6 and abs(lost / drop - 1) < 0.02, f"gradient {flow['applied_gradient'][-1]}: the lower platen loses {lost} Pa of {drop}")


def main():
    program = program_from_command_line(__doc__)
    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        (folder / "tiny.csv").write_text(GRADING)
        TINY["grading"] = folder / "tiny.csv"
        program.run_scene(SCENE, folder, {**TINY, "save_every": 0.04})
        flow = check_kept(folder, "ramp")
        expect(flow["eroded_fines_share"][-1] > 0.3, f"only {flow['eroded_fines_share'][-1]} of the fines have left")
        # Within 1 %, but for the instants at which the few coarse grains shift.
        off = sorted(abs(value / STRESS - 1) for value in flow["platen_stress_pa"])
        expect(off[int(0.9 * len(off))] < 0.01 and off[-1] < 0.1, f"the platen's stress is off by {off[-5:]}")
        sets = sorted((folder / name for name in ("water.h5.1", "water.h5.2")), key=lambda part: (part / "fluid.h5").stat().st_mtime_ns)
        program.run_scene(SCENE, folder, {**TINY, "begin": "continued", "restart": sets[0].name})
        continued = check_kept(folder, "continued")
        # What follows the water's time is the same; which grains leave when is chaotic.
        for name, tolerance in (("time_s", 1e-12), ("applied_gradient", 1e-9), ("eroded_fines_share", 0.2)):
            difference = max(abs(a - b) for a, b in zip(flow[name], continued[name]))
            expect(len(flow[name]) == len(continued[name]) and difference < tolerance, f"{name} differs by {difference}")
        short = {**TINY, "begin": "restart", "restart": folder / "consolidated.restart", "rest_time": 0.005}
        for name, drive in (("stages", {"drive": "stages", "largest_gradient": 0.5, "stage_ramp": 1e-3, "stage_hold": 4e-3}),
                            ("cyclic", {"drive": "cyclic", "cyclic_frequency": 100, "cyclic_cycles": 1.5, "cyclic_mean": 2, "cyclic_amplitude": 1}),
                            ("down", {"flow": "down", "ramp_time": 0.02})):
            (folder / name).mkdir()
            program.run_scene(SCENE, folder / name, {**short, **drive})
            part = check_kept(folder / name, name)
            if name == "cyclic":
                expect(abs(max(part["applied_gradient"]) - 3) < 0.1 and min(part["applied_gradient"][3:]) < 1.1, f"cyclic: {part['applied_gradient']}")
            if name == "stages":
                check_balance(folder / name, part)
            if name == "down":
                expect(part["superficial_velocity_z_m_per_s"][-1] < 0 and part["base_stress_pa"][-1] > part["base_stress_pa"][0] + 20, "flow down")
        # Between walls, a new sample.
        (folder / "walls").mkdir()
        program.run_scene(SCENE, folder / "walls", {**TINY, "sides": "f", "rest_time": 0.005, "ramp_time": 0.01})
        check_kept(folder / "walls", "walls")
        print(f"{program.ranks} ranks: {flow['eroded_fines_share'][-1]:.2f} of the fines washed out, none lost")


if __name__ == "__main__":
    main()
