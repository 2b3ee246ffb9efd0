#include "suffuse/coupling/automatic_coefficient.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pore_kernels.h"
#include "suffuse/common/error.h"

namespace suffuse::coupling {

namespace {

/// The crowding beyond which the law is not extrapolated: a solid fraction of 3/4, close packing.
constexpr double kLargestCrowding = 3;

/// Share of the ball that is added to the pores: few pores, between spheres that are mostly alone, count less
/// than their narrowness would have it. In dense packings pores fill 0.43 of it, in dilute ones 0.2.
constexpr double kOpenShare = 0.15;

/// A power of the resolution through the errors at 5 and 8 cells, where packings were run
/// (docs/results/data/coefficient_held_out_force.csv); as at 8 for finer ones.
double error_at(double cells, double at_five, double at_eight) {
  const double order = std::log(at_five / at_eight) / std::log(8. / 5);
  return at_five * std::pow(5 / std::clamp(cells, 1., 8.), order);
}

}  // namespace

double CoefficientLaw::operator()(double diameter, double crowding) const {
  const double x = std::min(crowding, kLargestCrowding);
  const double k = constant + (single + crowded * x) / diameter + narrow * x * x / (diameter * diameter);
  return std::min(k, kLargestCoefficient);
}

CoefficientLaw coefficient_law(lbm::SolidOperator solid_operator) {
  switch (solid_operator) {
    case lbm::SolidOperator::force:
      return {2.07, 5.163, 10.21, 90.5};
    case lbm::SolidOperator::sc3:
      return {0.64, 5.3, 6.34, 44.5};
    default:
      throw_user_error({"lbm solid", "coefficient", "auto", "go with operator force or sc3",
                        "give a number, or change the operator"});
  }
}

double expected_permeability_error(double cells_per_sauter_diameter) {
  return error_at(cells_per_sauter_diameter, 0.065, 0.03);
}

double largest_permeability_error(double cells_per_sauter_diameter) {
  return error_at(cells_per_sauter_diameter, 0.185, 0.066);
}

double crowding_of(const PoreSums& sums, double radius) {
  const double ball = 4. / 3 * std::numbers::pi * PoreSurvey::kReach * PoreSurvey::kReach *
                      PoreSurvey::kReach * radius * radius * radius * 2 / 5;
  return radius / 3 * sums.surface / (sums.volume + kOpenShare * ball);
}

PoreSurvey::PoreSurvey(lbm::InstructionSet instruction_set, const lbm::PartialSolidArrays& arrays,
                       const lbm::CellBox& local_box)
    : instruction_set_(instruction_set), arrays_(arrays), box_(local_box) {}

std::vector<PoreSums> PoreSurvey::sums(const std::vector<LatticeSphere>& spheres) {
  PoreCells cells{};
  for (int a = 0; a < 3; ++a) {
    cells.lo[a] = box_.lo[static_cast<std::size_t>(a)];
    cells.cells[a] = box_.extent(a);
  }
  cells.row_pitch = arrays_.row_pitch;
  cells.plane_pitch = arrays_.plane_pitch;
  cells.fraction = arrays_.fraction;
  constexpr std::ptrdiff_t spare = 7;
  cells.near_row = cells.cells[0] + spare;
  cells.near_plane = cells.near_row * cells.cells[1];
  const auto count = static_cast<std::size_t>(cells.near_plane * cells.cells[2]);
  nearness_.assign(count, 0);
  surface_.assign(count, 0);
  cells.nearness = nearness_.data();
  cells.surface = surface_.data();

  auto add = portable::add_nearness;
  auto sum = portable::sum_pores;
#ifdef SUFFUSE_HAVE_X86_KERNELS
  if (instruction_set_ == lbm::InstructionSet::avx2) {
    add = avx2::add_nearness;
    sum = avx2::sum_pores;
  } else if (instruction_set_ == lbm::InstructionSet::avx512) {
    add = avx512::add_nearness;
    sum = avx512::sum_pores;
  }
#endif
  for (const LatticeSphere& s : spheres) add(s.position, s.radius, kNear, kFar, cells);
  std::vector<PoreSums> result(spheres.size());
  for (std::size_t n = 0; n < spheres.size(); ++n)
    sum(spheres[n].position, spheres[n].radius, kReach, cells, &result[n].volume, &result[n].surface);
  return result;
}

}  // namespace suffuse::coupling
