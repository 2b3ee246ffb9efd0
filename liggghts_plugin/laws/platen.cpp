#include "laws/platen.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "suffuse/micromechanics/hertz_contact.h"

namespace suffuse::platen {

double effective_modulus(double youngs_first, double poisson_first, double youngs_second,
                         double poisson_second) {
  return 1 / ((1 - poisson_first * poisson_first) / youngs_first +
              (1 - poisson_second * poisson_second) / youngs_second);
}

double damping_factor(double restitution) {
  const double log = std::log(restitution);
  return 2 * std::sqrt(5. / 6) * std::abs(log) / std::sqrt(log * log + std::numbers::pi * std::numbers::pi);
}

Reaction reaction(const Material& material, double radius, double mass, double overlap, double approach) {
  const micromechanics::HertzPair pair{material.effective_modulus, radius};
  const double stiffness = micromechanics::hertz_stiffness_at(pair, overlap);
  const double force =
      micromechanics::hertz_force(pair, overlap) + material.damping * std::sqrt(stiffness * mass) * approach;
  return {std::max(0., force), stiffness};
}

void advance(Motion& motion, const Drive& drive, const Reaction& all, double outward, double step) {
  const double damping = 2 * drive.damping_ratio * std::sqrt(all.stiffness * drive.mass);
  const double pushed = motion.velocity + step / drive.mass * (all.force - drive.load);
  motion.velocity =
      std::clamp(pushed / (1 + step * damping / drive.mass), -drive.most_speed, drive.most_speed);
  motion.position += outward * motion.velocity * step;
}

double stiffness_of_step(const Drive& drive, const Reaction& all, double step) {
  return all.stiffness * step * step / drive.mass;
}

std::size_t SizeTally::class_of(double diameter) const {
  return static_cast<std::size_t>(std::upper_bound(bounds_.begin(), bounds_.end(), diameter) -
                                  bounds_.begin());
}

SizeTally::Row SizeTally::total() const {
  Row all;
  for (const Row& row : rows_) {
    all.grains += row.grains;
    all.mass += row.mass;
  }
  return all;
}

}  // namespace suffuse::platen
