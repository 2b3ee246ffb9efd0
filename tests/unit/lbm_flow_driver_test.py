"""suffuse-flow from the outside: a duct passes the discharge of the series, a run in two halves gives the digits of a
run in one, and wrong input ends with one line and exit code 1. Usage: lbm_flow_driver_test.py PROGRAM MPIRUN FOLDER"""
import pathlib
import subprocess
import sys

CASE = """
[fluid]
viscosity = 1e-6
[lattice]
size = [0.0016, 0.0016, 0.0008]
spacing = 1e-4
relaxation_time = 1.1
[boundary]
xlo = "noslip"
xhi = "noslip"
ylo = "noslip"
yhi = "noslip"
zlo = {{ kind = "pressure", value = 1e-4, ramp = 0.2 }}
zhi = {{ kind = "pressure", value = 0 }}
[run]
time = {time}
[monitor]
file = "{name}.csv"
every = 0.5
[output]
file = "{name}.h5"
every = 1
[restart]
{restart}
"""


def main(program, mpirun, folder):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for left in folder.iterdir():  # of an earlier test
        left.unlink()

    def run(name, time, restart="", ranks=2, text=None):
        case = folder / f"{name}.toml"
        case.write_text(text or CASE.format(name=name, time=time, restart=restart))
        start = [mpirun, str(ranks)] if ranks > 1 else []
        return subprocess.run([*start, program, str(case)], cwd=folder, capture_output=True, text=True)

    def last_row(name):
        return (folder / f"{name}.csv").read_text().split("\n")[-2].split(",")

    whole = run("whole", 3)
    assert whole.returncode == 0, whole.stderr
    assert "% of the memory's" in whole.stdout and "MLUPS" in whole.stderr, whole
    velocity = float(last_row("whole")[3])
    series = 0.0351443 * (1e-4 / 0.0008) * 0.0016**2 / 1e-3
    # 0.5 %: the duct's second-order error on 16 cells; 3 s are 1.2 viscous times of the width, slowest mode exp(-23).
    assert abs(velocity / series - 1) < 0.008, (velocity, series)
    assert (folder / "whole.xdmf").exists()

    # The other half on another number of ranks; the ramp has ended, so the same steps are made.
    assert run("half", 1.5, 'write = "half_state.h5"').returncode == 0
    assert run("rest", 1.5, 'read = "half_state.h5"', ranks=3).returncode == 0
    # All but the sums over ranks, which are added in another order, are the same digits.
    one, two = last_row("whole"), last_row("rest")
    assert one[0] == two[0] and abs(float(one[3]) / float(two[3]) - 1) < 1e-13, (one, two)

    # A force that swings is where it was; a state means what it meant.
    swing = CASE.replace("[run]", "[force]\nacceleration = [0, 0, 0.01]\nfrequency = 0.7\n[run]").replace("every = 0.5", "every = 0.25")
    for name, time, restart in [("swung", 1, ""), ("swung_half", 0.5, 'write = "swung_state.h5"'), ("swung_rest", 0.5, 'read = "swung_state.h5"')]:
        assert run(name, time, text=swing.format(name=name, time=time, restart=restart)).returncode == 0
    one, two = last_row("swung"), last_row("swung_rest")
    assert one[0] == two[0] and abs(float(one[3]) / float(two[3]) - 1) < 1e-12, (one, two)
    other = swing.format(name="other", time=0.5, restart='read = "swung_state.h5"')
    for change, message in [(("relaxation_time = 1.1", "relaxation_time = 0.9"), "time step = "),
                            (("spacing = 1e-4", "spacing = 2e-4"), "cells"),
                            (("viscosity = 1e-6", "viscosity = 2e-6"), "time step = ")]:
        bad = run("other", 1, ranks=1, text=other.replace(*change))
        assert bad.returncode == 1 and message in bad.stderr and "swung_state.h5" in bad.stderr, bad

    # A state brings its solids: others are refused, the same and none go on. Snapshots are kept without a state to go on from.
    around = CASE.replace("[run]", "[solids]\nspheres = [[8e-4, 8e-4, {x}, 3e-4]]\n[run]").replace("every = 1\n", "every = 0.25\nappend = true\n")
    assert run("round", 0.5, text=around.format(x="4e-4", name="round", time=0.5, restart='write = "round_state.h5"')).returncode == 0
    go_on = dict(name="round", time=0.25, restart='read = "round_state.h5"')
    other = run("round", 0.25, text=around.format(x="3e-4", **go_on))
    assert other.returncode == 1 and "spheres = not those of round_state.h5" in other.stderr, other
    for text in (CASE.format(**go_on), around.format(x="4e-4", **go_on)):
        assert run("round", 0.25, text=text).returncode == 0
    again = run("round", 0.25, text=around.format(x="4e-4", name="round", time=0.25, restart=""))
    assert again.returncode == 0 and "round.h5 of an earlier run is now round.h5.before" in again.stdout, again

    good = CASE.format(name="bad", time=1, restart="")
    for change, message in [
        (('xlo = "noslip"', 'xlo = "nosli"'), "xlo = nosli, must be one of"),
        (("spacing = 1e-4", "spacing = 1.1e-4"), "fits"),
        (("\ntime = 1", "\ntim = 1"), "key = tim, must be one of time"),
        (("relaxation_time = 1.1", "relaxation_time = 0.5"), "must be > 0.5; raise viscosity or timestep"),
        (('zhi = { kind = "pressure", value = 0 }', 'zhi = "periodic"'), "must be periodic"),
        (("viscosity = 1e-6", 'viscosity = "water"'), "must be a number"),
        (("[run]", "[run"), "line"),
        (("\ntime = 1", "\ntime = 1e30"), "must be at most 1e+15 steps"),
        (("\ntime = 1", "\ntime = inf"), "time = inf, must be finite"),
        (("\ntime = 1", "\ntime = 0"), "time = 0, must be > 0"),
        (("\ntime = 1", "\ntime = 1\nuntil_steady = nan"), "until_steady = nan, must be finite"),
        (("\ntime = 1", "\ntime = 1\nuntil_steady = 0"), "until_steady = 0, must be > 0"),
        (("\ntime = 1", "\ntime = 1\nuntil_steady = 2"), "until_steady = 2, must be below 1"),
        (("\ntime = 1", "\ntime = 1\nuntil_steady = 1e-3\n[force]\nfrequency = 2"), "swings"),
        (("every = 0.5", "every = nan"), "[monitor]: every = nan, must be finite"),
        (("every = 0.5", "every = 0"), "[monitor]: every = 0, must be > 0"),
        (("every = 1", "every = -1"), "[output]: every = -1, must be > 0"),
        (("every = 1", 'every = 1\nfields = ["velocity", "velocity"]'), "velocity twice"),
        (("ramp = 0.2", "ramp = -0.2"), "ramp = -0.2, must be >= 0"),
        (("ramp = 0.2", "ramp = nan"), "ramp = nan, must be finite"),
        (('kind = "pressure", value = 0 ', 'kind = "pressure", value = inf '), "value = inf, must be finite"),
        (('kind = "pressure", value = 0 ', 'kind = "pressure" '), "come with a value"),
        (('xhi = "noslip"', 'xhi = { kind = "noslip", value = 1 }'), "come without value"),
        (("[run]", "[force]\nfrequency = -2\n[run]"), "frequency = -2, must be >= 0"),
        (("[run]", "[force]\nacceleration = [0, 0, nan]\n[run]"), "must be three finite numbers"),
        (("[run]", "[solids]\nspheres = [[0, 0, 0, inf]]\n[run]"), "finite, with a radius > 0"),
        (("[run]", "[solids]\nspheres = [[1, 0, 0, 1e-4]]\n[run]"), "must hold the centre of a cell"),
        (("[run]", "[solids]\nspheres = [[8e-4, 8e-4, 4e-4, 1]]\n[run]"), "all cells are solid"),
        (("[run]", "[force]\nfrequency = 1e3\n[run]"), "frequency = 1000 Hz, a period of"),
        (("size = [0.0016,", "size = [inf,"), "must be three finite numbers"),
        (("viscosity = 1e-6", "viscosity = -1e-6"), "viscosity = -1e-06, must be > 0"),
        (("viscosity = 1e-6", "viscosity = 1e-6\ndensity = nan"), "density = nan, must be finite"),
        (("spacing = 1e-4", "spacing = 1e-4\npressure_difference = nan"), "pressure_difference = nan"),
        (("spacing = 1e-4", 'spacing = 1e-4\ncollision = "bgk"\nmagic = 0.2'), "go with trt"),
        (("spacing = 1e-4", "spacing = 1e-4\nmagic = -1"), "magic = -1, must be > 0"),
        (("spacing = 1e-4", "spacing = 1e-4\nsmagorinsky = nan"), "smagorinsky = nan, must be finite"),
        (("[fluid]\nviscosity = 1e-6", "fluid = 3"), "must be a table"),
        (('file = "bad.csv"', ""), "[monitor]: file = missing"),
        (('file = "bad.csv"', 'file = "bad.xdmf"'), "bad.xdmf, must be written by one table only"),
        (("[restart]", '[restart]\nwrite = "/dev/null"'), "must be a regular file"),
        (("[restart]", '[restart]\nwrite = "nowhere/state.h5"'), "must be writable"),
        (("viscosity = 1e-6", "viscosity = 1e-6\nviscosity = 2e-6"), "line"),
    ]:
        assert change[0] in good, change
        ranks = 2 if "nosli" in change[1] else 1  # starting two takes a second
        bad = run("bad", 1, ranks=ranks, text=good.replace(*change, 1))
        said = [line for line in bad.stderr.split("\n") if line.startswith("suffuse-flow: ")]
        assert bad.returncode == 1 and len(said) == 1 and message in said[0], (change, bad.returncode, bad.stderr)
        assert not (folder / "bad.csv").exists(), "something was written before the input was checked"
    for path in (folder / "absent.toml", folder):
        bad = subprocess.run([program, str(path)], cwd=folder, capture_output=True, text=True)
        assert bad.returncode == 1 and str(path) in bad.stderr and "line 0" not in bad.stderr, (path, bad.stderr)

    # The duct's slowest mode dies with W^2/(2 pi^2 nu) = 0.13 s: in a tenth of 0.2 s the flow still changes; of 6 s, the
    # second tenth changes it by exp(-4.6) and the third by exp(-9).
    steady = good.replace(", ramp = 0.2", "").replace("every = 0.5", "every = 0.02")
    short = run("short", 0, text=steady.replace("\ntime = 1", "\ntime = 0.2\nuntil_steady = 1e-3"))
    assert short.returncode == 3 and "not yet steady after 0.2 s" in short.stdout, short
    long = run("long", 0, text=steady.replace("\ntime = 1", "\ntime = 6\nuntil_steady = 1e-3"))
    assert long.returncode == 0 and "\nsteady after 1.8 s" in long.stdout, long
    # What the first of the two left is kept.
    assert "bad.csv of an earlier run is now bad.csv.before" in long.stdout, long.stdout
    times = [float(row.split(",")[0]) for row in (folder / "bad.csv.before").read_text().split("\n")[1:-1]]
    assert len(times) == 11 and abs(times[-1] - 0.2) < 1e-9, times
    assert all((folder / name).exists() for name in ("bad.h5", "bad.h5.before", "bad.xdmf.before"))
    print("velocity / series:", velocity / series)


main(*sys.argv[1:])
