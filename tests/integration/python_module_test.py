#!/usr/bin/env python3
"""python_module_test.py --suffuse PROGRAM --module FOLDER [--pvpython PROGRAM [--picture SCRIPT]]

A small wet run read by suffuse_data: monitor, dump, grains, contacts and fields agree with each other, with their units and the
run's script; eroded mass by size class is what the dumps say; ParaView reads the contacts as lines beside the grains."""
import argparse
import math
import os
import pathlib
import shutil
import subprocess
import sys

try:
    import h5py  # noqa: F401
    import pandas  # noqa: F401
except ImportError:  # Debian's Python has them
    if sys.executable == "/usr/bin/python3":
        raise
    os.execv("/usr/bin/python3", ["/usr/bin/python3", *sys.argv])

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import Program, expect, scratch  # noqa: E402
from wet_scenes import SPACING, WATER, wet_box  # noqa: E402

HEIGHT, BOUND = 2.5e-3, 0.8e-3  # m: above the one grains count as eroded; between the two sizes of the scene
RUN = f"""
lbm monitor flow every 1e-3 file flow.csv superficial_velocity grains eroded_mass above {HEIGHT} {BOUND} solid_force
lbm output bed every 4e-3 file bed.h5 velocity pressure solid_fraction contacts
dump grains all custom 4000 grains.*.dump id type x y z vx vy vz radius density f_hydrodynamic_force[3]
dump_modify grains first yes format "%d %d %.16g %.16g %.16g %.16g %.16g %.16g %.16g %.16g %.16g"
lbm run 8e-3
"""


def check_tables(data, folder):
    flow = data.read_monitor(folder / "flow.csv")
    expect(list(flow["time_s"].round(6)) == [k * 1e-3 for k in range(len(flow))] and len(flow) >= 8, f"times {list(flow['time_s'])}")
    units = flow.attrs["units"]
    expect((units["time_s"], units["superficial_velocity_z_m_per_s"], units["solid_force_z_n"], units.get("grains")) == ("s", "m/s", "N", None), str(units))
    expect(data.unit_of("vertical_stress_pa_3") == "Pa" and data.unit_of("grains_left_below_0.0008_m") is None and data.unit_of("discharge_zlo_m3_per_s") == "m3/s", "units of names")

    first, last = (data.read_dump(file) for file in (sorted(folder.glob("grains.*.dump"), key=lambda f: int(f.name.split(".")[1]))[k] for k in (0, -1)))
    expect(last.attrs["step"] == 8000 and last.attrs["boundary"] == "pp pp ff" and abs(last.attrs["box"][2, 1] - 5e-3) < 1e-12, str(last.attrs))
    whole = data.read_dumps(folder, "grains.*.dump")
    expect(list(whole.index.levels[0]) == [0, 4000, 8000] and whole.loc[8000].equals(last), "dumps together")

    grains = data.read_grains(folder / "bed_grains.h5")
    expect(abs(grains.attrs["time_s"] - 8e-3) < 1e-9 and len(grains) == len(last) == 120, f"{len(grains)} grains at {grains.attrs['time_s']} s")
    for column, of_dump in (("position_z", "z"), ("velocity_x", "vx"), ("radius", "radius")):
        expect((grains[column] - last[of_dump]).abs().max() < 1e-12, f"{column} is not the dump's")
    expect(abs(grains["force_z"].sum() - flow["solid_force_z_n"].iloc[-1]) < 1e-9 * grains["force_z"].abs().sum(), "load of the grains")
    expect(grains.attrs["units"]["force_y"] == "N" and grains.attrs["script"] == "in.scene" and grains.attrs["suffuse_version"], str(grains.attrs))

    # Mass by class below the height, of the dumps, with LIGGGHTS's own densities.
    def below(table, small):
        own = table[(table["z"] < HEIGHT) & ((2 * table["radius"] < BOUND) == small)]
        return (own["density"] * 4 / 3 * math.pi * own["radius"] ** 3).sum()
    names = [name for name in flow if name.startswith("eroded_mass")]
    expect(names == ["eroded_mass_below_0.0008_m_kg", "eroded_mass_from_0.0008_m_kg"], str(names))
    for name, small in zip(names, (True, False)):
        went, mass = below(first, small) - below(last, small), flow[name].iloc[-1]
        expect(abs(went - mass) < 1e-9 * below(first, small) and flow[name].iloc[0] == 0, f"{name}: {mass}, of the dumps {went}")
    expect(any(flow[name].iloc[-1] != 0 for name in names), "no grain has crossed the height: nothing is tested")

    water = data.read_fields(folder / "bed.h5", time=4.1e-3)
    expect(abs(water.time_s - 4e-3) < 1e-9 and water["pressure"].shape == (40, 32, 32) and water.spacing == SPACING, "fields")
    expect(water.units == {"velocity": "m/s", "pressure": "Pa", "solid_fraction": "1"} and abs(water.centres(2)[-1] - (5e-3 - SPACING / 2)) < 1e-12, str(water.units))
    volume = water["solid_fraction"].sum() * SPACING ** 3
    true = (4 / 3 * math.pi * grains["radius"] ** 3).sum()
    expect(abs(volume / true - 1) < 0.02, f"solids of the fields {volume}, of the grains {true}")
    expect(data.read_times(folder / "bed.h5") == data.read_times(folder / "bed_grains.h5"), "times of the files")

    contacts = data.read_contacts(folder / "bed_grains.h5")
    expect(len(contacts) > 0 and contacts.attrs["units"]["normal_force"] == "N", "no contacts to read")
    gap = (contacts[["branch_x", "branch_y", "branch_z"]] ** 2).sum(axis=1) ** 0.5
    sizes = grains["radius"].loc[contacts["id_1"]].to_numpy() + grains["radius"].loc[contacts["id_2"]].to_numpy()
    expect(((gap < sizes) & (gap > 0.5 * sizes)).all(), "a contact's branch is no branch of its grains")
    normal = (contacts[["force_x", "force_y", "force_z"]].to_numpy() * contacts[["branch_x", "branch_y", "branch_z"]].to_numpy()).sum(axis=1) / gap
    expect((abs(normal - contacts["normal_force"]) <= 1e-9 * abs(normal).max()).all(), "normal forces")
    return len(contacts)


def check_refusals(data, folder):
    for what, words, call in (("no dump", "no dump of LIGGGHTS", lambda: data.read_dump(folder / "flow.csv")),
                              ("no contacts", "has no contacts", lambda: data.read_contacts(folder / "bed.h5")),
                              ("no HDF5", "bed.xdmf", lambda: data.read_fields(folder / "bed.xdmf")),
                              ("no pressure", "add it to `lbm output`", lambda: data.read_fields(folder / "bed.h5")["density"])):
        try:
            call()
        except data.DataError as problem:
            expect(words in str(problem), f"{what}: {problem}")
        else:
            sys.exit(f"{what} is taken")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--suffuse", required=True)
    parser.add_argument("--module", required=True)
    parser.add_argument("--pvpython")
    parser.add_argument("--picture", help="the script of ParaView's picture; drawn where xvfb-run gives it a display")
    options = parser.parse_args()
    sys.dont_write_bytecode = True
    sys.path.insert(0, options.module)
    import suffuse_data as data

    with scratch() as name:
        folder = pathlib.Path(name)
        # Let go 1 mm above the floor, in a box that is full of grains: some touch, some pass the height.
        Program(options.suffuse, "", 1).must_run(wet_box(grains=120) + WATER.replace("relaxation_time 0.515", "timestep 1e-4") + "velocity all set 0 0 -0.1\nreset_timestep 0\n" + RUN, folder)
        contacts = check_tables(data, folder)
        check_refusals(data, folder)
        if options.pvpython:
            reader = pathlib.Path(__file__).with_name("contacts_in_paraview.py")
            subprocess.run([options.pvpython, reader, folder / "bed_contacts.xdmf", str(contacts)], check=True)
        if options.picture and shutil.which("xvfb-run") and shutil.which("pvbatch"):
            # Without -noreset the server begins anew when ParaView's first look at it ends, and may miss the second.
            display = ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset"]
            done = subprocess.run([*display, "pvbatch", options.picture, folder / "bed.xdmf", "--output", folder / "p.png"], capture_output=True, text=True)
            expect(done.returncode == 0 and (folder / "p.png").stat().st_size > 5000 and "ERR" not in done.stdout + done.stderr, f"picture: {done.stdout}{done.stderr}")


if __name__ == "__main__":
    main()
