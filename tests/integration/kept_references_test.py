#!/usr/bin/env python3
"""kept_references_test.py --suffuse PROGRAM --mpirun SCRIPT --ranks N

References that computes have taken (the contacts of `broken/contacts`, the frozen threshold of `strong/contacts`) are kept in restart
files: a run that is cut in two gives the columns of an uncut one, on other numbers of ranks, too. A record of another
style, or a damaged one, is refused in a sentence.
"""
import pathlib
import struct
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from scenes import Program, expect, log_text, loose_sample, mistakes_not_named, program_from_command_line, read_sample, scratch, thermo_rows  # noqa: E402

COMPUTES = """
compute b all broken/contacts
compute late all broken/contacts reference step 150
compute s all strong/contacts threshold frozen
thermo_style custom step c_b[1] c_b[2] c_b[3] c_b[4] c_b[5] c_late[3] c_late[4] c_s[1] c_s[2] c_s[6]
thermo_modify format float %.17g lost error norm no
thermo 50
"""
SQUEEZE = "fix squeeze all deform 1 x trate -400 y trate -400 z trate -400 remap x\n"


def rows(program, text, folder, name):
    """What the computes gave, by step."""
    program.must_run(text, folder, name)
    return {int(step): values for step, *values in thermo_rows(log_text(folder, name), 11)}


def main():
    program = program_from_command_line(__doc__)
    other = Program(program.suffuse, program.mpirun, 3 - program.ranks if program.ranks < 3 else 1)
    with scratch() as scratch_folder:
        folder = pathlib.Path(scratch_folder)
        Program(program.suffuse, program.mpirun, 1).must_run(
            loose_sample(grains=120) + SQUEEZE + "run 700\nunfix squeeze\n"
            "reset_timestep 0\nwrite_restart sample\n", folder)
        start = read_sample("sample") + COMPUTES
        uncut = rows(program, start + SQUEEZE + "run 200\nrun 200\n", folder, "uncut")
        program.must_run(start + SQUEEZE + "run 100\nwrite_restart early\nrun 100\nwrite_restart half\n", folder, "first")
        moved = uncut[200][0] != uncut[150][0] and uncut[200][3] != uncut[200][4] and uncut[200][8] > 0
        expect(uncut[200][3] > 20 and moved, f"nothing to see: {uncut}")
        for kind, state, step in ((program, "half", 200), (other, "half", 200), (program, "early", 100)):
            cut = rows(kind, read_sample(state) + COMPUTES + SQUEEZE + "run 200\n", folder, "second")
            for now in (step, step + 50):
                # References are whole numbers and one force, to the last digit; contacts of a run that goes on differ by a few.
                expect([cut[now][k] for k in (3, 8)] == [uncut[now][k] for k in (3, 8)], f"{state}, step {now}: references of {cut[now]}, not {uncut[now]}")
                expect(all(abs(a - b) < 5 / uncut[now][3] for a, b in zip(cut[now][:3], uncut[now][:3])), f"{state}, step {now}: {cut[now]}, not {uncut[now]}")
                if state == "half":
                    expect(cut[now][6] == uncut[now][6], f"late reference: {cut[now]}, not {uncut[now]}")
        again = rows(program, read_sample("half") + COMPUTES + "run 0\nuncompute b\ncompute b all broken/contacts\nrun 0\n", folder, "anew")
        expect(again[200][0] == 0 and again[200][3] == again[200][4], f"a compute that is given anew has a reference of before: {again}")
        whole = (folder / "half").read_bytes()
        mark = whole.index(b"suffuse\n", whole.index(b"reference_of_b"))
        damaged = bytearray(whole)
        damaged[mark + 40:mark + 48] = struct.pack("<d", 7)
        (folder / "damaged").write_bytes(damaged)
        cases = [(read_sample("half") + "compute b all strong/contacts threshold frozen\n", ["compute strong/contacts", "of compute broken/contacts", "another ID"]),
                 (read_sample("half") + COMPUTES + "unfix reference_of_b\n", ["unfix", "uncompute"]),
                 (read_sample("damaged") + COMPUTES, ["compute broken/contacts", "damaged"])]
        amiss = mistakes_not_named(program, cases, folder)
        expect(not amiss, "\n".join(amiss))
    print(f"{program.ranks} ranks: references are kept")


if __name__ == "__main__":
    main()
