#include "stress_servo.h"

#include <algorithm>
#include <cmath>

namespace suffuse::servo {
namespace {

/// Below this share of the largest stress of an undrained path the sample counts as carrying none.
constexpr double kUnloadedShare = 0.01;
/// Slow parts of the law take this many controller time constants: integral action, start of shearing.
constexpr double kSlowness = 10;
/// Share of a wrong stress rate that one control step corrects. Two coupled lateral boundaries double the
/// effect of a correction, and the stiffness may be underestimated by as much again: below 1/4 neither rings.
constexpr double kCorrection = 0.2;
/// Constrained modulus over bulk modulus of a packing of central springs: (1/5)/(1/9).
constexpr double kConstrainedOverBulk = 1.8;
/// A sample that collapses contracts faster than a quasi-static path allows: its boundaries may be faster by
/// so many times the share of the controlled stress that it has lost.
constexpr double kCatchUp = 20;
/// Control steps are at most so many times as frequent as the longest interval.
constexpr std::int64_t kMostFrequent = 10;
/// The bulk modulus of a packing is several times its pressure, for Hertz about κ/2; a floor for nearly empty
/// networks.
constexpr double kLeastStiffnessOverTarget = 3;

/// Proportional–integral action on one error, limited to ±limit. Updates the integral part.
double drive(double error, double stiffness, const Measurement& m, double limit, double& bias) {
  const double proportional = error / (stiffness * m.relaxation_time);
  const double unlimited = proportional + bias;
  if (std::abs(unlimited) <= limit || unlimited * proportional < 0)  // no wind-up against the limit
    bias += proportional * m.interval / (kSlowness * m.relaxation_time);
  bias = std::clamp(bias, -limit, limit);
  return std::clamp(unlimited, -limit, limit);
}

double stiffness_of(const Settings& s, const Measurement& m) {
  return std::max(m.bulk_stiffness, kLeastStiffnessOverTarget * s.target);
}

/// Equal rates on all axes, towards p' = target.
void drive_isotropic(const Settings& s, const Measurement& m, State& state) {
  const double p = mean_stress(m.stress);
  const double limit = rate_limit(s, m.inertial_size, p);
  // Three axes at the same rate: the volume strains three times as fast. Nothing strains a sample at rest, so
  // there is no standing error for integral action to remove. Grains without friction that still rearrange
  // hold p' some per cent below the target meanwhile: that waits for them, and integral action would not
  // (docs/decisions/servo-approach.md).
  const double rate = (s.target - p) / (3 * stiffness_of(s, m) * m.relaxation_time);
  state.rate.setConstant(std::clamp(rate, -limit, limit));
  state.bias.setZero();
}

/// Each axis on its own, towards the same stress on all.
void drive_to_cell_pressure(const Settings& s, const Measurement& m, State& state) {
  const double limit = rate_limit(s, m.inertial_size, mean_stress(m.stress));
  for (int i = 0; i < 3; ++i)
    state.rate[i] =
        drive(s.target - m.stress[i], kConstrainedOverBulk * stiffness_of(s, m), m, limit, state.bias[i]);
}

/// A wanted change of stress: its distance to go, and the rates of the target and of the stress itself.
struct Tracking {
  double error = 0;        // Pa
  double target_rate = 0;  // Pa/s
  double stress_rate = 0;  // Pa/s
};

/// A rate, from the one before, such that a stress follows its moving target.
double follow(const Settings& s, const Measurement& m, double rate, const Tracking& t, double limit) {
  const double wanted = t.error / m.relaxation_time + t.target_rate;
  const double correction =
      kCorrection * (wanted - t.stress_rate) / (kConstrainedOverBulk * stiffness_of(s, m));
  return std::clamp(rate + correction, -limit, limit);
}

/// Both lateral boundaries towards one target. Their common rate answers for the lateral mean (and so for
/// p'), their difference for its equal sharing; limited each on its own, a long way to equal stresses does
/// not disturb the mean.
void follow_laterally(const Settings& s, const Measurement& m, double target, double target_rate,
                      double limit, State& state) {
  const int i = (s.axis + 1) % 3, j = (s.axis + 2) % 3;
  const Vec3 stress_rate = (m.stress - state.last_stress) / m.interval;
  const Tracking mean{target - (m.stress[i] + m.stress[j]) / 2, target_rate,
                      (stress_rate[i] + stress_rate[j]) / 2};
  const Tracking half_difference{-(m.stress[i] - m.stress[j]) / 2, 0, (stress_rate[i] - stress_rate[j]) / 2};
  const double common = follow(s, m, (state.rate[i] + state.rate[j]) / 2, mean, limit);
  const double opposed = follow(s, m, (state.rate[i] - state.rate[j]) / 2, half_difference, limit / 4);
  state.rate[i] = common + opposed;
  state.rate[j] = common - opposed;
}

/// Axial rate as ordered, started smoothly, and no faster than the inertial number allows.
double axial_rate(const Settings& s, const Measurement& m, State& state) {
  state.axial_ramp = std::min(1.0, state.axial_ramp + m.interval / (kSlowness * m.relaxation_time));
  state.largest_stress = std::max(state.largest_stress, mean_stress(m.stress));
  const double limit = axial_rate_limit(s, state, m);
  const double ordered = s.axial_rate > 0 ? std::min(s.axial_rate, limit) : limit;
  return ordered * state.axial_ramp * state.axial_direction;
}

void reverse_if_due(const Settings& s, const Measurement& m, State& state) {
  const double q = deviatoric_stress(m.stress, s.axis);
  const bool due = state.axial_direction > 0 ? q >= s.deviator_high : q <= s.deviator_low;
  if (!due) return;
  state.axial_direction = -state.axial_direction;
  state.axial_ramp = 0;
  ++state.reversals;
}

void shear(const Settings& s, const Measurement& m, State& state) {
  if (s.path == Path::cyclic) reverse_if_due(s, m, state);
  const double axial = axial_rate(s, m, state);
  state.rate[s.axis] = axial;
  if (s.path == Path::constant_volume) {
    for (int i = 0; i < 3; ++i)
      if (i != s.axis) state.rate[i] = -0.5 * axial;
    return;
  }
  const bool constant_mean = s.path == Path::constant_mean;
  const double target = constant_mean ? 0.5 * (3 * s.target - m.stress[s.axis]) : s.target;
  const double axial_stress_rate = (m.stress[s.axis] - state.last_stress[s.axis]) / m.interval;
  // Lateral boundaries move to keep a stress, not to deform the sample: they may be up to twice as fast as
  // the axis.
  const double controlled = constant_mean ? mean_stress(m.stress) : (m.stress.sum() - m.stress[s.axis]) / 2;
  const double lost = std::clamp(1 - controlled / s.target - s.tolerance, 0., 1.);
  const double limit =
      2 * std::max(rate_limit(s, m.inertial_size, s.target), std::abs(axial)) * (1 + kCatchUp * lost);
  follow_laterally(s, m, target, constant_mean ? -0.5 * axial_stress_rate : 0.0, limit, state);
}

bool reached(const Settings& s, const Measurement& m) {
  const double band = s.tolerance * s.target;
  if (std::abs(mean_stress(m.stress) - s.target) > band) return false;
  if (s.path == Path::isotropic || s.path == Path::constant_mean) return true;
  return (m.stress.array() - s.target).abs().maxCoeff() <= band;
}

void begin_holding(const Settings& s, const Measurement& m, State& state) {
  state.phase = Phase::holding;
  state.reference_lengths = m.lengths;
  state.axial_direction = s.direction;
  state.axial_ramp = 0;
  state.last_stress = m.stress;
}

void note_peak(const Settings& s, const Measurement& m, State& state) {
  const double q = deviatoric_stress(m.stress, s.axis);
  if (std::abs(q) <= std::abs(state.peak_deviator)) return;
  state.peak_deviator = q;
  state.strain_at_peak = axial_strain(state, m.lengths, s.axis);
}

bool stop_met(const Settings& s, const Measurement& m, const State& state) {
  switch (s.stop) {
    case Stop::none:
      return false;
    case Stop::target:
      return true;  // holding has begun
    case Stop::static_state:
      return m.is_static;
    case Stop::axial_strain:
      return std::abs(axial_strain(state, m.lengths, s.axis)) >= s.stop_value;
    case Stop::cycles:
      return static_cast<double>(state.reversals) >= 2 * s.stop_value;
  }
  return false;
}

}  // namespace

double mean_stress(const Vec3& stress) {
  return stress.sum() / 3;
}

double deviatoric_stress(const Vec3& stress, int axis) {
  return stress[axis] - 0.5 * (stress.sum() - stress[axis]);
}

double rate_limit(const Settings& s, double inertial_size, double mean_stress) {
  const double quasi_static = s.inertial_number * std::sqrt(s.target) / inertial_size;
  const double unloaded = s.approach_share * s.target;
  const double raise = mean_stress < unloaded ? unloaded / std::max(mean_stress, 1e-12 * unloaded) : 1.0;
  return std::min(quasi_static * raise, s.max_rate);
}

double undrained_rate_limit(const Settings& s, double inertial_size, double largest_stress,
                            double mean_stress) {
  if (!(largest_stress > 0)) return s.max_rate;
  const double at_largest = s.inertial_number * std::sqrt(largest_stress) / inertial_size;
  const double share = mean_stress / largest_stress;
  const double liquefied = std::sqrt(kUnloadedShare) * kUnloadedShare / std::max(share, 1e-12);
  const double of_largest = share < kUnloadedShare ? std::min(liquefied, 1.0) : std::sqrt(share);
  return std::min(at_largest * of_largest, s.max_rate);
}

double axial_rate_limit(const Settings& s, const State& state, const Measurement& m) {
  return s.path == Path::constant_volume
             ? undrained_rate_limit(s, m.inertial_size, state.largest_stress, mean_stress(m.stress))
             : rate_limit(s, m.inertial_size, s.target);
}

std::int64_t control_interval(const Settings& s, std::int64_t longest, double steps_allowed) {
  if (s.path == Path::isotropic || s.path == Path::constant_volume) return longest;
  std::int64_t interval = longest;
  for (std::int64_t parts = 1; parts <= std::min(longest, kMostFrequent); ++parts) {
    if (longest % parts != 0) continue;
    interval = longest / parts;
    if (static_cast<double>(interval) <= steps_allowed) break;
  }
  return interval;
}

double axial_strain(const State& state, const Vec3& lengths, int axis) {
  if (state.phase == Phase::approaching) return 0;
  return 1 - lengths[axis] / state.reference_lengths[axis];
}

double volumetric_strain(const State& state, const Vec3& lengths) {
  if (state.phase == Phase::approaching) return 0;
  return 1 - lengths.prod() / state.reference_lengths.prod();
}

State control(const Settings& s, const State& before, const Measurement& m) {
  State state = before;
  if (state.phase == Phase::approaching && (s.path == Path::constant_volume || reached(s, m)))
    begin_holding(s, m, state);
  else if (state.phase == Phase::holding && stop_met(s, m, state))
    state.phase = Phase::done;

  const bool shears = s.path != Path::isotropic && state.phase == Phase::holding;
  if (shears) {
    note_peak(s, m, state);
    shear(s, m, state);
  } else if (s.path == Path::isotropic ||
             (s.path == Path::constant_mean && state.phase == Phase::approaching)) {
    drive_isotropic(s, m, state);
  } else if (state.phase == Phase::approaching) {
    drive_to_cell_pressure(s, m, state);
  } else {
    state.rate.setZero();  // sheared to its end: strains stay
  }
  state.last_stress = m.stress;
  return state;
}

bool sample_static(StaticWindow& w, const Settings& settings, const StaticSample& sample, double duration) {
  const bool started = w.start >= 0;
  if (started) {
    w.stress_low = std::min(w.stress_low, sample.mean_stress);
    w.stress_high = std::max(w.stress_high, sample.mean_stress);
    w.coordination_low = std::min(w.coordination_low, sample.coordination);
    w.coordination_high = std::max(w.coordination_high, sample.coordination);
  }
  const auto kept = [&](double low, double high) { return high - low <= settings.tolerance * (high + low); };
  const bool balanced = settings.unbalanced > 0 ? sample.unbalanced <= settings.unbalanced
                                                : kept(w.coordination_low, w.coordination_high);
  const bool constant = started && sample.mean_stress > 0 && sample.coordination > 0 && balanced &&
                        kept(w.stress_low, w.stress_high);
  if (constant) return sample.time - w.start >= duration;
  w = {sample.time, sample.mean_stress, sample.mean_stress, sample.coordination, sample.coordination};
  return false;
}

}  // namespace suffuse::servo
