#!/usr/bin/env python3
"""appendix_definitions_test.py --suffuse PROGRAM --mpirun SCRIPT

The thesis's appendices D to H, written out anew from their text and fed with what they were fed with (dumps of LIGGGHTS's own
`pair/gran/local`, `contact/atom` and `stress/atom`), give what our computes give on the same state; and where the thesis's text
differs from an appendix (alpha by contact point), the text's formula does.
"""
import math
import tempfile

from contact_scene import SAMPLE, SPLIT, Suffuse, check, read_dump

WORDS = [f"c_{name}[{k + 1}]" for name, n in {"z": 17, "ap": 8, "ah": 8, "r": 6, "s": 4, "sx": 4, "f": 14, "st": 6}.items() for k in range(n)] + ["vol"]
WORDS += [f"c_f[{i + 1}][{j + 1}]" for i in range(36) for j in range(7)]
SCRIPT = SAMPLE + f"""
compute z all coordination split {SPLIT}
compute ap all stress/reduction split {SPLIT}
compute ah all stress/reduction split {SPLIT} by pair_halves
compute r all constraint/ratio
compute s all sliding/contacts
compute sx all sliding/contacts appendix
compute f all fabric
compute st all strong/contacts axis z
compute pgl all pair/gran/local pos id force force_normal force_tangential
compute touching all contact/atom
compute sigma all stress/atom pair
compute si all slipping/index
dump pairs all local 1 pairs.dump {" ".join(f"c_pgl[{k}]" for k in range(1, 19))} c_si[7] c_si[8]
dump_modify pairs format "{" ".join(["%.17g"] * 20)}"
dump grains all custom 1 grains.dump id radius c_touching c_sigma[1] c_sigma[2] c_sigma[3]
dump_modify grains format "%d {" ".join(["%.17g"] * 5)}"
thermo_style custom step {" ".join(WORDS)}
thermo_modify format float %.17g
run 0
"""


def norm(v):
    return math.sqrt(sum(x * x for x in v))


def coordination_by_appendix_e(grains, volume):
    contacts = [g["c_touching"] for g in grains]
    total, n, n0, n1 = sum(contacts), len(contacts), contacts.count(0), contacts.count(1)
    weighted = sum(g["c_touching"] * 4 / 3 * math.pi * g["radius"] ** 3 for g in grains) / volume
    return total / n, (total - n1) / (n - n0 - n1), total / (n - n0), weighted


def reduction_by_appendix_f(grains):
    fines = [g for g in grains if 2 * g["radius"] < SPLIT]
    solid = lambda group: sum(4 / 3 * math.pi * g["radius"] ** 3 for g in group)  # noqa: E731
    p = lambda group: -sum(g["c_sigma[1]"] + g["c_sigma[2]"] + g["c_sigma[3]"] for g in group) / 3  # noqa: E731
    q = lambda group: -sum(g["c_sigma[3]"] - g["c_sigma[1]"] for g in group)  # noqa: E731
    shire = p(fines) / (solid(fines) / solid(grains)) / p(grains)
    return shire, p(fines) / p(grains), q(fines) / q(grains), sum(g["c_touching"] for g in fines) / len(fines)


def reduction_by_equation_4_2(pairs, radius, box):
    """Each grain takes the arm from its centre to the contact point."""
    moment = dict.fromkeys(radius, 0.0)
    for pair in pairs:
        force = [pair[f"c_pgl[{k}]"] for k in (10, 11, 12)]
        branch = [pair[f"c_pgl[{k}]"] - pair[f"c_pgl[{k + 3}]"] for k in (1, 2, 3)]
        branch = [b - length * round(b / length) for b, length in zip(branch, box)]
        distance = norm(branch)
        along = sum(b * f for b, f in zip(branch, force)) / distance
        i, j = pair["c_pgl[7]"], pair["c_pgl[8]"]
        overlap = radius[i] + radius[j] - distance
        moment[i] += (radius[i] - overlap / 2) * along / 3
        moment[j] += (radius[j] - overlap / 2) * along / 3
    fines = [i for i in radius if 2 * radius[i] < SPLIT]
    share = sum(moment[i] for i in fines) / sum(moment.values())
    return share / (sum(radius[i] ** 3 for i in fines) / sum(r ** 3 for r in radius.values())), share


def sliding_by_appendix_g(pairs, friction=0.3):
    index = [norm([p[f"c_pgl[{k}]"] for k in (16, 17, 18)]) / (friction * norm([p[f"c_pgl[{k}]"] for k in (13, 14, 15)])) for p in pairs]
    return index, sum(s >= 1 for s in index) / len(index), sum(s >= 1 - 1e-6 for s in index) / len(index)


def rose_by_appendix_d(pairs, first, second):
    """Bins of 10 degrees of the normal force's projected angle and its opposite; least squares for the rose."""
    counts = [0] * 36
    for pair in pairs:
        normal = [pair[f"c_pgl[{k}]"] for k in (13, 14, 15)]
        angle = math.atan2(normal[second], normal[first]) % (2 * math.pi)
        for a in (angle, (angle + math.pi) % (2 * math.pi)):
            counts[min(int(a / (2 * math.pi) * 36), 35)] += 1
    centres = [(k + 0.5) * 2 * math.pi / 36 for k in range(36)]
    density = [c / sum(counts) / (2 * math.pi / 36) for c in counts]
    rest = [e - 1 / (2 * math.pi) for e in density]
    cc = sum(math.cos(2 * t) ** 2 for t in centres)
    ss = sum(math.sin(2 * t) ** 2 for t in centres)
    cs = sum(math.cos(2 * t) * math.sin(2 * t) for t in centres)
    bc = sum(e * math.cos(2 * t) for e, t in zip(rest, centres))
    bs = sum(e * math.sin(2 * t) for e, t in zip(rest, centres))
    c1 = (bc * ss - bs * cs) / (cc * ss - cs * cs)
    c2 = (bs * cc - bc * cs) / (cc * ss - cs * cs)
    direction = math.atan2(c2, c1) / 2
    return counts, 2 * math.pi * c1 / math.cos(2 * direction), direction


def compression(pair, box):
    """Positive where the normal force on the first grain points away from the second, their nearest images."""
    branch = [pair[f"c_pgl[{k}]"] - pair[f"c_pgl[{k + 3}]"] for k in (1, 2, 3)]
    branch = [b - length * round(b / length) for b, length in zip(branch, box)]
    return sum(b * pair[f"c_pgl[{k}]"] for b, k in zip(branch, (13, 14, 15)))


def box_of(path):
    lines = path.read_text().splitlines()
    at = next(k for k, line in enumerate(lines) if line.startswith("ITEM: BOX BOUNDS"))
    return [float(line.split()[1]) - float(line.split()[0]) for line in lines[at + 1:at + 4]]


def main():
    with tempfile.TemporaryDirectory(prefix="suffuse-test-") as folder:
        suffuse = Suffuse(folder, __doc__)
        suffuse.prepare()
        for ranks in (1, 2):
            out = suffuse.must_run(ranks, SCRIPT, f"appendix{ranks}")
            row = next(line.split() for line in out.splitlines() if len(line.split()) == len(WORDS) + 1 and line.split()[0] == "0")
            ours = dict(zip(WORDS, map(float, row[1:])))
            pairs = read_dump(suffuse.folder / "pairs.dump")
            grains = read_dump(suffuse.folder / "grains.dump")
            compare(ours, pairs, grains, box_of(suffuse.folder / "grains.dump"), ranks)


def compare(ours, pairs, grains, box, ranks):
    def agree(word, expected, tolerance):
        value = ours[f"c_{word}"]
        check(abs(value - expected) <= tolerance * max(1.0, abs(expected)), f"{word} on {ranks} ranks: {value!r}, by the appendix {expected!r}")

    # Counts and sums of the same numbers: 1e-11 is their rounding (dumps carry 17 digits). Box bounds are dumped with six digits,
    # which moves branches across faces by 1e-6 of the box, some 1e-4 of an overlap: 1e-5 where the branch enters.
    z, z_mech, z_geo, z_volume = coordination_by_appendix_e(grains, ours["vol"])
    for k, expected in ((1, z), (2, z_mech), (3, z_geo), (4, z_volume)):
        agree(f"z[{k}]", expected, 1e-11)
    shire, sufian, beta, cn_ff = reduction_by_appendix_f(grains)
    for word, expected in (("ah[1]", shire), ("ah[2]", sufian), ("ah[3]", beta), ("z[8]", cn_ff)):
        agree(word, expected, 1e-10)
    point_shire, point_share = reduction_by_equation_4_2(pairs, {g["id"]: g["radius"] for g in grains}, box)
    agree("ap[1]", point_shire, 1e-5)
    agree("ap[4]", point_share, 1e-5)
    check(abs(shire - point_shire) > 0.05, "the two alphas agree: the sample does not tell them apart")
    index, exact, tolerant = sliding_by_appendix_g(pairs)
    # The appendix takes the whole force, which has damping in it: it counts contacts whose spring is below its limit too.
    slides = sum(p["c_si[8]"] >= (1 - 1e-6) * p["c_si[7]"] for p in pairs) / len(pairs)
    agree("s[1]", slides, 1e-11)
    check(0.05 < slides < tolerant, f"{slides} of the contacts slide, {tolerant} by the whole force")
    # S >= 1 exactly splits the contacts at their Coulomb limit by rounding, here as in the appendix: only its bounds are sure.
    surely = sum(s >= 1 + 1e-9 for s in index) / len(index)
    check(surely <= ours["c_sx[1]"] <= tolerant, f"share by the appendix's rule {ours['c_sx[1]']}, sure {surely}, with tolerance {tolerant}")
    agree("s[3]", sum(min(s, 1) for s in index) / len(index), 1e-10)
    for k, number in ((1, z), (2, z_geo), (3, z_mech)):
        agree(f"r[{k}]", number * (3 - 2 * slides) / 12, 1e-11)
    for plane, (first, second) in enumerate(((0, 1), (0, 2), (1, 2))):
        counts, anisotropy, direction = rose_by_appendix_d(pairs, first, second)
        check([ours[f"c_f[{k + 1}][{2 + plane}]"] for k in range(36)] == counts, f"orientation histogram of plane {plane} differs")
        agree(f"f[{9 + 2 * plane}]", anisotropy, 1e-10)
        agree(f"f[{10 + 2 * plane}]", direction, 1e-9)
    # LIGGGHTS's normal points from the first grain to the second, so that compression has a force against it.
    normal = [math.copysign(norm([p[f"c_pgl[{k}]"] for k in (13, 14, 15)]), compression(p, box)) for p in pairs]
    mean = sum(normal) / len(normal)
    agree("st[1]", sum(f >= mean for f in normal) / len(normal), 1e-11)
    agree("st[2]", mean, 1e-11)
    print(f"{ranks} ranks, {len(grains)} grains, {len(pairs)} contacts: alpha by pair halves {shire:.4f}, by contact point {point_shire:.4f}; "
          f"Z {z:.4f}; sliding {100 * slides:.2f} % (S >= 1 - 1e-6 by the whole force {100 * tolerant:.2f} %, >= 1 exactly {100 * exact:.2f} %)")


if __name__ == "__main__":
    main()
