#!/usr/bin/env python3
"""lbm_between_runs_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

Where the water is not, and what changes between two `lbm run`: a plain `run` moves grains without water, and so is a grain outside of
the water's region; grains of another diameter have other pores; faces keep their kind; guards look at the grains that are there.
"""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import columns, expect, material, program_from_command_line, scratch  # noqa: E402

BOX = """units si
atom_style granular
atom_modify map array
communicate single vel yes
boundary {boundary}
newton off
processors * 1 1
region box block 0 2e-3 0 2e-3 0 {height} units box
create_box 1 box
""" + material(skin=2e-4, modulus="5e6", restitution=0.5, friction=0.3) + """
thermo 1000000
lbm fluid density 1000 viscosity 1e-6
"""
FALLING = "fix motion all nve/sphere\nfix weight all gravity 9.81 vector 0 0 -1\n" \
    "create_atoms 1 single 1e-3 1e-3 {z} units box\nset group all diameter 4e-4 density {density}\ntimestep 1e-6\n"
SAID = 'print "SAID $(vcm(all,z)/(-9.81*v_fallen)) $(f_hydrodynamic_force[3])"\n'


def said(program, folder, text):
    screen = program.must_run(text, folder)
    return [float(word) for word in re.search(r"^SAID (\S+) (\S+)", screen, re.M).groups()]


def check_plain_runs(program, folder):
    """Speed over that of a free fall after 4 ms without water."""
    resolved, averaged = "lbm lattice spacing 1e-4 relaxation_time 0.53\n", "lbm method averaged\nlbm lattice spacing 6.666667e-4 timestep 1e-4\n"
    for lattice, between in ((resolved, ""), (resolved, "lbm clear\n"), (averaged, "")):
        text = BOX.format(boundary="f f f", height="6e-3") + FALLING.format(z="3e-3", density=2650) + lattice + "lbm force gravity 0 0 -9.81\n"
        fall, load = said(program, folder, text + "lbm run 0.01\n" + between + "velocity all set 0 0 0\nvariable fallen equal 4e-3\nrun 4000\n" + SAID)
        expect(abs(fall - 1) < 1e-9, f"{between}a plain run moves a grain with {fall} of free fall's speed")
        expect((load == 0) == bool(between), f"{between}a load of {load} N is left")


def check_dry_grains(program, folder):
    """Above the water's region: heavy, light, with a weight of the water or without."""
    for density, gravity in ((2650, ""), (900, ""), (2650, "lbm force gravity 0 0 -9.81\n")):
        text = BOX.format(boundary="f f f", height="6e-3") + FALLING.format(z="5e-3", density=density) + \
            "region water block 0 2e-3 0 2e-3 0 2e-3 units box\nlbm lattice spacing 1e-4 relaxation_time 0.53 region water\n" + gravity + \
            "variable fallen equal 4e-3\nlbm run 0.004\n" + SAID
        fall, load = said(program, folder, text)
        expect(abs(fall - 1) < 1e-9 and load == 0, f"{density} kg/m3, {gravity}a dry grain falls at {fall} of free fall's speed, load {load} N")


def check_fast_dry_grain(program, folder):
    """Faster than the water could follow, where there is none."""
    text = BOX.format(boundary="f f f", height="6e-3") + FALLING.format(z="5e-3", density=2650) + \
        "region water block 0 2e-3 0 2e-3 0 2e-3 units box\nlbm lattice spacing 1e-4 relaxation_time 0.53 region water\nvelocity all set 0 0 1\n" + \
        "lbm guard motion 0.05\nlbm run 5e-4\n"
    program.must_run(text, folder)


def check_pores(program, folder):
    """Held spheres that have grown have the pores of those that were as large from the beginning."""
    places = "".join(f"create_atoms 1 single {x} {y} {z} units box\n" for x in ("0.5e-3", "1.5e-3") for y in ("0.5e-3", "1.5e-3") for z in ("0.5e-3", "1.5e-3"))
    flows = []
    for first in ("9.9e-4", "7e-4"):
        text = BOX.format(boundary="p p p", height="2e-3") + places + f"set group all diameter {first} density 2650\ntimestep 1e-5\n" + \
            "lbm lattice spacing 2e-4 relaxation_time 0.8\nlbm force pressure_gradient 0 0 10\nlbm monitor m every 1e-2 file flow.csv superficial_velocity\n" + \
            "lbm run 0.01\nset group all diameter 9.9e-4\nlbm run 0.3\n"
        program.must_run(text, folder)
        flows.append(columns(folder / "flow.csv")["superficial_velocity_z_m_per_s"][-1])
        (folder / "flow.csv").unlink()
    expect(abs(flows[1] / flows[0] - 1) < 1e-3, f"spheres that have grown let {flows[1]} m/s through, others {flows[0]}")


def check_faces(program, folder):
    """Of water averaged over cells as of the lattice's."""
    for lattice in ("lbm lattice spacing 1e-4 relaxation_time 0.8\n", "lbm method averaged\nlbm lattice spacing 6.666667e-4 timestep 1e-4\n"):
        text = BOX.format(boundary="p p f", height="4e-3") + "create_atoms 1 single 1e-3 1e-3 2e-3 units box\nset group all diameter 4e-4 density 2650\ntimestep 1e-4\n"
        code, screen = program.run(text + lattice + "lbm run 2e-3\nlbm boundary zlo pressure 1 zhi pressure 0\nlbm run 2e-3\n", folder)
        expect(code == 1 and "stay" in screen and "kind" in screen, f"a face of another kind: code {code}\n{screen[-800:]}")


def check_guard(program, folder):
    """Of grains that come in after the run has begun."""
    text = BOX.format(boundary="f f f", height="6e-3") + "fix motion all nve/sphere\ntimestep 1e-6\nregion top block 5e-4 1.5e-3 5e-4 1.5e-3 4e-3 5.5e-3 units box\n" + \
        "fix p1 all particletemplate/sphere 15485863 atom_type 1 density constant 2650 radius constant 2e-4\n" + \
        "fix p2 all particledistribution/discrete 32452843 1 p1 1.0\n" + \
        "fix ins all insert/pack seed 32452867 distributiontemplate p2 vel constant 0. 0. -0.01 insert_every once overlapcheck yes particles_in_region 1 region top\n" + \
        "lbm lattice spacing 1e-4 relaxation_time 0.8\nlbm guard motion 0.01\nlbm run 0.006\n"
    code, screen = program.run(text, folder)
    expect(code == 4 and "motion of a grain" in screen, f"a grain that came in and is too fast: code {code}\n{screen[-800:]}")


STAGED = "create_atoms 1 single 1e-3 1e-3 2e-3 units box\nset group all diameter 4e-4 density 2650\ntimestep 1e-4\n" \
    "lbm lattice spacing 1e-4 relaxation_time 0.8\nlbm boundary zlo velocity 0 0 1e-3 zhi pressure 0\n"
TICK = 1e-3  # fluid steps of spacing^2 (relaxation_time - 1/2) / (3 viscosity)


def check_changed_outputs(program, folder):
    """A monitor and an output that change their interval from stage to stage: every sample of the run stays, none twice."""
    text, stage = BOX.format(boundary="p p f", height="4e-3") + STAGED, "lbm monitor m every {t} file staged.csv mass\n" \
        "lbm output o every {t} file staged.h5 pressure grains\n"
    for interval, steps in ((2, 13), (3, 12), (5, 12)):
        text += stage.format(t=interval * TICK) + f"lbm run {steps * TICK}\nlbm monitor m off\nlbm output o off\n"
    screen = program.must_run(text, folder)
    rows = columns(folder / "staged.csv")
    want = [t for t in range(0, 13, 2)] + [t for t in range(15, 25, 3)] + [25, 30, 35]
    expect([round(t / TICK) for t in rows["time_s"]] == want, f"rows at {[t / TICK for t in rows['time_s']]}")
    expect(".before" not in screen and not list(folder.glob("staged*.before")), "a file of the run itself was put aside")
    change = rows["mass_change_kg"]
    expect(all(value != 0 for value in change[1:]), f"the change of mass begins anew: {change}")
    for file in ("staged.xdmf", "staged_grains.xdmf"):
        times = [round(float(t) / TICK) for t in re.findall(r'<Time Value="([^"]+)"', (folder / file).read_text())]
        expect(times == sorted([*want, 13]), f"states of {file} at {times}")


def check_other_columns(program, folder):
    """A monitor of other quantities must not take the place of what the same run has written."""
    text = BOX.format(boundary="p p f", height="4e-3") + STAGED + "lbm monitor m every {t} file other.csv mass\nlbm run {run}\nlbm monitor m off\n" \
        "lbm monitor m every {t} file other.csv kinetic_energy\nlbm run {run}\n"
    code, screen = program.run(text.format(t=2 * TICK, run=4 * TICK), folder)
    expect(code == 1 and "other.csv" in screen and "another FILE" in screen, f"other columns in the file of the run: code {code}\n{screen[-800:]}")
    expect(len(columns(folder / "other.csv")["time_s"]) == 3, "rows of the run are lost")


def main():
    program = program_from_command_line(__doc__)
    with scratch() as folder:
        folder = pathlib.Path(folder)
        check_plain_runs(program, folder)
        check_dry_grains(program, folder)
        check_fast_dry_grain(program, folder)
        check_pores(program, folder)
        check_faces(program, folder)
        check_guard(program, folder)
        check_changed_outputs(program, folder)
        check_other_columns(program, folder)
    print(f"{program.ranks} ranks: without water where there is none, and as it is where something has changed")


if __name__ == "__main__":
    main()
