"""A small dense two-size sample in a periodic box, and runs of `suffuse` on it, for the tests of the computes.

The grains are soft (E = 10 MPa at 100 kPa, overlaps of some per cent of a diameter), so that the rounding of image
positions, 1e-18 m or so, stays below 1e-13 of an overlap and results on different ranks can be compared to 1e-12.
"""
import argparse
import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "support"))
import scenes  # noqa: E402

SPLIT = 0.7e-3  # m; coarse grains of 1.0 mm, fines of 0.4 mm

HEADER = scenes.HEADER.format(boundary="p p p")
MATERIAL = scenes.material(2e-4, "1e7", friction=0.3) + "fix motion all nve/sphere\ntimestep 2e-6\n"

# A cube of so many metres with grains of both sizes, not touching each other.
FILL = HEADER + """
region sample block 0 {edge} 0 {edge} 0 {edge} units box
create_box 1 sample
""" + MATERIAL + """
fix large all particletemplate/sphere 11593 atom_type 1 density constant 2650 radius constant 0.5e-3
fix small all particletemplate/sphere 11807 atom_type 1 density constant 2650 radius constant 0.2e-3
fix grading all particledistribution/discrete 32452843 2 large 0.75 small 0.25
fix insertion all insert/pack seed 32452867 distributiontemplate grading insert_every once overlapcheck yes &
    volumefraction_region 0.3 region sample ntry_mc 20000
run 1
unfix insertion
"""

# Compressed to 100 kPa and sheared by 1 %: sliding contacts, a deviator, grains without contact.
PREPARE = FILL.format(edge=5e-3) + """
fix s all stress/servo isotropic 100e3 inertial_number 2e-3 max_rate 50 until target
run 40000
unfix s
fix s all stress/servo constant_p 100e3 axis z rate 5 inertial_number 1e-2 until axial_strain 0.01
run 20000
unfix s
reset_timestep 0
write_restart sample.restart
"""

SAMPLE = HEADER + "read_restart sample.restart\n" + MATERIAL


class Suffuse:
    """`suffuse` under mpirun, in one folder."""

    def __init__(self, folder, description):
        parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
        parser.add_argument("--suffuse", required=True)
        parser.add_argument("--mpirun", required=True)
        parser.add_argument("--analyse", help="the program suffuse-analyse")
        self.options = parser.parse_args()
        self.folder = pathlib.Path(folder)

    def run(self, ranks, script, name):
        """Runs the script; returns exit code, standard output and the text of standard error."""
        (self.folder / f"in.{name}").write_text(script)
        launcher = [self.options.mpirun, str(ranks)] if ranks > 1 else []
        done = subprocess.run(launcher + [self.options.suffuse, "-in", f"in.{name}", "-log", f"log.{name}"],
                              cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=240, env=os.environ | scenes.QUICK_STARTS_AND_ENDS)
        return done.returncode, done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace")

    def must_run(self, ranks, script, name):
        """The run's log (see scenes.log_text)."""
        code, out, err = self.run(ranks, script, name)
        if code != 0:
            sys.exit(f"{name} on {ranks} ranks ended with code {code}:\n{out[-2000:]}\n{err[-2000:]}")
        return scenes.log_text(self.folder, name)

    def analyse(self, *words):
        """Runs suffuse-analyse; returns exit code, standard output and standard error."""
        done = subprocess.run([self.options.analyse, *map(str, words)], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=240)
        return done.returncode, done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace")

    def prepare(self):
        self.must_run(1, PREPARE, "prepare")


def read_dump(path, frame=0):
    """One frame of a dump as a list of dictionaries by column name."""
    frames = path.read_text().split("ITEM: TIMESTEP")[1:]
    lines = frames[frame].splitlines()
    at = next(k for k, line in enumerate(lines) if line.startswith(("ITEM: ATOMS", "ITEM: ENTRIES")))
    names = lines[at].split()[2:]
    return [dict(zip(names, map(float, line.split()))) for line in lines[at + 1:] if line.strip()]


def check(condition, message):
    if not condition:
        sys.exit("FAILED: " + message)


def close(a, b, relative, scale):
    return abs(a - b) <= relative * max(abs(a), abs(b), scale)
