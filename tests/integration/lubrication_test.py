#!/usr/bin/env python3
"""lubrication_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

fix lubrication in real runs: forces and torques of every grain against a sum over all pairs and images written out
here, so that 1, 2 and 3 ranks agree; films that close faster than neighbour lists are made;
momentum and energy; steps that are too long; and mistakes.
"""
import math
import pathlib
import random
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import HEADER, expect, log_text, material, program_from_command_line, scratch, thermo_rows  # noqa: E402

VISCOSITY, OUTER, INNER = 1.2e-3, 1e-4, 2e-5
LENGTH, HEIGHT = 3e-3, 4e-3
DENSITY = 2650

SCENE = HEADER + "read_data grains.data\n" + material("{skin}", "7e8", 0.7, 0.3) + """
fix motion all nve/sphere
timestep {step}
compute spin all erotate/sphere
"""
FILM = f"fix film all lubrication viscosity {VISCOSITY} outer {OUTER} inner {INNER}"
OUTPUT = """
dump grains all custom 1 grains.out id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz radius
dump_modify grains sort id format "%d %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g"
thermo_style custom step ke c_spin f_film[1] f_film[2] f_film[3] f_film[4] f_film[5] f_film[6]
thermo_modify format float %.17g lost error norm no
thermo 1
"""


def scene(boundary="p p f", skin=5e-5, step=1e-7):
    return SCENE.format(boundary=boundary, skin=skin, step=step)


class Grain:
    def __init__(self, radius, x, v, w):
        self.radius, self.x, self.v, self.w = radius, x, v, w
        self.mass = DENSITY * 4 / 3 * math.pi * radius**3
        self.moment = 0.4 * self.mass * radius**2


def add(a, b, factor=1.0):
    return [p + factor * q for p, q in zip(a, b)]


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def image(d, periodic):
    """The shortest of a branch vector's images; the box is wider than two grains and a film."""
    return [p - size * round(p / size) if around else p for p, size, around in zip(d, (LENGTH, LENGTH, HEIGHT), periodic)]


def random_grains(number, seed=7):
    """Spheres of three sizes with gaps from a fifth of the inner gap on, so that many films are there and none touch."""
    source, grains, least = random.Random(seed), [], 0.2 * INNER
    while len(grains) < number:
        radius = source.choice((0.5e-3, 0.35e-3, 0.25e-3)) if len(grains) < number // 2 else 0.25e-3
        x = [source.uniform(0, LENGTH), source.uniform(0, LENGTH), source.uniform(radius + least, HEIGHT - radius - least)]
        branches = [(image(add(x, other.x, -1), (True, True, False)), other) for other in grains]
        if all(math.sqrt(dot(d, d)) > radius + other.radius + least for d, other in branches):
            grains.append(Grain(radius, x, [source.uniform(-0.05, 0.05) for _ in range(3)], [source.uniform(-50, 50) for _ in range(3)]))
    return grains


def write_grains(folder, grains):
    text = f"grains\n\n{len(grains)} atoms\n1 atom types\n0 {LENGTH} xlo xhi\n0 {LENGTH} ylo yhi\n0 {HEIGHT} zlo zhi\n\nAtoms\n\n"
    for n, g in enumerate(grains):
        text += f"{n + 1} 1 {2 * g.radius!r} {DENSITY} " + " ".join(repr(p) for p in g.x) + "\n"
    text += "\nVelocities\n\n"
    for n, g in enumerate(grains):
        text += f"{n + 1} " + " ".join(repr(p) for p in g.v + g.w) + "\n"
    (pathlib.Path(folder) / "grains.data").write_text(text)


def film_loads(first, n, gap, second=None):
    """Force and torque on the first; without a second: a plane at rest. The formulas of docs/reference/fix_lubrication.md."""
    a1 = first.radius
    radius = a1 if second is None else a1 * second.radius / (a1 + second.radius)
    p1 = radius / a1
    p2 = 0 if second is None else radius / second.radius
    h = max(gap, INNER)
    log = math.log(OUTER / h)
    kn = 6 * math.pi * VISCOSITY * radius**2 * (1 / h - 1 / OUTER)
    ku = 8 / 5 * math.pi * VISCOSITY * radius * (2 - 3 * p1 * p2) * log
    kuw = 12 / 5 * math.pi * VISCOSITY * radius**2 * (p1 - p2) * log
    kw = 24 / 5 * math.pi * VISCOSITY * radius**3 * log
    v2, w2, l2 = ([0] * 3, [0] * 3, 0) if second is None else (second.v, second.w, second.radius + gap / 2)
    l1 = a1 + gap / 2
    relative = add(v2, first.v, -1)
    vn = dot(relative, n)
    u = add(add(relative, n, -vn), cross(add([l1 * p for p in first.w], w2, l2), n), -1)
    w = cross(add(first.w, w2, -1), n)
    drag, couple = add([ku * p for p in u], w, kuw), add([kuw * p for p in u], w, kw)
    return add(drag, n, kn * vn), cross(n, add([l1 * p for p in drag], couple, -1))


def all_loads(grains, periodic=(True, True, False), walls=True, below=math.inf):
    """Loads of every grain, and the number of films; only of films below this height: the middle of a gap, at a wall the grain's centre."""
    loads, films = [], 0.0
    for i, g in enumerate(grains):
        force, torque = [0.0] * 3, [0.0] * 3
        for j, other in enumerate(grains):
            if i == j:
                continue
            d = image(add(other.x, g.x, -1), periodic)
            distance = math.sqrt(dot(d, d))
            gap = distance - g.radius - other.radius
            n = [p / distance for p in d]
            if gap >= OUTER or g.x[2] + n[2] * (g.radius + gap / 2) > below:
                continue
            f, t = film_loads(g, n, gap, other)
            force, torque, films = add(force, f), add(torque, t), films + 0.5
        for at, side in ((0, -1), (HEIGHT, 1)) if walls else ():
            gap = abs(at - g.x[2]) - g.radius
            if gap < OUTER and g.x[2] <= below:
                f, t = film_loads(g, [0, 0, side], gap)
                force, torque, films = add(force, f), add(torque, t), films + 1
        loads.append(force + torque)
    return loads, films


def read_steps(folder):
    """Per output step: the grains, and their forces and torques."""
    lines = (pathlib.Path(folder) / "grains.out").read_text().splitlines()
    steps, k = [], 0
    while k < len(lines):
        number = int(lines[k + 3])
        rows = [[float(word) for word in line.split()] for line in lines[k + 9:k + 9 + number]]
        steps.append(([Grain(r[16], r[1:4], r[4:7], r[7:10]) for r in rows], [r[10:16] for r in rows]))
        k += 9 + number
    return steps


def check_loads(found, wanted, what):
    """Rounding: gaps are differences of coordinates of 1e-3 m, so off by 1e-18 m, a part in 1e13 of the smallest."""
    scale = [max(abs(load[k]) for load in wanted for k in part) for part in ((0, 1, 2), (3, 4, 5))]
    worst = max(abs(p - q) / scale[k // 3] for f, w in zip(found, wanted) for k, (p, q) in enumerate(zip(f, w)))
    expect(worst < 1e-11, f"{what}: loads differ from the sum over pairs by {worst:.2e} of the largest")
    return worst


def check_many_grains(program, folder, grains):
    walls = f" walls zplane 0 zplane {HEIGHT} density 1000\n"
    # Velocities of the first output are those of the data file: no step has been made.
    wanted, films = all_loads(grains)
    expect(films > 60, f"only {films} films in the scene")
    for style in ("bin", "nsq"):
        write_grains(folder, grains)
        program.must_run(scene().replace("bin", style) + FILM + walls + OUTPUT + "run 0\n", folder)
        worst = check_loads(read_steps(folder)[0][1], wanted, style)
        row = thermo_rows(log_text(folder), 9)[0]
        expect(row[3] == films, f"{style}: {row[3]} films, {films} by hand")
        expect(row[5] == 0, f"{row[5]} of the films are bounded at a short step")
        expect(row[8] > 0, "no Reynolds number")
        power = -sum(dot(load[:3], g.v) + dot(load[3:], g.w) for load, g in zip(wanted, grains))
        # The same sum in another order, of terms of both signs.
        expect(abs(row[7] - power) < 1e-10 * power, f"{style}: power {row[7]} W, {power} W by hand")
    # In half of the box: a region's films, without their torques.
    region = f"region wet block 0 {LENGTH} 0 {LENGTH} 0 {HEIGHT / 2} units box\n"
    wanted_there, films_there = all_loads(grains, below=HEIGHT / 2)
    expect(0.2 * films < films_there < 0.8 * films, f"{films_there} of {films} films in the region")
    program.must_run(scene() + region + FILM + " region wet torque no" + walls + OUTPUT + "run 0\n", folder)
    found = read_steps(folder)[0][1]
    expect(all(value == 0 for load in found for value in load[3:]), "torques in spite of `torque no`")
    check_loads([f[:3] + w[3:] for f, w in zip(found, wanted_there)], wanted_there, "region")
    # Of half of the grains, films among themselves alone.
    write_grains(folder, grains)
    half = len(grains) // 2
    program.must_run(scene() + f"group half id <= {half}\n" + FILM.replace("all", "half") + OUTPUT + "run 0\n", folder)
    found = read_steps(folder)[0][1]
    check_loads(found[:half], all_loads(grains[:half], walls=False)[0], "group")
    expect(all(value == 0 for load in found[half:] for value in load), "grains outside the group are loaded")
    return films, worst


def check_conservation(program, folder, grains):
    """All faces periodic: linear momentum stays, energy falls by the power."""
    write_grains(folder, [g for g in grains if g.radius < g.x[2] - OUTER and g.x[2] < HEIGHT - OUTER - g.radius])
    steps, dt = 40, 1e-6
    film = FILM.replace(f"viscosity {VISCOSITY}", "viscosity 0.1")
    program.must_run(scene("p p p", step=dt) + film + OUTPUT + f"run {steps}\n", folder)
    rows, states = thermo_rows(log_text(folder), 9), read_steps(folder)
    momenta = [[sum(g.mass * g.v[k] for g in grains_then) for k in range(3)] for grains_then, _ in states]
    size = sum(g.mass * math.sqrt(dot(g.v, g.v)) for g in states[0][0])
    drift = max(abs(p - q) for p, q in zip(momenta[0], momenta[-1])) / size
    expect(drift < 1e-13, f"momentum drifts by {drift:.1e} of the grains' own")  # rounding of 40 steps
    energy = [row[1] + row[2] for row in rows]
    expect(all(b < a for a, b in zip(energy, energy[1:])), "energy rises")
    lost = sum(0.5 * (a[7] + b[7]) * dt for a, b in zip(rows, rows[1:]))
    # Forces are taken at mid-step velocities: the sum is off by dt times the rate of the fastest film, here 1 %.
    expect(abs(energy[0] - energy[-1] - lost) < 0.02 * lost, f"energy fell by {energy[0] - energy[-1]} J, power x time is {lost} J")
    expect(lost > 0.01 * energy[0], "hardly any energy was lost: the scene shows nothing")
    return drift


def check_fast_pair(program, folder):
    """A pair beyond the list, at 2 m/s, comes within the film before grains have moved by half the skin."""
    skin, step = 4e-4, 5e-6
    a = 0.25e-3
    grains = [Grain(a, [1e-3, 1.5e-3, 2e-3], [1, 0, 0], [0, 80, 0]), Grain(a, [1e-3 + 2 * a + 4.8e-4, 1.5e-3, 2e-3], [-1, 0, 0], [0, 0, 0])]
    write_grains(folder, grains)
    program.must_run(scene(skin=skin, step=step) + FILM + OUTPUT + "run 44\n", folder)
    # The output holds velocities of the end of a step; forces were taken in its middle, a kick F dt / 2m before.
    seen = 0
    for now, loads in read_steps(folder)[1:]:
        for g, load in zip(now, loads):
            g.v = add(g.v, load[:3], -0.5 * step / g.mass)
            g.w = add(g.w, load[3:], -0.5 * step / g.moment)
        wanted, films = all_loads(now, walls=False)
        if films:
            check_loads(loads, wanted, f"fast pair, film {seen}")
            seen += 1
        else:
            expect(all(value == 0 for load in loads for value in load), "a force without a film")
    expect(seen >= 3, f"only {seen} steps with a film")
    return seen


def check_slowing(program, folder):
    """Two spheres on a line lose c/m (ln(outer/inner) - 1 + inner/outer) of their relative speed on the way through the film,
    c = 6 pi mu (a/2)^2, m their reduced mass: m dv/dt = -c (1/h - 1/outer) v, integrated over h."""
    a, speed, step = 0.5e-3, 0.02, 8e-7
    for every, tolerance in ((1, 0.002), (10, 0.01)):
        grains = [Grain(a, [1e-3, 1.5e-3, 2e-3], [speed / 2, 0, 0], [0, 0, 0]),
                  Grain(a, [1e-3 + 2 * a + 1.02 * OUTER, 1.5e-3, 2e-3], [-speed / 2, 0, 0], [0, 0, 0])]
        write_grains(folder, grains)
        program.must_run(scene(step=step) + FILM + f" every {every}\n" + OUTPUT + "run 6000\n", folder)
        lost = 6 * math.pi * VISCOSITY * (a / 2)**2 / (grains[0].mass / 2) * (math.log(OUTER / INNER) - 1 + INNER / OUTER)
        inside = next(now for now, _ in read_steps(folder) if now[1].x[0] - now[0].x[0] - 2 * a < INNER)
        found = inside[0].v[0] - inside[1].v[0]
        # Held forces lag behind by half of the held time, in which the gap closes by 1e-4 of the outer one for each step.
        expect(abs(found - (speed - lost)) < tolerance * speed, f"every {every}: {found} m/s at the inner gap, theory {speed - lost}")
        expect(lost > 0.05 * speed, "the film hardly slows the spheres: the scene shows nothing")


def check_long_steps(program, folder, grains):
    """A fluid so viscous that one step could stop every grain: films are bounded, and energy still only falls."""
    write_grains(folder, grains)
    film = FILM.replace(f"viscosity {VISCOSITY}", "viscosity 1e4") + f" walls zplane 0 zplane {HEIGHT}\n"
    program.must_run(scene(step=1e-6) + film + OUTPUT + "run 60\n", folder)
    rows = thermo_rows(log_text(folder), 9)
    bounded = rows[-1][6]
    expect(bounded > 0.5, f"{bounded} of the films are bounded")
    energy = [row[1] + row[2] for row in rows]
    expect(all(b <= a for a, b in zip(energy, energy[1:])), "energy rises")
    expect(energy[-1] < 0.5 * energy[0], "grains are hardly slowed down")
    # Held over ten steps, forces change every tenth, and neither momentum nor the fall of energy suffers.
    write_grains(folder, grains)
    film = FILM.replace(f"viscosity {VISCOSITY}", "viscosity 10") + " every 10\n"
    program.must_run(scene("p p p") + film + OUTPUT + "run 20\n", folder)
    forces = [[load[:3] for load in loads] for _, loads in read_steps(folder)]
    expect(forces[0] == forces[9] and forces[10] == forces[19] and forces[9] != forces[10], "forces are not held for ten steps")
    largest = max(abs(value) for force in forces[10] for value in force)
    expect(max(abs(sum(force[k] for force in forces[10])) for k in range(3)) < 1e-12 * largest, "held forces do not balance")
    rows = thermo_rows(log_text(folder), 9)
    energy = [row[1] + row[2] for row in rows]
    expect(energy[10] < energy[0] and energy[20] < energy[10], "energy rises with held forces")
    return bounded


GOOD = "viscosity 1e-3 outer 1e-4 inner 1e-6"
CASES = [
    ("fix film all lubrication", ["viscosity = nothing", "Pa s"]),
    ("fix film all lubrication viscosity 1e-3 inner 1e-6", ["outer = nothing", "2/3 of a cell"]),
    ("fix film all lubrication viscosity 1e-3 outer 1e-4", ["inner = nothing", "roughness"]),
    ("fix film all lubrication viscosity -1 outer 1e-4 inner 1e-6", ["viscosity = -1", "> 0"]),
    ("fix film all lubrication viscosity water outer 1e-4 inner 1e-6", ["viscosity = water", "be a number"]),
    ("fix film all lubrication viscosity 1e-3 outer 1e-6 inner 1e-6", ["inner = 1e-06", "smaller than outer"]),
    ("fix film all lubrication viscosity 1e-3 outer 0.1 inner 1e-6", ["outer = 0.1", "radius", "metres"]),
    (f"fix film all lubrication {GOOD} region water\nrun 0", ["region = water", "exist"]),
    (f"fix film all lubrication {GOOD} torque off", ["torque = off", "yes or no"]),
    (f"fix film all lubrication {GOOD} walls zplane 4\nrun 0", ["walls = zplane 4", "lie in the box, 0 to 0.004"]),
    (f"fix film all lubrication {GOOD} range 3", ["keyword = range", "viscosity, outer, inner"]),
    (f"fix film all lubrication {GOOD} every 0.5", ["every = 0.5", "whole number"]),
    (f"fix film all lubrication {GOOD} walls", ["walls", "be given"]),
    (f"fix film all lubrication {GOOD} walls top", ["walls = top", "zplane Z"]),
    (f"fix film all lubrication {GOOD} walls zplane 0 yplane 0\nrun 0", ["walls = yplane 0", "periodic axis"]),
    (f"fix film all lubrication {GOOD}\nfix more all lubrication {GOOD}\nrun 0", ["group = of", "no grain in common"]),
    (f"fix film all lubrication {GOOD} walls zplane high", ["zplane = high", "be a number"]),
    (f"fix film all lubrication {GOOD}", ["newton = on", "be off"]),
    (f"neighbor 1e-4 multi\nfix film all lubrication {GOOD}\nrun 1", ["neighbor style = multi", "bin"]),
    (f"delete_atoms group all\nfix film all lubrication {GOOD}", ["grains = none", "after"]),
    (f"fix film all lubrication {GOOD}\ncreate_atoms 1 single 1e-4 1e-4 2e-3 units box\n"
     "set type 1 diameter 1e-4\nrun 1", ["smallest radius = 5e-05", "after the insertion"]),
]


def check_mistakes(program, folder, grains):
    write_grains(folder, grains[:3])
    for lines, words in CASES:
        text = scene() + lines + "\n"
        if "newton" in words[0]:
            text = text.replace("newton off", "newton on").replace("tangential history", "tangential no_history") + "run 1\n"
        code, screen = program.run(text, folder, timeout=60)
        errors = [line for line in screen.splitlines() if line.startswith("suffuse: error:")]
        expect(code == 1 and len(errors) == 1, f"`{lines}` ended with code {code}, {len(errors)} error lines\n{screen[-800:]}")
        for word in words:
            expect(word in errors[0], f"`{lines}`: no '{word}' in: {errors[0]}")


def main():
    program = program_from_command_line(__doc__)
    grains = random_grains(100)
    with scratch() as folder:
        films, worst = check_many_grains(program, folder, grains)
        drift = check_conservation(program, folder, grains)
        fast = check_fast_pair(program, folder)
        check_slowing(program, folder)
        bounded = check_long_steps(program, folder, grains)
        if program.ranks < 3:
            check_mistakes(program, folder, grains)
    print(f"{program.ranks} ranks: {films:.0f} films within {worst:.1e}, momentum within {drift:.1e}, {fast} steps of a fast pair, "
          f"{bounded:.2f} of the films bounded at a long step")


if __name__ == "__main__":
    main()
