"""Fines of two to five cells that fill the pores of a dense gap-graded soil, free to move

Physics: scene 09 with 200 grains of A(20 %), porosity 0.22 to 0.3 by layers, under 100 Pa: in water at rest nothing moves; then the gradient
rises to four in a hundredth of a second, and fines are lifted.
Went wrong: with coefficients of up to 240 in cells between coarse grains a fine one takes more momentum from its cells in a step than it weighs,
and gains speed without bound within a few milliseconds, in water at rest, at two to five cells a fine, even where
only spheres beyond four cells had them.
Criterion: the run is not stopped at rest, and from there on water and grains are slower than 0.06 of the lattice's sound, some times what flows
in the pores (fines that the opened platen lets go start with 0.04).
"""
import pathlib

SCENE = pathlib.Path(__file__).resolve().parents[3] / "input_scripts" / "09_suffusion" / "in.suffusion"


def mach(bench, cells, grading):
    """The largest from the rest on."""
    bench.must_run_scene(SCENE, {"grading": grading, "grains": 200, "cells_per_fine": cells, "rest_time": 0.01, "ramp_time": 0.01, "sample_time": 1e-3})
    return max(bench.series()["largest_mach"])


def run(bench, preset, full):
    reached = []
    for grading in ("A20", "A30", "B10") if full else ("A20",):
        for cells in (2, 3, 4, 5) if full and grading != "B10" else (2, 3):
            fastest = mach(bench, cells, grading)
            bench.expect(fastest < 0.06, f"{grading}, {cells} cells: Mach {fastest}")
            reached.append(f"{grading}, {cells} cells a fine: Mach {fastest:.3f}")
    return "; ".join(reached)
