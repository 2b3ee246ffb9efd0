#include "suffuse/micromechanics/shear_response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "suffuse/common/error.h"

namespace suffuse::micromechanics {
namespace {

using Column = std::vector<double>;
/// Numbers that are not defined everywhere.
using PartialColumn = std::vector<std::optional<double>>;

/// Means over `window` of strain about each sample; towards the ends over as much as there is on both sides.
Column moving_mean(const Column& strain, const Column& values, double window) {
  Column means(values.size());
  std::size_t first = 0, end = 0;  // both ends of the window only move on
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double reach = std::min({window / 2, strain[k] - strain.front(), strain.back() - strain[k]});
    while (strain[first] < strain[k] - reach) ++first;
    while (end < values.size() && strain[end] <= strain[k] + reach) ++end;
    double sum = 0;
    for (std::size_t j = first; j < std::max(end, k + 1); ++j) sum += values[j];
    means[k] = sum / static_cast<double>(std::max(end, k + 1) - first);
  }
  return means;
}

std::size_t index_of_most(const Column& values) {
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

/// q/p', where p' is positive.
PartialColumn ratio_of(const Column& deviator, const Column& pressure) {
  PartialColumn ratio(deviator.size());
  for (std::size_t k = 0; k < ratio.size(); ++k)
    if (pressure[k] > 0) ratio[k] = deviator[k] / pressure[k];
  return ratio;
}

/// The first sample of the largest number; none where none is defined.
std::optional<std::size_t> peak_of(const PartialColumn& ratio) {
  const auto peak = std::max_element(ratio.begin(), ratio.end());  // nothing is less than any number
  return *peak ? std::optional(static_cast<std::size_t>(peak - ratio.begin())) : std::nullopt;
}

/// The first sample from which `holds` is true of all samples up to `end`; `end` if of none.
template <class Holds>
std::size_t first_for_good(std::size_t end, const Holds& holds) {
  std::size_t first = end;
  while (first > 0 && holds(first - 1)) --first;
  return first;
}

StressReductionStages stages_of(const Column& strain, const PartialColumn& ratio, const Column& alpha,
                                std::size_t peak, const ShearSettings& settings) {
  const double start = alpha.front();
  const std::size_t left = first_for_good(peak + 1, [&](std::size_t k) {
    return std::abs(alpha[k] - start) > settings.constant * std::abs(start);
  });
  const std::size_t first = std::min(left, peak);
  return {start, alpha[first], alpha[peak], alpha.back(), strain[first], ratio[first]};
}

std::vector<FabricState> fabrics_of(const Column& strain, const Column& fine, const Column& alpha) {
  std::vector<FabricState> states;
  for (std::size_t k = 0; k < strain.size(); ++k) {
    const FabricCase now = fabric_case(fine[k], alpha[k]);
    if (states.empty() || states.back().fabric != now) states.push_back({now, strain[k]});
  }
  return states;
}

std::optional<double> strain_of_constant_volume(const Column& strain, const Column& volumetric,
                                                const ShearSettings& settings) {
  const auto [least, most] = std::minmax_element(volumetric.begin(), volumetric.end());
  const double band = settings.level * (*most - *least);
  const std::size_t first = first_for_good(
      strain.size(), [&](std::size_t k) { return std::abs(volumetric[k] - volumetric.back()) <= band; });
  const double span = strain.back() - strain.front();
  if (strain[first] - strain.front() > settings.at_the_end * span) return std::nullopt;
  return strain[first];
}

void check(const ShearSeries& series, const ShearSettings& settings, const char* who) {
  const std::size_t samples = series.axial_strain.size();
  if (samples < 3)
    throw_user_error({who, "series", fmt::format("{} samples", samples), "have three or more",
                      "give the series of a shear test"});
  for (const Column* column : {&series.mean_stress, &series.deviator, &series.volumetric_strain,
                               &series.void_ratio, &series.coordination, &series.fine_coordination,
                               &series.coarse_coordination, &series.stress_reduction, &series.sliding_share})
    if (column->size() != samples &&
        !(column->empty() && column != &series.mean_stress && column != &series.deviator))
      throw_user_error({who, "series", fmt::format("{} beside {} samples", column->size(), samples),
                        "have columns of one length", ""});
  for (std::size_t k = 1; k < samples; ++k)
    if (!(series.axial_strain[k] > series.axial_strain[k - 1]))
      throw_user_error({who, "axial strain",
                        fmt::format("{:g} after {:g}", series.axial_strain[k], series.axial_strain[k - 1]),
                        "grow from sample to sample", "cyclic paths have no peak; cut the series"});
  if (series.axial_strain.back() - series.axial_strain.front() <= settings.window)
    throw_user_error({who, "axial strain", fmt::format("{:g} at the end", series.axial_strain.back()),
                      fmt::format("go past the window of {:g}", settings.window), "shear on"});
}

}  // namespace

ShearResponse shear_response(const ShearSeries& series, const ShearSettings& settings, const char* who) {
  check(series, settings, who);
  const Column& strain = series.axial_strain;
  const auto mean = [&](const Column& column) { return moving_mean(strain, column, settings.window); };
  const Column deviator = mean(series.deviator), pressure = mean(series.mean_stress);
  const PartialColumn ratio = ratio_of(deviator, pressure);
  const std::optional<std::size_t> peak = peak_of(ratio);

  ShearResponse result;
  if (!series.void_ratio.empty()) result.initial_void_ratio = series.void_ratio.front();
  result.peak_deviator = deviator[index_of_most(deviator)];
  if (peak) {
    result.strain_at_peak = strain[*peak];
    result.peak_ratio = ratio[*peak];
  }
  result.end_ratio = ratio.back();
  result.end_strain = strain.back();
  if (!series.volumetric_strain.empty()) {
    const Column volumetric = mean(series.volumetric_strain);
    result.end_volumetric = volumetric.back();
    result.strain_of_constant_volume = strain_of_constant_volume(strain, volumetric, settings);
  }
  Column coordination, alpha;
  if (!series.coordination.empty()) {
    coordination = mean(series.coordination);
    result.coordination_start = coordination.front();
    result.coordination_least = *std::min_element(coordination.begin(), coordination.end());
    result.coordination_end = coordination.back();
    if (coordination.front() > 0)
      result.coordination_drop = 1 - *result.coordination_least / *result.coordination_start;
  }
  if (!series.coarse_coordination.empty()) {
    const Column coarse = mean(series.coarse_coordination);
    result.coarse_start = coarse.front();
    result.coarse_least = *std::min_element(coarse.begin(), coarse.end());
    result.coarse_end = coarse.back();
  }
  if (!series.stress_reduction.empty()) {
    alpha = mean(series.stress_reduction);
    if (peak) result.stages = stages_of(strain, ratio, alpha, *peak, settings);
    if (!series.fine_coordination.empty())
      result.fabrics = fabrics_of(strain, mean(series.fine_coordination), alpha);
  }
  if (!coordination.empty() && !alpha.empty()) {
    const std::size_t unstable = first_for_good(strain.size(), [&](std::size_t k) {
      return microscale_verdict(coordination[k], alpha[k], BoundaryWording::either) == Verdict::unstable;
    });
    if (unstable < strain.size()) result.strain_unstable = strain[unstable];
  }
  if (!series.sliding_share.empty()) {
    const Column sliding = mean(series.sliding_share);
    const std::size_t most = index_of_most(sliding);
    result.sliding_most = sliding[most];
    result.strain_of_most_sliding = strain[most];
    result.sliding_end = sliding.back();
  }
  return result;
}

}  // namespace suffuse::micromechanics
