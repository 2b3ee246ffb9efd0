#!/usr/bin/env python3
"""computes_bad_input_test.py --suffuse PROGRAM --mpirun SCRIPT

A mistake in a line of ours ends the program with exit code 1 and one line that names the style, the word and the rule, on one
rank and on two; and a sample without contacts, or without grains yet, is no mistake: its values are zeros.
"""
import tempfile

from contact_scene import HEADER, MATERIAL, Suffuse, check
from scenes import thermo_rows

EMPTY_BOX = HEADER + "region sample block 0 5e-3 0 5e-3 0 5e-3 units box\ncreate_box 1 sample\n" + MATERIAL
TWO_GRAINS = EMPTY_BOX + """
create_atoms 1 single 1e-3 1e-3 1e-3 units box
create_atoms 1 single 3e-3 3e-3 3e-3 units box
set group all diameter 1e-3 density 2650
"""

# Grains are to come at step 1000: a run before has none.
NO_GRAINS = EMPTY_BOX + """
fix one all particletemplate/sphere 11593 atom_type 1 density constant 2650 radius constant 0.5e-3
fix grading all particledistribution/discrete 32452843 1 one 1.0
fix insertion all insert/pack seed 32452867 distributiontemplate grading insert_every 1000 start 1000 &
    volumefraction_region 0.1 region sample
"""

# (line, words that the message must hold)
MISTAKES = [
    ("compute c all coordination splt 1e-3", ("compute coordination", "splt", "split")),
    ("compute c all coordination split", ("compute coordination", "split", "be given")),
    ("compute c all coordination split -1e-3", ("compute coordination", "split", "-1e-3", "> 0")),
    ("compute c all coordination split abc", ("compute coordination", "split", "abc", "number")),
    ("compute c all stress/reduction", ("compute stress/reduction", "split", "be given")),
    ("compute c all stress/reduction split 1e-3 by point", ("compute stress/reduction", "by", "point", "contact_point")),
    ("compute c all constraint/ratio tolerance 2", ("compute constraint/ratio", "tolerance", "< 1")),
    ("compute c all sliding/contacts tolerance", ("compute sliding/contacts", "tolerance", "be given")),
    ("compute c all slipping/index 3", ("compute slipping/index", "3")),
    ("compute c all fabric bins 12", ("compute fabric", "bins")),
    ("compute c all strong/contacts threshold half", ("compute strong/contacts", "threshold", "half")),
    ("compute c all strong/contacts axis w", ("compute strong/contacts", "axis", "w")),
    ("compute c all broken/contacts reference now", ("compute broken/contacts", "reference", "now")),
    ("compute c all broken/contacts reference file", ("compute broken/contacts", "reference file", "be given")),
    ("compute c all inertial/number diameter median", ("compute inertial/number", "diameter", "median")),
    ("compute c all inertial/number diameter 0", ("compute inertial/number", "diameter", "> 0")),
    ("compute c all stress/layer q 4", ("compute stress/layer", "axis", "q")),
    ("compute c all stress/layer z 0", ("compute stress/layer", "layers", "0")),
    ("compute c all stress/layer z", ("compute stress/layer", "layers", "be given")),
    ("compute c all stress/layer z 4 bounds 2 1", ("compute stress/layer", "bounds")),
    ("compute c all stress/layer z 4 trim 3e-3\nrun 0", ("compute stress/layer", "trim", "column")),
    ("compute c all fines/layer z 4 bounds 0 1e-3", ("compute fines/layer", "split", "be given")),
    ("compute c all fines/layer z 4 split 5e-4", ("compute fines/layer", "bounds", "be given")),
    ("compute c all fines/layer z 4 split 5e-4 bounds 2 1", ("compute fines/layer", "bounds", "low end first")),
    ("compute c all fines/layer z 4 split 5e-4 bounds 0 1 colour", ("compute fines/layer", "colour")),
    ("compute c all stress/layer z 4 share half", ("compute stress/layer", "share", "half")),
    ("region far block 4e-3 5e-3 0 1e-3 0 1e-3 units box\ngroup none region far\ncompute c none coordination\nrun 0",
     ("compute coordination", "group", "none", "grains")),
]

ALL = """
compute z all coordination split 1.5e-3
compute a all stress/reduction split 1.5e-3
compute r all constraint/ratio
compute s all sliding/contacts
compute f all fabric
compute st all strong/contacts threshold frozen
compute b all broken/contacts
compute i all inertial/number
compute l all stress/layer z 2
compute si all slipping/index
dump si all local 1 si.dump c_si[1]
thermo_style custom step c_z[1] c_z[2] c_z[3] c_z[6] c_a[1] c_a[3] c_r[1] c_s[1] c_f[1] c_f[9] c_st[1] c_b[1] c_i[1] c_l[1] c_l[1][1] c_l[2][8]
run 5
"""


def main():
    with tempfile.TemporaryDirectory(prefix="suffuse-test-") as folder:
        suffuse = Suffuse(folder, __doc__)
        for number, (line, words) in enumerate(MISTAKES):
            for ranks in (1, 2):
                code, out, err = suffuse.run(ranks, TWO_GRAINS + line + "\n", f"mistake{number}")
                told = [text for text in (out + "\n" + err).splitlines() if words[0] + ":" in text]
                check(code == 1, f"`{line}` on {ranks} ranks: exit code {code}\n{out[-500:]}{err[-500:]}")
                check(len(told) == 1, f"`{line}` on {ranks} ranks: {len(told)} lines name the style:\n" + "\n".join(told))
                check(all(word in told[0] for word in words), f"`{line}` on {ranks} ranks says only: {told[0]}")
        for name, scene in (("no contacts", TWO_GRAINS), ("no grains", NO_GRAINS)):
            for ranks in (1, 2, 3):
                out = suffuse.must_run(ranks, scene + ALL, name.replace(" ", "_"))
                rows = thermo_rows(out, 17)
                check(len(rows) == 2, f"{name} on {ranks} ranks: {len(rows)} thermo rows")
                check(all(value == 0 for row in rows for value in row[1:]), f"{name} on {ranks} ranks: {rows}")
        print(f"{len(MISTAKES)} mistakes are told in one line; loose and empty samples give zeros")


if __name__ == "__main__":
    main()
