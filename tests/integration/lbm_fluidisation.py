#!/usr/bin/env python3
"""lbm_fluidisation.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

A bed of 150 equal grains in a periodic column: it rests while the gradient is below its critical one, and its effective stress
vanishes where the head lost over it carries its weight in water.
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import HEADER, expect, columns, program_from_command_line, scratch  # noqa: E402

D, WIDTH, GRAINS = 3.5e-4, 5 * 3.5e-4, 150
SOLIDS = GRAINS * 3.14159265358979 / 6 * D ** 3
CRITICAL_HEAD = 1.65 * SOLIDS / WIDTH ** 2  # m: i_cr L = (Gs - 1)(1 - n) L, whatever height L the bed is given
RAMP, HOLD, RISE = 0.06, 0.03, 0.08         # s

SCENE = HEADER.format(boundary="p p f") + f"""
processors 1 1 *
region column block 0 {WIDTH} 0 {WIDTH} 0 {12 * D} units box
create_box 1 column
neighbor 5e-5 bin
neigh_modify delay 0
fix modulus all property/global youngsModulus peratomtype 5e6
fix ratio all property/global poissonsRatio peratomtype 0.3
fix restitution all property/global coefficientRestitution peratomtypepair 1 0.3
fix friction all property/global coefficientFriction peratomtypepair 1 0.3
pair_style gran model hertz tangential history
pair_coeff * *
fix motion all nve/sphere
fix weight all gravity 9.81 vector 0 0 -1
fix floor all wall/gran model hertz tangential history primitive type 1 zplane 0
fix lid all wall/gran model hertz tangential history primitive type 1 zplane {12 * D}
fix size all particletemplate/sphere 11593 atom_type 1 density constant 2650 radius constant {D / 2}
fix sizes all particledistribution/discrete 32452843 1 size 1
fix insertion all insert/pack seed 32452867 distributiontemplate sizes insert_every once overlapcheck yes &
    particles_in_region {GRAINS} region column ntry_mc 20000
timestep 1e-9
run 1
unfix insertion
dem_timestep rayleigh 0.2 pressure 50
thermo 20000
run $(ceil(0.15/dt))

compute layers all stress/layer z 1 bounds {0.5 * D} {2.5 * D}
variable head equal 0
variable pressure equal 9810*v_head
lbm fluid density 1000 viscosity 1e-6
lbm lattice spacing {D / 5} relaxation_time 0.515
lbm boundary xlo periodic xhi periodic ylo periodic yhi periodic zlo pressure v_pressure zhi pressure 0
lbm force gravity 0 0 -9.81
lbm run 0.03

lbm monitor flow every 5e-4 file flow.csv superficial_velocity solid_force hydraulic_gradient v_head as head_m c_layers[1][3] as stress_pa
variable start equal $(step*dt)
variable head equal {CRITICAL_HEAD}*0.8*(step*dt-v_start)/{RAMP}
write_dump_here rest
lbm run {RAMP}
variable head equal {CRITICAL_HEAD}*0.8
write_dump_here held
lbm run {HOLD}
write_dump_here after
variable start equal $(step*dt)
variable head equal {CRITICAL_HEAD}*(0.8+0.4*(step*dt-v_start)/{RISE})
lbm run {RISE}
write_dump_here lifted
"""


def with_dumps(text):
    """The lines `write_dump_here NAME` as dumps of one snapshot."""
    lines = []
    for line in text.splitlines():
        if line.startswith("write_dump_here"):
            name = line.split()[1]
            line = f"dump {name} all custom 1 {name}.dump id x y z\ndump_modify {name} format \"%d %.12g %.12g %.12g\"\nrun 0\nundump {name}"
        lines.append(line)
    return "\n".join(lines) + "\n"


def positions(path):
    rows = [line.split() for line in path.read_text().split("ITEM: ATOMS")[-1].splitlines()[1:]]
    return {int(row[0]): [float(word) for word in row[1:]] for row in rows}


def largest_move(one, other):
    def along(axis, shift):
        return abs(shift - (round(shift / WIDTH) * WIDTH if axis < 2 else 0))
    return max(max(along(axis, b - a) for axis, (a, b) in enumerate(zip(one[grain], other[grain]))) for grain in one) / D


def vanishing_head(heads, stresses):
    """Head where the stress vanishes: the line through its fall from nine tenths to a fifth of what it was."""
    points = [(h, s / stresses[0]) for h, s in zip(heads, stresses) if 0.2 < s / stresses[0] < 0.9]
    expect(len(points) > 20, f"only {len(points)} samples while the stress falls")
    n = len(points)
    mean_h, mean_s = sum(h for h, _ in points) / n, sum(s for _, s in points) / n
    slope = sum((h - mean_h) * (s - mean_s) for h, s in points) / sum((h - mean_h) ** 2 for h, _ in points)
    return mean_h - mean_s / slope


def main():
    program = program_from_command_line(__doc__)
    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        program.must_run(with_dumps(SCENE), folder, timeout=500)
        series = columns(folder / "flow.csv")
        rest, held, after, lifted = (positions(folder / f"{name}.dump") for name in ("rest", "held", "after", "lifted"))
        critical = vanishing_head(series["head_m"], series["stress_pa"]) / CRITICAL_HEAD
        moves = [largest_move(rest, held), largest_move(held, after), largest_move(after, lifted)]
        print(f"{program.ranks} ranks: critical gradient over Terzaghi's {critical:.4f}; largest move up to 0.8 {moves[0]:.4f} diameters, "
              f"held there {moves[1]:.5f}, up to 1.2 {moves[2]:.3f}")
        # The layer's stress is that of the grains above it, whose share of the head differs by the porosity's scatter along the bed.
        expect(abs(critical - 1) < 0.03, f"critical gradient {critical} of Terzaghi's")
        # Hertz contacts of 5 MPa under 30 Pa: (1.5 (1 - nu^2) p/E)^(2/3) = 4e-4 of a bed of five diameters, and grains that are
        # hardly loaded settle into other places by some more.
        expect(moves[0] < 0.05, f"grains move by {moves[0]} diameters below 0.8 of the critical gradient")
        expect(moves[1] < 0.005, f"grains move by {moves[1]} diameters while 0.8 of the critical gradient is held")
        expect(moves[2] > 0.1, f"grains move by {moves[2]} diameters only above the critical gradient")


if __name__ == "__main__":
    main()
