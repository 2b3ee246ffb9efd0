#!/usr/bin/env python3
"""density_scaling_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

What `fix density/scaling` promises: small grains have the inertia of the reference's time step and nothing else
changes: free fall, the weight on a floor, densities, porosity; once, whatever comes (a second run, new grains, a restart),
and not at all after unfix.
"""
import math
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import HEADER, columns, expect, loose_sample, mistakes_not_named, program_from_command_line, read_sample, scratch  # noqa: E402

SCALING = "fix ds all density/scaling size 1e-3\n"
DUMP = """
dump grains all custom 1 {name}.dump id x y z radius density mass
dump_modify grains format "%d %.17g %.17g %.17g %.17g %.17g %.17g" sort id
run 0
undump grains
"""

# A box with a floor: one grain of 0.5 mm and one of 1 mm, some way above it.
TWO = HEADER.format(boundary="p p f") + """
region sample block 0 0.01 0 0.01 0 0.02 units box
create_box 2 sample
neighbor 1e-4 bin
neigh_modify delay 0
fix modulus all property/global youngsModulus peratomtype 7e7 7e8
fix ratio all property/global poissonsRatio peratomtype 0.3 0.25
fix restitution all property/global coefficientRestitution peratomtypepair 2 0.3 0.3 0.3 0.3
fix friction all property/global coefficientFriction peratomtypepair 2 0.3 0.3 0.3 0.3
{before}pair_style gran model {law} tangential history
pair_coeff * *
fix motion all nve/sphere
create_atoms 1 single 0.003 0.003 {height} units box
create_atoms 2 single 0.007 0.007 {height} units box
set type 1 diameter 0.5e-3
set type 1 density 2600
set type 2 diameter 1e-3
set type 2 density 1300
timestep 1e-6
"""
GRAVITY = "fix pull all gravity 9.81 vector 0 0 -1\n"
FLOOR = "fix floor all wall/gran model hertz tangential history primitive type 1 zplane 0\n"


def two(height=0.01, law="hertz", before=""):
    return TWO.format(height=height, law=law, before=before)


def frame(path):
    """The last frame of a dump: {id: row} by column name."""
    text = pathlib.Path(path).read_text().split("ITEM: ATOMS ")[-1].splitlines()
    names = text[0].split()
    return {int(line.split()[0]): dict(zip(names, map(float, line.split()))) for line in text[1:] if line.strip()}


def mass(grain):
    return grain["density"] * 4 / 3 * math.pi * grain["radius"] ** 3


def values(screen, word):
    """The numbers of the line that starts with `word`."""
    line = next(line for line in screen.splitlines() if line.startswith(word + " "))
    return [float(number) for number in line.split()[1:]]


FIELDS = "".join(f"variable d{k} equal f_ds[{k}]\n" for k in range(1, 7))
TELL = 'print "fields ${d1} ${d2} ${d3} ${d4} ${d5} ${d6}"\n'


def free_fall(program, folder):
    """Both grains fall by g t²/2: the scaled one as well. Velocity-Verlet is exact for a constant force; that nothing touches
    a grain is known after the first of 10,000 steps, which costs up to 1e-4 of the way."""
    for gravity_first in (True, False):
        words = [GRAVITY, "fix ds all density/scaling size 2e-3\n"]
        program.must_run(two() + "".join(words if gravity_first else reversed(words)) + "run 10000\n" + DUMP.format(name="fall"), folder, "fall")
        for grain in frame(folder / "fall.dump").values():
            fallen = 0.01 - grain["z"]
            expect(abs(fallen / (0.5 * 9.81 * 0.01 ** 2) - 1) < 2e-4, f"a grain fell by {fallen}")
            expect(abs(grain["mass"] / mass(grain) / (2e-3 / (2 * grain["radius"])) ** 2 - 1) < 1e-9, f"inertia {grain}")


def held(program, folder):
    """What `fix freeze` holds stays, although the scaling comes after it in the script."""
    program.must_run(two() + "group small type 1\n" + GRAVITY + "fix base small freeze\n" + SCALING +
                     "run 1000\n" + DUMP.format(name="held"), folder, "held")
    expect(frame(folder / "held.dump")[1]["z"] == 0.01, f"a frozen grain moved to {frame(folder / 'held.dump')[1]['z']}")


def weight_on_a_floor(program, folder):
    """At rest, the floor carries the true weight of each grain."""
    screen = program.must_run(two(height=0.52e-3) + GRAVITY + FLOOR + "fix ds all density/scaling size 2e-3\nrun 60000\n" + DUMP.format(name="floor"), folder, "floor")
    for grain in frame(folder / "floor.dump").values():
        # Hertz against a wall of type 1: F = 4/3 E* √r δ^1.5
        modulus, ratio = (7e7, 0.3) if grain["id"] == 1 else (7e8, 0.25)
        effective = 1 / ((1 - ratio ** 2) / modulus + (1 - 0.3 ** 2) / 7e7)
        overlap = grain["radius"] - grain["z"]
        force = 4 / 3 * effective * math.sqrt(grain["radius"]) * max(overlap, 0) ** 1.5
        expect(abs(force / (mass(grain) * 9.81) - 1) < 2e-3, f"the floor carries {force / 9.81 / mass(grain)} of grain {grain['id']}")
    return screen


def once(program, folder):
    """Masses after a second run, after a restart (into which the true ones go), and after unfix."""
    start = loose_sample(grains=120)
    tail = FIELDS + TELL
    screen = program.must_run(start + SCALING + "dem_timestep rayleigh 0.2 pressure 1e5\nrun 20\nrun 20\n" + DUMP.format(name="scaled") + tail +
                              "write_restart sample.restart\nrun 100\n" + DUMP.format(name="later") + "unfix ds\n" + DUMP.format(name="unfixed"), folder, "once")
    scaled = frame(folder / "scaled.dump")
    factors = {k: max(1, (1e-3 / (2 * grain["radius"])) ** 2) for k, grain in scaled.items()}
    for name, by in (("scaled", factors), ("later", factors), ("unfixed", dict.fromkeys(factors, 1))):
        for k, grain in frame(folder / f"{name}.dump").items():
            expect(abs(grain["density"] - 2650) < 1e-9, f"{name}: density {grain['density']}")
            expect(abs(grain["mass"] / mass(grain) / by[k] - 1) < 1e-9, f"{name}: grain {k} has {grain['mass'] / mass(grain)} of its mass, not {by[k]}")
    small = [k for k, factor in factors.items() if factor > 1 + 1e-9]
    total = sum(mass(grain) for grain in scaled.values())
    fields = values(screen, "fields")
    expect(abs(fields[0] / max(factors.values()) - 1) < 1e-9 and fields[2] == len(small), f"fields {fields}")
    expect(abs(fields[1] - sum(mass(scaled[k]) for k in small) / total) < 1e-9, f"share of mass {fields[1]}")
    expect(abs(fields[5] - sum(mass(grain) * factors[k] for k, grain in scaled.items()) / total) < 1e-9, f"inertia {fields[5]}")
    # The step is that of the largest grains, 1 mm: t_R = π r √(ρ/G)/(0.1631 ν + 0.8766)
    rayleigh = math.pi * 0.5e-3 * math.sqrt(2650 / (7e8 / 2.6)) / (0.1631 * 0.3 + 0.8766)
    step = float(re.search(r"DEM time step (\S+) s", screen).group(1))
    expect(abs(step / (0.2 * rayleigh) - 1) < 1e-3, f"time step {step}, not {0.2 * rayleigh}")

    program.must_run(read_sample("sample.restart") + DUMP.format(name="plain"), folder, "plain")
    for grain in frame(folder / "plain.dump").values():
        expect(abs(grain["mass"] / mass(grain) - 1) < 1e-9, "a restart file holds scaled masses")
    program.must_run(read_sample("sample.restart") + f"timestep {step}\n" + SCALING + "run 100\n" + DUMP.format(name="continued"), folder, "continued")
    later, continued = frame(folder / "later.dump"), frame(folder / "continued.dump")
    for k, grain in continued.items():
        expect(abs(grain["mass"] / later[k]["mass"] - 1) < 1e-12, f"grain {k} scaled otherwise after a restart")


def newcomers(program, folder):
    """Grains that come later are scaled before their first step, wherever the insertion stands in the script."""
    insertion = "fix small all particletemplate/sphere 11593 atom_type 1 density constant 2600 radius constant 0.25e-3\n" \
                "fix large all particletemplate/sphere 11701 atom_type 2 density constant 1300 radius constant 0.6e-3\n" \
                "fix grading all particledistribution/discrete 32452843 2 small 0.5 large 0.5\n" \
                "fix later all insert/pack seed 32452867 distributiontemplate grading insert_every 50 overlapcheck yes &\n" \
                "    particles_in_region 300 region sample ntry_mc 20000\n"
    for order in (insertion + SCALING, SCALING + insertion):
        program.must_run(two() + order + "run 60\n" + DUMP.format(name="new"), folder, "new")
        grains = frame(folder / "new.dump")
        expect(len(grains) > 80, f"{len(grains)} grains: none came")
        for grain in grains.values():
            factor = max(1, (1e-3 / (2 * grain["radius"])) ** 2)
            expect(abs(grain["mass"] / mass(grain) / factor - 1) < 1e-9, f"a newcomer has {grain['mass'] / mass(grain)} of its mass, not {factor}")


def ghosts(program, folder):
    """Two small grains that meet across a periodic face and away from it rebound alike: ghosts are scaled from the first step."""
    screens = []
    for at in (0.005, 0.0):
        scene = two().split("create_atoms")[0] + f"create_atoms 1 single {(at - 0.26003e-3) % 0.01} 0.005 0.01 units box\n" + \
            f"create_atoms 1 single {at + 0.26003e-3} 0.005 0.01 units box\nset type 1 diameter 0.5e-3\nset type 1 density 2600\n" + \
            f"timestep 1e-6\nset atom 1 vx 0.1\nset atom 2 vx -0.1\nfix ds all density/scaling size 2e-3\nrun 400\n" + \
            "variable u equal vx[1]\nvariable w equal vx[2]\nprint \"speeds ${u} ${w}\"\n"
        screens.append(values(program.must_run(scene, folder, "ghosts"), "speeds"))
    (u, w), across = screens
    expect(abs(u + w) < 1e-12 and -0.1 < u < -0.01, f"rebound {u} {w}")
    expect(abs(across[0] / u - 1) < 1e-6 and abs(across[1] / w - 1) < 1e-6, f"across the face {across}, inside {u} {w}")


def shared_step(program, folder):
    """`rayleigh T` lifts every grain to the same critical time, whatever its material and the law."""
    hooke = "fix v all property/global characteristicVelocity scalar 0.5\n"
    kn = "fix kn all property/global kn peratomtypepair 2 1e5 1e5 1e5 4e5\nfix kt all property/global kt peratomtypepair 2 3e4 3e4 3e4 3e4\n" \
         "fix gn all property/global gamman peratomtypepair 2 1e3 1e3 1e3 1e3\nfix gt all property/global gammat peratomtypepair 2 1e3 1e3 1e3 1e3\n"
    for law, before in (("hertz", ""), ("hooke", hooke), ("hooke/stiffness", kn)):
        screen = program.must_run(two(law=law, before=before) + "timestep 2e-5\nfix ds all density/scaling rayleigh 0.1\ndem_timestep check pressure 10\n" + FIELDS +
                                  "run 0\n" + TELL, folder, "shared")
        share = float(re.search(r"DEM time step \S+ s: (\S+) of the", screen).group(1))
        expect(abs(share - 0.1) < 1e-6, f"{law}: the step is {share} of the critical time")
        expect(values(screen, "fields")[2] == 2 and values(screen, "fields")[0] > 10, f"{law}: {values(screen, 'fields')}")


def bound(program, folder):
    """The inertial number of the scaled grains: that of the reference diameter, and a warning above its bound."""
    start = loose_sample(grains=200) + SCALING[:-1] + " every 100\ndem_timestep rayleigh 0.2 pressure 1e5\nfix s all stress/servo isotropic 100e3 inertial_number 5e-4 until target\n" \
        "run 400000\nfix s all stress/servo constant_volume axis z rate {rate} inertial_number 1e-2\n"
    tail = "variable rate equal f_s[9]\nvariable p equal f_s[1]\n" + FIELDS + 'run 3000\nprint "shear ${rate} ${p}"\n' + TELL
    screen = program.must_run(start.format(rate=0.3) + tail, folder, "gentle")
    rate, pressure = values(screen, "shear")
    fields = values(screen, "fields")
    expected = rate * 1e-3 * math.sqrt(2650 / pressure)
    # p' of the last sample, up to 100 steps before
    expect(abs(fields[3] / expected - 1) < 0.05, f"inertial number {fields[3]}, expected {expected}")
    expect("WARNING: fix density/scaling" not in screen, "a warning below the bound")
    expect(0 < fields[4] < 0.5, f"unbalanced share {fields[4]}")
    screen = program.must_run(start.format(rate=20) + tail, folder, "hasty")
    expect(screen.count("WARNING: fix density/scaling ds: inertial number") == 1, "no warning above the bound, or more than one")


def mistakes(program, folder):
    sample = loose_sample(grains=100)
    cases = [
        (sample + "fix ds all density/scaling\n", ["density/scaling", "size D or rayleigh T"]),
        (sample + "fix ds all density/scaling size 0\n", ["reference diameter = 0", "> 0"]),
        (sample + "fix ds all density/scaling rayleigh 2\n", ["share = 2", "<= 1"]),
        (sample + "fix ds all density/scaling size 1e-3 bond 1\n", ["keyword = bond", "bound"]),
        (sample + SCALING + "fix dt all density/scaling size 2e-3\nrun 1\n", ["= 2", "one at a time"]),
        (sample + SCALING + "fix h all hydrodynamic/force\nrun 1\n", ["fix = h", "unfix ds"]),
        (sample + SCALING + "variable g equal 9.81\nfix g all gravity v_g vector 0 0 -1\nrun 1\n", ["fix gravity = g", "constant"]),
        (sample + "set group all mass 1e-6\n" + SCALING + "run 1\n", ["density times volume", "density"]),
    ]
    failures = mistakes_not_named(program, cases, folder)
    expect(not failures, "\n".join(failures))


def main():
    program = program_from_command_line(__doc__)
    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        for test in (free_fall, held, weight_on_a_floor, once, newcomers, ghosts, shared_step, bound, mistakes):
            test(program, folder)
        print(f"{program.ranks} ranks: scaled grains have another inertia and nothing else")


if __name__ == "__main__":
    main()
