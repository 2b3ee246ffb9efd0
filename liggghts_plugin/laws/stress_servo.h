#pragma once

#include <cstdint>

#include "suffuse/common/linear_algebra.h"

/// The control law of `fix stress/servo`: strain rates of a periodic box from its measured stress. Pure: no
/// LIGGGHTS, no MPI. Stresses and strains are positive in compression; strain rates are logarithmic, 1/s.
namespace suffuse::servo {

enum class Path {
  isotropic,        ///< p' to the target, equal rates on the three axes (Appendix A)
  constant_mean,    ///< axial strain rate given, lateral stresses ½(3p' − σ_axial) (eqs 5.1–5.4)
  triaxial,         ///< axial strain rate given, lateral stresses at the cell pressure
  cyclic,           ///< triaxial, the axial direction reverses at two bounds of the deviator
  constant_volume,  ///< axial strain rate given, lateral rates −½ of it (undrained)
};

enum class Phase { approaching = 0, holding = 1, done = 2 };

enum class Stop { none, target, static_state, axial_strain, cycles };

struct Settings {
  Path path = Path::isotropic;
  double target = 0;        ///< p' or cell pressure, Pa; unused for constant volume
  int axis = 2;             ///< axial direction, 0..2
  double direction = 1;     ///< +1 axial compression, −1 extension
  double axial_rate = 0;    ///< magnitude, 1/s; 0: as fast as the inertial number allows
  double deviator_low = 0;  ///< cyclic bounds of q = σ_axial − σ_lateral, Pa
  double deviator_high = 0;
  double inertial_number =
      7.9e-5;                    ///< limit of eq 3.17 at the target stress (thesis, after Perez et al. 2016)
  double max_rate = 50;          ///< 1/s, while the sample carries no stress
  double approach_share = 0.01;  ///< of the target, up to which p' may rise faster than inertial_number says
  double tolerance = 0.005;      ///< relative, of the controlled stress, and of p' and Z for `static`
  double unbalanced = 0.01;      ///< largest unbalanced-force ratio of a static sample; 0: Z decides instead
  Stop stop = Stop::none;
  double stop_value = 0;  ///< axial strain, or number of cycles
};

/// What the control law is told at each control step.
struct Measurement {
  double interval = 0;          ///< time since the last control step, s
  Vec3 stress = Vec3::Zero();   ///< normal stresses of the box, Pa
  Vec3 lengths = Vec3::Zero();  ///< of the box, m
  double bulk_stiffness = 0;    ///< upper bound of the elastic bulk modulus (from the contacts), Pa
  double inertial_size = 0;     ///< d √ρ: inertial number per strain rate times √p', √(kg/m)
  double relaxation_time = 0;   ///< of the controller, s
  bool is_static = false;       ///< verdict of sample_static
};

/// Everything the law remembers.
struct State {
  Vec3 rate = Vec3::Zero();               ///< applied now, 1/s
  Vec3 bias = Vec3::Zero();               ///< slow part of the rate (integral action), 1/s
  Vec3 last_stress = Vec3::Zero();        ///< at the control step before, Pa
  Vec3 reference_lengths = Vec3::Zero();  ///< at the start of holding, m
  double axial_ramp = 0;                  ///< 0..1, start of shearing
  double axial_direction = 1;             ///< reverses in cyclic loading
  std::int64_t reversals = 0;
  double peak_deviator = 0;   ///< largest |q| while shearing, Pa
  double strain_at_peak = 0;  ///< axial strain there
  double largest_stress = 0;  ///< largest p' of a constant-volume path, Pa
  Phase phase = Phase::approaching;
};

/// p' = (σ_x + σ_y + σ_z)/3 (eq 5.1).
double mean_stress(const Vec3& stress);

/// q = σ_axial − ½(σ_lateral1 + σ_lateral2); negative in extension.
double deviatoric_stress(const Vec3& stress, int axis);

/// Largest logarithmic strain rate per axis at a mean stress, 1/s.
///
/// I_max √p_target/(d √ρ) (eq 3.17 with the target in place of p'), raised in inverse proportion to p'
/// while p' is below 1 % of the target, since a sample without a force network has no quasi-static state to
/// keep; never above max_rate, and never below the limit of eq 3.17 unless max_rate itself is. Any mean
/// stress is valid, tension too.
double rate_limit(const Settings& settings, double inertial_size, double mean_stress);

/// The same at constant volume, where there is no target: eq 3.17 at the present p' while that is above 1 %
/// of the largest of the path; below, where the sample liquefies and has no force network, raised in inverse
/// proportion to p' up to the limit at the largest; max_rate while there has been no stress at all.
double undrained_rate_limit(const Settings& settings, double inertial_size, double largest_stress,
                            double mean_stress);

/// Largest axial rate while shearing, 1/s.
double axial_rate_limit(const Settings& settings, const State& state, const Measurement& measurement);

/// Steps between control steps where boundaries follow a stress: the largest part of `longest` that is within
/// `steps_allowed`, at least a tenth of `longest`. A sample loses stress in a collapse within its inertial
/// time d √(ρ/p'); the controller's relaxation time has to be
/// shorter.
std::int64_t control_interval(const Settings& settings, std::int64_t longest, double steps_allowed);

/// Engineering strain along an axis since the reference, (l₀ − l)/l₀.
double axial_strain(const State& state, const Vec3& lengths, int axis);

/// Engineering volumetric strain since the reference, (V₀ − V)/V₀.
double volumetric_strain(const State& state, const Vec3& lengths);

/// One control step: returns the state whose `rate` is to be applied until the next.
///
/// Proportional to the stress error over the bulk stiffness, with integral action (the lateral rates of a
/// dilating sample must not cost a standing error) and limited by rate_limit. Throws nothing; any finite
/// measurement is valid.
State control(const Settings& settings, const State& state, const Measurement& measurement);

/// Band of p' and Z since the last time that one of them moved.
struct StaticWindow {
  double start = -1;                       ///< s; negative before the first sample
  double stress_low = 0, stress_high = 0;  ///< Pa
  double coordination_low = 0, coordination_high = 0;
};

/// What decides whether a sample is static.
struct StaticSample {
  double time = 0;          ///< s
  double mean_stress = 0;   ///< Pa
  double coordination = 0;  ///< Z
  double unbalanced = 0;    ///< mean resultant force on a grain over mean contact force
};

/// One sample for `static`: true once p' has varied by no more than ± tolerance (relative) for `duration`
/// seconds, with the unbalanced-force ratio within settings.unbalanced at every sample; where that is 0, once
/// p' and Z have both kept to the tolerance (thesis, chapter 4: constant over 20,000 steps). A larger change
/// starts the window anew.
bool sample_static(StaticWindow& window, const Settings& settings, const StaticSample& sample,
                   double duration);

}  // namespace suffuse::servo
