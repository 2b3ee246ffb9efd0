"""Small dry scenes for the integration tests, and how to run them.

A scene is a LIGGGHTS script as text. `Program` runs it in a folder of its own on a number of ranks.
"""
import argparse
import csv
import os
import pathlib
import subprocess
import sys
import tempfile

# What Open MPI need not do for hundreds of short runs. All ranks end together when one line refuses a script: mpirun need not wait
# between asking the ranks to end and killing them, which takes it a second or two after every exit code but 0 (not where mpirun gets
# a SIGTERM: the ranks save a state in that time). A rank without mpirun needs no daemon, which only starting more ranks would need;
# without one all such ranks of a machine take the same session folder, and the first to end removes it under one that begins: each
# test has a folder of its own for them, where a killed run's leftovers harm no other test either.
_SESSIONS = tempfile.TemporaryDirectory(prefix="suffuse-mpi-")
QUICK_STARTS_AND_ENDS = {"OMPI_MCA_odls_base_sigkill_timeout": "0", "OMPI_MCA_ess_singleton_isolated": "1",
                         "OMPI_MCA_orte_tmpdir_base": _SESSIONS.name}

HEADER = """
units si
atom_style granular
atom_modify map array
communicate single vel yes
boundary {boundary}
newton off
"""


def material(skin=1e-4, modulus="7e8", restitution=0.7, friction="{friction}", law="hertz tangential history"):
    """Neighbours and contact law of one type of grains; any of it may be filled in later ("{friction}")."""
    return f"""
neighbor {skin} bin
neigh_modify delay 0
fix modulus all property/global youngsModulus peratomtype {modulus}
fix ratio all property/global poissonsRatio peratomtype 0.3
fix restitution all property/global coefficientRestitution peratomtypepair 1 {restitution}
fix friction all property/global coefficientFriction peratomtypepair 1 {friction}
pair_style gran model {law}
pair_coeff * *
"""


MATERIAL = material() + "fix motion all nve/sphere\n"

# Three sizes, 0.5 to 1 mm, placed at random without contact.
GRAINS = """
region sample block 0 {length} 0 {length} 0 {length} units box
create_box 1 sample
{material}
fix large all particletemplate/sphere 11593 atom_type 1 density constant 2650 radius constant 0.5e-3
fix middle all particletemplate/sphere 11701 atom_type 1 density constant 2650 radius constant 0.35e-3
fix small all particletemplate/sphere 11807 atom_type 1 density constant 2650 radius constant 0.25e-3
fix grading all particledistribution/discrete 32452843 3 large 0.5 middle 0.3 small 0.2
fix insertion all insert/pack seed 32452867 distributiontemplate grading insert_every once overlapcheck yes &
    particles_in_region {grains} region sample ntry_mc 20000
timestep 8e-7
run 1
unfix insertion
thermo_modify lost error norm no
"""


def loose_sample(grains=400, friction=0.0, boundary="p p p"):
    """Script text that fills a box loosely; the box holds them at a void ratio of about 2.2."""
    volume = grains * 1.7e-10  # mean grain of the three sizes
    length = (volume * 3.2) ** (1 / 3)
    return HEADER.format(boundary=boundary) + GRAINS.format(
        length=length, grains=grains, material=MATERIAL.format(friction=friction))


def read_sample(restart, before="", friction=0.3):
    """Script text that takes up a sample from a restart file; `before` stands before the box is read."""
    return HEADER.format(boundary="p p p") + before + f"read_restart {restart}\n" + MATERIAL.format(friction=friction) + \
        "timestep 8e-7\nthermo_modify lost error norm no\n"


def variable_words(variables):
    """As options of the command line."""
    return [str(word) for name, value in variables.items() for word in ("-var", name, value)]


class Program:
    """`suffuse` under mpirun."""

    def __init__(self, suffuse, mpirun, ranks):
        self.suffuse, self.mpirun, self.ranks = suffuse, mpirun, ranks
        self.extra = []  # options of every run

    def run(self, text, folder, name="scene", timeout=240):
        """Runs the script; returns (exit code, screen text)."""
        script = pathlib.Path(folder) / f"in.{name}"
        script.write_text(text)
        return self.run_file(script.name, folder, [], f"log.{name}", timeout)

    def run_scene(self, script, folder, variables, timeout=400):
        """Runs a script file with `-var` options; returns the screen text."""
        code, screen = self.run_file(script, folder, variable_words(variables), "log.scene", timeout)
        if code != 0:
            sys.exit(f"{script} ended with code {code}:\n{screen[-3000:]}")
        return screen

    def run_file(self, script, folder, words, log, timeout):
        launcher = [self.mpirun, str(self.ranks)] if self.ranks > 1 else []
        command = launcher + [self.suffuse, "-in", str(script), "-log", log, "-echo", "none"] + self.extra + words
        done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=timeout,
                              env=os.environ | QUICK_STARTS_AND_ENDS)
        return done.returncode, done.stdout.decode(errors="replace")

    def must_run(self, text, folder, name="scene", timeout=240):
        code, screen = self.run(text, folder, name, timeout)
        if code != 0:
            sys.exit(f"{name} ended with code {code}:\n{screen[-3000:]}")
        return screen


def log_text(folder, name="scene"):
    """A run's log. On the screen of several ranks another one's words may stand within a line."""
    return (pathlib.Path(folder) / f"log.{name}").read_text(errors="replace")


def thermo_rows(log, words):
    """Rows of so many numbers in a log's text, the first a step."""
    lines = (line.split() for line in log.splitlines())
    return [[float(word) for word in line] for line in lines if len(line) == words and line[0].isdigit()]


def mistakes_not_named(program, cases, folder, title=lambda script: script.strip().splitlines()[-1]):
    """Runs scripts that a person got wrong: each must end with code 1 and one error line that has the case's words.
    Returns what is amiss, a text each; `title` names a script in it."""
    amiss = []
    for script, words in cases:
        code, screen = program.run(script, folder, timeout=60)
        lines = [line for line in screen.splitlines() if line.startswith("suffuse: error:")]
        if code != 1:
            amiss.append(f"`{title(script)}` ended with code {code}\n{screen[-500:]}")
        elif len(lines) != 1:
            amiss.append(f"`{title(script)}` gave {len(lines)} error lines\n{screen[-500:]}")
        else:
            amiss += [f"`{title(script)}`: no '{word}' in: {lines[0]}" for word in words if word not in lines[0]]
    return amiss


def program_from_command_line(description):
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--suffuse", required=True)
    parser.add_argument("--mpirun", required=True)
    parser.add_argument("--ranks", type=int, required=True)
    options = parser.parse_args()
    return Program(options.suffuse, options.mpirun, options.ranks)


def columns(path):
    """A CSV file's columns as lists of floats by name."""
    with open(path) as file:
        rows = list(csv.reader(file))
    return {name: [float(row[k]) for row in rows[1:]] for k, name in enumerate(rows[0])}


def scratch():
    return tempfile.TemporaryDirectory(prefix="suffuse-test-")


def expect(condition, message):
    if not condition:
        sys.exit(message)
