#!/usr/bin/env python3
"""samples_with_walls_test.py --suffuse PROGRAM --mpirun SCRIPT --analyse PROGRAM

A sample that is not the simulation box: grains between plates in a larger box, with fixed, growing and shrink-wrapped sides,
have one mean stress by `region` and `bed`, that of their contacts by hand; without either the program says so. Contacts with
walls count in a layer's stress: a stack of grains on a floor, a plane or a mesh, has in each layer the weight above its
middle. All on 1, 2 and 3 ranks. `suffuse-analyse` takes the same bodies from the dumps.
"""
import math
import tempfile

from contact_scene import Suffuse, check, close
from scenes import HEADER, material, thermo_rows

# 5 x 5 x 5 equal grains, 0.98 mm apart, between plates 4.9 mm apart: overlaps of 20 um between grains and 10 um with the plates.
PLATES = HEADER.format(boundary="{bc} {bc} {bc}") + """
region box block -1e-3 5.9e-3 -1e-3 5.9e-3 -1e-3 5.9e-3 units box
create_box 1 box
""" + material(1e-4, "5e6", 0.5, 0.5) + """
lattice sc 0.98e-3 origin 0.5 0.5 0.5
region cube block 0 4.9e-3 0 4.9e-3 0 4.9e-3 units box
region ball sphere 2.45e-3 2.45e-3 2.45e-3 4.25e-3 units box
region core block 0.98e-3 3.92e-3 0.98e-3 3.92e-3 0.98e-3 3.92e-3 units box
create_atoms 1 region cube
set type 1 diameter 1e-3 density 2650
{before}
fix m all nve/sphere
fix w1 all wall/gran model hertz tangential history primitive type 1 xplane 0
fix w2 all wall/gran model hertz tangential history primitive type 1 xplane 4.9e-3
fix w3 all wall/gran model hertz tangential history primitive type 1 yplane 0
fix w4 all wall/gran model hertz tangential history primitive type 1 yplane 4.9e-3
fix w5 all wall/gran model hertz tangential history primitive type 1 zplane 0
fix w6 all wall/gran model hertz tangential history primitive type 1 zplane 4.9e-3
timestep 1e-6
{after}
thermo_style custom step {words}
thermo_modify norm no format float %.17g
run 0
"""
COMPUTES = """
compute b all stress/reduction split 0.5e-3
compute r all stress/reduction split 0.5e-3 region cube
compute rw all stress/reduction split 0.5e-3 region cube walls yes
compute s all stress/reduction split 0.5e-3 region ball
compute k all stress/reduction split 0.5e-3 region core
compute w all stress/reduction split 0.5e-3 bed walls yes
compute z all coordination region cube
compute zk all coordination region core
compute lr all stress/layer z 3 region cube walls no
compute lw all stress/layer z 5 region cube
compute lb all stress/layer z 5 bed
compute ls all stress/layer z 1 region core
compute in all inertial/number rate 1 region cube
compute pgl all pair/gran/local pos id force force_normal force_tangential
dump g all custom 1 grains.dump id radius x y z
dump_modify g format "%d %.17g %.17g %.17g %.17g"
dump p all local 1 pairs.dump PAIRS
dump_modify p format "FORMATS"
""".replace("PAIRS", " ".join(f"c_pgl[{k}]" for k in range(1, 19))).replace("FORMATS", " ".join(["%.17g"] * 18))
WORDS = ["c_b[7]", "c_r[7]", "c_rw[7]", "c_s[7]", "c_k[7]", "c_w[7]", "c_z[1]", "c_z[4]", "c_zk[1]", "c_lr[4]", "c_lw[4]", "c_lb[4]", "c_lb[2]", "c_ls[4]", "c_in[4]"] + \
    [f"c_lw[{k}][3]" for k in range(1, 6)]
SIDE, GAP, RADIUS = 4.9e-3, 0.98e-3, 0.5e-3


def hertz(overlap, r_eff):
    return 4 / 3 * 5e6 / 2 / (1 - 0.3 ** 2) * math.sqrt(r_eff * overlap) * overlap


def last_row(out, words):
    return dict(zip(words, thermo_rows(out, len(words) + 1)[-1][1:]))


def plates(suffuse):
    grain_force, wall_force = hertz(2e-5, RADIUS / 2), hertz(1e-5, RADIUS)
    grains_only = 25 * 4 * GAP * grain_force / SIDE ** 3
    with_walls = grains_only + 25 * 2 * (RADIUS - 1e-5) * wall_force / SIDE ** 3
    check(close(grains_only, 4315, 1e-3, 0), f"by hand {grains_only}")
    for boundary in "fms":
        for ranks in (1, 2, 3):
            # The computes before and after the walls: the order in the script does not matter.
            before, after = (COMPUTES, "") if ranks == 2 else ("", COMPUTES)
            out = suffuse.must_run(ranks, PLATES.format(bc=boundary, before=before, after=after, words=" ".join(WORDS)), f"plates{boundary}{ranks}")
            got = last_row(out, WORDS)

            def agree(word, expected, tolerance):
                check(close(got[word], expected, tolerance, 0), f"boundary {boundary}, {ranks} ranks: {word} = {got[word]!r}, by hand {expected!r}")

            agree("c_r[7]", grains_only, 1e-9)
            agree("c_rw[7]", with_walls, 1e-9)
            bed = (SIDE + 2e-5) ** 3
            agree("c_w[7]", with_walls * SIDE ** 3 / bed, 1e-9)
            agree("c_s[7]", grains_only * SIDE ** 3 / (4 / 3 * math.pi * 4.25e-3 ** 3), 2e-4)  # all grains; its volume by points
            # 3 x 3 x 3 grains whole, in as many cells of the array: its own stress and coordination.
            agree("c_k[7]", grain_force / GAP ** 2, 1e-9)
            agree("c_zk[1]", 6, 1e-12)
            agree("c_in[4]", grains_only, 1e-9)
            agree("c_z[1]", 2 * 300 / 125, 1e-12)
            agree("c_z[4]", 600 * 4 / 3 * math.pi * RADIUS ** 3 / SIDE ** 3, 1e-9)
            # The plates cut caps of 10 um off: 3e-4 of a grain's volume and stress each.
            agree("c_lr[4]", grains_only, 1e-3)
            agree("c_lw[4]", with_walls, 1e-3)
            agree("c_lb[4]", with_walls * SIDE ** 3 / bed, 1e-9)
            agree("c_lb[2]", bed / (125 * 4 / 3 * math.pi * RADIUS ** 3) - 1, 1e-9)
            # Whole cells of the array within the bed: grains outside lend their caps, six contacts a grain.
            agree("c_ls[4]", grain_force / GAP ** 2, 2e-3)
            # Layers along z: one of the two contacts of a grain by the plate is with it.
            for k in range(1, 6):
                outer = k in (1, 5)
                force = (GAP / 2 * grain_force + (RADIUS - 1e-5) * wall_force) if outer else GAP * grain_force
                agree(f"c_lw[{k}][3]", 25 * force / (SIDE ** 3 / 5), 1e-2)
            analysed(suffuse, boundary, grains_only)
            told = [line for line in out.splitlines() if "takes the simulation box" in line]
            check(len(told) == 1 and told[0].startswith("compute stress/reduction:"), f"the program should say once that it takes the box:\n{told}")
            check(out.count("contacts with walls are left out") == 4, "the program should say which computes leave walls out")


def analysed(suffuse, boundary, by_hand):
    """The dumps of the last run, of which the box is the plates' only by chance."""
    solids = 125 * 4 / 3 * math.pi * RADIUS ** 3
    for options, volume in ((["--region", 0, SIDE, 0, SIDE, 0, SIDE], SIDE ** 3), (["--bed"], (SIDE + 2e-5) ** 3), (["--volume", SIDE ** 3], SIDE ** 3)):
        code, out, err = suffuse.analyse("contacts", "grains.dump", "pairs.dump", *options, "--output", "series.csv")
        check(code == 0 and "porosity and stresses are of the box" not in out, f"{options}: {out} {err}")
        names, values = (line.split(",") for line in (suffuse.folder / "series.csv").read_text().splitlines())
        row = dict(zip(names, values))
        (suffuse.folder / "series.csv").unlink()
        # Positions to 17 digits, the box in the header to six, which --bed does not read.
        check(close(float(row["mean_stress_pa"]), by_hand * SIDE ** 3 / volume, 1e-9, 0), f"{options}: p' {row['mean_stress_pa']}")
        check(close(float(row["porosity"]), 1 - solids / volume, 1e-9, 0), f"{options}: porosity {row['porosity']}")
    # The inner 3 x 3 x 3 grains in as many cells of the array: its own stress and six contacts a grain.
    code, out, err = suffuse.analyse("contacts", "grains.dump", "pairs.dump", "--region", *(3 * [GAP, 4 * GAP]), "--output", "series.csv")
    check(code == 0, f"{out} {err}")
    names, values = (line.split(",") for line in (suffuse.folder / "series.csv").read_text().splitlines())
    row = {name: float(value) for name, value in zip(names, values) if value}
    (suffuse.folder / "series.csv").unlink()
    check(close(row["mean_stress_pa"], hertz(2e-5, RADIUS / 2) / GAP ** 2, 1e-9, 0), f"core: p' {row['mean_stress_pa']}")
    check(close(row["coordination_number"], 6, 1e-12, 0) and row["grains"] == 27, f"core: Z {row['coordination_number']} of {row['grains']} grains")
    code, out, err = suffuse.analyse("contacts", "grains.dump", "pairs.dump")
    said = "say --bed" in err and code == 1 if boundary == "s" else "porosity and stresses are of the box" in out and code == 0
    check(said, f"boundary {boundary}: nothing said of the box: {out} {err}")
    code, out, err = suffuse.analyse("contacts", "grains.dump", "pairs.dump", "--bed", "--volume", 1)
    check(code == 1 and "one of --volume" in err, err)


STACK = HEADER.format(boundary="p p f") + """
region box block 0 1.2e-3 0 1.2e-3 -0.5e-3 6e-3 units box
create_box 1 box
""" + material(2e-4, "5e6", 0.1, 0.5) + """
create_atoms 1 single 0.6e-3 0.6e-3 0.5e-3
create_atoms 1 single 0.6e-3 0.6e-3 1.5e-3
create_atoms 1 single 0.6e-3 0.6e-3 2.5e-3
create_atoms 1 single 0.6e-3 0.6e-3 3.5e-3
set type 1 diameter 1e-3 density 2650
compute w all stress/layer z 4 bounds 0 4e-3
compute n all stress/layer z 4 bounds 0 4e-3 walls no
compute b all stress/layer z 2 bed
fix m all nve/sphere
fix g all gravity 9.81 vector 0 0 -1
fix drag all viscous 1e-6
{floor}
timestep 5e-6
thermo_style custom step {words}
thermo_modify format float %.17g
thermo 40000
run 40000
{end}
"""
STACK_WORDS = [f"c_{name}[{k}][3]" for name, layers in (("w", 4), ("n", 4), ("b", 2)) for k in range(1, layers + 1)]
PLANE = "fix floor all wall/gran model hertz tangential history primitive type 1 zplane 0"
MESH = """fix plate all mesh/surface file floor.stl type 1
fix floor all wall/gran model hertz tangential history mesh n_meshes 1 meshes plate"""
STL = """solid floor
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1.2e-3 0 0
vertex 1.2e-3 1.2e-3 0
endloop
endfacet
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1.2e-3 1.2e-3 0
vertex 0 1.2e-3 0
endloop
endfacet
endsolid floor
"""


def stack(suffuse):
    """In equilibrium the force on the floor is the weight, and a grain's mean stress that of the weight above its middle."""
    (suffuse.folder / "floor.stl").write_text(STL)
    weight = 2650 * 4 / 3 * math.pi * RADIUS ** 3 * 9.81
    area = 1.2e-3 ** 2
    results = {}
    for name, floor, all_ranks in (("plane", PLANE, (1, 2, 3)), ("mesh", MESH, (1, 2))):
        for ranks in all_ranks:
            out = suffuse.must_run(ranks, STACK.format(floor=floor, words=" ".join(STACK_WORDS), end=""), f"{name}{ranks}")
            lines = [line.split() for line in out.splitlines() if line.split()[:1] == ["40000"] and len(line.split()) == len(STACK_WORDS) + 1]
            got = dict(zip(STACK_WORDS, map(float, lines[0][1:])))
            results[name, ranks] = got
            for k in range(1, 5):
                above = (k - 0.5) * weight / area
                # Grains sink by some um and share their caps with the layer below: 1e-2 of a layer.
                check(close(got[f"c_w[{k}][3]"], above, 1e-2, 0), f"{name}, {ranks} ranks: layer {k} carries {got[f'c_w[{k}][3]']} Pa, the weight above is {above} Pa")
            missing = got["c_w[4][3]"] - got["c_n[4][3]"]
            check(close(missing, 4 * weight * RADIUS / (area * 1e-3), 1e-2, 0), f"without walls the lowest layer lacks {missing} Pa, by hand W r/h")
            check(got["c_n[1][3]"] == got["c_w[1][3]"], "the wall acts on the upper layer")
            check(close(got["c_b[2][3]"], 3 * weight / area, 1e-2, 0), f"the lower half of the bed carries {got['c_b[2][3]']} Pa")
    first = results["plane", 1]
    for key, got in results.items():
        for word, value in got.items():
            check(close(value, first[word], 1e-9, 1), f"{word}: {value!r} with {key}, {first[word]!r} with a plane on one rank")
    print("layers in Pa, from the top: " + ", ".join(f"{first[f'c_w[{k}][3]']:.2f} (walls left out {first[f'c_n[{k}][3]']:.2f}, weight above {(k - 0.5) * weight / area:.2f})"
                                                     for k in range(1, 5)))


def refusals(suffuse):
    words = "step"
    for line, expected in (("compute x all stress/reduction split 1e-3 region nobody", "region = nobody, must exist"),
                           ("compute x all stress/reduction split 1e-3 region cube bed", "must be one of them"),
                           ("compute x all stress/layer z 3 region ball", "must be a block"),
                           ("compute x all stress/layer z 3 walls perhaps", "must be yes or no"),
                           ("region out sphere 2e-3 2e-3 2e-3 1e-3 side out units box\ncompute x all coordination region out", "body at rest"),
                           ("region open block 0 INF 0 1e-3 0 1e-3 units box\ncompute x all coordination region open", "bounded along x")):
        for ranks in (1, 2):
            code, out, err = suffuse.run(ranks, PLATES.format(bc="f", before="", after=line, words=words), "refused")
            check(code == 1 and expected in err, f"{line} on {ranks} ranks: exit code {code}, {err[-500:]}")


def main():
    with tempfile.TemporaryDirectory(prefix="suffuse-test-") as folder:
        suffuse = Suffuse(folder, __doc__)
        plates(suffuse)
        stack(suffuse)
        refusals(suffuse)


if __name__ == "__main__":
    main()
