#!/usr/bin/env python3
"""friction_limit_test.py --suffuse PROGRAM --mpirun SCRIPT --analyse PROGRAM

Which contacts slide is what the contact law itself says. Two grains, one of them moved sideways, with and without cohesion,
with a tangential spring and without: the limit and the slipping index are those of the law written out by hand; damping
beyond the limit makes no contact slide; `suffuse-analyse` on the dumps says the same.
"""
import math
import subprocess
import tempfile

from contact_scene import Suffuse, check, close, read_dump
from scenes import HEADER, material

SCENE = HEADER.format(boundary="f f f") + """
region box block -2e-3 4e-3 -2e-3 2e-3 -2e-3 2e-3 units box
create_box 1 box
fix ced all property/global cohesionEnergyDensity peratomtypepair 1 5e4
""" + material(1e-3, "5e6", 0.5, 0.5, law="hertz {law}") + """
create_atoms 1 single 0 0 0
create_atoms 1 single 0.98e-3 0 0
set type 1 diameter 1e-3 density 2650
group b id 2
fix mv b move linear 0 {speed} 0
timestep 1e-6
compute f all pair/gran/local pos id force force_normal force_tangential
compute si all slipping/index
compute sl all sliding/contacts
compute r all constraint/ratio
dump g all custom {every} grains.dump id radius x y z
dump f all local {every} contacts.dump {columns}
dump_modify f format "{formats}"
thermo_style custom step c_sl[1] c_sl[3] c_sl[4] c_r[5]
thermo_modify format float %.17g
thermo {every}
run {steps}
"""
COLUMNS = [f"c_f[{k}]" for k in range(1, 19)] + [f"c_si[{k}]" for k in range(1, 9)]
FRICTION, MODULUS, POISSON, RESTITUTION, RADIUS, DENSITY, COHESION = 0.5, 5e6, 0.3, 0.5, 5e-4, 2650, 5e4


def law(distance, normal_speed):
    """LIGGGHTS's Hertz with its damping, and sjkr: normal force of the spring, and cohesion, N; the tangential stiffness, N/m."""
    overlap, r_eff, m_eff = 2 * RADIUS - distance, RADIUS / 2, DENSITY * 4 / 3 * math.pi * RADIUS ** 3 / 2
    y_eff = MODULUS / 2 / (1 - POISSON ** 2)
    g_eff = MODULUS / 4 / (2 - POISSON) / (1 + POISSON)
    root = math.sqrt(r_eff * overlap)
    beta = math.log(RESTITUTION) / math.sqrt(math.log(RESTITUTION) ** 2 + math.pi ** 2)
    damping = -2 * math.sqrt(5 / 6) * beta
    normal = 4 / 3 * y_eff * root * overlap - damping * math.sqrt(2 * y_eff * root * m_eff) * normal_speed
    area = math.pi / 4 * (2 * RADIUS - distance) * (2 * RADIUS + distance)
    tangential_damping = damping * math.sqrt(8 * g_eff * root * m_eff)
    return normal, -COHESION * area, 8 * g_eff * root, tangential_damping


def run(suffuse, name, words, speed, every, steps):
    script = SCENE.format(law=words, speed=speed, every=every, steps=steps, columns=" ".join(COLUMNS), formats=" ".join(["%.17g"] * len(COLUMNS)))
    out = suffuse.must_run(1, script, name)
    lines = out.splitlines()
    head = max(k for k, line in enumerate(lines) if line.split()[:1] == ["Step"])
    table = lines[head + 1:]
    rows = [list(map(float, line.split())) for line in table[:steps // every + 1]]
    frames = [read_dump(suffuse.folder / "contacts.dump", k)[0] for k in range(steps // every + 1)]
    return rows[:len(frames)], frames


def check_limit(rows, frames, speed, share_of_cohesion, every):
    """Position and velocity of the moved grain are known: y = v t, v across."""
    for k, (row, frame) in enumerate(zip(rows, frames)):
        x, y = 0.98e-3, speed * k * every * 1e-6
        distance = math.hypot(x, y)
        normal, cohesion, _, _ = law(distance, speed * y / distance)
        limit = FRICTION * abs(normal + share_of_cohesion * cohesion)
        # Damping is that of the force computation, at mid-step velocities, which here are the constant ones: rounding of 1e-9.
        check(close(frame["c_si[7]"], limit, 1e-8, 0), f"step {row[0]:.0f}: limit {frame['c_si[7]']!r}, by hand {limit!r}")
        tangential = frame["c_si[4]"]
        check(close(frame["c_si[1]"], min(tangential / limit, 1), 1e-7, 1), f"S {frame['c_si[1]']!r}, by hand {tangential / limit!r}")
        check(close(frame["c_si[2]"], FRICTION * frame["c_si[1]"], 1e-12, 1), "mobilised friction is not mu S")
        check(row[2] == frame["c_si[1]"] and row[3] == frame["c_si[2]"] and row[4] == row[1], "the computes differ")


def analysed(suffuse, *options):
    done = subprocess.run([suffuse.options.analyse, "contacts", "grains.dump", "contacts.dump", "--pair-values", "pos id force force_normal force_tangential",
                           "--friction", str(FRICTION), "--output", "contacts.csv", *options],
                          cwd=suffuse.folder, capture_output=True, text=True)
    check(done.returncode == 0, done.stderr)
    lines = (suffuse.folder / "contacts.csv").read_text().splitlines()
    (suffuse.folder / "contacts.csv").unlink()
    return [dict(zip(lines[0].split(","), line.split(","))) for line in lines[1:]], done.stdout


def main():
    with tempfile.TemporaryDirectory(prefix="suffuse-test-") as folder:
        suffuse = Suffuse(folder, __doc__)

        # Cohesion is added behind the cap, so that the limit is that of the spring alone; with tangential_reduce before it.
        rows, frames = run(suffuse, "cohesion", "tangential history cohesion sjkr", 0.03, 40, 200)
        check_limit(rows, frames, 0.03, 0, 40)
        last = frames[-1]
        check(close(last["c_si[1]"], 0.81, 0.005, 0), f"S = {last['c_si[1]']}, by hand 0.81")
        check(last["c_si[4]"] / FRICTION / last["c_si[3]"] > 1.1, "the total normal force would do: the test tells nothing")
        law_columns = ["friction_limit=c_si[7]", "spring_force=c_si[8]"]
        table, said = analysed(suffuse, "--column", *law_columns)
        check([close(float(t["mean_slipping_index"]), r[2], 1e-12, 1) and float(t["sliding_share"]) == r[1] for t, r in zip(table, rows)].count(False) == 0,
              "suffuse-analyse differs from the computes")
        table, said = analysed(suffuse)
        check("1 contacts have more tangential force than friction" in said, f"nothing said of S > 1:\n{said}")
        rows, frames = run(suffuse, "reduced", "tangential history cohesion sjkr tangential_reduce on", 0.03, 40, 80)
        check_limit(rows, frames, 0.03, 1, 40)

        # At 0.5 m/s damping is twice the limit before the spring has grown; when it has, the contact slides.
        rows, frames = run(suffuse, "fast", "tangential history", 0.5, 1, 20)
        check_limit(rows, frames, 0.5, 0, 1)
        check(max(f["c_si[4]"] / f["c_si[7]"] for f, r in zip(frames, rows) if r[1] == 0) > 1.8, "no damping above the limit here")
        _, _, stiffness, damping = law(0.98e-3, 0)
        for frame, row in zip(frames[1:], rows[1:]):
            spring = stiffness * 0.5 * row[0] * 1e-6
            slides = spring > frame["c_si[7]"]
            check(row[1] == slides, f"step {row[0]:.0f}: spring {spring:.4g} N, limit {frame['c_si[7]']:.4g} N, sliding share {row[1]}")
            if not slides:  # the plane of contact turns by 1e-2 in these steps, the stiffness less
                check(close(frame["c_si[8]"], spring, 1e-3, 0), f"spring {frame['c_si[8]']!r}, by hand {spring!r}")
        check(0 < sum(r[1] for r in rows) < len(rows), "the contact should hold first and slide then")
        table, said = analysed(suffuse, "--column", *law_columns)
        check([float(t["sliding_share"]) for t in table] == [r[1] for r in rows], "suffuse-analyse tells it otherwise")

        # Without a spring friction is viscous up to the same limit.
        rows, frames = run(suffuse, "viscous", "tangential no_history cohesion sjkr", 0.03, 40, 80)
        check_limit(rows, frames, 0.03, 0, 40)
        check(rows[-1][1] == 0 and close(frames[-1]["c_si[4]"], damping * 0.03, 1e-3, 0), "slow: below the limit")
        rows, frames = run(suffuse, "viscous_fast", "tangential no_history cohesion sjkr", 0.5, 1, 2)
        check(rows[-1][1] == 1 and close(frames[-1]["c_si[1]"], 1, 1e-12, 0), "fast: at the limit")
        rows, _ = run(suffuse, "smooth", "tangential off", 0.03, 40, 40)
        check(rows[-1][1] == 1, "a law without friction holds nothing")
        print("limits, springs and sliding are the law's")


if __name__ == "__main__":
    main()
