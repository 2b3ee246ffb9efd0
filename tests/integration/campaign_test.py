#!/usr/bin/env python3
"""campaign_test.py --programs FOLDER --campaigns DIR: two tiny samples from grading to table and figure, killed twice on the way.

Snakemake and all that it started are ended by SIGKILL while a sample is compressed, and the program alone while one is sheared; the same command
again goes on from the restart files and ends with results, whose series have no gap and no row twice. Then a sample of one's own; other settings
in the finished folder; and, on made-up folders, from where a step begins.
"""
import argparse
import csv
import filecmp
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from campaign_decisions import check_decisions  # noqa: E402
from scenes import columns, expect  # noqa: E402


class Campaign:
    def __init__(self, options, folder):
        self.command = ["snakemake", "-s", str(options.campaigns / "Snakefile"), "--cores", "2", "--directory", str(folder)]
        self.environment = dict(os.environ, SUFFUSE_PROGRAMS=str(options.programs), XDG_CACHE_HOME=str(folder / "cache"))
        self.folder = folder

    def start(self, *words):
        return subprocess.Popen([*self.command, *words], env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                start_new_session=True)

    def run(self, *words, timeout=300):
        running = self.start(*words)
        try:
            return running.communicate(timeout=timeout)[0], running.returncode
        except subprocess.TimeoutExpired:
            os.killpg(running.pid, signal.SIGKILL)
            sys.exit(f"{words} took more than {timeout} s:\n{running.communicate()[0][-2000:]}")


def killed_on_the_way(campaign, tiny):
    running = campaign.start(*tiny)
    began = time.time()
    while not list(campaign.folder.glob("samples/*/compression.1*000.restart")):
        expect(running.poll() is None and time.time() - began < 120, "no restart file within two minutes")
        time.sleep(0.1)
    os.killpg(running.pid, signal.SIGKILL)
    running.communicate()
    expect(not (campaign.folder / "results.csv").exists(), "killed too late")


def kill_the_shear(folder):
    """The program alone, as a machine without memory does: Snakemake sees a step that failed."""
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (process / "cmdline").read_bytes()
            if b"in.constant_p_shear" in words and b"suffuse\0" in words.split(b"-in")[0] and os.readlink(process / "cwd") == str(folder):
                os.kill(int(process.name), signal.SIGKILL)
        except (FileNotFoundError, ProcessLookupError, PermissionError):
            pass


def killed_while_shearing(campaign, tiny):
    running = campaign.start(*tiny, "--nolock", "--rerun-incomplete")
    began = time.time()
    while not list(campaign.folder.glob("samples/*/shear/shear.*.restart")):
        expect(running.poll() is None and time.time() - began < 200, "no restart file of the shear")
        time.sleep(0.02)
    kill_the_shear(campaign.folder.resolve())
    screen = running.communicate()[0]
    expect(running.returncode != 0 and not (campaign.folder / "results.csv").exists(), f"killed too late:\n{(screen or '')[-2000:]}")


def check_series(path, samples):
    """Every 1,000 steps once: the time between rows is one."""
    times = columns(path)["time_s"]
    steps = [later - earlier for earlier, later in zip(times, times[1:])]
    expect(len(times) >= samples and max(steps) < 1.01 * min(steps), f"{path}: gaps or rows twice: {min(steps)} to {max(steps)}")


def check_results(folder):
    with open(folder / "results.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    found = {(row["source"], row["case"].split("_")[0], row["quantity"]): row for row in rows}
    for key in (("table-4-1", "A20", "porosity"), ("table-4-1", "A30", "alpha_pair_halves"), ("table-5-1", "A20", "void_ratio"),
                ("at rest", "A30", "unconnected_fines_share"), ("shear", "A20", "q_peak")):
        expect(key in found and float(found[key]["measured"]) > 0 and "in." in found[key]["command"], f"no {key} in the results")
    expect(found["table-4-1", "A20", "porosity"]["thesis"] == "0.222", "the row of 8a dense")
    expect(found["table-4-1", "A30", "porosity"]["thesis"] == "0.253", "the row of 8b loose")
    expect(found["table-4-1", "A20", "grains"]["measured"] == "300", "all of the grains")
    expect(float(found["shear", "A20", "axial_strain"]["measured"]) >= 0.0199, "sheared to 2 %")
    for key in (("table-4-1", "A30", "alpha_finest_fraction"), ("table-4-1", "A20", "coordination_eq_4_7"), ("shear curves", "A20", "peak_stress_ratio")):
        expect(key in found and float(found[key]["measured"]) > 0, f"no {key} in the results")
    for name in ("figure_4_4.png", "figure_4_5.png", "figure_4_6.png", *(f"figure_5_{k}.png" for k in (3, 4, 5, 6, 7, "7c", "8a", "8b", 9, 10, 11, 12))):
        expect((folder / name).stat().st_size > 5000, f"no {name}")


def check_published(campaign, options):
    """The figure of Table 4.1 from the published values, whose file begins with the command that made them."""
    figure = campaign.folder / "published.png"
    done = subprocess.run(["/usr/bin/python3", str(options.campaigns.parents[1] / "analysis/figures/figure_4_4.py"),
                           str(options.campaigns.parents[1] / "docs/results/data/chapter_4_samples.csv"), "--output", str(figure)], capture_output=True, text=True)
    expect(done.returncode == 0 and figure.stat().st_size > 5000, done.stderr)


def check_plan(campaign):
    """All of chapters 4 and 5: 27 rows of the one table, ten of the other, five of which are in both."""
    screen, code = campaign.run("--dry-run", "--quiet")
    expect(code == 0, screen)
    expect("A30_dense_32452867" in screen and "core hours" in screen, f"no cost by sample:\n{screen}")
    jobs = dict(line.split()[:2] for line in screen.splitlines() if line.split()[1:2] and line.split()[1].isdigit())
    expect(jobs.get("equilibrate") == "32" and jobs.get("shear") == "10" and jobs.get("analyse") == "32", f"{jobs}")


def check_mistakes(campaign):
    (campaign.folder / "wrong.csv").write_text("sample,state,grains,seed,shear\nA20,solid,300,1,no\n")
    screen, code = campaign.run("--config", "samples=wrong.csv")
    expect(code == 1 and "row 1" in screen and "state (loose, medium, dense)" in screen, screen)
    screen, code = campaign.run("--config", "samples=nowhere.csv")
    expect(code == 1 and "samples = nowhere.csv, must be a CSV file" in screen, screen)
    for row, message in (("soils/mine.csv,dense,300,1,no,,", "sample = soils/mine.csv, must be a name of the gradings, or a CSV file in"),
                         ("A20,dense,300,1,no,a b,", "A20_dense_1_a b is to be a folder")):
        (campaign.folder / "wrong.csv").write_text(f"sample,state,grains,seed,shear,variant,options\n{row}\n")
        screen, code = campaign.run("--config", "samples=wrong.csv")
        expect(code == 1 and "row 1" in screen and message in screen, screen)


def check_own_sample(campaign, options):
    """Continuously graded, in a folder and with a name that are easily cut: its contacts have the scene's split and the row's own friction."""
    soils = campaign.folder / "my soils"
    soils.mkdir()
    (soils / "A1.5.csv").write_text("diameter_mm,percent_finer\n0.2,0\n0.25,20\n0.3,45\n0.35,70\n0.45,100\n")
    (soils / "list.csv").write_text("sample,state,grains,seed,shear,variant,options\nA1.5.csv,loose,300,1,yes,smooth,-var friction 0.1\n")
    folder = campaign.folder / "samples" / "A1.5_loose_1_smooth"
    screen, code = campaign.run(f"samples/{folder.name}/contacts.csv", f"samples/{folder.name}/shear/classes.csv", "--configfile", str(options.campaigns / "tiny.yaml"),
                                "--config", f"samples={soils / 'list.csv'}")
    expect(code == 0, screen[-3000:])
    described = dict(line.split(" = ") for line in (folder / "sample.toml").read_text().splitlines())
    expect(described["friction"] == "0.1", f"friction {described['friction']}")
    for friction in ("0.1", "0.3"):
        done = subprocess.run([str(options.programs / "suffuse-analyse"), "contacts", str(folder / "isotropic.grains.dump"),
                               str(folder / "isotropic.contacts.dump"), "--split", described["split_m"], "--friction", friction,
                               "--output", str(soils / f"{friction}.csv")], capture_output=True, text=True)
        expect(done.returncode == 0, done.stderr)
    expect(filecmp.cmp(folder / "contacts.csv", soils / "0.1.csv", shallow=False), "contacts with another friction or split than the sample's")
    expect(not filecmp.cmp(folder / "contacts.csv", soils / "0.3.csv", shallow=False), "friction changes nothing in this sample")
    with open(folder / "shear" / "classes.csv", newline="") as file:
        sheared = list(csv.DictReader(line for line in file if not line.startswith("#")))[-1]
    mobilised, sliding = float(sheared["mean_mobilised_friction"]), float(sheared["sliding_share"])
    expect(0.02 < mobilised < 0.1 and sliding > 0.02, f"sheared with another friction than the row's: T/N {mobilised}, sliding {sliding} of friction 0.1")


def check_other_settings(campaign, tiny):
    """In a finished folder: what they change is done again, and no more."""
    for settings, again in ((["restart_every=4000", "ranks=2"], []), (["axial_strain=0.012"], ["shear"]), (["equilibrium_most=10000"], ["equilibrate", "shear"])):
        screen, code = campaign.run(*tiny, "--nolock", "--dry-run", "--config", *settings)
        done = [rule for rule in ("prepare", "equilibrate", "shear") if f"rule {rule}:" in screen]
        expect(code == 0 and done == again, f"{settings} does {done} again, not {again}:\n{screen}")


def check_longer_list(campaign, tiny, shorter):
    """A sample that was added to the list of a finished folder is made, and with it the table, with times of files as the only trigger too."""
    longer = campaign.folder / "longer.csv"
    longer.write_text(shorter.read_text() + "A30,dense,300,7,no\n")
    screen, code = campaign.run(*tiny, "--nolock", "--dry-run", "--rerun-triggers", "mtime", "--config", f"samples={longer}")
    expect(code == 0 and screen.count("rule equilibrate:") == 1 and "rule table:" in screen, screen[-3000:])


def check_shear_again(campaign, tiny):
    """To another strain: no snapshot of the one before is in its table."""
    screen, code = campaign.run("samples/A20_dense_32452867/shear/classes.csv", *tiny, "--nolock", "--config", "axial_strain=0.005", "snapshots=0 0.005 1e9")
    expect(code == 0, screen[-3000:])
    shear = campaign.folder / "samples" / "A20_dense_32452867" / "shear"
    snapshots = sorted(path.name for path in shear.glob("shear_*.grains.dump"))
    states = len((shear / "classes.csv").read_text().splitlines()) - 1
    expect(snapshots == ["shear_0.005.grains.dump", "shear_0.grains.dump"] and states == 2, f"{states} states of {snapshots}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programs", required=True, type=pathlib.Path)
    parser.add_argument("--campaigns", required=True, type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="suffuse-campaign-") as scratch:
        folder = pathlib.Path(scratch)
        campaign = Campaign(options, folder)
        tiny = ("--configfile", str(options.campaigns / "tiny.yaml"))
        check_decisions(options.campaigns)
        check_plan(campaign)
        check_published(campaign, options)
        check_mistakes(campaign)
        killed_on_the_way(campaign, tiny)
        killed_while_shearing(campaign, tiny)
        screen, code = campaign.run(*tiny, "--nolock", "--rerun-incomplete")
        expect(code == 0, screen[-3000:])
        expect("goes on from shear." in screen, f"nothing was continued:\n{screen}")
        check_results(folder)
        for series in folder.glob("samples/*/compression.csv"):
            check_series(series, 20)
        sheared = next(folder.glob("samples/*/shear/shear.csv"))
        check_series(sheared, 5)
        strains = columns(sheared)["axial_strain"]
        expect(strains[0] < 0.05 * strains[-1], f"the part before the kill is gone: begins at a strain of {strains[0]}")
        screen, code = campaign.run(*tiny, "--nolock")
        expect(code == 0 and "Nothing to be done" in screen, "a finished campaign is done again")
        check_longer_list(campaign, tiny, options.campaigns / "tiny.csv")
        check_other_settings(campaign, tiny)
        check_shear_again(campaign, tiny)
        check_own_sample(campaign, options)
    print("campaign: killed twice, continued, results complete")


if __name__ == "__main__":
    main()
