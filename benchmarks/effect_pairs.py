#!/usr/bin/env python3
"""effect_pairs.py [--suffuse PROGRAM] [--effect NAME ...] [--repeat 3] [--csv FILE] [--check]

For every effect that `lbm run` switches, a scene that needs it and one that does not, each with the effect off, on and left to `auto`:
what is measured, how far it lies from a reference, what `auto` decided and why, and the processor time of the three (the least of
--repeat turns). The reference is a formula or a finer lattice where the effect is needed, and the effect switched on where it is not.

--check ends with code 1 unless, in every pair, `auto` is on where it is needed and off where not (rotation, which saves nothing, stays on),
leaving the effect out changes the result by less than the scene's bound where `auto` says so, and by more than the bound where not.
docs/results/effects.md is made of the table.
"""
import argparse
import csv
import dataclasses
import json
import math
import pathlib
import resource
import sys
import tempfile
import types
from collections.abc import Callable

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "tests" / "support"), str(ROOT / "tests" / "hard_cases")]
from hard_cases import Bench as HardCaseBench  # noqa: E402
from wet_grains import DENSITY, DUMP, VISCOSITY, Water, cubic, grain, last_dump, scattered, scene  # noqa: E402

BOX = {"zlo": "noslip", "zhi": "noslip"}


class Bench(HardCaseBench):
    """A folder, and the program on one rank; adds up the processor time of its runs."""

    def __init__(self, suffuse, folder):
        super().__init__(types.SimpleNamespace(suffuse=suffuse, mpirun=""), folder)
        self.seconds = 0.0

    def run(self, text):
        """Exit code of the script."""
        (self.folder / "effects.json").unlink(missing_ok=True)
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        code, screen = super().run(text, timeout=900)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.seconds += after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        if code not in (0, 4) and "Lost atoms" not in screen:
            sys.exit(f"ended with code {code}:\n{screen[-2500:]}")
        return code

    def last(self, column):
        return self.series()[column][-1]

    def grains(self):
        return last_dump(self.folder / "grains.dump")


@dataclasses.dataclass
class Scene:
    """measure(bench, line) runs the scene with the line that switches the effect and returns a number, or None where a guard stopped it."""
    effect: str
    needed: bool
    what: str
    unit: str
    measure: Callable
    reference: Callable | None  # of the bench; None: the effect switched on
    bound: float                # of the relative difference between off and the reference
    words: dict


def watch(water, steps, quantity="superficial_velocity"):
    """A monitor's line, which also asks for effects.json."""
    return f"lbm monitor flow every {steps * water.step:.12g} file flow.csv {quantity}\n"


# --- turbulence: grains thrown through water at rest ------------------------------------------------------------------------------

def energy_left(tau, line, bench, refinement=1, steps=1200, thrown=0.05):
    """Share of grains' and water's energy after `steps` of a lattice of 24^3; finer ones have the same Reynolds and Mach numbers."""
    tau = 0.5 + refinement * (tau - 0.5)
    water = Water((24 * refinement,) * 3, tau, spacing=1e-4 / refinement, lines=line)
    speed, diameter, count = water.speed(thrown), 5e-4, 8
    after = watch(water, 10 * refinement, "kinetic_energy") + f"lbm run {steps * refinement * water.step:.12g}\n"
    if bench.run(scene(bench, water, scattered(count, diameter, water.size, speed=speed), after, restitution=0.9)) != 0:
        return None
    start = count * 0.5 * 2650 * math.pi / 6 * diameter ** 3 * speed ** 2
    return (bench.last("fluid_kinetic_energy_j") + bench.last("grains_kinetic_energy_j")) / start


# --- comoving: a bed that carries its water along ---------------------------------------------------------------------------------

def slip_past_a_moved_bed(cells_a_step, bench, line, tau=0.51):
    """Speed (m/s, of the pores) with which the water of a bed that is moved as a whole flows past it under a gradient."""
    diameter, count = 8e-4, 12
    water = Water((22, 22, 22), tau, lines="lbm force pressure_gradient 0 0 300\n" + line)
    solids = count * math.pi / 6 * diameter ** 3 / math.prod(water.size)
    speed = water.speed(cells_a_step)
    after = f"fix motion all move linear 0 0 {speed:.12g} units box\n" + watch(water, 20) + f"lbm run {9000 * water.step:.12g}\n"
    if bench.run(scene(bench, water, scattered(count, diameter, water.size, clear=1.0), after, held=True, timestep=water.step / 10)) != 0:
        return None
    flow = bench.series()["superficial_velocity_z_m_per_s"][-50:]
    return sum(flow) / len(flow) / (1 - solids) - speed


# --- lubrication -------------------------------------------------------------------------------------------------------------------

def gap_above_a_wall(bench, line):
    """Gap, in radii, that a heavy grain in a thick liquid has left above a wall after a while."""
    water = Water((32, 32, 32), 1.0, BOX, 0.05, lines=line)
    radius = 5 * water.spacing
    after = watch(water, 100) + f"lbm run {FILM_TIME:.12g}\n{DUMP}run 0\n"
    bench.run(scene(bench, water, [grain([1.6e-3, 1.6e-3, radius * (1 + FILM_GAP)], 2 * radius)], after, periodic="ppf"))
    return bench.grains()["z"][0] / radius - 1


FILM_GAP, FILM_TIME = 0.12, 0.1


def gap_by_theory(_):
    """Brenner's resistance of a sphere near a wall, by its expansion for small gaps: (1/e) + (1/5) ln(1/e) + 0.9713 (Cox and Brenner 1967)."""
    radius, gap, time, step = 5e-4, FILM_GAP, 0.0, 1e-6
    weight = 1650 * 4 / 3 * math.pi * radius ** 3 * 0.05
    while time < FILM_TIME:
        resistance = 1 / gap - 0.2 * math.log(gap) + 0.9713
        gap -= step * weight / (6 * math.pi * DENSITY * VISCOSITY * radius ** 2 * resistance)
        time += step
    return gap


def flow_through_grains_at_rest(bench, line):
    """Darcy velocity (m/s) through a bed that rests on its floor, a third of the critical gradient."""
    water = Water((24, 24, 36), 0.52, lines="lbm force pressure_gradient 0 0 3000\n" + line, gravity=9.81)
    water.faces = {"zlo": "pressure 0", "zhi": "pressure 0"}
    grains = cubic((4, 4, 4), 6e-4, gap=1.0)
    after = watch(water, 50) + f"lbm run {2000 * water.step:.12g}\n"
    bench.run(scene(bench, water, grains, after, periodic="ppf", modulus=5e7))
    return bench.last("superficial_velocity_z_m_per_s")


# --- added mass, buoyancy, rotation ---------------------------------------------------------------------------------------------------

def fall(bench, line, density, cells=5, tau=0.8, gravity=0.0981, time=0.05):
    """Speed, m/s, of one grain after a while of falling or rising."""
    water = Water((24, 24, 40), tau, BOX, gravity, lines=line)
    after = watch(water, 20) + f"lbm run {time:.12g}\n{DUMP}run 0\n"
    if bench.run(scene(bench, water, [grain([0.5 * s for s in water.size], cells * water.spacing, density)], after, periodic="ppf")) != 0:
        return None
    return abs(bench.grains()["vz"][0])


def pulled(bench, line):
    """Speed of a grain that a force pulls through water without weight, m/s."""
    water = Water((24, 24, 24), 0.8, {"xlo": "noslip", "xhi": "noslip"}, lines=line)
    after = "fix pull all addforce 0 0 1e-9\n" + watch(water, 20) + f"lbm run 0.05\n{DUMP}run 0\n"
    bench.run(scene(bench, water, [grain([0.5 * s for s in water.size], 6e-4)], after, periodic="fpp"))
    return bench.grains()["vz"][0]


SHEAR_FORCE = 10.0  # N/m^3


def spin_in_a_channel(bench, line):
    """Angular velocity, 1/s, of a neutral grain between two walls, a quarter of the way across, and of the water there."""
    water = Water((32, 24, 24), 0.9, {"xlo": "noslip", "xhi": "noslip"}, lines=f"lbm force pressure_gradient 0 0 {SHEAR_FORCE}\n" + line)
    after = watch(water, 100) + f"lbm run 6.0\n{DUMP}run 0\n"
    bench.run(scene(bench, water, [grain([0.8e-3, 1.2e-3, 1.2e-3], 5e-4, 1000.0)], after, periodic="fpp"))
    return abs(bench.grains()["omegay"][0]), bench.grains()["x"][0]


def spin(bench, line):
    return spin_in_a_channel(bench, line)[0]


def spin_by_faxen(bench):
    """Half of the vorticity of the undisturbed flow at the grain's centre."""
    _, x = spin_in_a_channel(bench, "")
    return abs(SHEAR_FORCE / (DENSITY * VISCOSITY) * (1.6e-3 - x)) / 2


# --- dry regions ------------------------------------------------------------------------------------------------------------------------

class WaterInPart(Water):
    """The lattice fills the lowest part of a box that is `times` as high; what lies above is dry."""

    def __init__(self, *words, times=3, **more):
        super().__init__(*words, **more)
        self.times = times

    @property
    def size(self):
        x, y, z = super().size
        return [x, y, self.times * z]

    def text(self):
        x, y, z = super().size
        return f"region water block 0 {x:.12g} 0 {y:.12g} 0 {z:.12g} units box\n" + super().text().replace("precision double", "precision double region water")


def flow_beside_a_dry_region(bench, times):
    """Darcy velocity through a held bed, in a box that is `times` as high as the water and full of grains."""
    water = (Water if times == 1 else WaterInPart)((30, 30, 36), 0.8, lines="lbm force pressure_gradient 0 0 30\n", faces={"zlo": "pressure 0", "zhi": "pressure 0"})
    water.times = times
    after = watch(water, 100) + f"lbm run {DRY_STEPS * water.step:.12g}\n"
    layer, top = 6e-4, 6 * 6e-4  # pores of the water's last cells would count the layer next to them
    grains = [g for g in cubic((5, 5, 6 * times), layer, gap=1.0) if not top < g["place"][2] < top + layer]
    bench.run(scene(bench, water, grains, after, periodic="ppf", held=True))
    return bench.last("superficial_velocity_z_m_per_s"), len(grains)


DRY_STEPS = 10000


def dry_region_holds(options, of_the_run=0.02, of_a_grain=60e-9):
    """Grains and space without water, twice as much as with it, change nothing. Space costs nothing, a held grain one look in each step whether it
    has moved (40 ns; its bound is in seconds)."""
    seconds, flows, grains = {1: math.inf, 3: math.inf}, {}, {}
    for _ in range(max(3, options.repeat)):
        for times in seconds:
            with tempfile.TemporaryDirectory(prefix="suffuse-effects-") as folder:
                bench = Bench(options.suffuse, folder)
                flows[times], grains[times] = flow_beside_a_dry_region(bench, times)
            seconds[times] = min(seconds[times], bench.seconds)
    dearer, beside = seconds[3] - seconds[1], grains[3] - grains[1]
    bound = of_the_run * seconds[1] + of_a_grain * beside * DRY_STEPS
    holds = abs(flows[3] / flows[1] - 1) < 1e-9 and (dearer < bound or not options.check)
    print(f"dry region: flow {flows[1]:.8g}, beside it {flows[3]:.8g}; {seconds[1]:.2f} s, {seconds[3]:.2f} s: {100 * dearer / seconds[1]:+.1f} %, "
          f"{1e9 * dearer / beside / DRY_STEPS:.0f} ns a dry grain and step{'' if holds else '  DOES NOT HOLD'}")
    return holds


def switch(effect, besides=""):
    return {state: f"lbm effect {effect} {state} {besides}" for state in ("off", "on", "auto")}


ADDED = {"off": "lbm couple virtual_mass 0", "on": "lbm couple virtual_mass 0.5", "auto": "lbm couple virtual_mass auto"}

SCENES = [
    Scene("turbulence", True, "energy of grains thrown at a grid Reynolds number of 150 (relaxation time 0.501)", "of the start",
          lambda b, line: energy_left(0.501, line, b), lambda b: energy_left(0.501, "lbm effect turbulence off comoving off", b, 3), 0.25,
          switch("turbulence", "comoving off")),
    Scene("turbulence", False, "the same at 5 (0.53)", "of the start", lambda b, line: energy_left(0.53, line, b), None, 0.02,
          switch("turbulence", "comoving off")),
    Scene("comoving", True, "slip of water past a bed that carries it along at V dx/nu = 9 (0.51)", "m/s",
          lambda b, line: slip_past_a_moved_bed(0.03, b, line), lambda b: slip_past_a_moved_bed(0.0, b, "lbm effect comoving off"), 0.05,
          switch("comoving", "turbulence off")),
    Scene("comoving", False, "the same at 0.5 (0.6)", "m/s", lambda b, line: slip_past_a_moved_bed(0.0167, b, line, 0.6), None, 0.01,
          switch("comoving", "turbulence off")),
    Scene("lubrication", True, "gap left above a wall by a slow grain", "radii", gap_above_a_wall, gap_by_theory, 0.3, switch("lubrication")),
    Scene("lubrication", False, "Darcy velocity through grains that rest on each other", "m/s", flow_through_grains_at_rest, None, 0.01, switch("lubrication")),
    Scene("added mass", True, "speed of a rising grain, a fifth of the water's density, after 0.05 s", "m/s",
          lambda b, line: fall(b, line, 200.0), lambda b: fall(b, "lbm couple virtual_mass 1", 200.0), 0.1, ADDED),
    Scene("added mass", False, "speed of a sinking grain, 2.65 of it, 8 cells, after 0.05 s", "m/s",
          lambda b, line: fall(b, line, 2650.0, 8, 0.55), None, 0.02, ADDED),
    Scene("buoyancy", True, "speed of a sinking grain", "m/s", lambda b, line: fall(b, line, 2650.0, time=0.15),
          lambda b: fall(b, "lbm effect buoyancy off", 2650.0, time=0.15) * 1.65 / 2.65, 0.3, switch("buoyancy")),
    Scene("buoyancy", False, "speed of a grain that a force pulls, no weight", "m/s", pulled, None, 1e-12, switch("buoyancy")),
    Scene("rotation", True, "spin of a neutral grain in a channel", "1/s", spin, spin_by_faxen, 0.1, switch("rotation")),
    Scene("rotation", False, "speed of a grain on the middle of its way down", "m/s", lambda b, line: fall(b, line, 2650.0, time=0.15), None, 1e-3,
          switch("rotation")),
]


def decision(folder, effect):
    """What effects.json says of it: on, and the number with its limit."""
    report = json.loads((folder / "effects.json").read_text())
    found = next(e for e in report["effects"] if e["name"] == effect)
    on = found["on"] or found["changes"] > 0
    if found.get("value") is None:
        return on, found.get("source") or ""
    return on, f"{found['number']} = {found['value']:.3g}, limit {found['limit']:g}"


def difference(value, reference):
    return math.inf if value is None else abs(value / reference - 1)


def take(one, options):
    """A row of the table."""
    row = types.SimpleNamespace(scene=one, values={}, seconds={}, auto=None, why="")
    with tempfile.TemporaryDirectory(prefix="suffuse-effects-") as folder:
        reference = one.reference(Bench(options.suffuse, folder)) if one.reference else None
        for _ in range(options.repeat):
            for state, line in one.words.items():
                bench = Bench(options.suffuse, folder)
                row.values[state] = one.measure(bench, line)
                row.seconds[state] = min(row.seconds.get(state, math.inf), bench.seconds)
                if state == "auto":
                    row.auto, row.why = decision(bench.folder, one.effect)
        row.reference = reference if reference is not None else row.values["on"]
    row.off = difference(row.values["off"], row.reference)
    row.on = difference(row.values["auto"], row.reference)
    decided = row.auto == one.needed or one.effect == "rotation"
    row.holds = decided and (row.off > one.bound > row.on if one.needed else row.off <= one.bound)
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--suffuse", default=str(ROOT / "build" / "release" / "bin" / "suffuse"))
    parser.add_argument("--effect", action="append", help="only these; `dry region` is one")
    parser.add_argument("--repeat", type=int, default=1)
    parser.add_argument("--csv", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    rows = []
    for one in SCENES:
        if options.effect and one.effect not in options.effect:
            continue
        row = take(one, options)
        rows.append(row)
        shown = {s: "stopped" if v is None else f"{v:.5g}" for s, v in row.values.items()}
        print(f"{one.effect:12}{'needed' if one.needed else 'not':8}auto {'on' if row.auto else 'off':4}off {shown['off']:>10} on {shown['on']:>10} auto {shown['auto']:>10} "
              f"reference {row.reference:.5g}: without it {100 * row.off:.3g} %, auto {100 * row.on:.3g} %; "
              f"{row.seconds['off']:.2f} {row.seconds['on']:.2f} {row.seconds['auto']:.2f} s  {row.why}{'' if row.holds else '  DOES NOT HOLD'}", flush=True)
    if options.csv:
        with options.csv.open("w", newline="") as file:
            table = csv.writer(file)
            table.writerow(["effect", "needed", "scene", "unit", "off", "on", "auto", "reference", "error_off", "error_auto", "bound", "auto_is_on", "reason",
                            "core_seconds_off", "core_seconds_on", "core_seconds_auto"])
            for row in rows:
                one = row.scene
                table.writerow([one.effect, int(one.needed), one.what, one.unit] + [row.values[s] for s in ("off", "on", "auto")] +
                               [row.reference, row.off, row.on, one.bound, int(row.auto), row.why] + [round(row.seconds[s], 3) for s in ("off", "on", "auto")])
    dry = not options.effect or "dry region" in options.effect
    if (dry and not dry_region_holds(options)) | (options.check and not all(row.holds for row in rows)):
        sys.exit("a pair does not hold")


if __name__ == "__main__":
    main()
