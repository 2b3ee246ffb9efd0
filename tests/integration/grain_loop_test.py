#!/usr/bin/env python3
"""grain_loop_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

The vectorised contact loop and the neighbour lists by size class beside LIGGGHTS's own:
forces of every law from the same state (`compare`), numbers of listed pairs, restart files in both directions, `clear`, and the
two things that ours does otherwise: springs of pairs that parted, and the normal that tangential velocities are split with.
"""
import re
import sys
import tempfile

sys.path.insert(0, str(__import__("pathlib").Path(__file__).resolve().parents[1] / "support"))
from scenes import HEADER, Program, material, mistakes_not_named, program_from_command_line  # noqa: E402

MATERIALS = """
neighbor {skin} {style}
neigh_modify delay 0
fix m1 all property/global youngsModulus peratomtype 7e7 5e7
fix m2 all property/global poissonsRatio peratomtype 0.3 0.25
fix m3 all property/global coefficientRestitution peratomtypepair 2 0.7 0.6 0.6 0.8
fix m4 all property/global coefficientFriction peratomtypepair 2 0.3 0.4 0.4 0.5
fix m5 all property/global coefficientRollingFriction peratomtypepair 2 0.1 0.05 0.05 0.2
fix m6 all property/global characteristicVelocity scalar 0.1
fix m7 all property/global kn peratomtypepair 2 1e3 2e3 2e3 3e3
fix m8 all property/global kt peratomtypepair 2 5e2 6e2 6e2 7e2
fix m9 all property/global gamman peratomtypepair 2 100 110 110 120
fix m10 all property/global gammat peratomtypepair 2 50 55 55 60
pair_style gran model {model}
pair_coeff * *
"""

# Grains of two materials and three sizes in a box that shrinks, moving every way.
COLLAPSE = HEADER + """
region b block 0 {edge} 0 {edge} 0 {edge} units box
create_box 2 b
""" + MATERIALS + """
fix l all particletemplate/sphere 11593 atom_type 1 density constant 2650 radius constant {large}
fix m all particletemplate/sphere 11701 atom_type 2 density constant 2650 radius constant {middle}
fix s all particletemplate/sphere 11807 atom_type 2 density constant 2650 radius constant 0.1e-3
fix d all particledistribution/discrete 32452843 3 l 0.6 m 0.3 s 0.1
fix ins all insert/pack seed 32452867 distributiontemplate d insert_every once overlapcheck yes maxattempt 1000 volumefraction_region 0.35 &
    region b ntry_mc 20000
fix motion all nve/sphere
timestep 5e-7
run 1
unfix ins
variable vx atom random(-0.2,0.2,32452867)
variable vy atom random(-0.2,0.2,32452843)
variable vz atom random(-0.2,0.2,49979687)
velocity all set v_vx v_vy v_vz units box
thermo_style custom step atoms ke
thermo_modify lost error norm no format float %.17g
"""

LAWS = ["hertz tangential history", "hertz tangential no_history", "hertz", "hooke tangential history",
        "hooke/stiffness tangential history", "hertz tangential history rolling_friction cdt",
        "hertz tangential history rolling_friction cdt torsionTorque on", "hooke tangential no_history ktToKnUser on limitForce on",
        "hertz tangential history tangential_damping off"]
STOCK_PHYSICS = "lost_springs keep normal_at full_step"


def collapse(model, boundary="p p p", skin=1e-4, style="bin", edge=4e-3, large=0.4e-3, middle=0.25e-3):
    return COLLAPSE.format(model=model, boundary=boundary, skin=skin, style=style, edge=edge, large=large, middle=middle)


def check(right, what):
    if not right:
        sys.exit("FAILED: " + what)


def check_forces(program, folder):
    """The two loops from the same state, twenty times a run: differences are sums in another order."""
    worst = 0
    laws = LAWS if program.ranks == 1 else LAWS[:2]  # what ranks change is the same for all laws
    for number, law in enumerate(laws):
        boundary = "p p p" if number % 2 == 0 else "f p f"
        squeeze = "fix squeeze all deform 1 y erate -140 remap x\n"
        if number % 2 == 0:
            squeeze = "fix squeeze all deform 1 x erate -52 y erate -52 z erate -52 remap x\n"
        text = collapse(f"{law} {STOCK_PHYSICS} compare 400", boundary) + squeeze
        if number % 2:
            model = re.split(" (?:ktToKnUser|tangential_damping|torsionTorque)", law)[0]
            text += "".join(f"fix {a}{n} all wall/gran model {model} primitive type 1 {a}plane {v}\n"
                            for a in "xz" for n, v in enumerate((0, 4e-3)))
        screen = program.must_run(text + "run 8000\n", folder, f"law{number}")
        check("vectorised loop" in screen, f"{law}: LIGGGHTS's own loop was taken")
        found = [float(value) for value in re.findall(r"largest difference of a force from LIGGGHTS's own loop (\S+) of", screen)]
        check(len(found) >= 20, f"{law}: {len(found)} comparisons")
        check(max(found[-3:]) > 0, f"{law}: nothing touched")
        worst = max([worst] + found)
    # Rounding of positions (1e-19 m) beside overlaps of some nanometres where grains just touch.
    check(worst < 1e-8, f"forces differ by {worst} of their rms")
    return worst, len(laws)


def neighbours(screen):
    return [int(n) for n in re.findall(r"Total # of neighbors = (\d+)", screen)][-1]


def check_lists(stock, program, folder):
    """As many pairs as LIGGGHTS lists, at sizes 1:1 to 1:30, several skins, periodic or not. (Which pairs: unit test.)"""
    total = 0
    for large, middle, edge, skin, boundary in ((0.1e-3, 0.1e-3, 2e-3, 5e-5, "p p p"), (0.4e-3, 0.2e-3, 3e-3, 5e-6, "p p p"),
                                                (0.4e-3, 0.2e-3, 3e-3, 3e-4, "f f p"), (1e-3, 0.3e-3, 5e-3, 1e-4, "p f p"),
                                                (3e-3, 0.5e-3, 1.3e-2, 2e-5, "p p p")):
        text = collapse("hertz tangential history", boundary, skin, "bin", edge, large, middle) + "run 0\n"
        expected, found = neighbours(stock.must_run(text, folder, "lists_stock")), neighbours(program.must_run(text, folder, "lists"))
        check(expected == found, f"sizes to {large} m, skin {skin} m, {boundary}: {found} pairs, LIGGGHTS has {expected}")
        multi = neighbours(program.must_run(text.replace(f"neighbor {skin} bin", f"neighbor {skin} multi"), folder, "lists_multi"))
        check(multi == expected, f"`neighbor multi` lists {multi} pairs, LIGGGHTS's bin {expected}")
        total += expected
    return total


FORCES = """
dump forces all custom 1 NAME.dump id x y z fx fy fz tqx tqy tqz
dump_modify forces sort id format "%d %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g"
run 0
"""


def dumped(folder, name):
    lines = (__import__("pathlib").Path(folder) / f"{name}.dump").read_text().splitlines()
    start = max(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
    return [[float(word) for word in line.split()] for line in lines[start + 1:]]


def check_restarts(stock, program, folder):
    """A file that one loop has written is read by the other, springs and all."""
    squeeze = "fix squeeze all deform 1 x erate -40 y erate -40 z erate -40 remap x\nrun 8000\nunfix squeeze\n"
    for writer, name in ((stock, "stock"), (program, "ours")):
        writer.must_run(collapse("hertz tangential history") + squeeze + f"write_restart {name}.restart\n", folder, f"write_{name}")
        read = HEADER.format(boundary="p p p") + f"read_restart {name}.restart\n" + \
            MATERIALS.format(model="hertz tangential history", skin=1e-4, style="bin") + \
            "fix motion all nve/sphere\ntimestep 5e-7\nthermo_modify lost error\n"
        for reader, by in ((stock, "stock"), (program, "ours")):
            reader.must_run(read + FORCES.replace("NAME", f"{name}_{by}"), folder, f"read_{name}_{by}")
        left, right = dumped(folder, f"{name}_stock"), dumped(folder, f"{name}_ours")
        size = (sum(f * f for row in left for f in row[4:7]) / len(left)) ** 0.5
        worst = max(abs(a - b) for l, r in zip(left, right) for a, b in zip(l[4:7], r[4:7])) / size
        check(len(left) > 100 and size > 0 and worst < 1e-8, f"{len(left)} grains of {name}.restart: forces differ by {worst}")


# One grain strikes another that is held, along and across, parts, and strikes again before the next list (which a skin of 2 mm
# puts off): is the spring of the first contact back?
RETOUCH = HEADER.format(boundary="f f f") + """
region box block -0.01 0.01 -0.01 0.01 -0.01 0.02 units box
create_box 1 box
""" + material(2e-3, "5e6", 0.9, 0.5, law="hertz tangential history {options}") + """
timestep 1e-6
create_atoms 1 single 0 0 0 units box
create_atoms 1 single 0 0 0.001999 units box
set group all diameter 0.002 density 2500
group a id 1
group b id 2
fix frz a freeze
fix motion b nve/sphere
compute pairs all pair/gran/local id force history
velocity b set 0.01 0 -0.05 units box
thermo_modify lost ignore norm no
run 200
velocity b set 0 0 5 units box
run 40 pre no post no
velocity b set 0 0 -5 units box
dump c all local 1 retouch.dump c_pairs[7]
dump_modify c format "%.6g"
run 80 pre no post no
"""


def first_spring(program, folder, options):
    """The spring (m) in the first step of the second contact."""
    program.must_run(RETOUCH.format(options=options), folder, "retouch")
    lines = (__import__("pathlib").Path(folder) / "retouch.dump").read_text().splitlines()
    values = [float(lines[k + 1]) for k, line in enumerate(lines) if line.startswith("ITEM: ENTRIES") and k + 1 < len(lines) and
              not lines[k + 1].startswith("ITEM")]
    check(values, "the grains did not touch again")
    return values[0]


def check_lost_springs(stock, program, folder):
    kept, dropped = first_spring(program, folder, "lost_springs keep"), first_spring(program, folder, "lost_springs drop")
    of_stock = first_spring(stock, folder, "")
    check(abs(of_stock) > 5e-7 and abs(kept / of_stock - 1) < 1e-4, f"kept spring {kept} m, LIGGGHTS's {of_stock} m")
    check(abs(dropped) < 0.03 * abs(of_stock), f"a pair that parted has a spring of {dropped} m; before it parted {of_stock} m")


# A small frictional grain falls into the neck between two large held ones (`vyas2025`; after LAMMPS's test).
NECK = HEADER.format(boundary="f f f") + """
region box block -0.03 0.03 -0.02 0.02 -0.02 0.02 units box
create_box 1 box
""" + material(2e-4, "5e8", 0.5, 0.5, law="hertz tangential history tangential_damping off {options}") + """
timestep {step}
create_atoms 1 single 0.005 2.7937481665e-5 {height} units box
create_atoms 1 single 0 0 0 units box
create_atoms 1 single 0.01 0 0 units box
group fine id 1
group large id 2 3
set group fine diameter {diameter} density 2500
set group large diameter 0.01 density 2500
fix frz large freeze
fix g fine gravity 9.81 vector 0 0 -1
fix motion fine nve/sphere
variable y equal y[1]
variable z equal z[1]
thermo_modify norm no lost ignore
run {steps}
print "ends at $(v_y) $(v_z)"
"""


def neck_end(program, folder, ratio, step, options):
    R, r, y = 0.005, 0.005 / ratio, 2.7937481665e-5
    height = ((R + r) ** 2 - R ** 2 - y ** 2) ** 0.5
    steps = round(0.2 / step)
    text = NECK.format(options=options, step=step, height=height, diameter=2 * r, steps=steps)
    found = re.findall(r"^ends at (\S+) (\S+)", program.must_run(text, folder, "neck"), re.MULTILINE)[-1]
    return [float(value) for value in found]


def check_neck(program, folder):
    """With the half-step normal the path hardly depends on the step; with the full-step normal it does (1.1 mm of 17)."""
    def change(options):
        coarse, fine = (neck_end(program, folder, 10, step, options) for step in (2e-6, 1e-6))
        check(fine[1] < -0.01, f"{options}: the grain has not fallen out of the neck: {fine}")
        return max(abs(a - b) for a, b in zip(coarse, fine))
    half, full = change("normal_at half_step"), change("normal_at full_step")
    print(f"neck, ratio 10: half the step moves the end by {half:.1e} m, with the full-step normal by {full:.1e} m")
    check(half < 1e-5 and full > 1e-4, f"half the step moves the end by {half} m, with the full-step normal by {full} m")


CLEARED = collapse("hertz tangential history") + "run 10\nclear\n" + \
    collapse("hertz tangential history", large=0.3e-3) + "compute c all coordination\nrun 10\n"

MISTAKES = [(collapse(f"hertz tangential history {words}"), [*words.split(), "must be"])
            for words in ("lost_springs maybe", "normal_at noon", "loop fast", "compare never", "compare 0")]


def main():
    program = program_from_command_line(__doc__)
    stock = Program(program.suffuse, program.mpirun, program.ranks)
    stock.extra = ["-suffix", "off"]
    with tempfile.TemporaryDirectory() as folder:
        worst, laws = check_forces(program, folder)
        pairs = check_lists(stock, program, folder)
        check_restarts(stock, program, folder)
        program.must_run(CLEARED, folder, "cleared")
        if program.ranks == 1:
            check_lost_springs(stock, program, folder)
            check_neck(program, folder)
            amiss = mistakes_not_named(program, MISTAKES, folder)
            check(not amiss, "\n".join(amiss))
        print(f"{program.ranks} ranks: {laws} laws within {worst:.1e} of LIGGGHTS's forces, {pairs} listed pairs the same")


if __name__ == "__main__":
    main()
