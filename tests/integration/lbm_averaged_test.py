#!/usr/bin/env python3
"""lbm_averaged_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

`lbm method averaged` in runs of `suffuse`: a bed that settles, carries the hydraulic gradient and expands; the same on one rank
and on N; a run that goes on from a saved state; words that the averaged flow refuses or does not use.
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import HEADER, Program, columns, expect, material, mistakes_not_named, program_from_command_line, scratch  # noqa: E402

D, GRAINS, WIDTH, HEIGHT = 7e-4, 200, 4.2e-3, 12.6e-3

BED = HEADER.format(boundary="p p f") + "processors 1 1 *\n{start}" + material(skin=2e-4, modulus="5e6", friction="0.3") + f"""
fix motion all nve/sphere
fix weight all gravity 9.81 vector 0 0 -1
fix floor all wall/gran model hertz tangential history primitive type 1 zplane 0
fix lid all wall/gran model hertz tangential history primitive type 1 zplane {HEIGHT}
timestep 4e-6
thermo_modify lost error norm no
"""
NEW = f"""region box block 0 {WIDTH} 0 {WIDTH} 0 {HEIGHT} units box
create_box 1 box
"""
INSERT = f"""fix t1 all particletemplate/sphere 11593 atom_type 1 density constant 2650 radius constant {D / 2}
fix dist all particledistribution/discrete 32452843 1 t1 1.0
region low block 0 {WIDTH} 0 {WIDTH} 0 {0.8 * HEIGHT} units box
fix insertion all insert/pack seed 32452867 distributiontemplate dist insert_every once overlapcheck yes particles_in_region {GRAINS} region low ntry_mc 20000
run 1
unfix insertion
run 20000
write_restart start
"""
WATER = """
lbm method averaged {closures}
lbm fluid density 1000 viscosity 1e-6
lbm lattice spacing {spacing} timestep 4e-4
lbm force gravity 0 0 -9.81
lbm boundary zlo velocity 0 0 {speed} zhi pressure 0
lbm monitor flow every 2e-3 file flow.csv superficial_velocity hydraulic_gradient bed solid_force mass kinetic_energy grains
lbm output fields every 5e-2 file bed.h5 velocity pressure solid_fraction grains
"""


def water(speed=1e-3, closures="", spacing=3 * D, more=""):
    return WATER.format(closures=closures, spacing=spacing, speed=speed) + more


def bed(read=None):
    return BED.format(start=f"read_restart {read}\n" if read else NEW)


def run(program, folder, text, ranks=None, timeout=300):
    return Program(program.suffuse, program.mpirun, ranks or program.ranks).must_run(text, folder, timeout=timeout)


def check_expansion(program, folder):
    """Slow flow leaves the bed as it is; fast flow carries its weight whatever the speed, and the bed stands higher the faster the
    flow, as Richardson and Zaki say."""
    area, solid = WIDTH**2, GRAINS * 3.14159265 / 6 * D**3
    carried = 1.65 * solid / area / HEIGHT  # over the whole height
    heights = []
    for speed in (1e-3, 2e-2, 3e-2):
        text = bed("start") + water(speed, "drag di_felice") + "thermo 100000\nlbm run 0.3\n"
        screen = run(program, folder, text, 1)
        expect("averaged flow, drag di_felice (Di Felice 1994), weighted by size" in screen, "no word about the method")
        flow = columns(folder / "flow.csv")
        late = slice(-75, None)
        gradient = sum(flow["hydraulic_gradient_z"][late]) / 75
        heights.append(sum(flow["centre_of_grains_z_m"][late]) / 75)
        passing = sum(flow["superficial_velocity_z_m_per_s"][late]) / 75  # relative to grains that move on the whole
        expect(abs(passing / speed - 1) < 0.05, f"of an inflow of {speed} m/s {passing} pass")
        if speed > 1e-2:
            load = sum(flow["solid_force_z_n"][late]) / 75 / (2650 * 9.81 * solid)
            # The lowest grains touch the floor now and then.
            expect(0.94 < load < 1.01, f"a bed in water of {speed} m/s: load over weight {load}")
        else:
            expect(gradient < 0.6 * carried, f"a bed at rest: gradient {gradient}, carried {carried}")
    # The formula scatters by some 0.03 in porosity, and a narrow bed of 200 grains is no uniform one.
    # Twice the centre's height is the bed's; its porosity gives Richardson and Zaki's exponent.
    terminal = 0.110  # m/s, 0.7 mm of 2,650 kg/m3 in water by Schiller and Naumann: Re 77
    for speed, height in zip((2e-2, 3e-2), heights[1:]):
        porosity = 1 - solid / area / (2 * height)
        expected = (speed / terminal) ** (1 / 2.88)  # exponent 4.45 Re^-0.1
        print(f"{speed} m/s: porosity {porosity}, Richardson and Zaki {expected}")
        expect(abs(porosity - expected) < 0.07, f"in {speed} m/s the porosity is {porosity}, Richardson and Zaki's {expected}")
    print(f"centres of the bed {heights} m")
    expect(heights[0] < heights[1] < heights[2], f"centres of the bed {heights}")


def check_step(program, folder):
    """A settled bed below its critical gradient stays at rest, whatever the fluid's step: drag and the water's inertia act with the
    delay of a step, which must not feed the contacts' vibrations."""
    flows = []
    for step in (4e-4, 4e-5):
        text = water(4e-3).replace("timestep 4e-4", f"timestep {step}")
        run(program, folder, bed("start") + text + "thermo 100000\nlbm run 0.08\n", 1)
        flow = columns(folder / "flow.csv")
        flows.append(sum(flow["solid_force_z_n"][-5:]) / 5)
        energy, height = flow["grains_kinetic_energy_j"][-1], flow["bed_height_m"]
        expect(energy < 1e-10, f"a bed at rest has {energy} J with steps of {step} s")
        expect(abs(height[-1] / height[0] - 1) < 0.01, f"a bed at rest rises from {height[0]} to {height[-1]} m with steps of {step} s")
    expect(abs(flows[0] / flows[1] - 1) < 0.01, f"loads at two steps {flows}")


def check_ranks_and_restart(program, folder):
    """Held grains in a rising flow: contacts, which LIGGGHTS sums in another order on other ranks, play no part."""
    held = "velocity all set 0 0 0\nset group all omegax 0 omegay 0 omegaz 0\nthermo 100000\n"
    text = held + "fix hydrodynamic_force all hydrodynamic/force\nvariable rising equal 2*f_hydrodynamic_force\n" + water("v_rising")
    start, go_on = [bed(file).replace("fix motion all nve/sphere\n", "") for file in ("start", "state.grains")]
    run(program, folder, start + text + "lbm run 0.02\n", 1)
    one = columns(folder / "flow.csv")
    run(program, folder, start + text + "lbm restart write state every 0.01\nlbm run 0.01\n")
    run(program, folder, go_on + text + "lbm restart read state\nlbm run 0.01\n")
    many = columns(folder / "flow.csv")
    expect(len(one["time_s"]) == len(many["time_s"]) == 11, "the run that goes on has other lines")
    for name, values in one.items():
        worst = max(abs(a - b) for a, b in zip(values, many[name])) / max(1e-300, max(abs(a) for a in values))
        # Positions go through LIGGGHTS's restart and borders; sums of output over ranks are in another order.
        expect(worst < 1e-9, f"{name} of the run that goes on differs by {worst}")
    expect(one["solid_force_z_n"][-1] > 1.05 * one["solid_force_z_n"][1], "the flow does not rise")


def check_water_of_another_kind(program, folder):
    """Grains pushed up in water that follows other water, resolved after averaged or averaged after resolved, slow down as in the first
    water: what the one foresaw or added to their inertia is not left to the other."""
    lattice = "lbm fluid density 1000 viscosity 1e-6\nlbm lattice {}\nlbm force gravity 0 0 -9.81\nlbm boundary zlo noslip zhi noslip\n"
    waters = {"averaged": "lbm method averaged\n" + lattice.format(f"spacing {3 * D} timestep 4e-4"),
              "resolved": "lbm method resolved\n" + lattice.format(f"spacing {D / 3} relaxation_time 0.52")}
    push = "velocity all set 0 0 0.03\nlbm monitor m every 4e-4 file {}.csv kinetic_energy\nlbm run 4e-3\n"
    for other, second in (("averaged", "resolved"), ("resolved", "averaged")):
        for first, name in ((second, "same"), (other, "other")):
            run(program, folder, bed("start") + waters[first] + "lbm run 1e-2\nlbm clear\n" + waters[second] + push.format(name))
        same, after = (columns(folder / f"{name}.csv")["grains_kinetic_energy_j"][-1] for name in ("same", "other"))
        expect(abs(after / same - 1) < 0.05, f"{second} after {other}: {after / same:.3f} of the energy")


def check_refusals(program, folder):
    start = bed("start")
    cases = [
        ("lbm lattice spacing 1e-3 relaxation_time 0.6\nlbm method averaged\n", ["lbm method", "come before it"]),
        ("lbm method averaged drag ergun\n", ["drag = ergun", "beetstra, di_felice, gidaspow, tang"]),
        (water(spacing=D) + "lbm run 1e-3\n", ["be at least 1.5 mean diameters"]),
        (water(more="lbm effect turbulence on\n") + "lbm run 1e-3\n", ["only the resolved flow has it"]),
        (water(more="fix inside all wall/gran model hertz tangential history primitive type 1 zplane 1.1e-2\nlbm walls water all\n") + "lbm run 1e-3\n",
         ["lie on the faces of the water's box"]),
        (water(more="lbm boundary zhi noslip\n") + "lbm run 1e-3\n", ["make one face a pressure face"])]
    amiss = mistakes_not_named(program, [(start + script, words) for script, words in cases], folder)
    expect(not amiss, "\n".join(amiss))
    code, screen = program.run(start + "variable lost equal exp(1000)*0\nfix lost all addforce v_lost 0.0 0.0\n" + water() + "lbm run 0.1\n", folder)
    expect(code == 4 and "motion of a grain" in screen and "not a number" in screen, f"grains that are lost: {code}, {screen[-400:]}")
    screen = run(program, folder, start + water(closures="drag tang graded no", more="lbm collision bgk\n") + "lbm plan 1\nlbm run 1e-3\n")
    expect("note: not used: lbm collision" in screen and "Tang et al. 2015" in screen, "no word about what is not used")


def main():
    program = program_from_command_line(__doc__)
    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        run(program, folder, bed() + INSERT, 1)
        if program.ranks == 1:
            check_expansion(program, folder)
            check_step(program, folder)
            check_refusals(program, folder)
            check_water_of_another_kind(program, folder)
        check_ranks_and_restart(program, folder)


if __name__ == "__main__":
    main()
