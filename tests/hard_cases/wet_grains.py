"""Scenes of grains in water whose every number is in hand: grains placed and pushed one by one, a lattice by its cells."""
import math
import random

from scenes import HEADER, material

VISCOSITY, DENSITY, SPACING = 1e-6, 1000.0, 1e-4


class Water:
    """A lattice: cells along x, y, z, relaxation time, and what follows."""

    def __init__(self, cells, tau, faces=None, gravity=0.0, preset="default", lines="", spacing=SPACING, precision="double"):
        self.cells, self.tau, self.spacing, self.gravity = cells, tau, spacing, gravity
        self.faces = faces or {}          # zlo="noslip", ...; periodic where none is named
        self.preset, self.lines, self.precision = preset, lines, precision

    @property
    def step(self):
        return (self.tau - 0.5) / 3 * self.spacing ** 2 / VISCOSITY

    def speed(self, cells_a_step):
        """m/s of a speed in cells a step."""
        return cells_a_step * self.spacing / self.step

    @property
    def size(self):
        return [n * self.spacing for n in self.cells]

    def text(self):
        boundary = " ".join(f"{face} {kind}" for face, kind in self.faces.items())
        return "\n".join(filter(None, [
            "lbm preset thesis" if self.preset == "thesis" else "",
            f"lbm fluid density {DENSITY} viscosity {VISCOSITY}",
            f"lbm lattice spacing {self.spacing:.12g} relaxation_time {self.tau} precision {self.precision}",
            f"lbm boundary {boundary}" if boundary else "",
            f"lbm force gravity 0 0 {-self.gravity}" if self.gravity else "",
            self.lines])) + "\n"


def grain(place, diameter, density=2650.0, velocity=(0, 0, 0)):
    return {"place": place, "diameter": diameter, "density": density, "velocity": velocity}


def write_grains(folder, grains, size, name="grains.data"):
    """LIGGGHTS's data file. A scene without grains has no contact law either: LIGGGHTS wants a grain of type 1 for it."""
    lines = ["grains of a hard case", "", f"{len(grains)} atoms", "1 atom types", ""]
    lines += [f"0 {length:.12g} {axis}lo {axis}hi" for axis, length in zip("xyz", size)]
    if grains:
        lines += ["", "Atoms", ""] + [f"{k + 1} 1 {g['diameter']:.12g} {g['density']:.12g} " + " ".join(f"{x:.12g}" for x in g["place"])
                                      for k, g in enumerate(grains)]
        lines += ["", "Velocities", ""] + [f"{k + 1} " + " ".join(f"{v:.12g}" for v in g["velocity"]) + " 0 0 0" for k, g in enumerate(grains)]
    (folder / name).write_text("\n".join(lines) + "\n")


def scene(bench, water, grains, after, periodic="ppp", friction=0.3, modulus=5e6, held=False, processors="* * *", restitution=0.3, timestep=None, extra=""):
    """Script text: the grains of `grains`, walls at faces that are not periodic, weight where the water has it, and `after`."""
    write_grains(bench.folder, grains, water.size)
    walls = [f"fix wall_{axis}{side} all wall/gran model hertz tangential history primitive type 1 {axis}plane {0 if side == 'lo' else water.size[k]:.12g}"
             for k, axis in enumerate("xyz") if grains and periodic[k] == "f" for side in ("lo", "hi")]
    smallest = min([g["diameter"] for g in grains], default=water.spacing)
    return "\n".join([
        HEADER.format(boundary=" ".join(periodic)), "hard_particles yes", f"processors {processors}", "" if grains else "atom_modify sort 0 0", "read_data grains.data",
        material(0.3 * smallest, modulus, restitution, friction) if grains else f"neighbor {0.3 * smallest} bin",
        "" if held else "fix motion all nve/sphere", *walls,
        f"fix weight all gravity {water.gravity} vector 0 0 -1" if water.gravity else "",
        "fix hydrodynamic_force all hydrodynamic/force",
        f"timestep {timestep:.12g}" if timestep else "dem_timestep rayleigh 0.2 pressure 100" if grains else f"timestep {water.step:.12g}",
        "thermo 1000000", "thermo_modify lost error norm no", extra, water.text(), after, ""])


def pulled_in_a_periodic_box(water, count, diameter, weight):
    """Lets the water's gradient balance the weight (m/s^2) in water of `count` grains; returns the line that pulls them."""
    pull = 1650 * math.pi / 6 * diameter ** 3 * weight
    water.lines = "\n".join(filter(None, [water.lines, f"lbm force pressure_gradient 0 0 {count * pull / math.prod(water.size):.12g}"]))
    return f"fix pull all addforce 0 0 {-pull:.12g}"


def array_speed(concentration):
    """Of a cubic array over that of a lone sphere (Hasimoto 1959)."""
    return 1 - 1.7601 * concentration ** (1 / 3) + concentration - 1.5593 * concentration ** 2


def stokes_velocity(diameter, gravity, density=2650.0):
    """m/s of a lone sphere that settles in the water (Stokes 1851)."""
    return (density / DENSITY - 1) * gravity * diameter ** 2 / (18 * VISCOSITY)


def weight_pressure(count, diameter, size):
    """Pa: the weight in water of `count` grains over the column's area, at which the gradient is critical."""
    return 1650 * 9.81 * count * math.pi / 6 * diameter ** 3 / (size[0] * size[1])


def scattered(count, diameter, size, seed=7, clear=1.05, walls="ppp", density=2650.0, speed=0.0):
    """Grains at random without contacts; pushed in random directions with `speed`."""
    dice, found = random.Random(seed), []
    while len(found) < count:
        margin = [0.55 * diameter if kind == "f" else 0.0 for kind in walls]
        place = [m + dice.random() * (length - 2 * m) for m, length in zip(margin, size)]
        apart = all(math.sqrt(sum(min(abs(a - b), (length - abs(a - b)) if kind == "p" else math.inf) ** 2
                                  for a, b, length, kind in zip(place, other["place"], size, walls))) > clear * diameter for other in found)
        if apart:
            direction = [dice.gauss(0, 1) for _ in range(3)]
            norm = math.sqrt(sum(d * d for d in direction))
            found.append(grain(place, diameter, density, [speed * d / norm for d in direction]))
    return found


def cubic(counts, diameter, gap=1.0, corner=(0, 0, 0), density=2650.0):
    """A simple cubic array, `gap` diameters from centre to centre."""
    pitch = gap * diameter
    return [grain([c + pitch * (n + 0.5) for c, n in zip(corner, (i, j, k))], diameter, density)
            for k in range(counts[2]) for j in range(counts[1]) for i in range(counts[0])]


def last_dump(path):
    """Values by column of the last snapshot of a dump, rows in the order of the ids."""
    text = path.read_text().split("ITEM: ATOMS ")[-1]
    names, rows = text.splitlines()[0].split(), [list(map(float, line.split())) for line in text.splitlines()[1:]]
    rows.sort(key=lambda row: row[names.index("id")])
    return {name: [row[k] for row in rows] for k, name in enumerate(names)}


DUMP = 'dump grains all custom 1 grains.dump id x y z vx vy vz omegax omegay omegaz radius\n' \
       'dump_modify grains format "%d' + " %.17g" * 10 + '"\n'
