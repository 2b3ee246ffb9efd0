"""What runs of suffuse leave, as pandas tables with units: monitor files, dumps of LIGGGHTS, HDF5 of `lbm output`.

    import sys; sys.path.insert(0, "analysis/python")      # PREFIX/share/suffuse/python where suffuse is installed
    import suffuse_data as data

    flow = data.read_monitor("flow.csv")                   # a row an instant, columns as in the file
    flow.attrs["units"]["superficial_velocity_z_m_per_s"]  # "m/s"
    grains = data.read_dump("grains.20000.dump")           # a row a grain, index: id
    last = data.read_grains("bed_grains.h5")               # the last snapshot; time=0.2: the nearest to it
    water = data.read_fields("bed.h5", time=0.2)           # arrays [z, y, x], origin and spacing in m

Everything is in SI units. Every table says in `attrs` where it comes from ("file") and its columns' units ("units", where they
have one); snapshots also their "time_s" or "step". Needs pandas, and h5py for HDF5 (Debian: python3-pandas, python3-h5py).
"""
import dataclasses
import pathlib
import re

import numpy
import pandas

UNITS_OF_NAMES = {"m3_per_s": "m3/s", "m_per_s2": "m/s2", "m_per_s": "m/s", "rad_per_s": "rad/s", "kg_per_m3": "kg/m3", "pa_per_m": "Pa/m",
                  "pa": "Pa", "kg": "kg", "nm": "N m", "n": "N", "j": "J", "s": "s", "mm": "mm", "m": "m"}
NAME_WITH_UNIT = re.compile("_(" + "|".join(UNITS_OF_NAMES) + r")(_\d+|_[xyz])*$")
# Columns of `dump custom` that LIGGGHTS defines, with `units si`.
UNITS_OF_DUMPS = {**dict.fromkeys(("x", "y", "z", "xu", "yu", "zu", "radius", "diameter"), "m"), **dict.fromkeys(("vx", "vy", "vz"), "m/s"),
                  **dict.fromkeys(("fx", "fy", "fz"), "N"), **dict.fromkeys(("omegax", "omegay", "omegaz"), "rad/s"),
                  **dict.fromkeys(("tqx", "tqy", "tqz"), "N m"), "mass": "kg", "density": "kg/m3"}


class DataError(ValueError):
    """A file that is not what was expected: its message names the file and what to give instead."""


def unit_of(column):
    """The unit that a column of a monitor has in its name, or None: velocity_z_m_per_s -> "m/s", stress_pa_3 -> "Pa"."""
    found = None if column.startswith("grains_left") else NAME_WITH_UNIT.search(column)
    return UNITS_OF_NAMES[found[1]] if found else None


def known_units(columns, unit):
    return {name: unit(name) for name in columns if unit(name)}


def read_monitor(path):
    """A CSV file of `lbm monitor`, or of suffuse-analyse: numbers as numbers, empty cells as NaN, lines with # left out."""
    try:
        table = pandas.read_csv(path, comment="#", skipinitialspace=True)
    except pandas.errors.EmptyDataError:
        raise DataError(f"{path}: is empty; has the run got that far?") from None
    table.attrs = {"file": str(path), "units": known_units(table.columns, unit_of)}
    return table


def read_dump(path):
    """The last snapshot of a file of `dump ... custom` or `local`: a row a grain (index: id, where there is one) or a contact.

    attrs: "step", "box" (low and high, a row an axis, m), "boundary" (as "pp pp ff"), "units"."""
    try:
        lines = pathlib.Path(path).read_text(encoding="ascii").splitlines()
    except UnicodeDecodeError:
        raise DataError(f"{path}: is no text file; read binary dumps by LIGGGHTS's binary2txt") from None
    starts = [number for number, line in enumerate(lines) if line.startswith("ITEM: TIMESTEP")]
    if not starts:
        raise DataError(f"{path}: is no dump of LIGGGHTS (no ITEM: TIMESTEP)")
    lines = lines[starts[-1]:]
    try:
        step, count = int(lines[1]), int(lines[3])
        box = numpy.array([[float(word) for word in line.split()[:2]] for line in lines[5:8]])
        columns, rows = lines[8].split()[2:], [line.split() for line in lines[9:9 + count]]
    except (IndexError, ValueError):
        raise DataError(f"{path}: ends in the middle of its header; is the run still writing?") from None
    if len(rows) < count or any(len(row) != len(columns) for row in rows):
        raise DataError(f"{path}: has fewer rows or values than it announces; is the run still writing?")
    table = pandas.DataFrame(rows, columns=columns).apply(pandas.to_numeric)
    if "id" in columns:
        table = table.set_index("id").sort_index()
    table.attrs = {"file": str(path), "step": step, "box": box, "boundary": lines[4].partition("BOUNDS")[2].strip(),
                   "units": {name: UNITS_OF_DUMPS[name] for name in columns if name in UNITS_OF_DUMPS}}
    return table


def read_dumps(folder, pattern):
    """The dumps of a folder that fit a pattern such as "grains.*.dump", in the order of their steps: one table, index (step, id)."""
    files = sorted(pathlib.Path(folder).glob(pattern))
    if not files:
        raise DataError(f"{folder}: has no {pattern}")
    tables = sorted((read_dump(file) for file in files), key=lambda table: table.attrs["step"])
    whole = pandas.concat({table.attrs["step"]: table for table in tables}, names=["step"])
    whole.attrs = {"file": f"{folder}/{pattern}", "units": tables[0].attrs["units"]}
    return whole


def open_hdf5(path):
    try:
        import h5py
    except ImportError:
        raise DataError("this Python has no h5py; install it (Debian: python3-h5py)") from None
    try:
        return h5py.File(path, "r")
    except OSError as problem:
        raise DataError(f"{path}: {problem}; give FILE.h5 or FILE_grains.h5 of `lbm output`") from None


def snapshots(file):
    """Groups of an open file in the order of time."""
    groups = [file[name] for name in file if name.startswith("step_")]
    if not groups:
        raise DataError(f"{file.filename}: has no snapshots; is it a file of `lbm output`?")
    return sorted(groups, key=lambda group: float(group.attrs["time_s"]))


def snapshot_at(file, time):
    groups = snapshots(file)
    return groups[-1] if time is None else min(groups, key=lambda group: abs(float(group.attrs["time_s"]) - time))


def read_times(path):
    """Times of all snapshots of a file of `lbm output`, s."""
    with open_hdf5(path) as file:
        return [float(group.attrs["time_s"]) for group in snapshots(file)]


def text_of(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def origin_of(file):
    """What a file says of itself: "suffuse_version" and "script", in files that have them."""
    return {name: text_of(file.attrs[name]) for name in ("suffuse_version", "script") if name in file.attrs}


def table_of(path, time, group_name, axes):
    """Arrays of a group as columns; of three values each as name_x, name_y, name_z."""
    with open_hdf5(path) as file:
        snapshot = snapshot_at(file, time)
        if group_name not in snapshot:
            raise DataError(f"{path}: has no {group_name}; add the word to `lbm output`, and give its FILE_grains.h5")
        columns, units = {}, {}
        for name, array in snapshot[group_name].items():
            if name in ("ends", "lines"):
                continue  # the same as lines for ParaView
            values, unit = array[()], array.attrs.get("units")
            names = [name] if values.ndim == 1 else [f"{name}_{axis}" for axis in axes.get(name, "xyz")]
            for k, column in enumerate(names):
                columns[column] = values if values.ndim == 1 else values[:, k]
                if unit is not None:
                    units[column] = text_of(unit)
        table = pandas.DataFrame(columns)
        table.attrs = {"file": str(path), "time_s": float(snapshot.attrs["time_s"]), "box": snapshot["box"][()].T,
                       "units": units, **origin_of(file)}
    return table


def read_grains(path, time=None):
    """Grains of FILE_grains.h5 at the last snapshot, or that nearest to a time: position_x, velocity_z, force_y, ...; index: id."""
    table = table_of(path, time, "grains", {})
    attrs, table = table.attrs, table.set_index("id").sort_index()
    table.attrs = attrs
    return table


def read_contacts(path, time=None):
    """Contacts of FILE_grains.h5 (`lbm output ... contacts`): id_1, id_2 (negative: a wall), force on the first, branch, friction."""
    return table_of(path, time, "contacts", {"ids": "12"}).rename(columns={"ids_1": "id_1", "ids_2": "id_2"})


@dataclasses.dataclass
class Fields:
    """One snapshot of the water. Arrays are indexed [z, y, x], velocity[z, y, x, axis]; values are those of cells' centres."""

    time_s: float
    arrays: dict
    origin: numpy.ndarray  # of the box's low corner, m
    spacing: float  # of the cells, m
    units: dict
    file: str

    def __getitem__(self, name):
        if name not in self.arrays:
            raise DataError(f"{self.file}: has no {name}, but {', '.join(self.arrays)}; add it to `lbm output`")
        return self.arrays[name]

    def centres(self, axis):
        """Coordinates of the cells' centres along axis 0, 1 or 2 (x, y, z), m."""
        count = next(iter(self.arrays.values())).shape[2 - axis]
        return self.origin[axis] + self.spacing * (numpy.arange(count) + 0.5)


def read_fields(path, time=None):
    """Fields of FILE.h5 of `lbm output` at the last snapshot, or that nearest to a time."""
    with open_hdf5(path) as file:
        if "spacing_m" not in file.attrs:
            raise DataError(f"{path}: does not say its spacing; is it a file of `lbm output` of this version?")
        snapshot = snapshot_at(file, time)
        return Fields(float(snapshot.attrs["time_s"]), {name: array[()] for name, array in snapshot.items()},
                      numpy.array([float(file.attrs[f"origin_{axis}_m"]) for axis in "xyz"]), float(file.attrs["spacing_m"]),
                      {name: text_of(array.attrs["units"]) for name, array in snapshot.items() if "units" in array.attrs}, str(path))
