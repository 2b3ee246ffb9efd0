"""What OVITO makes of a text dump, by the rules of its manual (ovito.org/manual, file formats: LAMMPS dump, LAMMPS dump local);
OVITO itself is not in Debian."""
import dataclasses
import math
import re

from scenes import expect

# Names of columns that OVITO takes by itself, and what they become; other ones are properties of their own.
OF_COLUMNS = {"id": "Particle Identifier", "type": "Particle Type", "radius": "Radius",
              **{axis + suffix: f"Position.{axis.upper()}" for suffix in ("", "u") for axis in "xyz"},
              **{"v" + axis: f"Velocity.{axis.upper()}" for axis in "xyz"}, **{"f" + axis: f"Force.{axis.upper()}" for axis in "xyz"},
              **{"omega" + axis: f"Angular Velocity.{axis.upper()}" for axis in "xyz"}, **{"tq" + axis: f"Torque.{axis.upper()}" for axis in "xyz"}}
WHOLE = {"Particle Identifier", "Particle Type", "Particle Identifiers.A", "Particle Identifiers.B"}


class NotReadable(Exception):
    """OVITO would refuse the file, or show something else than its grains."""


@dataclasses.dataclass
class Table:
    timestep: int
    box: list  # low and high of x, y, z
    periodic: list
    columns: dict  # property: values, in the order of the file's rows


def properties_of(names):
    return [OF_COLUMNS.get(name.lower(), name) for name in names]


def sections_of(lines):
    """(title, its lines): OVITO goes from ITEM: to ITEM: and passes over those that it does not know."""
    if not lines or not re.match("ITEM: (TIMESTEP|UNITS|TIME)", lines[0]):
        raise NotReadable(f"begins with '{lines[0] if lines else ''}': no dump of LAMMPS")
    starts = [number for number, line in enumerate(lines) if line.startswith("ITEM:")]
    return [(lines[a].removeprefix("ITEM:").split(), lines[a + 1:b]) for a, b in zip(starts, starts[1:] + [len(lines)])]


def read(path, columns=None):
    """The first state of a dump. `columns`: properties of the columns, one each, None to leave one out, as OVITO's
    `FileSource.load(..., columns=)`: what a `dump local` of LIGGGHTS needs, whose columns have names of their own."""
    timestep, label, count, box, periodic = None, None, None, None, None
    for title, rows in sections_of(path.read_text(encoding="ascii").splitlines()):
        if title == ["TIMESTEP"]:
            timestep = int(rows[0])
        elif title[:2] == ["NUMBER", "OF"]:
            label, count = title[2], int(rows[0])
        elif title[:2] == ["BOX", "BOUNDS"]:
            if len(title) != 5:
                raise NotReadable(f"{' '.join(title)}: not a box along the axes with its three boundaries")
            box, periodic = [tuple(map(float, row.split())) for row in rows], [word == "pp" for word in title[2:]]
        elif label is not None and title[0] == label:
            if label != "ATOMS" and label.lower() not in ("entries", "bonds"):
                raise NotReadable(f"{label} are no bonds")
            names = properties_of(title[1:]) if columns is None else columns
            if len(names) != len(title) - 1 or len(rows) < count or any(len(row.split()) != len(names) for row in rows[:count]):
                raise NotReadable(f"{len(title) - 1} columns, {len(names)} properties, {len(rows)} of {count} rows, not all of them whole")
            values = [[int(word) if name in WHOLE else float(word) for name, word in zip(names, row.split())] for row in rows[:count]]
            return Table(timestep, box, periodic, {name: list(column) for name, column in zip(names, zip(*values)) if name is not None})
    raise NotReadable("no section of atoms or entries")


def check_grains_and_contacts(grains_file, contacts_file, columns):
    """Grains with places inside of their box and sizes, contacts as bonds of theirs: each joins two that touch, some through a
    periodic face, with a force that is the sum of its parts. Gives the numbers of grains and of contacts."""
    grains, bonds = read(grains_file), read(contacts_file, columns)
    radii, places = grains.columns["Radius"], list(zip(*(grains.columns[f"Position.{axis}"] for axis in "XYZ")))
    row = {grain: number for number, grain in enumerate(grains.columns["Particle Identifier"])}
    expect(len(row) == len(places) and min(radii) > 0, f"{len(row)} names for {len(places)} grains")
    expect(grains.periodic == [True] * 3 and bonds.box == grains.box and bonds.timestep == grains.timestep, "boxes of grains and contacts")
    digits = 1e-5 * max(high - low for low, high in grains.box)  # the box has six digits
    expect(all(low - digits <= place[axis] <= high + digits for place in places for axis, (low, high) in enumerate(grains.box)), "grains outside of their box")
    wrapped = 0
    for number, (a, b) in enumerate(zip(bonds.columns["Particle Identifiers.A"], bonds.columns["Particle Identifiers.B"])):
        apart = [q - p for p, q in zip(places[row[a]], places[row[b]])]
        # OVITO draws a bond to the nearest image.
        images = [round(d / (high - low)) for d, (low, high) in zip(apart, grains.box)]
        wrapped += any(images)
        gap = math.hypot(*(d - n * (high - low) for d, n, (low, high) in zip(apart, images, grains.box))) - radii[row[a]] - radii[row[b]]
        expect(gap < digits, f"contact of {a} and {b}, {gap} m apart")
        force, *parts = ([bonds.columns[f"{part}Force.{axis}"][number] for axis in "XYZ"] for part in ("", "Normal ", "Tangential "))
        expect(all(abs(whole - p - q) <= 1e-4 * math.hypot(*force) for whole, p, q in zip(force, *parts)), f"forces of {a} and {b}: {force}, {parts}")
    bonds_read = len(bonds.columns["Particle Identifiers.A"])
    expect(0 < wrapped < bonds_read, f"{wrapped} of {bonds_read} contacts are through a periodic face: nothing is tested")
    return len(places), bonds_read
