"""Grains that are held by leaving them out, frozen, or moved along a given path

Physics: in a channel with no-slip sides a grain is pulled by a constant force until it falls steadily. A grain that is moved at that speed
(LIGGGHTS's `fix move linear`) must feel that force from the water; a grain that no fix integrates and one under `fix freeze` must feel the
same in a flow, and so must their neighbour that is free.
Went wrong: loads kept from a grain whose forces a fix sets to zero; a moved grain taken for one at rest, so that the water stands.
Criterion: force on the moved grain within 2 % of the pull; loads of held and frozen grains the same to the last digit.
"""
from wet_grains import Water, grain, last_dump, scene

PRESETS = ("default", "thesis")
FACES = {"xlo": "noslip", "xhi": "noslip", "ylo": "noslip", "yhi": "noslip"}
LOADS = 'dump loads all custom 1 loads.dump id f_hydrodynamic_force[1] f_hydrodynamic_force[2] f_hydrodynamic_force[3] ' \
        'f_hydrodynamic_force[4] f_hydrodynamic_force[5] f_hydrodynamic_force[6] vz\ndump_modify loads format "%d' + " %.17g" * 7 + '"\n'


def loads(bench, water, grains, lines, time, motion=True):
    after = f"{lines}\nlbm run {time:.12g}\n{LOADS}run 0\n"
    bench.must_run(scene(bench, water, grains, after, periodic="ffp", held=not motion, timestep=water.step / 200))
    return last_dump(bench.folder / "loads.dump")


def run(bench, preset, full):
    water = Water((24, 24, 32), 0.8, FACES, preset=preset)
    diameter, pull = 6 * water.spacing, 2e-8
    middle = [1.2e-3, 1.2e-3, 1.6e-3]
    settled = 2.0  # seven relaxation times of the channel
    free = loads(bench, water, [grain(middle, diameter)], f"fix pull all addforce 0 0 {pull}", settled)
    speed = free["vz"][0]
    moved = loads(bench, water, [grain(middle, diameter)], f"fix motion all move linear 0 0 {speed:.17g} units box", settled, motion=False)
    ratio = -moved["f_hydrodynamic_force[3]"][0] / pull
    bench.expect(abs(ratio - 1) < 0.02, f"moved at {speed:.4g} m/s the grain feels {ratio:.4f} of the pull")

    water = Water((24, 24, 32), 0.8, FACES, preset=preset, lines="lbm force pressure_gradient 0 0 20")
    pair = [grain(middle, diameter), grain([0.7e-3, 1.3e-3, 2.4e-3], diameter)]
    own = "group held id 1\ngroup free id 2\nfix motion free nve/sphere\n"
    left = loads(bench, water, pair, own, 0.02, motion=False)
    frozen = loads(bench, water, pair, own + "fix ice held freeze\n", 0.02, motion=False)
    bench.expect(left == frozen, f"held {left}, frozen {frozen}")
    return f"moved at the speed of a pulled one: {ratio:.4f} of the pull; held and frozen alike to the last digit"
