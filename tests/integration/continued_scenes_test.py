#!/usr/bin/env python3
"""continued_scenes_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

Scenes with water that are cut and go on from a saved state with other DEM steps: what follows the water's time is the
same at every time, and so is the motion but for its own step.
"""
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
from scenes import columns, expect, program_from_command_line, scratch  # noqa: E402

SCENES = ROOT / "input_scripts"

# A column of 60 grains, 20 x 20 x 40 cells.
COLUMN = {"scale": "quick", "width": 1.4e-3, "height": 2.8e-3, "bed": 1e-3, "layers": 2, "grains": 85, "settle_time": 0.03,
          "rest_time": 0.01, "ramp_time": 0.08, "stage_hold": 0.01, "stage_window": 2e-3, "stage_ramp": 5e-3,
          "output_time": 0.02, "dump_time": 0.02, "save_every": 0.02}


def largest_difference(one, two, name):
    return max(abs(a - b) for a, b in zip(one[name], two[name]))


def check_settling_sphere(program):
    """One DEM step a fluid step, then three: velocity-Verlet under the load, which is constant over the fluid's step, gives the
    same motion; under the virtual drag, which is not, another by what the steps' integration differs (a thousandth here)."""
    scene = SCENES / "05_settling_sphere" / "in.settling_sphere"
    case = {"case": "E4", "resolution": 3}
    with scratch() as folder:
        path = pathlib.Path(folder)
        program.run_scene(scene, folder, {**case, "save_every": 0.2})
        whole = columns(path / "settling.csv")
        program.run_scene(scene, folder, {**case, "begin": "continued", "restart": "sphere.h5.1", "substeps": 3})
        cut = columns(path / "settling.csv")
    expect(whole["time_s"] == cut["time_s"], "samples at other times")
    difference = largest_difference(whole, cut, "speed_m_per_s")
    expect(difference < 2e-4, f"the sphere's speed differs by {difference} m/s of 0.1")


def levels_of(gradient):
    """At which it stays for three samples."""
    return sorted({b for a, b, c in zip(gradient, gradient[1:], gradient[2:]) if a == b == c})


def check_column(program, drive):
    scene = SCENES / "03_fluidisation" / "in.fluidisation"
    with scratch() as folder:
        path = pathlib.Path(folder)
        program.run_scene(scene, folder, {**COLUMN, "drive": drive})
        whole = columns(path / "flow.csv")
        # The state before the last: of some time before the end.
        sets = sorted((path / name for name in ("water.h5.1", "water.h5.2")), key=lambda part: (part / "fluid.h5").stat().st_mtime_ns)
        program.run_scene(scene, folder, {**COLUMN, "drive": drive, "begin": "continued", "restart": sets[0].name,
                                          "timestep_share": 0.1})
        cut = columns(path / "flow.csv")
    both = min(len(whole["time_s"]), len(cut["time_s"]))
    expect(abs(len(whole["time_s"]) - len(cut["time_s"])) <= 5 and whole["time_s"][:both] == cut["time_s"][:both],
           "samples at other times")
    steps = max(abs(b - a) for a, b in zip(whole["dem_step"], cut["dem_step"]))
    expect(steps > 1000, f"the DEM's step was to differ; steps differ by {steps}")
    head, allowed = largest_difference(whole, cut, "applied_gradient"), 1e-12
    if drive == "stages":
        # A stage ends once the flow is steady. While the bed is about to lift that may be some looks earlier or later, with another step of the
        # DEM; the levels are the same, and the two are never further apart than one of them.
        levels, others = (levels_of(series["applied_gradient"]) for series in (whole, cut))
        expect(len(levels) > 3 and all(abs(a - b) < 1e-9 for a, b in zip(levels, others)) and abs(len(levels) - len(others)) <= 1, f"stages at {levels} and {others}")
        allowed = 1.01 * max(b - a for a, b in zip(levels, levels[1:]))
    expect(head < allowed, f"{drive}: the applied gradient differs by {head}, allowed {allowed}")
    for name, allowed in (("hydraulic_gradient_layer_1", 0.01), ("effective_stress_ratio_2", 0.01), ("void_ratio_layer_1", 1e-3),
                          ("broken_contacts", 0.03)):
        if drive == "ramp":
            difference = largest_difference(whole, cut, name)
            expect(difference < allowed, f"{name} differs by {difference}")
    return head


def main():
    program = program_from_command_line(__doc__)
    check_settling_sphere(program)
    heads = [check_column(program, drive) for drive in ("ramp", "stages")]
    print(f"{program.ranks} ranks: cut scenes go on; applied gradients differ by {heads}")


if __name__ == "__main__":
    main()
