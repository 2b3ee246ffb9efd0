#!/usr/bin/env python3
"""lbm_run_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

Grains and water in runs of `suffuse`: the same on one rank and on N; LIGGGHTS's own output as in `run`; what is
written at intervals; runs that go on from a restart; grains that come and go.
"""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import Program, columns, expect, program_from_command_line, scratch  # noqa: E402
from wet_scenes import WATER, wet_box  # noqa: E402

MONITOR = """
variable inlet equal 2*step*dt/1e-2
lbm boundary zlo pressure v_inlet zhi pressure 0
variable highest equal bound(all,zmax)
lbm monitor flow every 1e-3 file flow.csv layers 0 4e-3 4 superficial_velocity hydraulic_gradient layer_gradient &
    layer_porosity layer_pressure solid_force mean_force all mass discharge kinetic_energy bed grains grains_left 0.8e-3 &
    extremes v_highest as highest_m c_Z[1] as Z
lbm output fields every 4e-3 file bed.h5 velocity pressure solid_fraction grains
"""
COMPUTE = "compute Z all coordination\n"


def positions(path):
    """Positions and loads by id of the last snapshot of a dump."""
    lines = path.read_text().split("ITEM: ATOMS")[-1].splitlines()[1:]
    return {int(line.split()[0]): [float(word) for word in line.split()[1:]] for line in lines}


DUMP = """
dump grains all custom {every} grains.dump id x y z vx vy vz f_hydrodynamic_force[1] f_hydrodynamic_force[3]
dump_modify grains format "%d %.16g %.16g %.16g %.16g %.16g %.16g %.16g %.16g" sort id
"""


def check_ranks(program):
    """12 ms of settling and inflow on N ranks and on one. Forces of contacts are summed in another order, which collisions
    amplify: positions agree to 1e-9 of the box until then, not to the last digit."""
    states = []
    with scratch() as folder:
        path = pathlib.Path(folder)
        # LIGGGHTS places grains differently on other rank counts: all start from one file.
        Program(program.suffuse, program.mpirun, 1).must_run(wet_box() + "write_restart start\n", folder)
        text = wet_box(restart="start") + WATER + COMPUTE + MONITOR + DUMP.format(every=4000) + \
            "thermo 2000\nlbm run 12e-3\n"
        for ranks in sorted({1, program.ranks}):
            screen = Program(program.suffuse, program.mpirun, ranks).must_run(text, folder, timeout=300)
            states.append(positions(path / "grains.dump"))
            check_output(path, screen, columns(path / "flow.csv"))
        if len(states) > 1:  # the second run has kept what the first one left
            for name in ("flow.csv", "bed.h5", "bed.xdmf", "bed_grains.h5", "bed_grains.xdmf"):
                expect(f"note: {name} of an earlier run is now {name}.before" in screen and (path / f"{name}.before").exists(),
                       f"{name} of the first run is gone without a word")
            expect(len(columns(path / "flow.csv.before")["time_s"]) == 12, "flow.csv.before is not whole")
    one, many = states[0], states[-1]
    expect(len(one) == 40 and one.keys() == many.keys(), f"{len(one)} and {len(many)} grains")
    largest = max(abs(a - b) for grain in one for a, b in zip(one[grain][:3], many[grain][:3]))
    expect(largest < 4e-12, f"positions differ by {largest} m between 1 and {program.ranks} ranks")
    return largest


def check_drag_note(program):
    """Grains that settle at 6 viscosities a cell are too fast for TRT, and the run says so; the operator that it names says
    nothing."""
    note = "note: grains moved at up to"
    with scratch() as folder:
        for collision, said in (("trt", True), ("trt_comoving", False)):
            screen = program.must_run(wet_box() + WATER + f"lbm collision {collision}\nlbm run 8e-3\n", folder)
            expect((note in screen) == said, f"with {collision}: {screen[-600:]}")


def check_closed_box(program):
    """Water that grains stir in a closed box: none comes in, and its balance of mass is nothing but round-off."""
    for axis in "zx":  # across walls, and across periodic faces
        with scratch() as folder:
            program.must_run(wet_box() + WATER + f"lbm monitor m every 1e-3 file m.csv axis {axis} mass discharge\nlbm run 6e-3\n", folder)
            series = columns(pathlib.Path(folder) / "m.csv")
        stirred = max(abs(flux) for flux in series[f"discharge_{axis}lo_m3_per_s"]) * 1000 * 6e-3
        balance = max(abs(value) for value in series["mass_balance_kg"])
        # Fluxes through the first and last plane of cells are no inflow; they would make 1e-9 kg of it.
        expect(balance < 1e-9 * stirred, f"across {axis}: {balance} kg of {stirred} kg stirred")


def check_lost_flow(program):
    """An inflow that becomes too fast ends the run before a row of it is written."""
    rising = "variable fast equal 0.2*step*dt/4e-3\nlbm boundary zlo velocity 0 0 v_fast zhi pressure 0\n"
    monitor = "lbm monitor m every 2e-5 file m.csv extremes\n"
    with scratch() as folder:
        code, screen = program.run(wet_box(grains=0) + WATER + rising + monitor + "lbm run 1\n", folder)
        expect(code == 4 and "Mach number" in screen and "the run ended after fluid step" in screen, f"the run ended with {code}: {screen[-600:]}")
        mach = columns(pathlib.Path(folder) / "m.csv")["largest_mach"]
        # The inlet gains 0.0018 of Mach between two samples.
        expect(0.28 < mach[-1] <= 0.3, f"the last rows have Mach numbers {mach[-3:]}")


def check_changed_lines(program):
    """Monitors and outputs that are written anew between two runs are what they say then."""
    lines = "lbm monitor m every {every} file {name}.csv {quantity}\nlbm output o every 1e-3 file {name}.h5 {field}\nlbm run 2e-3\n"
    with scratch() as folder:
        program.must_run(wet_box(grains=4) + WATER + lines.format(every=1e-3, name="first", quantity="mass", field="velocity") +
                         "lbm monitor m off\nlbm output o off\n" + lines.format(every=5e-4, name="second", quantity="bed", field="pressure"), folder)
        first, second = (columns(pathlib.Path(folder) / f"{name}.csv") for name in ("first", "second"))
        expect(len(first["time_s"]) == 3 and len(second["time_s"]) >= 4, f"{len(first['time_s'])} and {len(second['time_s'])} rows")
        expect("bed_height_m" in second and "bed_height_m" not in first, "columns of the second monitor")
        expect((pathlib.Path(folder) / "second.h5").exists(), "no file of the second output")
        # In a run that goes on a monitor written anew keeps the rows of its file, those since the saved state too.
        monitor = "lbm monitor m every {} file kept.csv mass\n"
        program.must_run(wet_box(grains=4) + WATER + monitor.format(1e-3) + "lbm run 2e-3\nlbm restart write saved\n", folder)
        program.must_run(wet_box(restart="saved.grains") + WATER + monitor.format(1e-3) + "lbm restart read saved\nlbm run 2e-3\n" +
                         "lbm monitor m off\n" + monitor.format(5e-4) + "lbm run 2e-3\n", folder)
        times = columns(pathlib.Path(folder) / "kept.csv")["time_s"]
        expect(len(times) >= 9 and times == sorted(set(times)), f"rows at {times}")


def check_output(folder, screen, series):
    steps = [int(line.split()[0]) for line in screen.splitlines() if re.fullmatch(r"\s*\d+\s+\d+\s+[-+.e\d ]+", line)]
    expect(sorted(set(steps)) == sorted(steps) or steps.count(steps[0]) <= 2, f"thermo lines {steps}")
    expect(screen.count("Setting up run") <= 3, "LIGGGHTS is set up anew within a run")
    for word in ("lbm run: lattice", "buoyancy", "on  the fluid has weight", "solid mapping", "grains (LIGGGHTS)"):
        expect(word in screen, f"no '{word}' on the screen:\n{screen[-2000:]}")
    times = series["time_s"]
    expect(len(times) == 12 and all(abs(time - k * 1e-3) < 0.02e-3 * k + 1e-12 for k, time in enumerate(times)), f"samples at {times}")
    for layer in range(1, 5):
        expect(f"hydraulic_gradient_layer_{layer}" in series and f"pressure_layer_{layer}_pa" in series, "layers missing")
    expect(all(value == 40 for value in series["grains"]), f"grains {series['grains']}")
    expect(all(value == 0 for value in series["grains_left_below_0.0008_m"]), "grains counted as left")
    # The solids in the cells are the grains: 12 grains of 1 mm and 28 of 0.6 mm or the like, by the dump's masses.
    expect(series["fluid_mass_kg"][0] < 0.08e-3 and series["bed_porosity"][-1] < 1, "no solids in the fluid's cells")
    names = sorted(path.name for path in folder.iterdir())
    for name in ("bed.h5", "bed.xdmf", "bed_grains.h5", "bed_grains.xdmf", "grains.dump"):
        expect(name in names, f"{name} missing among {names}")


def check_restart(program):
    """A run in two parts, with a pause between them, and one that ends at the pause and goes on in a new process: the
    same to the last digit."""
    grid = f"{program.ranks} 1 1"
    water = WATER + "lbm boundary zlo pressure 1 zhi pressure 0\n"
    last = DUMP.format(every=100) + "lbm run 4e-3\n"
    with scratch() as folder:
        path = pathlib.Path(folder)
        Program(program.suffuse, program.mpirun, 1).must_run(wet_box() + "write_restart start\n", folder)
        program.must_run(wet_box(processors=grid, restart="start") + water + "lbm run 4e-3\nlbm restart write half.h5\n" + last,
                         folder)
        whole = positions(path / "grains.dump")
        expect(len(whole) == 40, f"{len(whole)} grains")
        program.must_run(wet_box(processors=grid, restart="half.h5.grains") + water + "lbm restart read half.h5\n" + last,
                         folder)
        second = positions(path / "grains.dump")
        late = wet_box(processors=grid, restart="half.h5.grains").replace("fix hydrodynamic_force all hydrodynamic/force\n", "")
        code, screen = program.run(late + "run 0\n" + water + "lbm restart read half.h5\nlbm run 4e-3\n", folder)
        expect(code == 1 and "without the loads of the grains" in screen, f"a restart without loads: {code}\n{screen[-500:]}")
        late = wet_box(processors=grid, restart="half.h5.grains")
        code, screen = program.run(late + "run 10\n" + water + "lbm restart read half.h5\nlbm run 4e-3\n", folder)
        expect(code == 1 and "meet grains of that step" in screen, f"grains of another step: {code}\n{screen[-500:]}")
    expect(whole.keys() == second.keys(), "grains differ after a restart")
    different = [grain for grain in whole if whole[grain] != second[grain]]
    expect(not different, f"{len(different)} grains differ, first {whole[different[0]]} {second[different[0]]}" if different else "")


def check_time_over_restart(program):
    """A head that follows the water's time, in a run that is continued with another DEM step: the same head at every time,
    the end where it was to be, and the same flow but for the integration of the grains' motion."""
    water = WATER + "variable head equal 5*f_hydrodynamic_force/4e-3\nlbm boundary zlo pressure v_head zhi pressure 0\n" \
        "variable liggghts equal step*dt\n" \
        "lbm monitor m every 1e-4 file m.csv v_head as head_pa v_liggghts as step_times_dt superficial_velocity\n"
    with scratch() as folder:
        path = pathlib.Path(folder)
        Program(program.suffuse, program.mpirun, 1).must_run(wet_box() + "write_restart start\n", folder)
        program.must_run(wet_box(restart="start") + water + "lbm run 2e-3\nlbm restart write half.h5\nlbm run until 4e-3\n", folder)
        whole = columns(path / "m.csv")
        slower = wet_box(restart="half.h5.grains").replace("timestep 1e-6", "timestep 4e-7")
        expect("timestep 4e-7" in slower, "the scene's step is another one")
        screen = program.must_run(slower + 'print "water at $(f_hydrodynamic_force) s"\n' + water +
                                  "lbm restart read half.h5\nlbm run until 4e-3\nlbm run until 1e-3\n"
                                  'print "then at $(f_hydrodynamic_force) s"\n', folder)
        both = columns(path / "m.csv")
    step = 1.25e-4 ** 2 * 0.015 / 3 / 1e-6  # of the fluid, s
    said = [float(word) for word in re.findall(r"water at (\S+) s", screen)] + \
        [float(word) for word in re.findall(r"then at (\S+) s", screen)]
    expect(len(said) == 2 and abs(said[0] - 2e-3) < step and abs(said[1] - 4e-3) < step, f"the script reads times {said}")
    expect("the fluid is at 0.00398438 s already" in screen, f"a time that has passed is run again:\n{screen[-1500:]}")
    expect(whole["time_s"] == both["time_s"] and len(both["time_s"]) > 38, f"{len(whole['time_s'])}, {len(both['time_s'])} rows")
    for time, head in zip(both["time_s"], both["head_pa"]):
        expect(abs(head - 5 * time / 4e-3) < 1e-9, f"head {head} Pa at {time} s")
    jump = max(abs(b - t) for b, t in zip(both["step_times_dt"], both["time_s"]))
    expect(jump > 0.5e-3, f"the DEM's step was to differ: step*dt is within {jump} s of the water's time")
    # Velocity-Verlet's error of the falling grains at either step is far below this.
    one, two = (series["superficial_velocity_z_m_per_s"][-1] for series in (whole, both))
    expect(abs(one / two - 1) < 1e-3, f"flow {one} and {two} m/s")


def check_plan_of_graded_bed(program):
    """A plan's error is that of the fines that make the pores: fines of two cells make a bed of coarse grains of eight
    cells err by a fifth, and two lone fine grains do not."""
    def plan(fines):
        coarse = [(x, y, z) for x in (1, 3) for y in (1, 3) for z in (1, 2.5, 4)]
        places = [(0.2 + 0.4 * (n % 10), 0.15 + 0.4 * (n // 10 % 10), 4.8 - 0.4 * (n // 100)) for n in range(fines)]
        atoms = "".join(f"create_atoms {kind} single {x}e-3 {y}e-3 {z}e-3\n" for kind, all_ in ((1, coarse), (2, places)) for x, y, z in all_)
        box = wet_box(grains=0).replace("create_box 1 box", "create_box 2 box").replace("peratomtypepair 1", "peratomtypepair 2")
        for name, value in (("youngsModulus", "7e8"), ("poissonsRatio", "0.3")):
            box = box.replace(f"{name} peratomtype {value}", f"{name} peratomtype {value} {value}")
        for name, value in (("coefficientRestitution", "0.7"), ("coefficientFriction", "0.3")):
            box = box.replace(f"{name} peratomtypepair 2 {value}", f"{name} peratomtypepair 2 {value} {value} {value} {value}")
        sizes = "set type 1 diameter 1e-3 density 2650\nset type 2 diameter 0.25e-3 density 2650\n"
        with scratch() as folder:
            return program.must_run(box + atoms + sizes + WATER + "lbm plan 0.1\n", folder)

    screen = plan(200)
    expect(re.search(r"about 14 % \(worst packing tried: 27 %\), by the 2 cells a diameter of 0.00025 m", screen), f"fines of two cells: {screen[-1500:]}")
    expect("lbm plan: note: the smallest grains have 2 cells per diameter" in screen, f"no note: {screen[-1500:]}")
    # 12 coarse grains of 1 mm2 pi each; two of a sixteenth: a hundredth of the surface. Sizes are in classes of 3 %.
    expect("about 1 % (worst packing tried: 3 %), by the 7.9 cells" in plan(2), f"two lone grains: {plan(2)[-1500:]}")


def check_mass_budget(program):
    """Water that is 3 % denser where it comes in than where it leaves: several boxes full flow through grains that are held, and as much comes in
    as goes out."""
    with scratch() as folder:
        screen = program.must_run(wet_box() + "unfix motion\nvelocity all set 0 0 0\nlbm fluid density 1000 viscosity 1e-6\n"
                                  "lbm lattice spacing 2.5e-4 relaxation_time 0.6\nlbm boundary zlo pressure 0.14 zhi pressure 0\nlbm run 4\n"
                                  "lbm monitor m every 0.02 file m.csv mass superficial_velocity extremes\nlbm run 4\n", folder)
        series = columns(pathlib.Path(folder) / "m.csv")
    box = 1000 * 4e-3 * 4e-3 * 5e-3
    speed = series["superficial_velocity_z_m_per_s"]
    through = sum(speed) / len(speed) * 4 / 5e-3
    balance = max(map(abs, series["mass_balance_kg"])) / box
    expect(through > 1 and balance < 2e-3 * through, f"{through:.2f} boxes went through, the budget misses {balance:.4f} of one\n{screen[-300:]}")


def check_steady_and_grains(program):
    """Until steady; water without grains; grains inserted and deleted between runs leave no solids behind."""
    empty = wet_box(grains=0) + WATER + "lbm boundary zlo pressure 0.1 zhi pressure 0\n" + \
        "lbm monitor m every 2e-3 file m.csv mass bed grains\n"
    grains = "create_atoms 1 single 2e-3 2e-3 1e-3\nset type 1 diameter 1e-3 density 2650\n"
    with scratch() as folder:
        screen = program.must_run(empty + "lbm run 2e-3\n" + grains + "lbm run 2e-3\ndelete_atoms group all\n"
                                  "lbm run 2e-3\n", folder)
        series = columns(pathlib.Path(folder) / "m.csv")
        expect("none: the fluid flows alone" in screen, "water without grains is not named")
        expect(series["grains"][0] == 0 and series["grains"][-1] == 0, f"{series['grains']}")
        volume = 4. / 3 * 3.14159265 * 0.5e-3 ** 3
        box = 4e-3 * 4e-3 * 5e-3
        with_grain = 1000 * (box - volume)
        masses = series["fluid_mass_kg"]
        expect(min(abs(mass / with_grain - 1) for mass in masses) < 1e-3, f"no sample has the grain: {masses}")
        expect(abs(masses[-1] / (1000 * box) - 1) < 1e-3, f"a deleted grain stays solid: {masses}")
        screen = program.must_run(empty + "lbm run 2 until steady 0.05 window 2e-3\n", folder, "steady")
        expect("lbm run: steady after" in screen, f"never steady:\n{screen[-800:]}")
        # A head that comes later: water that stands still until then is not steady.
        late = wet_box(grains=0) + WATER + "variable late equal 0.1*(f_hydrodynamic_force>9e-3)\nlbm boundary zlo pressure v_late zhi pressure 0\n"
        screen = program.must_run(late + "lbm run 2 until steady 0.05 window 2e-3\n", folder, "late")
        steady_after = float(re.search(r"lbm run: steady after (\S+) s", screen).group(1))
        expect(steady_after > 11e-3, f"steady after {steady_after} s, before the water has been moved for two windows")
        screen = program.must_run(wet_box() + WATER + "run 100\nlbm plan 0.5\nlbm run 1e-3\n", folder, "plan")
        expect("lbm plan: 0.5 s are" in screen and "GB for the fluid" in screen, "no plan")


def check_groups(program):
    """The mean force on a group is that on its own grains."""
    grains = "create_atoms 1 single 1e-3 2e-3 1e-3 units box\ncreate_atoms 1 single 3e-3 2e-3 3e-3 units box\n" \
        "set type 1 density 2650\nset group all diameter 1e-3\nset atom 2 diameter 6e-4\ngroup coarse id 1\ngroup fine id 2\n"
    monitor = "lbm monitor m every 1e-3 file m.csv solid_force mean_force all mean_force coarse mean_force fine\n"
    with scratch() as folder:
        program.must_run(wet_box(grains=0) + WATER + grains + "lbm boundary zlo pressure 0.5 zhi pressure 0\n" + monitor + "lbm run 4e-3\n", folder)
        series = columns(pathlib.Path(folder) / "m.csv")
    whole, total, coarse, fine = (series[f"{name}_z_n"][-1] for name in ("solid_force", "mean_force_all", "mean_force_coarse", "mean_force_fine"))
    expect(coarse > fine > 0, f"mean forces {coarse} N on the large grain and {fine} N on the small one")
    # Grains' loads have the buoyancy of the water's weight on top of the fluid's force; the mean of two steps differs from the last one.
    expect(abs(coarse + fine - 2 * total) < 1e-6 * total, f"{coarse} N and {fine} N are not 2 x {total} N (solid_force {whole} N)")


def check_own_time_step(program):
    """What the script runs without water afterwards has the script's time step, and so does the next choice of substeps."""
    with scratch() as folder:
        screen = program.must_run(wet_box(grains=4) + WATER + 'lbm run 1e-3\nprint "STEP $(dt)"\nlbm run 1e-3\nprint "STEP $(dt)"\n', folder)
    steps = [float(word) for word in re.findall(r"^STEP (\S+)", screen, re.M)]
    expect(steps == [1e-6, 1e-6], f"time steps of {steps} s after two lbm run, with 1e-6 s in the script")


def main():
    program = program_from_command_line(__doc__)
    largest = check_ranks(program)
    if program.ranks == 1:  # its numbers are the same on all
        check_drag_note(program)
    check_closed_box(program)
    check_groups(program)
    check_own_time_step(program)
    check_lost_flow(program)
    check_changed_lines(program)
    check_restart(program)
    check_time_over_restart(program)
    check_plan_of_graded_bed(program)
    check_mass_budget(program)
    check_steady_and_grains(program)
    print(f"{program.ranks} ranks: positions within {largest:.1e} m of one rank's")


if __name__ == "__main__":
    main()
