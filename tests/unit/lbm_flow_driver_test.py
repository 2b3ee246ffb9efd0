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

    def run(name, time, restart="", ranks=2, text=None):
        case = folder / f"{name}.toml"
        case.write_text(text or CASE.format(name=name, time=time, restart=restart))
        return subprocess.run([mpirun, str(ranks), program, str(case)], cwd=folder, capture_output=True, text=True)

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

    good = CASE.format(name="bad", time=1, restart="")
    for change, message in [
        (('xlo = "noslip"', 'xlo = "nosli"'), "xlo = nosli, must be one of"),
        (("spacing = 1e-4", "spacing = 1.1e-4"), "fits"),
        (("\ntime = 1", "\ntim = 1"), "key = tim, must be one of time"),
        (("relaxation_time = 1.1", "relaxation_time = 0.5"), "must be > 0.5; raise viscosity or timestep"),
        (('zhi = { kind = "pressure", value = 0 }', 'zhi = "periodic"'), "must be periodic"),
        (("viscosity = 1e-6", 'viscosity = "water"'), "must be a number"),
        (("[run]", "[run"), "line"),
    ]:
        assert change[0] in good, change
        bad = run("bad", 1, text=good.replace(*change))
        said = [line for line in bad.stderr.split("\n") if line.startswith("suffuse-flow: ")]
        assert bad.returncode == 1 and len(said) == 1 and message in said[0], (change, bad.returncode, bad.stderr)
        assert not (folder / "bad.csv").exists(), "something was written before the input was checked"
    print("velocity / series:", velocity / series)


main(*sys.argv[1:])
