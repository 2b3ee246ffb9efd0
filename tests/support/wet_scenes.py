"""Small scenes with water for the integration tests: grains of 0.5 to 1 mm in a box of 4 x 4 x 5 mm, 32 x 32 x 40 cells."""
from scenes import HEADER, MATERIAL

SPACING = 1.25e-4

CREATED = """
region box block 0 4e-3 0 4e-3 0 5e-3 units box
create_box 1 box
"""

REST = """
fix floor all wall/gran model hertz tangential history primitive type 1 zplane 0
fix lid all wall/gran model hertz tangential history primitive type 1 zplane 5e-3
fix weight all gravity 9.81 vector 0 0 -1
fix hydrodynamic_force all hydrodynamic/force
timestep 1e-6
thermo_modify lost error norm no
"""

GRAINS = """
fix large all particletemplate/sphere 11593 atom_type 1 density constant 2650 radius constant 0.5e-3
fix small all particletemplate/sphere 11807 atom_type 1 density constant 2650 radius constant 0.3e-3
fix grading all particledistribution/discrete 32452843 2 large 0.5 small 0.5
fix insertion all insert/pack seed 32452867 distributiontemplate grading insert_every once overlapcheck yes &
    particles_in_region {grains} region box ntry_mc 20000
run 1
unfix insertion
"""

WATER = f"""
lbm fluid density 1000 viscosity 1e-6
lbm lattice spacing {SPACING} relaxation_time 0.515
lbm force gravity 0 0 -9.81
"""


def wet_box(grains=40, processors="* * *", boundary="p p f", restart=None):
    """Script text: grains placed at random, or those of a restart file, soft enough for a DEM step of 1 microsecond; no
    water yet."""
    box = f"read_restart {restart}\n" if restart else CREATED
    return HEADER.format(boundary=boundary) + f"processors {processors}\natom_modify sort 0 0\n" + box + \
        MATERIAL.format(friction=0.3) + REST + ("" if restart or not grains else GRAINS.format(grains=grains))
