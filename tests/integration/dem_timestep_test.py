#!/usr/bin/env python3
"""dem_timestep_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

`dem_timestep` takes the smallest limit of all grains, each with its own density, size and material: the share that it
reports is that of LIGGGHTS's own `fix check/timestep/gran`. Under linear laws the limit is the contact duration, which a
collision of two grains, and of a grain with a wall of another material, is seen to take.
"""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import HEADER, expect, mistakes_not_named, program_from_command_line, scratch  # noqa: E402

# Two types with E, nu, density and radius each.
SAMPLE = HEADER.format(boundary="p p p") + """
region box block 0 6e-3 0 6e-3 0 6e-3 units box
create_box 2 box
neighbor 1e-4 bin
neigh_modify delay 0
fix y all property/global youngsModulus peratomtype {modulus}
fix nu all property/global poissonsRatio peratomtype 0.25 0.3
fix e all property/global coefficientRestitution peratomtypepair 2 0.5 0.5 0.5 0.5
fix mu all property/global coefficientFriction peratomtypepair 2 0.5 0.3 0.3 0.1
pair_style gran model hertz tangential history
pair_coeff * *
fix ga all particletemplate/sphere 15485863 atom_type 1 density constant {first} radius constant 1e-3
fix gb all particletemplate/sphere 15485867 atom_type 2 density constant {second} radius constant 2e-4
fix d all particledistribution/discrete 32452843 2 ga 0.8 gb 0.2
fix i all insert/pack seed 32452867 distributiontemplate d insert_every once overlapcheck yes volumefraction_region 0.15 region box ntry_mc 100000
fix m all nve/sphere
timestep 1e-9
run 1
unfix i
timestep 4e-8
dem_timestep check pressure 1e3
fix ts all check/timestep/gran 1 0.1 0.1 warn no
variable share equal f_ts[1]
run 2
print "stock ${{share}}"
"""

# Two grains, or a grain and a wall of type 2, that meet; bounces are all but elastic.
COLLISION = HEADER.format(boundary="f f f") + """
region box block 0 0.01 0 0.01 0 0.01 units box
create_box 2 box
neighbor 1e-4 bin
neigh_modify delay 0
fix y all property/global youngsModulus peratomtype 7e7 7e8
fix nu all property/global poissonsRatio peratomtype 0.25 0.3
fix e all property/global coefficientRestitution peratomtypepair 2 0.9999 0.9999 0.9999 0.9999
fix mu all property/global coefficientFriction peratomtypepair 2 0 0 0 0
fix v all property/global characteristicVelocity scalar 0.3
fix kn all property/global kn peratomtypepair 2 2e4 9e4 9e4 9e4
fix kt all property/global kt peratomtypepair 2 1e4 1e4 1e4 1e4
fix gn all property/global gamman peratomtypepair 2 1e-3 1e-3 1e-3 1e-3
fix gt all property/global gammat peratomtypepair 2 1e-3 1e-3 1e-3 1e-3
pair_style gran model {law} tangential history
pair_coeff * *
{wall}
fix m all nve/sphere
create_atoms 1 single 0.003 0.005 0.005 units box
{second}
set group all diameter 1e-3
set group all density 2500
set atom 1 vx {speed}
timestep 1e-7
dem_timestep check pressure 1
compute force all property/atom fx
compute all all reduce sum c_force
variable force equal abs(fx[1])
fix series all print 1 "${{force}}" file force.csv screen no title force
run 20000
"""


def like_stock(program, folder):
    for moduli, first, second in (("5e7 5e7", 7800, 500), ("5e7 5e7", 2650, 2650), ("5e7 5e8", 500, 7800), ("5e6 5e7", 100, 2650)):
        screen = program.must_run(SAMPLE.format(modulus=moduli, first=first, second=second), folder, "sample")
        ours = float(re.search(r"DEM time step \S+ s: (\S+) of the Rayleigh", screen).group(1))
        stock = float(re.search(r"^stock (\S+)", screen, re.M).group(1))
        expect(abs(ours / stock - 1) < 5e-3, f"{moduli} {first} {second}: {ours} of the Rayleigh time, LIGGGHTS says {stock}")  # printed to 3 digits


def like_a_collision(program, folder, law, between):
    words = {"grains": ("", "create_atoms 1 single 0.0045 0.005 0.005 units box", 1.0),
             "wall": (f"fix w all wall/gran model {law} tangential history primitive type 2 xplane 0.0", "create_atoms 1 single 0.009 0.005 0.005 units box", -2.0)}
    wall, second, speed = words[between]
    screen = program.must_run(COLLISION.format(law=law, wall=wall, second=second, speed=speed), folder, "collision")
    duration = float(re.search(r"of the contact duration (\S+) s", screen).group(1))
    force = [float(line) for line in (folder / "force.csv").read_text().split()[1:]]
    seen = sum(value > 0 for value in force) * 1e-7
    # Damping of e = 0.9999 makes it longer by 1e-9, LIGGGHTS's damped contact ends in tension: a step or two.
    expect(abs(seen / duration - 1) < 0.02, f"{law}, {between}: a contact lasts {seen} s, said {duration}")


def main():
    program = program_from_command_line(__doc__)
    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        like_stock(program, folder)
        for law in ("hooke", "hooke/stiffness"):
            like_a_collision(program, folder, law, "grains")
        like_a_collision(program, folder, "hooke/stiffness", "wall")
        failures = mistakes_not_named(program, [(SAMPLE.format(modulus="5e7 5e7", first=500, second=500).replace("units si", "units cgs"), ["dem_timestep", "units = cgs", "be si"])], folder)
        expect(not failures, "\n".join(failures))
        print(f"{program.ranks} ranks: the step's limit is the smallest of all grains' own")


if __name__ == "__main__":
    main()
