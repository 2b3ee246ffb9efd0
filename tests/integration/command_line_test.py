#!/usr/bin/env python3
"""command_line_test.py --suffuse PROGRAM --analyse PROGRAM --study PROGRAM --flow PROGRAM --source FOLDER

What the programs say to a first call and to misspelt words: each names the word that was meant, and exit code 1 follows."""
import argparse
import pathlib
import subprocess
import sys
import tempfile

BOX = "units si\natom_style granular\nboundary f f f\nnewton off\nregion b block 0 1 0 1 0 1 units box\ncreate_box 1 b\n"
SCENE = "input_scripts/03_fluidisation/in.fluidisation"
LINES = [  # a line of a script, what the refusal must say
    ("lbm latice spacing 1", ["word = latice", "did you mean lattice?", "--help lbm"]),
    ("lbm lattice spacin 1", ["did you mean spacing?"]),
    ("lbm lattice spacing 0.1 precision flaot", ["precision = flaot", "did you mean float?"]),
    ("lbm monitor m every 1 file f.csv superficial_velocty", ["did you mean superficial_velocity?"]),
    ("lbm monitor m every 1 file f.csv eroded_mas 1e-3", ["did you mean eroded_mass?"]),
    ("fix s all stress/sevro isotropic 1e5", ["fix s", "style = stress/sevro", "did you mean stress/servo?"]),
    ("fix m all nve/spere", ["did you mean nve/sphere?"]),  # LIGGGHTS's own too
    ("pair_stile gran model hertz", ["command = pair_stile", "did you mean pair_style?"]),
    ("lmb fluid density 1000", ["did you mean lbm?"]),
    ("dem_timestp rayleigh 0.1", ["did you mean dem_timestep?"]),
    ("if \"1 == 1\" then \"unfx gravity\"", ["did you mean unfix?"]),
    ("compute z all cordination", ["compute z", "did you mean coordination?"]),
    ("compute z all qqqqqqq", ["style = qqqqqqq", "--styles"]),
]


def answer(*command, given=subprocess.DEVNULL, **options):
    done = subprocess.run([str(word) for word in command], stdin=given, capture_output=True, text=True, timeout=60, **options)
    return done.returncode, done.stdout + done.stderr


def main():
    parser = argparse.ArgumentParser()
    for name in ("suffuse", "analyse", "study", "flow"):
        parser.add_argument(f"--{name}", required=True)
    parser.add_argument("--source", type=pathlib.Path, required=True)
    options = parser.parse_args()
    amiss = []

    def refused(words, command, **more):
        code, text = answer(*command, **more)
        if code != 1:
            amiss.append(f"{command}: ended with code {code}: {text[-300:]}")
        amiss.extend(f"{command}: no '{word}' in: {text[-400:]}" for word in words if word not in text)

    suffuse, scene = options.suffuse, options.source / SCENE
    with tempfile.TemporaryDirectory() as folder:
        script = pathlib.Path(folder) / "in.x"
        for line, words in LINES:
            script.write_text(BOX + line + "\n")
            refused(words, [suffuse, "-in", script, "-log", "none"], cwd=folder)
        refused(["suffuse -in SCRIPT", "--help"], [suffuse])
        refused(["suffuse -in in.x"], [suffuse, "in.x"], cwd=folder)
        refused(["did you mean -screen?"], [suffuse, "-scren", "none"])
        refused(["did you mean precision?"], [suffuse, "-in", scene, "-var", "precison", "float"])
        refused(["scale = quik", "did you mean quick?", "column"], [suffuse, "-in", scene, "-var", "scale", "quik"])
        script.write_text(BOX + 'print "x is ${x}"\n')
        code, text = answer(suffuse, "-in", script, "-var", "x", "-1", "-log", "none", cwd=folder)
        if code != 0 or "x is -1" not in text:
            amiss.append(f"-var x -1: {code} {text[-300:]}")
        # A script by standard input is read, and said to be.
        with open(script) as file:
            code, text = answer(suffuse, "-var", "x", "2", "-log", "none", given=file, cwd=folder)
        if code != 0 or "x is 2" not in text:
            amiss.append(f"a script by standard input: {code} {text[-300:]}")
    refused(["did you mean constriction?"], [options.analyse, "constrction"])
    refused(["did you mean --overwrite?"], [options.analyse, "grading", "--overwrit"])
    refused(["did you mean --dry-run?"], [options.study, "--dry"])
    refused(["did you mean --version?"], [options.flow, "--versio"])
    code, text = answer(suffuse, "--styles")
    rows = [line.split() for line in text.splitlines() if line.startswith(("command ", "fix ", "compute ", "pair_style "))]
    named = {tuple(row[:2]) for row in rows if row[2] != "-"}
    helpers = {" ".join(row[:2]) for row in rows if row[2] == "-"}
    table = [line.split("\t") for line in (options.source / "docs/reference/styles.tsv").read_text().splitlines() if not line.startswith("#")][1:]
    if code != 0 or named != {tuple(row[:2]) for row in table}:
        amiss.append(f"--styles has {named ^ {tuple(row[:2]) for row in table}} where docs/reference/styles.tsv has not, or the other way round")
    if any(not (options.source / "docs/reference" / row[2]).is_file() for row in rows if row[2] != "-"):
        amiss.append("--styles names a page that is not there")
    if helpers - {"fix contact/sampler", "fix compute/reference"}:
        amiss.append(f"styles without a page: {helpers}; add them to docs/reference/styles.tsv")
    sys.exit("\n".join(amiss) if amiss else 0)


if __name__ == "__main__":
    main()
