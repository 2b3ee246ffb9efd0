#include "averaged/grain_drag.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace suffuse::coupling::averaged {

double own_share(double phi) {
  const double e = 1 - std::clamp(phi, 0., 0.7), p = std::clamp(phi, 0., 0.7);
  return e * e * e * e / (1 + 4 * p + 4 * p * p - 4 * p * p * p + p * p * p * p);
}

namespace {

/// A grain that pushes the water feels its own push in the mean velocity of the cells around it, as if spread
/// over a sphere of this radius, in cells: z has to make up for it. In creeping flow u_self = F/(6 pi mu a).
/// The radius is that for which a sphere in a periodic box has Hasimoto's drag (docs key: hasimoto1959), the
/// decrease with the Reynolds number of the cell that for which lone spheres settle at the standard velocity.
/// Other grains screen the push, as Brinkman's medium does that of a sphere of this radius.
constexpr double kOwnPushRadius = 0.886, kOwnPushDecay = 0.33;

}  // namespace

double drag_of_mean_velocity(double drag, double share, double mu, double spacing, double cell_reynolds,
                             double resistance) {
  const double radius = kOwnPushRadius * spacing, screens = radius * std::sqrt(resistance / mu);
  const double push = share * drag /
                      (6 * std::numbers::pi * mu * radius * (1 + kOwnPushDecay * cell_reynolds) *
                       (1 + screens + screens * screens / 9));
  constexpr double most = 0.5;
  return drag / (1 - std::min(push, most));
}

double inertia_for_step(const PlacedGrain& grain, double e, const AveragedFlowSetup& setup) {
  constexpr double leave = 1.4;
  const double drag = grain.drag / (e * e) * setup.time_step;
  const double water = setup.density * grain.volume * (1 - e) / e;
  return std::max(0., (drag + 2 * water) / leave - grain.mass);
}

}  // namespace suffuse::coupling::averaged
