#include "contacts/contact_measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "suffuse/common/error.h"
#include "suffuse/micromechanics/constraint_ratio.h"
#include "suffuse/micromechanics/coordination.h"
#include "suffuse/micromechanics/fabric.h"
#include "suffuse/micromechanics/load_shares.h"
#include "suffuse/micromechanics/rattlers.h"
#include "suffuse/micromechanics/slipping.h"
#include "suffuse/micromechanics/stress.h"
#include "suffuse/micromechanics/stress_reduction.h"
#include "suffuse/micromechanics/strong_contacts.h"

namespace suffuse::analysis {
namespace {

using namespace micromechanics;

/// Text of six digits moves f_T and f_N by up to 5e-6 of themselves each.
constexpr double kToleranceOfText = 1e-5;
constexpr double kNarrowestGap = 1.3;
/// Diameters that differ by less, relative, are one size.
constexpr double kSameSize = 1e-9;

std::vector<double> sorted_diameters(const Packing& packing) {
  std::vector<double> diameters;
  for (const Grain& grain : packing.grains) diameters.push_back(2 * grain.radius);
  std::sort(diameters.begin(), diameters.end());
  return diameters;
}

void add(Record& record, std::initializer_list<Entry> entries) {
  for (const Entry& entry : entries) record.push_back(entry);
}

std::optional<double> only_if(bool defined, double value) {
  return defined ? std::optional<double>(value) : std::nullopt;
}

void add_counts(Record& record, const Packing& packing, const CoordinationSums& sums, bool split) {
  double solids = 0;
  for (const Grain& grain : packing.grains) solids += sphere_volume(grain.radius);
  add(record, {{"grains", sums.grains},
               {"contacts", sums.contacts},
               {"volume_m3", packing.volume},
               {"porosity", 1 - solids / packing.volume},
               {"void_ratio", packing.volume / solids - 1},
               {"fines", only_if(split, sums.fines)},
               {"contacts_coarse_coarse", only_if(split, sums.coarse_coarse)},
               {"contacts_fine_coarse", only_if(split, sums.fine_coarse)},
               {"contacts_fine_fine", only_if(split, sums.fine_fine)}});
}

void add_coordination(Record& record, const Coordination& z, bool split) {
  add(record, {{"coordination_number", z.mean},
               {"coordination_mechanical", z.mechanical},
               {"coordination_geometric", z.geometric},
               {"coordination_volume_weighted", z.volume_weighted},
               {"coordination_coarse_coarse", only_if(split, z.coarse_coarse)},
               {"coordination_fine_coarse", only_if(split, z.fine_coarse)},
               {"coordination_fine_fine", only_if(split, z.fine_fine)},
               {"coordination_fines_mean", only_if(split, z.fines_mean)},
               {"stable_share", z.stable_share},
               {"unconnected_fines_share", only_if(split, z.unconnected_fines_share)}});
}

void add_stress(Record& record, const Packing& packing, int axis) {
  const Mat3 stress = stress_times_volume(packing).matrix() / packing.volume;
  add(record, {{"mean_stress_pa", mean_stress(stress)},
               {"axial_deviatoric_stress_pa", axial_deviatoric_stress(stress, axis)},
               {"stress_xx_pa", stress(0, 0)},
               {"stress_yy_pa", stress(1, 1)},
               {"stress_zz_pa", stress(2, 2)},
               {"stress_xy_pa", stress(0, 1)},
               {"stress_xz_pa", stress(0, 2)},
               {"stress_yz_pa", stress(1, 2)}});
}

void add_reduction(Record& record, const Packing& packing, const std::optional<double>& split) {
  StressReduction point, halves;
  LoadShares shares;
  if (split) {
    point =
        stress_reduction(stress_reduction_sums(packing, {*split}, GrainArm::contact_point), packing.volume);
    halves =
        stress_reduction(stress_reduction_sums(packing, {*split}, GrainArm::pair_halves), packing.volume);
    shares = load_shares(load_share_sums(packing, {*split}));
  }
  const bool fines = split && point.fines_solid_share > 0 && point.mean_stress != 0;
  add(record, {{"alpha_contact_point", only_if(fines, point.shire)},
               {"alpha_pair_halves", only_if(fines, halves.shire)},
               {"alpha_sufian_contact_point", only_if(fines, point.sufian)},
               {"alpha_sufian_pair_halves", only_if(fines, halves.sufian)},
               {"beta_contact_point", fines ? point.beta : std::nullopt},
               {"beta_pair_halves", fines ? halves.beta : std::nullopt},
               {"fines_solid_share", only_if(split.has_value(), point.fines_solid_share)},
               {"load_share_coarse_coarse", only_if(fines, shares.coarse_coarse)},
               {"load_share_fine_coarse", only_if(fines, shares.fine_coarse)},
               {"load_share_fine_fine", only_if(fines, shares.fine_fine)}});
}

void add_sliding(Record& record, const Packing& packing, const Coordination& z, double tolerance) {
  const Sliding s = sliding(sliding_sums(packing, {tolerance, true, false}));
  const ConstraintRatio r = constraint_ratio(z, s.share);
  add(record, {{"sliding_share", s.share},
               {"mean_slipping_index", s.mean_slipping_index},
               {"mean_mobilised_friction", s.mean_mobilised_friction},
               {"constraint_ratio", r.mean},
               {"constraint_ratio_geometric", r.geometric},
               {"constraint_ratio_mechanical", r.mechanical}});
}

void add_fabric(Record& record, const Packing& packing) {
  const FabricSums sums = fabric_sums(packing);
  const Mat3 fabric = fabric_tensor(sums);
  const RoseFit xy = fit_rose(sums.planes[0]), xz = fit_rose(sums.planes[1]), yz = fit_rose(sums.planes[2]);
  add(record, {{"fabric_deviator", deviatoric_fabric(fabric)},
               {"fabric_xx", fabric(0, 0)},
               {"fabric_yy", fabric(1, 1)},
               {"fabric_zz", fabric(2, 2)},
               {"fabric_xy", fabric(0, 1)},
               {"fabric_xz", fabric(0, 2)},
               {"fabric_yz", fabric(1, 2)},
               {"rose_xy_anisotropy", xy.anisotropy},
               {"rose_xy_direction_rad", xy.direction},
               {"rose_xz_anisotropy", xz.anisotropy},
               {"rose_xz_direction_rad", xz.direction},
               {"rose_yz_anisotropy", yz.anisotropy},
               {"rose_yz_direction_rad", yz.direction}});
}

/// A region's grains may hang on rattlers outside of it: all are looked at.
std::vector<bool> bearing_grains(const Snapshot& snapshot, int minimum) {
  if (!snapshot.whole) return load_bearing(snapshot.packing, minimum);
  const std::vector<bool> all = load_bearing(snapshot.whole->packing, minimum);
  std::vector<bool> bearing;
  for (std::size_t g = 0; g < all.size(); ++g)
    if (snapshot.whole->is_in_part[g]) bearing.push_back(all[g]);
  return bearing;
}

}  // namespace

double sliding_tolerance(const MeasureSettings& settings, const Snapshot& snapshot) {
  return settings.sliding_tolerance.value_or(snapshot.six_digits ? kToleranceOfText
                                                                 : SlidingRule().tolerance);
}

double ContactMeasurer::strong_threshold(double mean_force) {
  if (settings_.strong == StrongThreshold::force) return settings_.strong_force;
  if (settings_.strong == StrongThreshold::mean) return mean_force;
  if (!frozen_ && mean_force > 0) frozen_ = mean_force;
  return frozen_.value_or(0);
}

Record ContactMeasurer::measure(const Snapshot& snapshot) {
  const Packing& packing = snapshot.packing;
  const bool split = settings_.split.has_value();
  const CoordinationSums counts = coordination_sums(packing, {settings_.split.value_or(0)});
  const Coordination z = coordination(counts, packing.volume);
  Record record;
  add(record, {{"step", static_cast<double>(snapshot.step)}, {"time_s", snapshot.time}});
  add_counts(record, packing, counts, split);
  add_coordination(record, z, split);
  const Rattlers loose =
      rattlers(packing, bearing_grains(snapshot, settings_.rattler_contacts), {settings_.split.value_or(0)});
  add(record, {{"rattler_share", loose.share},
               {"rattler_fines_share", only_if(split, loose.fines_share)},
               {"rattler_solid_share", loose.solid_share}});
  add_stress(record, packing, settings_.axis);
  add_reduction(record, packing, settings_.split);
  add_sliding(record, packing, z, sliding_tolerance(settings_, snapshot));
  add_fabric(record, packing);
  forces_ = force_distribution(packing, settings_.force_bins);
  const double threshold = strong_threshold(forces_.mean_normal);
  const StrongContacts strong = strong_contacts(strong_sums(packing, threshold), settings_.axis);
  add(record, {{"strong_share", strong.share},
               {"strong_threshold_n", threshold},
               {"strong_mean_stress_share", strong.mean_stress_share},
               {"strong_deviator_share", strong.deviator_share},
               {"mean_normal_force_n", forces_.mean_normal},
               {"mean_tangential_force_n", forces_.mean_tangential},
               {"tensile_share", forces_.tensile_share},
               {"normal_force_variation", forces_.coefficient_of_variation},
               {"force_tail_exponent", forces_.tail_exponent}});
  return record;
}

std::string warning_of_split(double split, const Snapshot& snapshot, const std::string& who,
                             const std::string& what) {
  const std::vector<double> diameters =
      sorted_diameters(snapshot.whole ? snapshot.whole->packing : snapshot.packing);
  if (diameters.empty()) return {};
  const std::string sizes =
      fmt::format("the grains have {:.4g} to {:.4g} m", diameters.front(), diameters.back());
  if (split > diameters.back())
    throw_user_error({who, what, fmt::format("{:g} m", split),
                      fmt::format("be at most the largest grain, {:.4g} m", diameters.back()),
                      "all grains would be fines: " + sizes});
  if (split > diameters.front()) return {};
  return fmt::format("warning: no grain is smaller than {} = {:g} m ({}): no fines, no alpha", what, split,
                     sizes);
}

double split_in_the_gap(const Packing& packing, const std::string& who) {
  const std::vector<double> diameters = sorted_diameters(packing);
  double widest = 1, split = 0;
  for (std::size_t i = 1; i < diameters.size(); ++i) {
    const double ratio = diameters[i] / diameters[i - 1];
    if (ratio <= widest) continue;
    widest = ratio;
    split = std::sqrt(diameters[i] * diameters[i - 1]);
  }
  if (widest < kNarrowestGap)
    throw_user_error({who, "--split", "gap", fmt::format("find sizes {} times apart or more", kNarrowestGap),
                      fmt::format("here they are {:.3g} times apart at most: give a diameter in m", widest)});
  return split;
}

double split_at_finer(const Packing& packing, double finer, const std::string& who) {
  const std::vector<double> diameters = sorted_diameters(packing);
  double solid = 0;
  for (const double d : diameters) solid += micromechanics::sphere_volume(d / 2);
  double below = 0, nearest = 1, split = 0;
  for (std::size_t i = 1; i < diameters.size(); ++i) {
    below += micromechanics::sphere_volume(diameters[i - 1] / 2);
    const double miss = std::abs(below / solid - finer);
    if (!(diameters[i] > diameters[i - 1] * (1 + kSameSize)) || miss >= nearest) continue;
    nearest = miss;
    split = std::sqrt(diameters[i] * diameters[i - 1]);
  }
  if (split == 0)
    throw_user_error(
        {who, "--split", fmt::format("{:g}%", 100 * finer), "find two sizes of grains", "here is one"});
  return split;
}

}  // namespace suffuse::analysis
