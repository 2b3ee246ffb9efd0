#!/usr/bin/env python3
"""lbm_held_grains_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

Grains that are held, by having no integrator or by fixes of the script, in flowing water: all fixes act in every step that they
ask for; loads do not depend on how often they are looked at; what `freeze`, `setforce` and `fix move` hold stays held
whatever the order of the lines; a weight that is reduced by buoyancy is spoken of.
"""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import columns, expect, program_from_command_line, scratch  # noqa: E402

HEAD = """
units si
atom_style granular
atom_modify map array
communicate single vel yes
newton off
boundary p p {z}
region box block 0 {lx} 0 {lx} 0 {lz} units box
create_box 2 box
neighbor 1e-4 bin
neigh_modify delay 0
fix y all property/global youngsModulus peratomtype 5e6 5e6
fix nu all property/global poissonsRatio peratomtype 0.3 0.3
fix e all property/global coefficientRestitution peratomtypepair 2 0.5 0.5 0.5 0.5
fix mu all property/global coefficientFriction peratomtypepair 2 0.5 0.5 0.5 0.5
pair_style gran model hertz tangential history
pair_coeff * *
"""

# One sphere of eight cells that no fix moves, in a periodic box.
SPHERE = HEAD.format(z="p", lx="1e-3", lz="1e-3") + """
create_atoms 1 single 0.52e-3 0.5e-3 0.47e-3
set type 1 diameter 4e-4 density 2650
timestep 2.5e-4
fix h all hydrodynamic/force
variable t equal step*dt
variable fz equal f_h[3]
thermo_style custom step v_fz
thermo 1000000
lbm fluid density 1000 viscosity 1e-6
lbm lattice spacing 5e-5 relaxation_time 0.8
"""

# A layer that shall be held, and one above it that sinks.
BASE = HEAD.format(z="f", lx="2e-3", lz="4e-3") + """
lattice sc 5e-4 origin 0.5 0.5 0.5
region bottom block INF INF INF INF 0 4.9e-4 units box
region upper block INF INF INF INF 1.2e-3 1.7e-3 units box
create_atoms 1 region bottom
create_atoms 2 region upper
set group all diameter 4e-4 density 2650
group base type 1
group top type 2
timestep 1.25e-5
{hold}
compute d base displace/atom
compute far base reduce max c_d[4]
compute dt top displace/atom
compute sunk top reduce max c_dt[4]
thermo_style custom step c_far c_sunk
thermo 100
run 0
{late}
lbm fluid density 1000 viscosity 1e-6
lbm lattice spacing 1e-4 relaxation_time 0.5375
lbm force gravity 0 0 -9.81
lbm couple substeps 10
lbm boundary zlo noslip zhi noslip
lbm effect lubrication {films}
lbm run 5e-3
run 100
variable far equal c_far
variable sunk equal c_sunk
print "moved ${{far}} sunk ${{sunk}}"
"""
GRAVITY = "fix g all gravity 9.81 vector 0 0 -1\n"


def rows(path):
    return [[float(word) for word in line.split()] for line in path.read_text().splitlines() if not line.startswith("#")]


def check_fixes_act(program, folder):
    """`fix print`, `fix ave/time` and `fix adapt` as in `run`: 200 steps, a line every 20; a sphere that grows by 2 % has grown, and
    its drag with it. In Stokes flow the drag of a sphere in a steadily driven box is G V_box whatever its size, so that the growing
    sphere's ends within the fluid's inertia of it: bounds 3.9e-10 to 4.1e-10 N around the value of a sphere that always had this
    size (3.96e-10 N)."""
    out = "fix out all print 20 \"${t} ${fz}\" file drag.txt screen no\nfix av all ave/time 1 20 20 f_h[3] file ave.txt\n"
    drive = "lbm force pressure_gradient 0 0 1\nlbm run 0.05\n"
    program.must_run(SPHERE + out + drive, folder)
    drag, mean = rows(folder / "drag.txt"), rows(folder / "ave.txt")
    expect([round(row[0] / 5e-3) for row in drag] in (list(range(11)), list(range(1, 11))), f"fix print wrote {drag}")
    expect([row[0] for row in mean] == [20 * k for k in range(1, 11)], f"fix ave/time wrote {mean}")
    # The mean of twenty steps up to one lies between the values at its ends: the drag rises all the time.
    by_step = {round(row[0] / 2.5e-4): row[1] for row in drag}
    for step, value in mean[1:]:
        expect(by_step[step - 20] < value < by_step[step], f"mean {value} at {step} not between its ends")
    grow = "variable d equal 4e-4*(1+step*1e-4)\nfix grow all adapt 10 atom diameter v_d\n" \
        "compute r all property/atom diameter\ncompute rr all reduce max c_r\nvariable size equal c_rr\n"
    screen = program.must_run(SPHERE + grow + drive.replace("lbm run", "thermo_style custom step c_rr f_h[3]\nlbm run"), folder)
    last = [line.split() for line in screen.splitlines() if re.fullmatch(r"\s*200(\s+[-+.e\d]+){2}\s*", line)][-1]
    expect(abs(float(last[1]) - 4.08e-4) < 1e-9, f"fix adapt leaves a diameter of {last[1]}")
    expect(3.9e-10 < float(last[2]) < 4.1e-10, f"a swollen grain's drag is {last[2]} N")


def check_loads_do_not_depend_on_looks(program, folder):
    """Oscillating flow, looked at every 1, 10 and 50 steps by monitors and thermo output: the same values, to the last digit; the mean
    of two steps' loads as well, and a run that was saved and taken up between two looks."""
    base = SPHERE + "variable G equal cos(2*PI*step*dt/0.05)\nlbm force pressure_gradient 0 0 v_G\n"
    for couple in ("", "lbm couple average_force yes\n"):
        curves = {}
        for steps in (1, 10, 50):
            monitor = f"lbm monitor m every {steps * 2.5e-4} file every_{steps}.csv solid_force\n"
            program.must_run(base + couple + monitor + "lbm run 0.1\n", folder)
            series = columns(folder / f"every_{steps}.csv")
            curves[steps] = dict(zip((round(time / 2.5e-4) for time in series["time_s"]), series["solid_force_z_n"]))
        expect(len(curves[50]) == 9 and len(curves[1]) == 401, "samples missing")
        for steps in (10, 50):
            for step, value in curves[steps].items():
                expect(value == curves[1][step], f"at step {step} the load is {value}, {curves[1][step]} if every step is looked at")
    parts = "write_restart nothing\nlbm monitor m every 2.5e-2 file parts.csv solid_force\nlbm run 0.0325\nlbm run 0.0675\n"
    program.must_run(base + parts, folder)
    program.must_run(base + "lbm monitor m every 2.5e-4 file all.csv solid_force\nlbm run 0.1\n", folder)
    whole = dict(zip(map(round4, columns(folder / "all.csv")["time_s"]), columns(folder / "all.csv")["solid_force_z_n"]))
    series = columns(folder / "parts.csv")
    for time, value in zip(series["time_s"], series["solid_force_z_n"]):
        expect(value == whole[round4(time)], f"in two runs the load at {time} s is {value}, not {whole[round4(time)]}")


def round4(time):
    return round(time / 2.5e-4)


def check_held_stays_held(program, folder):
    """Frozen grains do not move at all; those that are free sink."""
    integrate = "fix m all nve/sphere\n"
    cases = [(GRAVITY + integrate + "fix f base freeze", "", "off"), (GRAVITY + "fix f base freeze\n" + integrate, "", "on"),
             ("fix f base setforce 0 0 0\n" + integrate, GRAVITY + "unfix g\n", "off"),
             (GRAVITY + integrate, "fix h all hydrodynamic/force\nfix f base freeze", "on"),
             (GRAVITY + integrate + "fix f base freeze", "fix h all hydrodynamic/force", "on"),
             (GRAVITY + "fix m top nve/sphere\nfix f base move linear 0 0 0", "", "off")]
    for hold, late, films in cases:
        screen = program.must_run(BASE.format(hold=hold, late=late, films=films), folder)
        far, sunk = [float(word) for word in screen.split("moved ")[-1].split()[0:3:2]]
        expect(far == 0, f"grains that `{hold}` and `{late}` hold move by {far} m")
        expect(sunk > 1e-6, f"nothing sinks: {sunk} m")
    moved = BASE.format(hold=GRAVITY + "fix m top nve/sphere\nfix f base move linear 1e-2 0 0", late="", films="off")
    screen = program.must_run(moved, folder)
    far = float(screen.split("moved ")[-1].split()[0])
    # 5 ms in the water and 100 steps of 12.5 us without, at 1 cm/s.
    expect(abs(far / (1e-2 * (5e-3 + 1.25e-3)) - 1) < 1e-9, f"fix move goes {far} m")
    code, screen = program.run(moved.replace("timestep 1.25e-5", "timestep 1.2e-5").replace("substeps 10", "substeps auto"), folder)
    expect(code == 1 and "`timestep 1.136363636e-05` before `fix f ... move`" in screen, f"fix move and another step: {screen[-400:]}")
    twice = BASE.format(hold=GRAVITY + integrate, late="fix h all hydrodynamic/force\nfix h all hydrodynamic/force", films="off")
    program.must_run(twice, folder)


def check_reduced_weight(program, folder):
    note = "note: `fix gravity` weighs grains with 5.886 m/s^2, `lbm force gravity` the water with 9.81"
    for weight, said in (("9.81", False), ("5.886", True)):
        hold = f"fix g all gravity {weight} vector 0 0 -1\nfix m all nve/sphere"
        screen = program.must_run(BASE.format(hold=hold, late="", films="off"), folder)
        expect((note in screen) == said, f"a weight of {weight} m/s^2: {screen[-2500:]}")
    screen = program.must_run(BASE.format(hold=hold, late="lbm effect buoyancy off", films="off"), folder)
    expect(note not in screen, "a note where there is no buoyancy")


def main():
    program = program_from_command_line(__doc__)
    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        check_fixes_act(program, folder)
        check_loads_do_not_depend_on_looks(program, folder)
        check_held_stays_held(program, folder)
        check_reduced_weight(program, folder)
    print(f"{program.ranks} ranks: what is held stays held, and is looked at without harm")


if __name__ == "__main__":
    main()
