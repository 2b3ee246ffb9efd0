#include "laws/lubrication.h"

#include <Eigen/Geometry>  // cross products
#include <algorithm>
#include <cmath>
#include <numbers>

namespace suffuse::lubrication {
namespace {

struct Levers {
  double first = 0, second = 0;  // from the centres to mid-gap
};

Levers levers(const Body& first, const Body& second, double gap) {
  return {first.radius + 0.5 * gap, std::isfinite(second.radius) ? second.radius + 0.5 * gap : 0};
}

/// Factor that brings a rate (1/s) down to one per time step.
double bound(double rate, double time_step) {
  return rate * time_step > 1 ? 1 / (rate * time_step) : 1;
}

/// Factor that brings the largest eigenvalue of (resistance × inverse inertia) of the motions (u, w) in one
/// tangential direction down to one per time step.
double tangential_bound(const Resistance& k, const Levers& l, const Body& first, const Body& second,
                        double time_step) {
  const double uu = first.inverse_mass + second.inverse_mass + l.first * l.first * first.inverse_moment +
                    l.second * l.second * second.inverse_moment;
  const double uw = l.second * second.inverse_moment - l.first * first.inverse_moment;
  const double ww = first.inverse_moment + second.inverse_moment;
  const double trace = k.slide * uu + 2 * k.couple * uw + k.roll * ww;
  if (trace * time_step <= 1) return 1;  // no eigenvalue is larger than their sum
  const double determinant = (k.slide * k.roll - k.couple * k.couple) * (uu * ww - uw * uw);
  return bound(0.5 * (trace + std::sqrt(std::max(0.0, trace * trace - 4 * determinant))), time_step);
}

}  // namespace

Resistance film_resistance(const Film& film, double first_radius, double second_radius, double gap) {
  if (gap >= film.outer) return {};
  const double h = std::max(gap, film.inner);
  const double second_share =
      std::isinf(second_radius) ? 0 : first_radius / (first_radius + second_radius);  // R/a₂
  const double first_share = 1 - second_share;                                        // R/a₁
  const double radius = first_radius * first_share;
  const double inverse_gap = 1 / h;
  const double logarithm = std::log(film.outer * inverse_gap);
  const double unit = std::numbers::pi * film.viscosity * radius;
  Resistance k;
  k.squeeze = 6 * unit * radius * (inverse_gap - 1 / film.outer);
  k.slide = 8. / 5 * unit * (2 - 3 * first_share * second_share) * logarithm;
  k.couple = 12. / 5 * unit * radius * (first_share - second_share) * logarithm;
  k.roll = 24. / 5 * unit * radius * radius * logarithm;
  return k;
}

PairLoads film_loads(const Film& film, const Body& first, const Body& second, const Vec3& normal, double gap,
                     double time_step) {
  PairLoads loads;
  if (gap >= film.outer) return loads;
  const Resistance k = film_resistance(film, first.radius, second.radius, gap);
  const Levers l = levers(first, second, gap);
  const Vec3 second_spin = std::isfinite(second.radius) ? second.angular_velocity : Vec3::Zero();

  const Vec3 relative = second.velocity - first.velocity;
  const double approach = relative.dot(normal);
  const Vec3 slip = relative - approach * normal -
                    (l.first * first.angular_velocity + l.second * second_spin).cross(normal);
  const Vec3 rolling = (first.angular_velocity - second_spin).cross(normal);

  const double squeeze_factor = bound(k.squeeze * (first.inverse_mass + second.inverse_mass), time_step);
  const double shear_factor = tangential_bound(k, l, first, second, time_step);
  const double squeeze = squeeze_factor * k.squeeze * approach;
  const Vec3 drag = shear_factor * (k.slide * slip + k.couple * rolling);
  const Vec3 couple = shear_factor * (k.couple * slip + k.roll * rolling);

  loads.force_on_first = squeeze * normal + drag;
  loads.torque_on_first = normal.cross(l.first * drag - couple);
  if (std::isfinite(second.radius)) loads.torque_on_second = normal.cross(l.second * drag + couple);
  loads.power = squeeze * approach + slip.dot(drag) + rolling.dot(couple);
  loads.bounded = squeeze_factor < 1 || shear_factor < 1;
  return loads;
}

}  // namespace suffuse::lubrication
