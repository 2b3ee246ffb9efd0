#!/usr/bin/env python3
"""lbm_bad_input_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

What a person may write wrongly for the water: each gives one line that names the culprit and the remedy, and exit
code 1 on every rank.
"""
import sys
import pathlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import expect, mistakes_not_named, program_from_command_line, scratch  # noqa: E402
from wet_scenes import WATER, wet_box  # noqa: E402

FEW = wet_box(grains=4)
WET = FEW + WATER
RUN = "lbm run 1e-3\n"

# (script, words that the message must hold)
CASES = [
    (FEW + "lbm\n", ["lbm", "word = nothing", "be one of"]),
    (FEW + "lbm flow 1\n", ["word = flow", "be one of"]),
    (FEW + RUN, ["lbm run", "lattice = none", "lbm lattice"]),
    (FEW + "lbm plan 1\n", ["lbm plan", "lattice = none"]),
    (FEW + "lbm lattice spacing 1.25e-4 relaxation_time 0.49\n", ["relaxation_time = 0.49", "raise viscosity"]),
    (FEW + "lbm lattice spacing -1 relaxation_time 0.6\n", ["spacing = -1", "> 0"]),
    (FEW + "lbm lattice relaxation_time 0.6\n", ["spacing"]),
    (FEW + "lbm lattice spacing 1.25e-4 relaxation_time 0.6 precision half\n", ["precision = half", "double, float"]),
    (FEW + "lbm fluid density 0\n", ["density = 0", "> 0"]),
    (FEW + "lbm fluid density 1000 temperature 20\n", ["keyword = temperature", "density, viscosity"]),
    (FEW + WATER.replace("1.25e-4", "1.3e-4").replace("0.000125", "1.3e-4") + RUN, ["spacing", "whole number of cells"]),
    (WET + "lbm boundary xlo noslip\n" + RUN, ["xlo", "periodic"]),
    (WET + "lbm boundary zlo periodic zhi periodic\n" + RUN, ["zlo", "LIGGGHTS"]),
    (WET + "lbm boundary zlo pressure\n", ["pressure", "be given"]),
    (WET + "lbm boundary zlo pressure v_nothing\n", ["v_nothing", "no such variable"]),
    (WET + "lbm boundary zlo leaky\n", ["zlo = leaky", "noslip"]),
    (WET + "lbm boundary zlo noslip zlo freeslip\n", ["zlo = given twice"]),
    (WET + "lbm boundary top noslip\n", ["face = top", "zhi"]),
    (WET + "lbm force\n", ["gravity, pressure_gradient"]),
    (WET + "lbm force gravity 0 0\n", ["gravity z", "be given"]),
    (WET + "lbm collision les\n", ["operator = les", "trt"]),
    (WET + "lbm collision trt magic 0\n", ["magic = 0"]),
    (WET + "lbm solid operator sc4\n", ["operator = sc4", "sc3"]),
    (WET + "lbm solid weighting fraction coefficient 2\n", ["coefficient = given", "viscosity_independent"]),
    (WET + "lbm solid fraction subcells 100\n", ["subcells = 100", "at most 32"]),
    (WET + "lbm effect wind on\n", ["keyword = wind", "turbulence"]),
    (WET + "lbm effect lubrication maybe\n", ["lubrication = maybe", "on, off, auto"]),
    (WET + "lbm couple substeps 1\n" + RUN, ["substeps = 1", "substeps auto"]),
    (WET + "lbm couple substeps 0\n", ["substeps = 0", "whole number"]),
    (WET + "lbm couple virtual_mass -1\n", ["virtual_mass = -1", "0 to 100"]),
    (WET + "lbm monitor m every 1e-3 file m.csv\n", ["monitor m", "quantities"]),
    (WET + "lbm monitor m every 0 file m.csv bed\n", ["every = 0", "> 0"]),
    (WET + "lbm monitor m every 1e-3 file m.csv vorticity\n", ["vorticity", "superficial_velocity"]),
    (WET + "lbm monitor m every 1e-3 file m.csv layer_gradient\n", ["layer_gradient", "layers LO HI N"]),
    (WET + "lbm monitor m every 1e-3 file m.csv bed\nlbm monitor m every 1e-3 file n.csv bed\n", ["monitor m = given twice"]),
    (WET + "lbm monitor m every 1e-3 file m.csv c_nothing[1]\n" + RUN, ["c_nothing[1]", "exists"]),
    (WET + "lbm monitor m every 1e-3 file m.csv mean_force nobody\n" + RUN, ["nobody", "group"]),
    (WET + "lbm monitor m every 1e-3 file nowhere/m.csv bed\n" + RUN, ["nowhere/m.csv", "writable"]),
    (WET + "lbm output o every 1e-3 file o.h5 colour\n", ["colour", "velocity"]),
    (WET + "lbm output o every 1e-3\n", ["output o", "every and file"]),
    (WET + "lbm run\n", ["time", "be given"]),
    (WET + "lbm run -1\n", ["time = -1", "> 0"]),
    (WET + "lbm run 1e-3 until dry\n", ["keyword = dry", "steady"]),
    (WET + RUN + "lbm lattice spacing 1e-4 relaxation_time 0.6\n", ["lbm lattice", "before the first lbm run"]),
    (WET + "lbm restart write w.h5\n", ["fluid = none", "after `lbm run`"]),
    (WET + "lbm restart read nowhere.h5\n" + RUN, ["nowhere.h5"]),
    (WET + "fix bu all buoyancy level 5e-3 dim z density 1000\n" + RUN, ["bu", "displaced fluid"]),
    (WET + "fix d all deform 1 z scale 0.9 remap x\n" + RUN, ["box", "keep its size"]),
    (wet_box(grains=4, boundary="p p m").replace("run 1\n", "run 1\n") + WATER + RUN, ["boundary = shrink-wrapped"]),
    (WET + "create_atoms 1 single 1.0e-3 1.0e-3 2.5e-3\ncreate_atoms 1 single 1.01e-3 1.0e-3 2.5e-3\n"
     "set type 1 diameter 1e-3 density 2650\n" + RUN, ["grains = overlapping", "settle or separate"]),
    (WET + "fix h all hydrodynamic/force\nfix h2 all hydrodynamic/force\n" + RUN, ["hydrodynamic/force"]),
    (WET + "lbm boundary zlo velocity 0 0 v_fast zhi pressure 0\nvariable fast equal 100\n", ["v_fast", "no such variable"]),
    (WET + "variable fast equal 100*step\nlbm boundary zlo velocity 0 0 v_fast zhi pressure 0\nlbm run 1\n",
     ["velocity", "speed of sound"]),
    (WET + "shell touch empty.h5\nlbm restart read empty.h5\n" + RUN, ["empty.h5", "readable HDF5 file"]),
    (WET + "lbm output o every 1 file o.h5 density\n" + RUN + "lbm clear\n" + WATER + "lbm restart read o.h5\n" + RUN,
     ["o.h5", "hold a saved state"]),
    (FEW + WATER.replace("0.000125", "1e-9") + RUN, ["spacing = 1e-09", "cells along an axis"]),
    (wet_box(grains=0, boundary="f f f") + "region out block 1 2 1 2 1 2 units box\n" +
     WATER.replace("0.515", "0.515 region out") + RUN, ["size along x", "lie in the box"]),
    (WET + "lbm monitor m every 1e-3 file m.csv layers 1 2 3 layer_porosity\n" + RUN, ["layers = 1 2", "lie in the fluid"]),
    (WET + "lbm monitor m every 1e-3 file m.csv layers 0 4e-3 100 layer_porosity\n" + RUN, ["layers = 100", "at least a cell"]),
    (WET + "variable zero equal 0\nlbm monitor m every 1e-3 file m.csv relative v_zero\n" + RUN, ["relative v_zero", "first sample"]),
    (WET + "variable one equal 1\nlbm monitor m every 1e-3 file m.csv v_one as a,b\n", ["as = a,b", "comma"]),
    (WET + RUN + "unfix hydrodynamic_force\n" + RUN, ["hydrodynamic/force", "gone", "lbm clear"]),
    (WET + "lbm monitor m every 1e-3 file m.csv bed\nlbm monitor n every 1e-3 file ./m.csv mass\n", ["m.csv", "lbm monitor m"]),
    (WET + "lbm output o every 1e-3 file o.h5 grains\nlbm output p every 1e-3 file o_grains.h5\n", ["o_grains.h5", "lbm output o"]),
    (WET + "lbm output o every 1e-3 file o.h5\nlbm restart write o.h5 every 1e-3\n", ["o.h5", "lbm output o"]),
    (WET + "lbm output o every 1e-3 file o.h5 contact\n", ["contact", "grains, contacts"]),
    (WET + "lbm output o every 1e-3 file o.xdmf\n", ["o.xdmf", "be the HDF5 file"]),
    (WET + "lbm output o every 1e-3 file o.h5 velocity velocity\n", ["velocity = given twice"]),
    (WET + "lbm output o every 1e-3 file nowhere/o.h5\n" + RUN, ["nowhere/o.h5", "writable"]),
    (WET + "lbm restart write nowhere/r.h5 every 1e-3\n" + RUN, ["nowhere/r.h5", "writable"]),
    (WET + "lbm run 1e300\n", ["time = 1e+300 s", "DEM steps"]),
    (WET + "lbm couple substeps 5000000000\n", ["substeps = 5000000000", "at most"]),
    (WET + "timestep 1e-15\n" + RUN, ["timestep = 1e-15 s", "millionth"]),
    (WET + "timestep 0\n" + RUN, ["timestep = 0 s", "> 0"]),
    (WET.replace("units si", "units cgs") + RUN, ["units = cgs", "units si"]),
    (WET + "lbm collision bgk magic 0.2\n", ["magic", "trt"]),
    (FEW + "lbm fluid density 1000 density 2000\n", ["density = given twice"]),
    (FEW + "lbm lattice spacing 1e-4 spacing 2e-4 relaxation_time 0.6\n", ["spacing = given twice"]),
    (WET + "lbm force gravity 0 0 -9.81 gravity 0 0 -1\n", ["gravity = given twice"]),
    (WET + "lbm solid operator sc1 operator sc2\n", ["operator = given twice"]),
    (WET + "lbm effect lubrication on lubrication off\n", ["lubrication = given twice"]),
    (WET + "lbm couple substeps auto substeps 5\n", ["substeps = given twice"]),
    (WET + "lbm monitor m every 1e-3 every 1e-4 file m.csv bed\n", ["every = given twice"]),
    (WET + "lbm monitor m every 1e-3 file m.csv bed mass bed\n" + RUN, ["column = bed_height_m twice"]),
    (WET + "lbm output o every 1e-3 file o.h5 file p.h5\n", ["file = given twice"]),
    (WET + "lbm output o every 1e-3 file o.h5 grains grains\n", ["grains = given twice"]),
    (WET + f"lbm monitor m every 1e-3 file {'x' * 300} bed\n" + RUN, ["lbm monitor m", "writable", "name too long"]),
    (WET + "shell ln -sf loop loop\nlbm monitor m every 1e-3 file loop bed\n" + RUN, ["lbm monitor m", "writable", "symbolic links"]),
    (WET + f"lbm output o every 1e-3 file {'x' * 300}.h5\n" + RUN, ["lbm output o", "writable", "name too long"]),
    (WET + "shell ln -sf loop loop\nlbm output o every 1e-3 file loop\n" + RUN, ["lbm output o", "writable", "symbolic links"]),
    (WET + "lbm output o every 1e-3 file .\n" + RUN, ["lbm output o", "writable", "directory"]),
    (WET + f"lbm restart write {'x' * 300} every 1e-3\n" + RUN, ["lbm restart write", "name too long"]),
    (WET + "shell ln -sf loop loop\nlbm restart write loop every 1e-3\n" + RUN, ["lbm restart write", "name that is free"]),
    (WET + "shell mkdir -p kept.1\nshell touch kept.1/results.csv\nlbm restart write kept every 1e-3\n" + RUN, ["lbm restart write", "kept.1 is free", "take another name"]),
    (WET + "shell mkdir -p lone.2\nshell touch lone.2/grains lone.2/set\nlbm restart write lone every 1e-3\n" + RUN, ["lbm restart write", "the link to the states", "ln -s lone.2 lone"]),
    (WET + RUN + "lbm couple average_force yes\n" + RUN, ["lbm couple", "average_force = changed", "lbm clear"]),
    (WET + RUN + "lbm couple virtual_mass 0\n" + RUN, ["lbm couple", "virtual_mass = changed", "lbm clear"]),
    (WET + RUN + "lbm restart write /dev/null\n", ["lbm restart write", "/dev/null"]),
    (WET + "lbm monitor m every 1e-3 file /dev/full bed\n" + RUN, ["lbm monitor m", "/dev/full", "disk full"]),
    (WET + "lbm restart read .\n" + RUN, ["lbm restart read", "whole"]),
    (WET + "lbm solid coefficient 1e-30\n", ["coefficient = 1e-30", "be 0.001 to 60"]),
    (WET + "lbm solid remap 1e300\n", ["remap = 1e+300", "at most 0.1"]),
    (WET + "lbm couple virtual_mass 1e300\n", ["virtual_mass = 1e+300", "0 to 100"]),
    (WET + "lbm couple max_mach 1e300\n", ["max_mach = 1e+300", "at most 1"]),
    (WET + "lbm collision trt magic 1e300\n" + RUN, ["magic = 1e+300", "be 1e-4 to 100"]),
    (WET + "lbm force gravity 0 0 1e300\n" + RUN, ["gravity = 0 0 1e+300", "cells a step"]),
    (WET + "lbm force pressure_gradient 1e20 0 0\n" + RUN, ["pressure_gradient = 1e+20 0 0", "cells a step"]),
    (WET + "lbm run 1e-3 until steady 1e300\n", ["until steady = 1e+300", "below 1"]),
    (WET + "lbm run 1e-3 until steady 0.1 window 1e-3\n", ["window = 0.001 s", "be shorter than the run, 0.001 s"]),
    (WET + "lbm run until nan\n", ["time = nan", "be a number"]),
    (WET + "lbm run until -1\n", ["time = -1", "> 0"]),
    (WET + "lbm run until\n", ["time", "be given"]),
]


def culprit(script):
    """The line that is wrong: the last one but RUN."""
    lines = script.strip().splitlines()
    return lines[-2] if script.endswith(RUN) else lines[-1]


def main():
    program = program_from_command_line(__doc__)
    cases = CASES if program.ranks == 1 else CASES[::2]  # starting several ranks takes a second
    with scratch() as folder:
        failures = mistakes_not_named(program, cases, folder, culprit)
    expect(not failures, "\n".join(failures))
    print(f"{program.ranks} ranks: {len(cases)} mistakes, each named in one line")


if __name__ == "__main__":
    main()
