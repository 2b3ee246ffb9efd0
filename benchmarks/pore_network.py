"""A pore network beside the lattice: the packings of price_of_methods by YADE's PeriodicFlowEngine (pore-scale finite volumes on the
triangulation of the grains, `chareyre2012`), one Stokes solve each, as rows of price_of_methods.csv.

    price_of_methods --grains grains.csv > price_of_methods.csv
    yade -n -x benchmarks/pore_network.py grains.csv >> price_of_methods.csv

Needs Debian's package `yade` (2023.02a), which nothing else of this project does. Conductances of throats are as shipped
(permeabilityFactor 1); core seconds are processor time of the step that triangulates and solves.
"""
import csv
import math
import sys
import time

import numpy
from yade import Bo1_Sphere_Aabb, ForceResetter, InsertionSortCollider, Matrix3, O, PeriodicFlowEngine, Vector3, utils


def solve(grains):
    """Superficial velocity in a box of edge 1 at unit viscosity and gradient along x; the grains' forces over their sum; seconds."""
    O.reset()
    O.periodic = True
    O.cell.hSize = Matrix3(1, 0, 0, 0, 1, 0, 0, 0, 1)
    O.materials.append(utils.FrictMat())
    ids = [O.bodies.append(utils.sphere([float(g[axis]) for axis in "xyz"], float(g["radius"]), fixed=True)) for g in grains]
    # Images of grains as far as two diameters of the largest.
    flow = PeriodicFlowEngine(useSolver=3, permeabilityFactor=1, viscosity=1, gradP=Vector3(1, 0, 0),
                              duplicateThreshold=4 * max(float(g["radius"]) for g in grains), wallIds=[-1] * 6,
                              bndCondIsPressure=[0] * 6, multithread=False)
    O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()], allowBiggerThanPeriod=True, verletDist=0), flow]
    O.dt = 1e-9
    start = time.process_time()
    O.step()
    seconds = time.process_time() - start
    velocity = flow.averageVelocity()
    forces = numpy.array([flow.fluidForce(i)[0] for i in ids])
    return abs(velocity[0]), forces / forces.sum(), seconds


def main():
    with open(sys.argv[1], newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for packing in dict.fromkeys(row["packing"] for row in rows):
        grains = [row for row in rows if row["packing"] == packing]
        radii = numpy.array([float(g["radius"]) for g in grains])
        finest = numpy.array([float(g["force_share"]) for g in grains])
        velocity, forces, seconds = solve(grains)
        solid = 4 / 3 * math.pi * (radii ** 3).sum()
        sauter = 2 * (radii ** 3).sum() / (radii ** 2).sum()
        drag = sauter ** 2 / (18 * solid * velocity)
        ratios = numpy.sort(forces / finest)
        tenth, median, ninetieth = (ratios[int(share * (len(ratios) - 1) + 0.5)] for share in (0.1, 0.5, 0.9))
        print(f"{packing},pore_network_yade,{drag:.4f},{100 * (float(grains[0]['drag_K']) / drag - 1):.2f},"
              f"{100 * math.sqrt(((ratios - 1) ** 2).mean()):.2f},{tenth:.3f},{median:.3f},{ninetieth:.3f},{seconds:.5f}", flush=True)


main()
