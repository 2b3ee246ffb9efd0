#!/usr/bin/env python3
"""bad_input_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

What a person may write wrongly for the servo and the commands: each gives one line that names the culprit and the
remedy, and exit code 1 on every rank.
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import HEADER, MATERIAL, expect, loose_sample, mistakes_not_named, program_from_command_line, scratch  # noqa: E402

SAMPLE = loose_sample(grains=30)
OPEN_SAMPLE = loose_sample(grains=30, boundary="f f f")
SERVO = "fix s all stress/servo "
CGS = SAMPLE.replace("units si", "units cgs")
FLAT = HEADER.format(boundary="f f p") + "dimension 2\nregion box block 0 4e-3 0 4e-3 -1e-4 1e-4 units box\ncreate_box 1 box\n" + \
    MATERIAL.format(friction=0.3) + "create_atoms 1 single 1e-3 1e-3 0\nset type 1 diameter 1e-3 density 2650\ntimestep 1e-6\n"
# Numbers 1 and 2 are one grain's, 3 and 3 are two grains'.
DOUBLE = """grains

4 atoms
1 atom types
0 4e-3 xlo xhi
0 4e-3 ylo yhi
0 4e-3 zlo zhi

Atoms

1 1 5e-4 2650 1e-3 1e-3 1e-3
2 1 5e-4 2650 3e-3 1e-3 1e-3
3 1 5e-4 2650 1e-3 3e-3 1e-3
3 1 5e-4 2650 3e-3 3e-3 1e-3
"""
CLUMPS = HEADER.format(boundary="f f f") + "region box block 0 1e-2 0 1e-2 0 1e-2 units box\ncreate_box 1 box\n" + \
    MATERIAL.format(friction=0.3).replace("fix motion all nve/sphere\n", "") + \
    """fix c all particletemplate/multisphere 15485863 atom_type 1 density constant 2650 nspheres 2 ntry 100000 spheres file clump.txt scale 1.0 type 1
fix d all particledistribution/discrete 32452843 1 c 1.0
fix i all insert/pack seed 32452867 distributiontemplate d insert_every once overlapcheck yes particles_in_region 3 region box
fix m all multisphere
timestep 1e-6
"""

# (script after the sample, words that the message must hold)
CASES = [
    (SAMPLE + SERVO + "isotropic\n", ["fix stress/servo", "target mean stress", "be given"]),
    (SAMPLE + SERVO + "isotropic 0\n", ["target mean stress = 0", "must be > 0"]),
    (SAMPLE + SERVO + "isotropic -200e3\n", ["target mean stress = -200e3", "must be > 0"]),
    (SAMPLE + SERVO + "isotropic 200kPa\n", ["200kPa", "must be a number"]),
    (SAMPLE + SERVO + "hydrostatic 200e3\n", ["stress path = hydrostatic", "isotropic"]),
    (SAMPLE + SERVO + "isotropic 200e3 evry 50\n", ["keyword = evry", "every"]),
    (SAMPLE + SERVO + "isotropic 200e3 every 0\n", ["every = 0", "whole number"]),
    (SAMPLE + SERVO + "isotropic 200e3 until\n", ["stop condition", "be given"]),
    (SAMPLE + SERVO + "isotropic 200e3 until axial_strain 0.1\n", ["until = axial_strain", "shear path"]),
    (SAMPLE + SERVO + "constant_p 200e3 until static\n", ["until = static", "axial_strain"]),
    (SAMPLE + SERVO + "constant_p 200e3 until axial_strain 15\n", ["axial_strain = 15", "0.15"]),
    (SAMPLE + SERVO + "triaxial 100e3 axis w\n", ["axis = w", "x, y or z"]),
    (SAMPLE + SERVO + "cyclic 100e3 axis z rate 1\n", ["deviator = none", "two bounds"]),
    (SAMPLE + SERVO + "cyclic 100e3 deviator 40e3 -20e3\n", ["deviator = 40000 -20000", "lower < upper"]),
    (SAMPLE + SERVO + "isotropic 200e3 diameter median\n", ["diameter = median", "mass, number"]),
    (SAMPLE + SERVO + "isotropic 200e3 approach 2\n", ["approach = 2", "be <= 1"]),
    (SAMPLE + SERVO + "isotropic 200e3 tolerance 1e300\n", ["tolerance = 1e+300", "<= 1"]),
    (SAMPLE + SERVO + "isotropic 200e3 inertial_number 1e300\n", ["inertial_number = 1e+300", "<= 1"]),
    (SAMPLE + SERVO + "isotropic 200e3 unbalanced 1e300\n", ["unbalanced (off or a ratio) = 1e+300", "<= 1"]),
    (SAMPLE + "fix d all density/scaling size 1e300\nrun 1\n", ["reference diameter = 1e+300", "at most 1e+06"]),
    (SAMPLE + "fix d all density/scaling rayleigh 1e-300\nrun 1\n", ["share of the critical time = 1e-300", "at most 1e+06"]),
    (SAMPLE + SERVO + "isotropic 200e3 unbalanced 0\n", ["unbalanced (off or a ratio) = 0", "> 0"]),
    (OPEN_SAMPLE + SERVO + "isotropic 200e3\n", ["boundary", "be periodic"]),
    (SAMPLE + "group none empty\n".replace("empty", "type 2") + "fix s none stress/servo isotropic 200e3\n", ["group = none", "be all"]),
    (SAMPLE + SERVO + "isotropic 200e3\nfix t all stress/servo isotropic 200e3\nrun 10\n", ["servos = 2", "unfix"]),
    (SAMPLE + SERVO + "isotropic 200e3\nfix d all deform 1 x erate -1\nrun 10\n", ["fix = d", "deform"]),
    (SAMPLE.replace("units si", "units cgs") + SERVO + "isotropic 200e3\n", ["fix stress/servo", "units = cgs", "be si"]),
    (SAMPLE + "fix w all wall/gran model hertz tangential history primitive type 1 zplane 1e-3\n" + SERVO + "isotropic 200e3\nrun 10\n", ["fix = w", "unfix the wall"]),
    (SAMPLE + "delete_atoms group all\n" + SERVO + "isotropic 200e3\nrun 10\n", ["group = all", "contain grains"]),
    (SAMPLE.replace("coefficientFriction peratomtypepair 1 0.0", "coefficientFriction peratomtypepair 1 -0.3") + SERVO + "isotropic 200e3\nrun 1\n", ["coefficientFriction = -0.3", ">= 0"]),
    (SAMPLE + SERVO + "isotropic 200e3\nrun 0\n" + SERVO + "constant_volume\nrun 10 pre no\n", ["pre = no", "fix s is new", "drop `pre no`"]),
    (SAMPLE + "run 0\nfix p all density/scaling size 1e-3\nrun 10 pre no\n", ["pre = no", "fix p is new"]),
    (SAMPLE + "dem_timestep rayleigh 0.1\n", ["dem_timestep", "pressure = missing"]),
    (SAMPLE + "dem_timestep rayleigh 2 pressure 1e5\n", ["share = 2", "<= 1"]),
    (SAMPLE + "dem_timestep rayleigh -1 pressure 1e5\n", ["share of the Rayleigh time = -1", "> 0"]),
    (SAMPLE + "timestep 1e-3\ndem_timestep check pressure 1e5\n", ["time step = 0.001 s", "eq 3.3"]),
    (SAMPLE + "dem_timestep guess pressure 1e5\n", ["keyword = guess", "rayleigh, check"]),
    (SAMPLE + SERVO + "isotropic 200e3\nunfix suffuse_contacts\n", ["fix = suffuse_contacts", "stay"]),
    (SAMPLE + "report nowhere.csv A values p 1\n", ["file = nowhere.csv", "readable"]),
    (SAMPLE + "report wrong.csv A values p 1\n", ["wrong.csv", "header"]),
    (SAMPLE + "report wrong.csv A values p\n", ["report", "be given"]),
    (SAMPLE + "report right.csv A values p 1 p 2\n", ["report", "p = given twice"]),
    (SAMPLE + "report right.csv A write nowhere/r.csv values p 1\n", ["report write", "nowhere/r.csv", "writable"]),
    (SAMPLE + "report right.csv A write /dev/full values p 1\n", ["report write", "/dev/full", "regular file"]),
    (SAMPLE + SERVO + "isotropic 200e3 every 50 every 60\n", ["every = given twice"]),
    (SAMPLE + SERVO + "triaxial 100e3 compression extension\n", ["compression and extension", "one of them"]),
    (SAMPLE + SERVO + "triaxial 100e3 axis x axis y\n", ["axis = given twice"]),
    (SAMPLE + "compute Z all coordination split 1e-3 split 2e-3\n", ["compute coordination", "split = given twice"]),
    (SAMPLE + "fix l all lubrication viscosity 1e-3 viscosity 2e-3 outer 1e-5 inner 1e-7\n", ["viscosity = given twice"]),
    (SAMPLE + "fix d all density/scaling size 1e-3 every 5 every 6\n", ["every = given twice"]),
    (CGS + "compute Z all coordination\n", ["compute coordination", "units = cgs", "be si"]),
    (CGS + "compute s all slipping/index\n", ["compute slipping/index", "units = cgs"]),
    (CGS + "compute l all stress/layer z 3\n", ["compute stress/layer", "units = cgs"]),
    (CGS + "fix h all hydrodynamic/force\n", ["fix hydrodynamic/force", "units = cgs"]),
    (CGS + "fix l all lubrication viscosity 1e-3 outer 1e-5 inner 1e-7\n", ["fix lubrication", "units = cgs"]),
    (CGS + "fix d all density/scaling size 1e-3\n", ["fix density/scaling", "units = cgs"]),
    (CGS + "dem_timestep rayleigh 0.1 pressure 1e5\n", ["dem_timestep", "units = cgs"]),
    (FLAT + "compute Z all coordination\n", ["compute coordination", "dimension = 2", "be 3"]),
    (FLAT + "compute i all inertial/number\n", ["compute inertial/number", "dimension = 2"]),
    (FLAT + "compute si all slipping/index\n", ["compute slipping/index", "dimension = 2"]),
    (FLAT + "compute f all fines/layer x 3 split 1e-3 bounds 0 1e-3\n", ["compute fines/layer", "dimension = 2"]),
    (FLAT + SERVO + "isotropic 200e3\n", ["fix stress/servo", "dimension = 2"]),
    (FLAT + "fix h all hydrodynamic/force\n", ["fix hydrodynamic/force", "dimension = 2"]),
    (FLAT + "fix l all lubrication viscosity 1e-3 outer 1e-5 inner 1e-7\n", ["fix lubrication", "dimension = 2"]),
    (FLAT + "fix d all density/scaling size 1e-3\n", ["fix density/scaling", "dimension = 2"]),
    (FLAT + "fix p all loading/platen upper xplane 1e-3 fixed\n", ["fix loading/platen", "dimension = 2"]),
    (FLAT + "dem_timestep rayleigh 0.1 pressure 1e5\n", ["dem_timestep", "dimension = 2"]),
    (CLUMPS + "compute Z all coordination\nrun 1\n", ["compute coordination", "fix = multisphere", "single spheres"]),
    (CLUMPS + "compute Z all contact/atom\nfix h all hydrodynamic/force\nrun 1\n", ["hydrodynamic/force", "fix = multisphere"]),
    (CLUMPS + "dem_timestep rayleigh 0.1 pressure 1e5\n", ["dem_timestep", "fix = multisphere"]),
    (HEADER.format(boundary="f f f") + "read_data double.data\n", ["read_data", "grain = 3 twice", "a number of its own"]),
]


def check_lost_grains(program, folder):
    """Grains that fall out of an open box are counted at the end of the run that loses them, and not again."""
    box = HEADER.format(boundary="f f f") + "region box block 0 4e-3 0 4e-3 0 4e-3 units box\ncreate_box 1 box\n" + \
        MATERIAL.format(friction=0.3) + "create_atoms 1 single 1e-3 1e-3 1e-3\ncreate_atoms 1 single 3e-3 3e-3 1e-3\n" \
        "create_atoms 1 single 1e-3 3e-3 3.5e-3\nset type 1 diameter 1e-3 density 2650\ntimestep 1e-6\nthermo_modify lost ignore\n" \
        "velocity all set 0 0 -0.1\nrun 1000\nrun 15000\nrun 1000\n"
    screen = program.must_run(box, folder)
    lines = [line for line in screen.splitlines() if "left the box" in line]
    expect(lines == ["suffuse: note: 2 grains left the box in this run and are lost; 1 is left (`thermo_modify lost error` ends a run that loses one; docs/what_goes_wrong.md)"],
           f"lost grains: {lines}")


def check_mesh_beyond_faces(program, folder):
    """A plate that reaches out of the periodic faces is pointed out, once; one that ends at them is not."""
    def plate(low, high):
        corners = [(low, low), (high, low), (high, high), (low, high)]
        facets = "".join("facet normal 0 0 1\nouter loop\n" + "".join(f"vertex {corners[k][0]} {corners[k][1]} 5e-4\n" for k in three) +
                         "endloop\nendfacet\n" for three in ((0, 1, 2), (0, 2, 3)))
        return f"solid plate\n{facets}endsolid plate\n"

    for name, low, high, notes in (("fits", 0, 4e-3, 0), ("beyond", -1e-3, 5e-3, 1)):
        (pathlib.Path(folder) / f"{name}.stl").write_text(plate(low, high))
        screen = program.must_run(
            HEADER.format(boundary="p p f") + "region box block 0 4e-3 0 4e-3 0 4e-3 units box\ncreate_box 1 box\n" +
            MATERIAL.format(friction=0.3) + "create_atoms 1 single 1e-3 1e-3 1.2e-3\nset type 1 diameter 1e-3 density 2650\ntimestep 1e-6\n"
            f"fix plate all mesh/surface file {name}.stl type 1\nfix w all wall/gran model hertz tangential history mesh n_meshes 1 meshes plate\n"
            "run 10\nrun 10\n", folder)
        expect(screen.count("note: mesh plate reaches out of the periodic faces across x and y") == notes, f"{name}: {screen[-800:]}")


def check_variables(program, folder):
    """A -var that the script does not know is refused before anything runs; one that only an included file knows is not."""
    path = pathlib.Path(folder)
    (path / "part_a.inc").write_text("variable size index 3\nprint 'size ${size}, ${kind}'\n")
    (path / "in.variables").write_text("variable kind index a\ninclude ${script_folder}/part_${kind}.inc\n")

    def run(*words):
        return program.run_file("in.variables", folder, list(words), "log.variables", 60)

    code, screen = run("-var", "size", "7")
    expect(code == 0 and "size 7, a" in screen, f"-var size 7: {code}\n{screen[-500:]}")
    code, screen = run("-var", "sise", "7")
    lines = [line for line in screen.splitlines() if line.startswith("suffuse: error:")]
    expect(code == 1 and len(lines) == 1 and "variable = sise, must be used by in.variables" in lines[0] and "kind, size" in lines[0]
           and "size 3" not in screen, f"-var sise 7: {code}\n{screen[-500:]}")
    code, screen = run("-var", "size", "7", "-var", "size", "8")
    expect(code == 0 and "size 7, a" in screen and screen.count("-var size is given twice: 7 counts, 8 does not") == 1,
           f"-var size twice: {code}\n{screen[-500:]}")


def main():
    program = program_from_command_line(__doc__)
    with scratch() as folder:
        (pathlib.Path(folder) / "wrong.csv").write_text("name,value\n")
        (pathlib.Path(folder) / "right.csv").write_text("case,quantity,value,tolerance,unit,source\nA,p,1,0.1,Pa,here\n")
        (pathlib.Path(folder) / "double.data").write_text(DOUBLE)
        (pathlib.Path(folder) / "clump.txt").write_text("0 0 0 5e-4\n6e-4 0 0 5e-4\n")
        check_lost_grains(program, folder)
        cases = CASES if program.ranks == 1 else CASES[::2]  # starting several ranks takes a second
        failures = mistakes_not_named(program, cases, folder)
        code, screen = program.run_file(folder, folder, [], "log.folder", 60)
        expect(code == 1 and "readable script" in screen, f"a folder as script ended with code {code}")
        check_variables(program, folder)
        check_mesh_beyond_faces(program, folder)
        code, screen = program.run("", folder, name="empty")
        expect(code == 0, f"an empty script ended with code {code}")
    expect(not failures, "\n".join(failures))
    print(f"{program.ranks} ranks: {len(cases)} mistakes, each named in one line")


if __name__ == "__main__":
    main()
