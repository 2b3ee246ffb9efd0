"""A servo asked for much: targets far off, no contact left, very stiff and soft grains, 20 and 5 grains, a sample that is taken away

Physics: a sample at 100 kPa is unloaded to a thousandth and loaded a hundredfold; its box is blown up until nothing touches; grains a
hundred times stiffer and softer; grains deleted until 70, 20, 5 and one are left, which touch their own images.
Went wrong: gains tuned for one stiffness, so that the box swings or creeps; a rate without bound where there is no stress to measure; a
sample of nothing at a pressure of nothing that is never done.
Criterion: static within 0.5 % of the target, void ratios as unloading (looser) and loading (denser) want them, and the volume a grain
takes the same within a tenth where grains or contacts were taken away; one grain is a cubic array, whose volume Hertz's law gives.
Loaded a thousandfold (overlaps of a fifth of a grain) the run ends with one line and code 4.
"""
import math

from scenes import loose_sample, read_sample

END = """variable p equal f_s[1]
variable e equal f_s[3]
variable phase equal f_s[10]
run 2000000
print "${{p}},${{e}},${{phase}}" file {name}.csv
write_restart {name}.restart
"""
BLOWN = "fix blow all deform 1 x scale 1.1 y scale 1.1 z scale 1.1 remap none\nrun 20000\nunfix blow\n"


def stiffness(script, modulus):
    given = "fix modulus all property/global youngsModulus peratomtype"
    return script.replace(f"{given} 7e8", f"hard_particles yes\n{given} {modulus:g}")


def without(count):
    return f"run 1\ngroup gone id <= {count}\ndelete_atoms group gone compress no\n"


def path(name, script, target):
    return script + f"dem_timestep rayleigh 0.2 pressure {target:g}\nfix s all stress/servo isotropic {target:g} until static\n" + END.format(name=name)


def void_ratio(bench, name, script, target=1e5):
    """At the end of a path that must be static at its target."""
    bench.must_run(path(name, script, target), name=name)
    p, e, phase = map(float, (bench.folder / f"{name}.csv").read_text().split(","))
    bench.expect(phase == 2 and abs(p / target - 1) < 0.006, f"{name}: p' {p:.5g} Pa for {target:g}, phase {phase:.0f}")
    return e


def refused(bench, name, script, target, *words):
    code, screen = bench.run(path(name, script, target), name=name)
    lines = [line for line in screen.splitlines() if line.startswith("suffuse: error:")]
    bench.expect(code == 4 and len(lines) == 1 and all(word in lines[0] for word in words), f"{name}: code {code}, {lines}\n{screen[-800:]}")


def array_of_one(pressure, modulus=7e8, ratio=0.3, bisections=60):
    """Void ratio of a cubic array under a pressure: F = p L^2 = 4/3 E* sqrt(R*) (d - L)^(3/2), E* = E/(2(1 - nu^2)), R* = d/4; d = 1."""
    low, high = 0.5, 1.0
    for _ in range(bisections):
        side = 0.5 * (low + high)
        force = 4 / 3 * modulus / (2 * (1 - ratio ** 2)) * math.sqrt(0.25) * (1 - side) ** 1.5
        low, high = (side, high) if force > pressure * side ** 2 else (low, side)
    return 6 / math.pi * side ** 3 - 1


def run(bench, preset, full):
    grains = 1000 if full else 200
    base = void_ratio(bench, "base", loose_sample(grains=grains, friction=0.3))
    sample = read_sample("base.restart")
    unloaded = void_ratio(bench, "unloaded", sample, 1e2)
    loaded = void_ratio(bench, "loaded", sample, 1e7)
    bench.expect(loaded < 0.8 * base and base < unloaded < 1.1 * base, f"e {base}, unloaded {unloaded}, loaded {loaded}")
    refused(bench, "crushed", sample, 1e8, "fix stress/servo", "the sample is lost")
    parted = void_ratio(bench, "parted", sample + BLOWN)
    stiff = void_ratio(bench, "stiff", stiffness(loose_sample(grains=grains // 4, friction=0.3), 7e10))
    soft = void_ratio(bench, "soft", stiffness(loose_sample(grains=grains, friction=0.3), 7e6))
    bench.expect(soft < 0.8 * base and base < 1.1 * stiff, f"e {base}, of stiff grains {stiff}, of soft {soft}")
    few = {left: void_ratio(bench, f"left_{left}", sample + without(grains - left)) for left in (70, 20, 5)}
    for name, e in (("parted", parted), ("of 70 grains", few[70])):
        bench.expect(abs((1 + e) / (1 + base) - 1) < 0.1, f"{name}: e {e:.3f}, before {base:.3f}")
    alone = void_ratio(bench, "alone", sample + without(grains - 1))
    bench.expect(abs(alone / array_of_one(1e5) - 1) < 0.003, f"a grain and its images: e {alone:.5f}, Hertz {array_of_one(1e5):.5f}")
    return (f"e at 100 kPa {base:.3f}; 0.1 kPa {unloaded:.3f}, 10 MPa {loaded:.3f}, parted and closed again {parted:.3f}; grains 100 times stiffer {stiff:.3f}, "
            f"softer {soft:.3f}; all but 70, 20, 5 grains deleted {few[70]:.3f}, {few[20]:.3f}, {few[5]:.3f}; one grain {alone:.4f}, by Hertz {array_of_one(1e5):.4f}; 100 MPa refused")
