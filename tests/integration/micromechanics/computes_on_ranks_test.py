#!/usr/bin/env python3
"""computes_on_ranks_test.py --suffuse PROGRAM --mpirun SCRIPT

Every compute of the contact network gives the same numbers on 1, 2 and 3 ranks, with contacts across ranks and
periodic faces, at the start of a run and after moving steps under a shrinking box; and the contact sum of the stress is
LIGGGHTS's own virial pressure.
"""
import re
import tempfile

from contact_scene import SAMPLE, SPLIT, Suffuse, check, close, read_dump
from scenes import thermo_rows

COMPUTES = f"""
compute z all coordination split {SPLIT}
compute ap all stress/reduction split {SPLIT} by contact_point
compute ah all stress/reduction split {SPLIT} by pair_halves
compute r all constraint/ratio
compute s all sliding/contacts
compute si all slipping/index
compute f all fabric
compute st all strong/contacts
compute b all broken/contacts
compute i all inertial/number
compute i50 all inertial/number diameter d50 rate 0.1
compute l all stress/layer z 4
compute lt all stress/layer x 3 trim 3e-4 share volume from bottom by pair_halves
compute lc all stress/layer y 5 share centre
compute lf all fines/layer z 4 split {SPLIT} bounds 0 4e-3
region half block INF INF INF INF 0 2.1e-3 units box
group lower region half
compute zg lower coordination split {SPLIT}
compute peratom all stress/atom pair
compute p all reduce sum c_peratom[1] c_peratom[2] c_peratom[3] c_peratom[4] c_peratom[5] c_peratom[6]
compute g all reduce sum c_ap[1] c_ap[2] c_ap[3] c_ap[4] c_ap[5] c_ap[6]
compute gh all reduce sum c_ah[1] c_ah[2] c_ah[3] c_ah[4] c_ah[5] c_ah[6]
"""
VECTORS = {"z": 17, "ap": 8, "ah": 8, "r": 6, "s": 4, "f": 14, "st": 6, "b": 6, "i": 5, "i50": 5, "l": 5, "lt": 5, "lc": 5, "lf": 7,
           "zg": 17, "p": 6, "g": 6, "gh": 6}
ARRAYS = {"l": (4, 12), "lt": (3, 12), "lc": (5, 12), "lf": (4, 8), "f": (36, 7)}
WORDS = [f"c_{name}[{k + 1}]" for name, n in VECTORS.items() for k in range(n)] + \
    [f"c_{name}[{i + 1}][{j + 1}]" for name, (rows, columns) in ARRAYS.items() for i in range(rows) for j in range(columns)] + \
    ["vol"]
# A shrinking box, so that grains, box and ghosts all move between the two outputs.
RUN = f"""
fix squeeze all deform 1 z trate -5 x trate 2 remap x
dump contacts all local 100 contacts.NAME c_si[1] c_si[2] c_si[3] c_si[4] c_si[5] c_si[6]
dump_modify contacts format "%.17g %.17g %.17g %.17g %.0f %.0f"
dump grains all custom 100 grains.NAME id c_z c_ap[1] c_ap[3] c_ah[3]
dump_modify grains format "%d %.17g %.17g %.17g %.17g" sort id
thermo_style custom step {" ".join(WORDS)}
thermo_modify format float %.17g
thermo 100
run 100
"""
# Rounding only: sums of some 2000 terms in another order, and images of positions (see contact_scene). Components that
# vanish but for cancellation are compared on the scale of what they cancel.
TOLERANCE = 1e-12
STRESS_SCALE = 1e5    # Pa


def scale_of(word):
    name, column = re.match(r"c_(\w+?)\[(.*)\]$", word).groups() if word.startswith("c_") else ("", "")
    if name in ("l", "lt", "lc"):
        return STRESS_SCALE
    return 1.0


def rows_of(log):
    return [dict(zip(WORDS, values)) for _, *values in thermo_rows(log, len(WORDS) + 1)]


def check_renumbered_steps(suffuse):
    """The measured strain rate after `reset_timestep`, and with another time step."""
    strained = "fix d all deform 1 x erate {} units box\nrun 50\nunfix d\n"
    out = suffuse.must_run(1, SAMPLE + "compute i all inertial/number\nthermo_style custom step c_i[2] vol\nthermo 50\n" + strained.format(-1) +
                           "reset_timestep 0\n" + strained.format(-5) + "timestep 1e-6\n" + strained.format(-2), "renumbered")
    rates = [rate for _, rate, _ in thermo_rows(out, 3)][1::2]
    check(len(rates) == 3 and all(abs(found / rate - 1) < 1e-2 for found, rate in zip(rates, (1, 5, 2))), f"strain rates 1, 5, 2 measured as {rates}")


def main():
    with tempfile.TemporaryDirectory(prefix="suffuse-test-") as folder:
        suffuse = Suffuse(folder, __doc__)
        suffuse.prepare()
        results = {}
        for ranks in (1, 2, 3):
            name = f"ranks{ranks}"
            out = suffuse.must_run(ranks, SAMPLE + COMPUTES + RUN.replace("NAME", name), name)
            results[ranks] = rows_of(out)
            check(len(results[ranks]) == 2, f"{len(results[ranks])} thermo rows on {ranks} ranks")
        worst = compare(results)
        check_one_state(results[1])
        compare_dumps(suffuse.folder)
        check_renumbered_steps(suffuse)
        print(f"largest relative difference between rank counts: {worst:.2e}")


def compare(results):
    worst = 0.0
    failures = []
    for ranks in (2, 3):
        for step in (0, 1):
            for word in WORDS:
                a, b = results[1][step][word], results[ranks][step][word]
                scale = scale_of(word)
                if word.startswith(("c_p[", "c_g[", "c_gh[")):
                    scale = 1e-3  # N·m, the order of the sum's normal components
                difference = abs(a - b) / max(abs(a), abs(b), scale)
                worst = max(worst, difference)
                if not difference <= TOLERANCE:
                    failures.append(f"{word} at row {step}: {a!r} on 1 rank, {b!r} on {ranks}")
    check(not failures, f"{len(failures)} values differ:\n" + "\n".join(failures[:40]))
    return worst


def check_one_state(rows):
    for row in rows:
        value = lambda name, k: row[f"c_{name}[{k}]"]  # noqa: E731
        check(value("s", 2) > 300, "too few contacts for this test to mean anything")
        check(0 < value("s", 1) < 1, f"share of sliding contacts {value('s', 1)}: the state should have both kinds")
        check(value("z", 12) + value("z", 13) + value("z", 14) == value("z", 11), "cc + fc + ff is not all contacts")
        check(min(value("z", k) for k in (12, 13, 14)) > 0, "a class of contacts is empty")
        for arm in ("ap", "ah"):
            check(close(value(arm, 4), value(arm, 1) * value(arm, 6), 1e-12, 1), "fines' stress share is not alpha times their solid share")
        # Σ σ^p V_p over grains, whatever the arm, is LIGGGHTS's virial (stress/atom, of the other sign); the scale of the
        # shear components is that of the normal ones they cancel from. 1e-12: the sampler stretches springs by 1e-13.
        for k in range(1, 7):
            for arm in ("g", "gh"):
                check(close(value(arm, k), -value("p", k), 1e-12, 1e-3), f"component {k}: grains {value(arm, k)!r}, virial {-value('p', k)!r}")
        # Layers by volume and by centre add up to the whole. Axis cuts are spherical segments, so only rounding.
        for name, layers in (("l", 4), ("lc", 5)):
            mean = sum(row[f"c_{name}[{i + 1}][9]"] for i in range(layers)) / layers
            check(close(mean, value("ap", 7), 1e-11, 1), f"layers of {name} have p' {mean!r}, the sample {value('ap', 7)!r}")
    check(rows[0]["c_b[2]"] == 0 and rows[0]["c_b[4]"] == rows[0]["c_s[2]"], "the first state is not its own reference")
    check(rows[1]["c_b[2]"] > 0 or rows[1]["c_b[3]"] > 0, "no contact changed: the test does not move the grains enough")
    check(abs(rows[1]["c_i[2]"] / 5 - 1) < 0.01, f"strain rate {rows[1]['c_i[2]']} measured, 5 applied")  # e^(rate t) - 1 over t is within 0.05 %


def compare_dumps(folder):
    for frame in (0, 1):
        contacts = {}
        for ranks in (1, 2, 3):
            table = read_dump(folder / f"contacts.ranks{ranks}", frame)
            contacts[ranks] = sorted((min(c["c_si[5]"], c["c_si[6]"]), max(c["c_si[5]"], c["c_si[6]"]), c["c_si[1]"]) for c in table)
        for ranks in (2, 3):
            check([c[:2] for c in contacts[ranks]] == [c[:2] for c in contacts[1]], "contact lists differ")
            # One contact, not a sum: its overlap may be small, so 1e-9.
            worst = max(abs(a[2] - b[2]) for a, b in zip(contacts[ranks], contacts[1]))
            check(worst < 1e-9, f"slipping index of a contact differs by {worst} between rank counts")
            one, more = (read_dump(folder / f"grains.ranks{n}", frame) for n in (1, ranks))
            check([g["c_z"] for g in one] == [g["c_z"] for g in more], "contacts of a grain differ")
            for column in ("c_ap[1]", "c_ap[3]", "c_ah[3]"):
                scale = max(abs(g[column]) for g in one)
                check(all(close(a[column], b[column], 1e-11, scale) for a, b in zip(one, more)), f"{column} of a grain differs")


if __name__ == "__main__":
    main()
