#!/usr/bin/env python3
"""lbm_effects_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

Effects that switch themselves while grains fall, stir the water and come to rest: told in one line each, written as JSON beside the
outputs, the same on one rank and on N, and after a restart before a change.
"""
import json
import pathlib
import re
import shutil
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import Program, expect, program_from_command_line, scratch  # noqa: E402
from wet_scenes import SPACING, WATER, wet_box  # noqa: E402

STEP = 0.005 * SPACING**2 / 1e-6  # s, of the fluid at relaxation time 0.515
SERIES = "lbm monitor m every 4e-3 file {name}.csv superficial_velocity kinetic_energy solid_force\n"
CHANGE = re.compile(r"^lbm run: (\w+(?: \w+)?) (on|off) from ([-+.\de]+) s: (.*)$", re.M)


def changes(screen):
    return [(name, state, float(time)) for name, state, time, _ in CHANGE.findall(screen)]


def falling(name, restart="start", more=""):
    """Grains that fall through water from where they were placed."""
    return wet_box(restart=restart).replace("atom_modify sort 0 0\n", "") + WATER + SERIES.format(name=name) + more


def check_changes(program, folder):
    """The collision follows the grains' fall; a state saved before it changes goes on."""
    saved = "lbm restart write {0}.state every 1.9e-2\nlbm run until 0.048\n"
    screen = program.must_run(falling("whole", more=saved.format("whole")), folder)
    told = changes(screen)
    # At the first look, at 0.0195 s, the fastest grain has 8.9 viscosities a cell (3 are the limit), at the second the water 11.7 (30): on any ranks.
    expect([(name, state, round(time / STEP)) for name, state, time in told] == [("comoving", "on", 250)],
           f"changes told: {told}\n{screen[-1500:]}")
    report = json.loads((folder / "effects.json").read_text())
    effects = {effect["name"]: effect for effect in report["effects"]}
    expect(effects["lubrication"]["on"] and effects["lubrication"]["number"] in ("Stokes number", "solid fraction"), f"{effects['lubrication']}")
    comoving = effects["comoving"]
    last = [change for change in told if change[0] == "comoving"][-1]
    expect(comoving["asked"] == "auto" and abs(comoving["changed_at_s"] - last[2]) < 1e-6 and comoving["on"] == (last[1] == "on"), f"{comoving} after {told}")
    expect(0 < comoving["share_of_steps"] < 1 and 0 <= comoving["share_of_time"] < 0.5, f"{comoving}")
    expect(comoving["limit"] == 3 and comoving["release"] == 1.5, f"{comoving}")
    shares = [effect["share_of_time"] for effect in report["effects"] if effect["share_of_time"] is not None]
    most = 1.05 if program.ranks == 1 else 1.3  # each is the slowest rank's, and another one may be slowest in each
    expect(0.8 < sum(shares) < most, f"shares add up to {sum(shares)}: {report}")
    rows = (folder / "whole.csv").read_text()
    shutil.copy(folder / "whole.csv", folder / "again.csv")
    again = program.must_run(falling("again", "whole.state.1/grains", "lbm restart read whole.state.1\n" + saved.format("again")), folder)
    expect((folder / "again.csv").read_text() == rows, "a run from a state before the change differs in its rows")
    expect("as in the saved state" in again and changes(again) == told, f"changes {told} became {changes(again)} after a restart at 0.019 s")
    return told


PAIR = """
create_atoms 1 single 2e-3 2e-3 0.5e-3
create_atoms 1 single 2e-3 2e-3 1.95e-3
set group all diameter 1e-3
set group all density 2650
neigh_modify delay 0
"""


def check_films(program, folder):
    """Films end, in the middle of a run, when a grain has come to rest on another: two grains fill 0.5 of the box around them at a gap of
    a tenth of a diameter. Their contact goes on, and a state saved after it as well."""
    def pair(name, restart=None, more=""):
        grains = "" if restart else PAIR
        return wet_box(grains=0, restart=restart).replace("atom_modify sort 0 0\n", "") + grains + WATER + SERIES.format(name=name) + \
            f"lbm restart write {name}.state every {600 * STEP!r}\n" + more + f"lbm run until {900 * STEP!r}\n"
    screen = program.must_run(pair("two"), folder)
    told = [change for change in changes(screen) if change[0] == "lubrication"]
    expect([change[1] for change in told] == ["off"] and 0 < told[0][2] < 590 * STEP, f"films: {told}\n{screen[-1500:]}")
    shutil.copy(folder / "two.csv", folder / "more.csv")
    again = program.must_run(pair("more", "two.state/grains", "lbm restart read two.state\n"), folder)
    expect((folder / "more.csv").read_text() == (folder / "two.csv").read_text(), "a run without films goes on otherwise after a restart")
    expect("lubrication off as in the saved state" in again, f"films after the restart:\n{again[:3000]}")


def check_films_between_runs(program, folder):
    """Films are water's: LIGGGHTS's own `run` has none, nor does it mind that a grain has become smaller than films were made for."""
    lines = wet_box(grains=0) + PAIR + WATER + f"lbm effect lubrication on\nlbm run until {20 * STEP!r}\n"
    program.must_run(lines + f"set atom 1 diameter 5e-4\nrun 10\nlbm run until {40 * STEP!r}\n", folder)
    code, screen = program.run(lines + "unfix suffuse_lubrication\n", folder)
    expect(code == 1 and "fix" in screen, f"films are there between two runs:\n{screen[-800:]}")


MEETING = """
create_atoms 1 single 2e-3 2e-3 2e-3
create_atoms 1 single 2e-3 2e-3 3.02e-3
set group all diameter 1e-3
set group all density 2650
neigh_modify delay 0
group lower id 1
group upper id 2
velocity upper set 1e-3 0 -1e-3
compute spin all erotate/sphere
"""
LEFT = f"lbm run {20 * STEP!r}\n" + 'variable spin equal c_spin\nvariable speed equal vcm(upper,z)\nthermo_style custom step c_spin\nrun 0\nprint "LEFT ${speed} ${spin}"\n'


def meeting(program, folder, lines="", effects="lubrication on", fluid_of="all", region=""):
    """Two grains that meet at 1 mm/s without gravity: the upper one's speed and the spin of both (J) after 20 steps, and what was said."""
    box = re.sub("fix weight.*\n", "", wet_box(grains=0, processors="* * 1")).replace("fix hydrodynamic_force all hydrodynamic/force\n", "")
    text = box + MEETING + f"fix hydrodynamic_force {fluid_of} hydrodynamic/force\n" + lines + \
        re.sub("lbm force.*\n", "", WATER).replace("spacing", region + "spacing") + f"lbm effect {effects}\n" + LEFT
    screen = program.must_run(text, folder)
    return [float(word) for word in re.search(r"^LEFT (\S+) (\S+)", screen, re.M).groups()], screen


def check_films_where_water_is(program, folder):
    """Films that the run adds lie in the water, between grains that the fluid knows, and turn grains where water does; those of the script
    are told as they act."""
    (speed, spin), _ = meeting(program, folder)
    expect(speed > -5e-4 and spin > 0, f"a film leaves {speed} m/s and a spin of {spin} J")
    (speed, spin), _ = meeting(program, folder, effects="lubrication on rotation off")
    expect(speed > -5e-4 and spin == 0, f"with rotation off a film leaves {speed} m/s and a spin of {spin} J")
    (speed, spin), _ = meeting(program, folder, "region wet block 0 4e-3 0 4e-3 0 1.25e-3 units box\n", region="region wet ")
    expect(speed == -1e-3 and spin == 0, f"two dry grains have a film: {speed} m/s, {spin} J")
    (speed, spin), _ = meeting(program, folder, fluid_of="lower")
    expect(speed == -1e-3, f"a film with a grain that the fluid does not know: {speed} m/s")
    _, screen = meeting(program, folder, f"fix gap all lubrication viscosity 1e-3 outer {SPACING / 2} inner 1e-6\n", effects="lubrication off")
    expect(re.search("lubrication +on +`fix gap lubrication` of the script", screen), f"films of the script:\n{screen[:3000]}")


def check_asked(program, folder):
    """Words have the last say; the averaged flow and other collisions have none of it."""
    lines = "lbm effect comoving off turbulence off lubrication off\nlbm run 4e-3\n"
    screen = program.must_run(falling("asked", more=lines), folder)
    for name in ("comoving", "turbulence", "lubrication"):
        expect(re.search(rf"{name} +off as asked for", screen), f"{name} is not off:\n{screen[:3000]}")
    expect(not changes(screen), f"{changes(screen)} although asked to be off")
    screen = program.must_run(falling("named", more="lbm collision trt\nlbm run 4e-3\n"), folder)
    expect("comoving    off as asked for" in screen, f"`lbm collision trt` is no last word:\n{screen[:3000]}")
    code, screen = program.run(falling("bad", more="lbm collision bgk\nlbm effect comoving on\nlbm run 4e-3\n"), folder)
    expect(code == 1 and "comoving = on" in screen and "lbm collision bgk" in screen, f"exit code {code}: {screen[-500:]}")


def check_grains_let_go(program, folder):
    """Grains held in a first run have no torque and no films; let go, they have both."""
    text = falling("held").replace("fix motion all nve/sphere\n", "")
    expect("nve/sphere" not in text, "something moves the grains")
    screen = program.must_run(text + "lbm run 1e-3\nfix motion all nve/sphere\nlbm run 1e-3\n", folder)
    told = {name: state for name, state, _ in changes(screen)}
    for name in ("motion", "rotation", "lubrication"):
        expect(told.get(name) == "on", f"{name} of grains that were let go: {told}")


def main():
    program = program_from_command_line(__doc__)
    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        Program(program.suffuse, program.mpirun, 1).must_run(wet_box() + "write_restart start\n", folder)
        told = check_changes(program, folder)
        check_films_where_water_is(program, folder)
        if program.ranks == 1:
            check_films(program, folder)
            check_films_between_runs(program, folder)
            check_asked(program, folder)
            check_grains_let_go(program, folder)
    print(f"{program.ranks} ranks: effects follow the scene, and a restart follows them: {told}")


if __name__ == "__main__":
    main()
