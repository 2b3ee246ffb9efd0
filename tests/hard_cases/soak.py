#!/usr/bin/env python3
"""soak.py --suffuse PROGRAM --mpirun SCRIPT [--minutes 120] [--ranks 2] [--csv FILE] [--figure FILE]

Fluidisation for hours: a bed of 300 grains under a gradient that swings up to 1.1 times its critical one, with monitors, fields, grains and a saved
state every minute. Resident memory and open files of every rank stay flat, the water's mass and the grains stay, a second of flow
takes the same processor time at the end as at the beginning, and SIGUSR1 ends it in order. On a machine that others use, too, one rank tells
the speed: ranks that wait for each other burn processor time.
"""
import argparse
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "support"), str(HERE)]
from scenes import columns  # noqa: E402
from wet_grains import Water, cubic, scene, weight_pressure  # noqa: E402

GRAINS, PERIOD = 300, 0.1  # s of flow
TICKS = os.sysconf("SC_CLK_TCK")


class Folder:
    def __init__(self, path):
        self.folder = path


def script(folder, minute):
    """`minute`: the flow's time, s, that takes about a minute; there are few of them."""
    water = Water((24, 24, 60), 0.51, {"zlo": "pressure v_p", "zhi": "pressure 0"}, 9.81)
    diameter, size = 4 * water.spacing, water.size
    critical = weight_pressure(GRAINS, diameter, size)
    after = f"""lbm run 0.05
lbm monitor flow every {10 * water.step:.12g} file flow.csv superficial_velocity mass kinetic_energy bed grains extremes
lbm output fields every {minute / 4:.12g} file fields.h5 velocity pressure solid_fraction grains contacts
lbm restart write water.h5 every {minute:.12g}
variable p equal {1.1 * critical:.8g}*(0.5-0.5*cos(2*PI*f_hydrodynamic_force/{PERIOD}))
lbm run {1e8 * water.step:.12g}
"""
    return scene(Folder(folder), water, cubic((5, 5, GRAINS // 25), diameter, 1.15), after, periodic="ppf", extra="variable p equal 0")


def ranks_of(process, program):
    """The program's processes below one that was started: itself, or mpirun's children."""
    found, waiting = [], [process.pid]
    while waiting:
        pid = waiting.pop()
        try:
            if os.readlink(f"/proc/{pid}/exe") == program:
                found.append(pid)
            for task in pathlib.Path(f"/proc/{pid}/task").iterdir():
                waiting += map(int, (task / "children").read_text().split())
        except FileNotFoundError:
            pass
    return sorted(found)


def state_of(pid):
    """Resident memory (MB), open files, processor seconds."""
    status = pathlib.Path(f"/proc/{pid}/status").read_text()
    resident = int(next(line.split()[1] for line in status.splitlines() if line.startswith("VmRSS"))) / 1024
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return resident, len(os.listdir(f"/proc/{pid}/fd")), (int(fields[11]) + int(fields[12])) / TICKS


def flow_time(folder):
    """Of the last whole row of the monitor, s."""
    try:
        with open(folder / "flow.csv", "rb") as file:
            file.seek(max(0, os.path.getsize(folder / "flow.csv") - 4096))
            return float(file.read().decode().split("\n")[-2].split(",")[0])
    except (FileNotFoundError, IndexError, ValueError):
        return 0.0


def soak(options, folder, minutes, minute):
    """Samples (wall s, flow s, MB of all ranks, open files of all ranks, processor s of all ranks), and the exit code."""
    (folder / "in.soak").write_text(script(folder, minute))
    launcher = [options.mpirun, str(options.ranks)] if options.ranks > 1 else []
    samples = []
    with open(folder / "screen", "w") as screen:
        running = subprocess.Popen([*launcher, options.suffuse, "-in", "in.soak", "-log", "none"], cwd=folder, stdout=screen, stderr=subprocess.STDOUT)
        began = time.time()
        every = max(0.5, 60 * minutes / 240)
        while time.time() - began < 60 * minutes and running.poll() is None:
            time.sleep(every)
            states = [state_of(pid) for pid in ranks_of(running, options.suffuse)]
            if len(states) == options.ranks and flow_time(folder) > 0:
                samples.append((time.time() - began, flow_time(folder), *map(sum, zip(*states))))
        for pid in ranks_of(running, options.suffuse)[:1]:
            os.kill(pid, signal.SIGUSR1)
        code = running.wait(timeout=300)
    return samples, code


def slope(x, y):
    mx, my = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


def verdicts(samples, folder, code):
    late = samples[len(samples) // 10:]  # buffers have been filled by then
    half = len(late) // 2
    wall, flow, memory, files, core = zip(*late)
    growth = slope(wall, memory) * (wall[-1] - wall[0]) / memory[0]
    cost = [slope(part_flow, part_core) for part_flow, part_core in ((flow[:half], core[:half]), (flow[half:], core[half:]))]
    series = columns(folder / "flow.csv")
    drift = max(map(abs, series["mass_balance_kg"])) / (1000 * 2.4e-3 * 2.4e-3 * 6e-3)
    return [("resident memory grows by", 100 * growth, "%", abs(growth) < 0.02), ("open files, most and least", max(files) - min(files), "apart", max(files) - min(files) <= 2 * (len(files) > 0)),
            ("processor time a second of flow, second half over first", cost[1] / cost[0], "", abs(cost[1] / cost[0] - 1) < 0.05),
            ("grains", min(series["grains"]), f"of {GRAINS}", min(series["grains"]) == GRAINS),
            ("flow", flow[-1], "s", flow[-1] > flow[0]), ("exit code after SIGUSR1", code, "", code == 128 + signal.SIGUSR1),
            ("water's mass less what came and went, share of all", drift, "", drift < 5e-3)]


def draw(samples, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    wall, flow, memory, files, core = zip(*samples)
    figure, axes = plt.subplots(3, 1, sharex=True, figsize=(6.5, 5.5), layout="constrained")
    for axis, values, label in zip(axes, (memory, files, [c / f for c, f in zip(core, flow)]), ("resident memory, MB", "open files", "processor s a s of flow")):
        axis.plot([w / 60 for w in wall], values, color="0.2", linewidth=1)
        axis.set_ylabel(label)
        axis.set_ylim(0, 1.2 * max(values))
    axes[-1].set_xlabel("wall time, min")
    figure.savefig(path, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--suffuse", required=True)
    parser.add_argument("--mpirun", required=True)
    parser.add_argument("--minutes", type=float, default=120)
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--csv", type=pathlib.Path)
    parser.add_argument("--figure", type=pathlib.Path)
    options = parser.parse_args()
    options.suffuse, options.mpirun = (str(pathlib.Path(path).resolve()) for path in (options.suffuse, options.mpirun))
    with tempfile.TemporaryDirectory(prefix="suffuse-soak-") as scratch:
        folder = pathlib.Path(scratch)
        pilot, _ = soak(options, folder, 0.15, 1e3)
        minute = 60 * pilot[-1][1] / pilot[-1][0]
        shutil.rmtree(folder)
        folder.mkdir()
        samples, code = soak(options, folder, options.minutes, minute)
        if options.csv:
            rows = ["wall_s,flow_s,resident_mb,open_files,processor_s"] + [",".join(f"{value:.6g}" for value in sample) for sample in samples]
            options.csv.write_text("\n".join(rows) + "\n")
        if options.figure:
            draw(samples, options.figure)
        found = verdicts(samples, folder, code)
        for name, value, unit, holds in found:
            print(f"{name:58} {value:.5g} {unit}{'' if holds else '   <-- outside its bound'}")
        print("\n".join(line for line in (folder / "screen").read_text().splitlines() if "lbm run: " in line)[-600:])
        sys.exit(0 if all(holds for *_, holds in found) else 1)


if __name__ == "__main__":
    main()
