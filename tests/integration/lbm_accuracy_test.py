#!/usr/bin/env python3
"""lbm_accuracy_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

`lbm accuracy`: spheres pulled through a periodic box keep to what was asked for against Hasimoto's speed; the `lbm lattice` line that it
prints gives the same run to the last digit; a bed's velocity comes from what drives it; what cannot be had is
refused, and grains that the averaged flow has no room for take the resolved one.
"""
import math
import pathlib
import re
import sys

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[1] / "support"), str(pathlib.Path(__file__).resolve().parents[1] / "hard_cases")]
from scenes import HEADER, columns, expect, material, mistakes_not_named, program_from_command_line, scratch  # noqa: E402
from wet_grains import array_speed  # noqa: E402
from wet_scenes import wet_box  # noqa: E402

DIAMETER, PITCH, SPEED = 1e-3, 4e-3, 1e-4
FLUID = "lbm fluid density 1000 viscosity 1e-6\n"


def pulled_spheres(lattice):
    """Eight spheres of a cubic array, each elsewhere on the lattice, pulled at a force for which Hasimoto's speed is SPEED, and a gradient that
    keeps all matter at rest on the whole."""
    concentration = math.pi / 6 * DIAMETER ** 3 / PITCH ** 3
    force = 3 * math.pi * 1e-3 * DIAMETER * SPEED / array_speed(concentration)
    places = [[PITCH * (0.5 + k // 2 ** axis % 2) + 3e-5 * ((3 * k + 5 * axis) % 8 - 3.5) for axis in range(3)] for k in range(8)]
    atoms = "\n".join(f"create_atoms 1 single {x:.9g} {y:.9g} {z:.9g} units box" for x, y, z in places)
    return HEADER.format(boundary="p p p") + f"""region box block 0 {2 * PITCH} 0 {2 * PITCH} 0 {2 * PITCH} units box
create_box 1 box
{atoms}
set type 1 diameter {DIAMETER} density 1100
{material(1e-4, 5e6, 0.3, 0.3)}fix motion all nve/sphere
fix pull all addforce 0 0 {force:.12g}
timestep 2e-5
thermo 1000000
thermo_modify lost error norm no
variable speed atom vz
compute fall all reduce ave v_speed
{FLUID}lbm force pressure_gradient 0 0 {-force / PITCH ** 3:.12g}
{lattice}
lbm monitor fall every 0.5 file fall.csv superficial_velocity grains c_fall as speed_m_per_s
lbm run 3
"""


def check_target(program):
    for share in (0.1, 0.03):
        with scratch() as folder:
            path = pathlib.Path(folder)
            screen = program.must_run(pulled_spheres(f"lbm accuracy {100 * share:g}% max_velocity {1.5 * SPEED}"), folder)
            fall = columns(path / "fall.csv")
            error = fall["speed_m_per_s"][-1] / SPEED - 1
            print(f"{100 * share:g} % asked for: {100 * error:+.2f} %")
            expect(abs(error) < share, f"{100 * share} % asked for, {100 * error:.2f} % reached")
            line = re.search(r"the same is `(.*)`", screen).group(1)
            program.must_run(pulled_spheres(line), folder)
            expect(columns(path / "fall.csv") == fall, f"`{line}` is another run")


def check_drive(program):
    """Ergun's velocity in a bed from its pressures; 1.5 times the critical gradient at least where it may be lifted."""
    bed = wet_box() + FLUID
    with scratch() as folder:
        slow = program.must_run(bed + "unfix motion\nlbm boundary zlo pressure 0.1 zhi pressure 0\nlbm accuracy 10%\n", folder)
        fast = program.must_run(bed + "unfix motion\nlbm boundary zlo pressure 10 zhi pressure 0\nlbm accuracy 10%\n", folder)
        lifted = program.must_run(bed + "lbm force gravity 0 0 -9.81\nlbm boundary zlo pressure 0.1 zhi pressure 0\nlbm accuracy 10%\n", folder)
        driven = program.must_run(bed + "unfix motion\nlbm boundary zlo velocity 0 0 1e-3 zhi pressure 0\nlbm accuracy 10%\n", folder)
    # A velocity at a face takes a pressure as well, Ergun's over the bed.
    expect(float(re.search(r"; density (\S+) %", driven).group(1)) > 0, f"no pressure of the face's velocity: {driven[-1500:]}")
    speeds = [float(re.search(r"at (\S+) m/s, from", screen).group(1)) for screen in (slow, fast, lifted)]
    expect(10 < speeds[1] / speeds[0] <= 100.5 and speeds[2] > 5 * speeds[0], f"velocities {speeds}")


def check_coarse_grain(program):
    """A coarse grain among fines, larger than cells of three mean diameters: the averaged flow has no water left there."""
    size, coarse, fine = 2.4e-3, 1.2e-3, 2e-4
    script = HEADER.format(boundary="p p p") + f"""region box block 0 {size} 0 {size} 0 {size} units box
create_box 1 box
create_atoms 1 single {size / 2} {size / 2} {size / 2} units box
region around sphere {size / 2} {size / 2} {size / 2} {(coarse + fine) / 2} side out units box
lattice sc {fine} origin 0.5 0.5 0.5
create_atoms 1 region around
set type 1 diameter {fine} density 2650
set atom 1 diameter {coarse} density 2650
{material(1e-4, 5e6, 0.3, 0.3)}timestep 1e-6
{FLUID}lbm accuracy 30% max_velocity 1e-4
"""
    with scratch() as folder:
        screen = program.must_run(script, folder)
    expect("resolved: not averaged, for cells of" in screen and "of a cell to the water" in screen, screen[-1500:])
    with scratch() as folder:
        amiss = mistakes_not_named(program, [(script.replace("lbm accuracy", "lbm method averaged\nlbm accuracy"), ["of a cell to the water"])], folder)
    expect(not amiss, "\n".join(amiss))


def check_refusals(program):
    bed = wet_box() + FLUID
    amiss = []
    with scratch() as folder:
        amiss = mistakes_not_named(program, [
            (bed + "lbm accuracy soon\n", ["lbm accuracy: accuracy = soon", "3%"]),
            (bed + "lbm accuracy 0.1%\n", ["accuracy = 0.1 %", "1.4"]),
            (bed + "unfix motion\nlbm accuracy 5%\n", ["velocity = none", "max_velocity"]),
            (bed + "lbm accuracy 5% max_speed 1\n", ["max_velocity, region"]),
            (bed + "lbm method averaged\nlbm accuracy 5% max_velocity 1e-2\n", ["accuracy = 5 %", "the averaged flow"]),
            (wet_box(grains=0) + FLUID + "lbm accuracy 5% max_velocity 1e-2\n", ["grains = none"]),
            (bed + "lbm preset thesis\nlbm accuracy 5% max_velocity 1e-2\n", ["solid operator = sc1", "lbm preset"]),
            (bed + "lbm solid coefficient 1\nlbm accuracy 5% max_velocity 1e-2\n", ["solid operator = force, coefficient given"]),
        ], folder)
    expect(not amiss, "\n".join(amiss))


def main():
    program = program_from_command_line(__doc__)
    check_refusals(program)
    check_coarse_grain(program)
    check_drive(program)
    check_target(program)
    print(f"{program.ranks} ranks: the accuracy that was asked for is kept")


if __name__ == "__main__":
    main()
