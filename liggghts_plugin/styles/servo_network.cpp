#include "servo_network.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "fix_contact_sampler.h"
#include "style_support.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/bulk_stiffness.h"

namespace suffuse {
namespace {

namespace mm = micromechanics;

/// Mean overlap over diameter from which contacts are not contacts any more.
constexpr double kAbsurdOverlap = 0.2;
constexpr const char* kRemedy =
    "go back to the last restart file; a smaller time step (dem_timestep) or max_rate keeps the grains "
    "apart, stiffer grains or a lower target overlap less";

double smaller_diameter(const mm::Packing& packing, const mm::Contact& contact) {
  const double first = packing.grains[static_cast<std::size_t>(contact.first)].radius;
  return 2 * std::min(first, contact.branch.norm() + mm::overlap(packing, contact) - first);
}

}  // namespace

ServoNetwork measure_network(LAMMPS_NS::LAMMPS* lmp, LAMMPS_NS::FixContactSampler& sampler, int group_bit) {
  const auto& packing = sampler.packing(group_bit);
  const double exponent = sampler.force_exponent();
  // grains, contacts, Σ k_n l², Σ |f|, Σ |resultant|, Σ overlap/diameter
  std::array<double, 6> sums{};
  sums[0] = static_cast<double>(packing.grains.size());
  std::vector<double> normal_stiffness;
  std::vector<Vec3> resultant(packing.grains.size(), Vec3::Zero());
  for (const auto& contact : packing.contacts) {
    const auto first = static_cast<std::size_t>(contact.first);
    const double depth = mm::overlap(packing, contact);
    normal_stiffness.push_back(exponent * std::abs(mm::normal_force(contact)) /
                               depth);  // of f ~ depth^exponent
    resultant[first] += contact.force;
    if (mm::owns_second(contact)) resultant[static_cast<std::size_t>(contact.second)] -= contact.force;
    if (!mm::is_counted(packing, contact)) continue;
    sums[1] += 1;
    sums[3] += contact.force.norm();
    sums[5] += depth / smaller_diameter(packing, contact);
  }
  sums[2] = mm::stiffness_length_sum(packing, normal_stiffness);
  for (const Vec3& net_force : resultant) sums[4] += net_force.norm();
  sum_over_ranks(lmp, sums);
  ServoNetwork network;
  network.grains = sums[0];
  network.coordination = 2 * sums[1] / sums[0];
  network.bulk_stiffness = mm::voigt_bulk_modulus(sums[2], packing.volume);
  network.unbalanced = sums[3] > 0 ? (sums[4] / sums[0]) / (sums[3] / sums[1]) : 0;
  network.overlap = sums[1] > 0 ? sums[5] / sums[1] : 0;
  return network;
}

void require_sound_sample(const std::string& who, const ServoSample& sample) {
  if (!sample.stress_is_finite || !std::isfinite(sample.void_ratio))
    throw_lost_run({who, "sample", "without a finite stress", "keep its grains", kRemedy});
  if (sample.void_ratio < 0)
    throw_lost_run({who, "void ratio", fmt::format("{:.3g}", sample.void_ratio),
                    "be >= 0: the sample is lost", kRemedy});
  if (sample.network->grains < sample.grains_at_start)
    throw_lost_run({who, "grains", fmt::format("{:.0f}", sample.network->grains),
                    fmt::format("be {:.0f} as at the start of the run", sample.grains_at_start), kRemedy});
  if (sample.network->overlap > kAbsurdOverlap)
    throw_lost_run({who, "mean overlap of a contact",
                    fmt::format("{:.2g} of a diameter", sample.network->overlap),
                    fmt::format("be below {:g}: the sample is lost", kAbsurdOverlap), kRemedy});
}

}  // namespace suffuse
