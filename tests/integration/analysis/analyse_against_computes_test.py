#!/usr/bin/env python3
"""analyse_against_computes_test.py --suffuse PROGRAM --mpirun SCRIPT --analyse PROGRAM

`suffuse-analyse contacts` gives what the computes gave in the run, on 1 and 2 ranks, for two states of a sheared sample: to
round-off from HDF5, to 1e-5 from LIGGGHTS's dumps of six digits, in text and gzip, one file a snapshot and all in one. Six digits
cannot tell a sliding contact from one at 1 - 1e-6 of its friction: there the share lies between those of the run with both limits;
dumps of ten digits give the run's own.
"""
import csv
import gzip
import math
import os
import shutil
import sys
import tempfile

try:
    import h5py
    import numpy
except ImportError:  # Debian's Python has them
    if sys.executable == "/usr/bin/python3":
        raise
    os.execv("/usr/bin/python3", ["/usr/bin/python3", *sys.argv])

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "micromechanics"))
from computed_columns import COLUMNS, COMPUTES, LAW_COLUMNS, LAW_VALUES, difference  # noqa: E402
from contact_scene import SAMPLE, SPLIT, Suffuse, check, read_dump  # noqa: E402
from scenes import thermo_rows  # noqa: E402

WORDS = [word for _, word, _ in COLUMNS] + ["c_sw[1]", "vol", "xlo", "xhi", "ylo", "yhi", "zlo", "zhi"]
VALUES = " ".join(f"c_pairs[{k}]" for k in range(1, 19)) + " " + LAW_VALUES


def dumps(tag):
    """Six digits as LIGGGHTS writes them, and all digits for the HDF5 file."""
    return f"""
dump short{tag} all local 1 pairs.*.dump {VALUES}
dump grains{tag} all custom 1 grains.*.dump id type x y z radius
dump ten{tag} all local 1 ten.pairs.*.dump {VALUES}
dump_modify ten{tag} format "{" ".join(["%.10g"] * 20)}"
dump long{tag} all local 1 exact.pairs.{tag} {VALUES}
dump_modify long{tag} format "{" ".join(["%.17g"] * 20)}"
dump all{tag} all custom 1 exact.grains.{tag} id radius x y z
dump_modify all{tag} format "%d {" ".join(["%.17g"] * 4)}"
run 0
undump short{tag}
undump grains{tag}
undump ten{tag}
undump long{tag}
undump all{tag}
"""


SCRIPT = SAMPLE + COMPUTES.format(split=SPLIT) + f"""
compute pairs all pair/gran/local force_tangential id pos force_normal force
thermo_style custom step {" ".join(WORDS)}
thermo_modify format float %.17g
{dumps("a")}
fix servo all stress/servo constant_p 100e3 axis z rate 5 inertial_number 1e-2 until axial_strain 0.01
run 200
unfix servo
{dumps("b")}
"""


def states(log):
    """What the computes gave at the two `run 0`s, by step."""
    return {int(step): dict(zip(WORDS, values)) for step, *values in thermo_rows(log, len(WORDS) + 1)}


def write_hdf5(path, folder, computed):
    with h5py.File(path, "w") as file:
        for tag, step in zip("ab", sorted(computed)):
            grains, pairs = read_dump(folder / f"exact.grains.{tag}"), read_dump(folder / f"exact.pairs.{tag}")
            group = file.create_group(f"step_{step:012d}")
            group.attrs["time_s"] = step * 2e-6
            group["box"] = [[computed[step][f"{axis}{end}"] for axis in "xyz"] for end in ("lo", "hi")]
            group["periodic"] = numpy.array([1, 1, 1], dtype="u1")
            group["grains/id"] = numpy.array([g["id"] for g in grains], dtype="i8")
            group["grains/radius"] = [g["radius"] for g in grains]
            group["grains/position"] = [[g[axis] for axis in "xyz"] for g in grains]
            group["contacts/ids"] = numpy.array([[p["c_pairs[7]"], p["c_pairs[8]"]] for p in pairs], dtype="i8")
            group["contacts/force"] = [[p[f"c_pairs[{k}]"] for k in (10, 11, 12)] for p in pairs]
            group["contacts/friction_limit"] = [p["c_si[7]"] for p in pairs]
            group["contacts/spring_force"] = [p["c_si[8]"] for p in pairs]


def gather(folder, name, steps):
    """One file of several snapshots."""
    return "".join((folder / f"{name}.{step}.dump").read_text() for step in steps)


def compare(suffuse, computed, what, files, tolerance):
    words = ["contacts", *files, "--split", SPLIT, "--output", "series.csv", "--overwrite"]
    if str(files[0]).endswith(".h5"):  # has the names of its quantities itself
        code, _, err = suffuse.analyse(*words, *LAW_COLUMNS)
        check(code == 1 and "leave these out" in err, f"{what}: --column of an HDF5 file: {err}")
    else:
        words += LAW_COLUMNS
    code, out, err = suffuse.analyse(*words)
    check(code == 0, f"{what}: suffuse-analyse ended with {code}: {err}")
    with open(suffuse.folder / "series.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    check([int(row["step"]) for row in rows] == sorted(computed), f"{what}: steps {[row['step'] for row in rows]}")
    worst = 0
    for row in rows:
        run = computed[int(row["step"])]
        for column, word, of_text in COLUMNS:
            value, expected = float(row[column]), run[word]
            if tolerance is None and of_text is None:
                continue
            allowed = of_text if tolerance is None else tolerance
            error = difference(value, expected)
            worst = max(worst, error)
            check(error <= allowed, f"{what}, step {row['step']}: {column} = {value!r}, in the run {word} = {expected!r}, off by {error:.2e}")
        share = float(row["sliding_share"])
        check(run["c_s[1]"] - 1e-12 <= share <= run["c_sw[1]"] + 1e-12, f"{what}: sliding {share}, in the run {run['c_s[1]']} to {run['c_sw[1]']}")
        ratio = float(row["coordination_number"]) * (3 - 2 * share) / 12
        check(abs(float(row["constraint_ratio"]) - ratio) < 1e-12, f"{what}: R {row['constraint_ratio']} is not Z (3 - 2 S_c)/12 = {ratio}")
    return worst


def check_bad_hdf5(suffuse):
    """HDF5 files that lack something or do not fit together are refused in one line; a volume stands in for a box."""
    def refused(what, words, change):
        path = suffuse.folder / "bad.h5"
        shutil.copyfile(suffuse.folder / "exact.h5", path)
        if callable(change):
            with h5py.File(path, "r+") as file:
                change(file[sorted(file)[1]])
        else:
            os.truncate(path, change)
        code, _, err = suffuse.analyse("contacts", "bad.h5", "--output", "bad.csv")
        check(code == 1 and len(err.strip().splitlines()) == 1 and all(word in err for word in words), f"{what}: exit code {code}, {err}")
        check(not list(suffuse.folder.glob("bad.csv*")), f"{what}: results are left behind")

    def without(name):
        def change(step):
            del step[name]
        return change

    def with_value(name, at, value):
        def change(step):
            step[name][at] = value
        return change

    def with_type(name, kind, at, value):
        def change(step):
            values = step[name][()].astype(kind)
            values[at] = value
            del step[name]
            step[name] = values
        return change

    def turned_on_itself(step):
        step["contacts/ids"][4] = [step["contacts/ids"][4][0]] * 2

    def twice(step):
        for name in ("ids", "force", "friction_limit", "spring_force"):
            step[f"contacts/{name}"][7] = step[f"contacts/{name}"][6]

    def claiming(step):
        del step["grains/radius"]
        step.create_dataset("grains/radius", shape=(2**40,), chunks=(1024,), dtype="f8")  # 8 TiB of nothing

    refused("no box", ["bad.h5/step_", "no box", "--volume"], without("box"))
    refused("no radius", ["grains/radius"], without("grains/radius"))
    refused("no force", ["contacts/force"], without("contacts/force"))
    refused("an unknown grain", ["grain 99999", "not there"], with_value("contacts/ids", (3, 1), 99999))
    refused("a grain twice", ["twice"], with_value("grains/id", 0, 5))
    refused("nan", ["contacts/force", "nan"], with_value("contacts/force", (0, 0), math.nan))
    refused("other units", ["units"], with_value("grains/radius", 3, 0.5))
    refused("half a grain", ["identifier", "5.5"], with_type("contacts/ids", "f8", (3, 1), 5.5))
    refused("a grain of a broken number", ["identifier", "2.5"], with_type("grains/id", "f8", 1, 2.5))
    refused("a contact with itself", ["0 m apart"], turned_on_itself)
    refused("a contact with itself, told apart", ["in contact with itself"], lambda step: (turned_on_itself(step), step.create_dataset(
        "contacts/branch", data=numpy.full(step["contacts/ids"].shape[:1] + (3,), 2e-4))))
    refused("a contact twice", ["is there twice"], twice)
    refused("a negative limit", ["negative friction"], with_value("contacts/friction_limit", 2, -1))
    refused("claims without data", ["grains/radius claims"], claiming)
    refused("a cut file", ["bad.h5"], 3000)
    shutil.copyfile(suffuse.folder / "exact.h5", suffuse.folder / "free.h5")
    with h5py.File(suffuse.folder / "free.h5", "r+") as file:
        for step in file.values():
            del step["box"], step["periodic"]
    code, _, err = suffuse.analyse("contacts", "free.h5", "--volume", "1e-7")
    # Without the box contacts across its faces look far apart: told, not counted wrongly.
    check(code == 1 and "apart" in err, f"no period: exit code {code}, {err}")


def main():
    with tempfile.TemporaryDirectory(prefix="suffuse-test-") as folder:
        suffuse = Suffuse(folder, __doc__)
        suffuse.prepare()
        for ranks in (1, 2):
            computed = states(suffuse.must_run(ranks, SCRIPT, f"computes{ranks}"))
            check(len(computed) == 2, f"{len(computed)} states in the run's output")
            shares = [computed[step]["c_s[1]"] for step in computed]
            check(min(shares) > 0 and abs(shares[0] - shares[1]) > 1e-3, f"shares of sliding contacts {shares} do not tell the states apart")
            write_hdf5(suffuse.folder / "exact.h5", suffuse.folder, computed)
            # 1e-11: sums of some thousand terms, and the 1e-13 by which the run stretches the springs of sliding contacts.
            exact = compare(suffuse, computed, f"HDF5, {ranks} ranks", ["exact.h5"], 1e-11)
            text = compare(suffuse, computed, f"text, {ranks} ranks", ["pairs.*.dump", "grains.*.dump"], None)
            # Ten digits: positions to 5e-13 m of 5e-3, box bounds still six digits in the header: 1e-6 of the box in some branches.
            compare(suffuse, computed, f"ten digits, {ranks} ranks", ["ten.pairs.*.dump", "grains.*.dump"], 1e-5)
            steps = sorted(computed)
            with gzip.open(suffuse.folder / "all.pairs.gz", "wt") as file:
                file.write(gather(suffuse.folder, "pairs", steps))
            (suffuse.folder / "all.grains").write_text(gather(suffuse.folder, "grains", steps))
            compare(suffuse, computed, f"one gzip file, {ranks} ranks", ["all.pairs.gz", "all.grains"], None)
            if ranks == 1:
                check_bad_hdf5(suffuse)
            print(f"{ranks} ranks: largest difference to the run {exact:.1e} from HDF5, {text:.1e} from text of six digits")


if __name__ == "__main__":
    main()
