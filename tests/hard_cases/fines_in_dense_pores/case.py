"""Fines of two to five cells that fill the pores of a dense gap-graded soil, free to move

Physics: scene 09 with 200 grains of A(20 %), porosity 0.22 to 0.3 by layers, under 100 Pa: in water at rest nothing moves; then the gradient
rises to four in a hundredth of a second, and fines are lifted.
Went wrong: with coefficients of up to 240 in cells between coarse grains a fine one takes more momentum from its cells in a step than it weighs,
and gains speed without bound within a few milliseconds, in water at rest, at two to five cells a fine. Grains of
1,200 kg/m3 do it with coefficients of 60, so that they are cut by what a grain weighs (largest_coefficient).
Criterion: the run is not stopped at rest, and from there on water and grains are slower than 0.06 of the lattice's sound, some times what flows
in the pores (fines that the opened platen lets go start with 0.04).
"""
import pathlib

SCENE = pathlib.Path(__file__).resolve().parents[3] / "input_scripts" / "09_suffusion" / "in.suffusion"


def mach(bench, grading, cells, density):
    """The largest from the rest on."""
    bench.must_run_scene(SCENE, {"grading": grading, "grains": 200, "cells_per_fine": cells, "grain_density": density, "rest_time": 0.01, "ramp_time": 0.01, "sample_time": 1e-3})
    return max(bench.series()["largest_mach"])


def run(bench, preset, full):
    variants = [("A20", cells, 2650) for cells in (2, 3)]
    if full:
        variants += [("A20", 4, 2650), ("A20", 5, 2650), *(("A30", cells, 2650) for cells in (2, 3, 4, 5)), ("B10", 2, 2650), ("B10", 3, 2650)]
        variants += [("A20", 5, 1200), ("A20", 3, 1500), ("A20", 5, 1500), ("A20", 3, 4000)]
    reached = []
    for grading, cells, density in variants:
        fastest = mach(bench, grading, cells, density)
        bench.expect(fastest < 0.06, f"{grading}, {cells} cells, {density} kg/m3: Mach {fastest}")
        reached.append(f"{grading}, {cells} cells a fine, {density} kg/m3: Mach {fastest:.3f}")
    return "; ".join(reached)
