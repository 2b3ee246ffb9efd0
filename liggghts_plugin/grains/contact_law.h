#pragma once

/// The contact laws of LIGGGHTS's granular pair style that the vectorised pass computes.
///
/// Formulas and names of coefficients are those of LIGGGHTS 3.8 (`pair_style gran model ...` and its
/// documentation of the models); all quantities in SI.

namespace suffuse::grains {

/// How normal and tangential stiffness and damping follow from a pair's radii, masses and materials.
enum class NormalLaw {
  hertz,           ///< k_n = 4/3 E* sqrt(r* overlap), k_t = 8 G* sqrt(r* overlap) (Hertz; Mindlin)
  hooke,           ///< linear: k_n from E*, r*, m* and a characteristic velocity
  hooke_stiffness  ///< linear: k_n, k_t and damping as the script gives them
};

enum class TangentialLaw {
  off,         ///< no tangential force
  no_history,  ///< viscous, at most friction times the normal force
  history      ///< a spring that is cut at friction times the normal force, and a dashpot while it is not
};

enum class RollingLaw {
  off,
  cdt  ///< a torque of constant size against the relative spin ("constant directional torque")
};

/// What two materials have in common. Which meaning a value has depends on the normal law:
///
/// | | hertz | hooke | hooke_stiffness |
/// |---|---|---|---|
/// | normal_stiffness | E* (Pa) | E* (Pa) | k_n (N/m) |
/// | tangential_stiffness | G* (Pa) | k_t / k_n | k_t (N/m) |
/// | normal_damping | 2 sqrt(5/6) abs(beta) | factor of sqrt(m* k_n) | 1/s, or kg/s if absolute |
/// | tangential_damping | the same or 0 | the same or 0 | the same or 0 |
struct alignas(64) PairCoefficients {
  double normal_stiffness = 0;
  double tangential_stiffness = 0;
  double normal_damping = 0;
  double tangential_damping = 0;
  double friction = 0;
  double rolling_friction = 0;
};

struct ContactLaw {
  NormalLaw normal = NormalLaw::hertz;
  TangentialLaw tangential = TangentialLaw::history;
  RollingLaw rolling = RollingLaw::off;
  bool limit_force = false;            ///< no attraction from damping
  bool absolute_damping = false;       ///< hooke_stiffness: damping is not multiplied by the mass
  bool torsion = false;                ///< rolling torque keeps its part along the normal
  double characteristic_velocity = 0;  ///< m/s, hooke only
  int materials = 1;
  const PairCoefficients* coefficients = nullptr;  ///< materials x materials
};

}  // namespace suffuse::grains
