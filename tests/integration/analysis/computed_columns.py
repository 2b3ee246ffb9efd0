"""Columns of `suffuse-analyse contacts` and the values of our computes that they repeat."""

# Our column, the compute's value in the run, and how far from it text of six digits may be, of its size, or of 1 where that is larger:
# 1e-5, as what is cut off is 5e-6 of a number at most. None: see above.
COLUMNS = [
    ("coordination_number", "c_z[1]", 1e-5), ("coordination_mechanical", "c_z[2]", 1e-5), ("coordination_geometric", "c_z[3]", 1e-5),
    ("coordination_volume_weighted", "c_z[4]", 1e-5), ("coordination_coarse_coarse", "c_z[5]", 1e-5),
    ("coordination_fine_coarse", "c_z[6]", 1e-5), ("coordination_fine_fine", "c_z[7]", 1e-5), ("coordination_fines_mean", "c_z[8]", 1e-5),
    ("stable_share", "c_z[9]", 1e-5), ("unconnected_fines_share", "c_z[10]", 1e-5), ("contacts", "c_z[11]", 0), ("grains", "c_z[15]", 0),
    ("contacts_coarse_coarse", "c_z[12]", 0), ("contacts_fine_coarse", "c_z[13]", 0), ("contacts_fine_fine", "c_z[14]", 0), ("fines", "c_z[16]", 0),
    ("alpha_contact_point", "c_ap[1]", 1e-5), ("alpha_sufian_contact_point", "c_ap[2]", 1e-5), ("beta_contact_point", "c_ap[3]", 1e-5),
    ("fines_solid_share", "c_ap[6]", 1e-5), ("mean_stress_pa", "c_ap[7]", 1e-5),
    ("alpha_pair_halves", "c_ah[1]", 1e-5), ("alpha_sufian_pair_halves", "c_ah[2]", 1e-5), ("beta_pair_halves", "c_ah[3]", 1e-5),
    ("constraint_ratio", "c_r[1]", None), ("constraint_ratio_geometric", "c_r[2]", None), ("constraint_ratio_mechanical", "c_r[3]", None),
    ("sliding_share", "c_s[1]", None), ("mean_slipping_index", "c_s[3]", 1e-5), ("mean_mobilised_friction", "c_s[4]", 1e-5),
    ("fabric_deviator", "c_f[1]", 1e-5), ("fabric_xx", "c_f[2]", 1e-5), ("fabric_yy", "c_f[3]", 1e-5), ("fabric_zz", "c_f[4]", 1e-5),
    ("fabric_xy", "c_f[5]", 1e-5), ("fabric_xz", "c_f[6]", 1e-5), ("fabric_yz", "c_f[7]", 1e-5),
    ("rose_xy_anisotropy", "c_f[9]", 1e-5), ("rose_xz_anisotropy", "c_f[11]", 1e-5), ("rose_yz_anisotropy", "c_f[13]", 1e-5),
    ("rose_xz_direction_rad", "c_f[12]", 1e-5), ("strong_share", "c_st[1]", 1e-5), ("strong_threshold_n", "c_st[2]", 1e-5),
    ("strong_mean_stress_share", "c_st[4]", 1e-5), ("strong_deviator_share", "c_st[5]", 1e-5),
]

# The limit and the spring that the contact law has, in dumps beside compute pair/gran/local.
LAW_VALUES = "c_si[7] c_si[8]"
LAW_COLUMNS = ["--column", "friction_limit=c_si[7]", "spring_force=c_si[8]"]

COMPUTES = """
compute z all coordination split {split}
compute ap all stress/reduction split {split}
compute ah all stress/reduction split {split} by pair_halves
compute r all constraint/ratio
compute s all sliding/contacts
compute sw all sliding/contacts tolerance 2e-5
compute si all slipping/index
compute f all fabric
compute st all strong/contacts axis z
"""


def difference(value, computed):
    """Of its size, or of 1 where that is larger."""
    return abs(value - computed) / max(1.0, abs(computed))
