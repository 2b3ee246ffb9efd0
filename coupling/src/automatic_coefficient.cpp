#include "suffuse/coupling/automatic_coefficient.h"

#include <algorithm>
#include <cmath>

#include "measured_errors.h"
#include "pore_kernels.h"
#include "suffuse/common/error.h"
#include "suffuse/simd/dispatch.h"

namespace suffuse::coupling {

namespace {

/// What packings showed: cells at a solid fraction of 0.55, root mean square, largest. The first row is a
/// guess from the fines of gap-graded ones.
constexpr MeasuredError kMeasured[] = {{1.5, 0.27, 0.54},  {2, 0.135, 0.27},   {2.5, 0.067, 0.22},
                                       {3, 0.0415, 0.134}, {3.5, 0.025, 0.05}, {4, 0.02, 0.05},
                                       {5, 0.0175, 0.052}, {8, 0.009, 0.033}};

double cells_of_usual_packing(double cells, double solid_fraction) {
  constexpr double densest = 0.8, loosest = 0.45, loose = 0.52, share_of_loosest = 0.88;
  constexpr double open = 0.3, bed = 0.4;
  const double porosity = 1 - std::clamp(solid_fraction, kUsualSolidFraction, densest);
  const double looseness = std::clamp((loose - solid_fraction) / (loose - loosest), 0., 1.) *
                           std::clamp((solid_fraction - open) / (bed - open), 0., 1.);
  return cells * std::sqrt(porosity / (1 - kUsualSolidFraction)) * (1 - (1 - share_of_loosest) * looseness);
}

/// Else every window is that of the spheres' radius. Ranks may differ in this and find the same.
bool sizes_differ(const std::vector<LatticeSphere>& spheres) {
  return std::any_of(spheres.begin(), spheres.end(),
                     [&](const LatticeSphere& s) { return s.radius != spheres.front().radius; });
}

}  // namespace

double CoefficientLaw::of_sphere(double diameter) const {
  constexpr double of_a_point = 10;
  const double below_a_cell = diameter < 1 ? std::pow(diameter, -1.5) - 1 : 0;
  return constant + single / diameter + of_a_point * below_a_cell;
}

CoefficientLaw coefficient_law(lbm::SolidOperator solid_operator) {
  const lbm::CoefficientTerms& terms = lbm::facts_of(solid_operator).coefficient;
  if (terms.given()) return {terms};
  std::string words;
  for (const lbm::SolidFacts& facts : lbm::kSolidOperators)
    if (facts.coefficient.given()) words += (words.empty() ? "" : " or ") + std::string(facts.word);
  throw_user_error({"lbm solid", "coefficient", "auto", "go with operator " + words,
                    "give a number, or change the operator"});
}

double expected_permeability_error(double cells_per_sauter_diameter, double solid_fraction) {
  return error_at(kMeasured, cells_of_usual_packing(cells_per_sauter_diameter, solid_fraction),
                  &MeasuredError::rms);
}

double largest_permeability_error(double cells_per_sauter_diameter, double solid_fraction) {
  return error_at(kMeasured, cells_of_usual_packing(cells_per_sauter_diameter, solid_fraction),
                  &MeasuredError::largest);
}

PoreSurvey::PoreSurvey(lbm::InstructionSet instruction_set, const lbm::PartialSolidArrays& arrays,
                       const lbm::CellBox& local_box)
    : instruction_set_(instruction_set),
      row_pitch_(arrays.row_pitch),
      plane_pitch_(arrays.plane_pitch),
      box_(local_box) {}

std::size_t PoreSurvey::values_held() const {
  constexpr std::ptrdiff_t spare = 8;  // packs go beyond the last cell
  return static_cast<std::size_t>(plane_pitch_ * box_.extent(2) + spare);
}

std::size_t PoreSurvey::place(int x, int y, int z) const {
  return static_cast<std::size_t>(x + row_pitch_ * y + plane_pitch_ * z);
}

std::vector<float> PoreSurvey::values() const {
  std::vector<float> values;
  if (surface_.empty()) return values;
  values.reserve(box_.volume());
  lbm::for_each_cell({{0, 0, 0}, box_.extents()},
                     [&](int x, int y, int z) { values.push_back(surface_[place(x, y, z)]); });
  return values;
}

void PoreSurvey::set_values(const std::vector<float>& values) {
  surface_.assign(values_held(), 0);
  std::size_t n = 0;
  lbm::for_each_cell({{0, 0, 0}, box_.extents()},
                     [&](int x, int y, int z) { surface_[place(x, y, z)] = values.at(n++); });
}

void PoreSurvey::update(const std::vector<LatticeSphere>& spheres, const CoefficientLaw& law) {
  const auto add_radius = SUFFUSE_CHOOSE(instruction_set_, decltype(&portable::add_radius), add_radius);
  const auto range = SUFFUSE_CHOOSE(instruction_set_, decltype(&portable::range_plane), range_plane);
  const auto add = SUFFUSE_CHOOSE(instruction_set_, decltype(&portable::add_smoothed), add_smoothed);
  const auto narrow = SUFFUSE_CHOOSE(instruction_set_, decltype(&portable::narrow_plane), narrow_plane);
  PoreCells cells{};
  for (int a = 0; a < 3; ++a) {
    cells.lo[a] = box_.lo[static_cast<std::size_t>(a)];
    cells.cells[a] = box_.extent(a);
  }
  cells.row_pitch = row_pitch_;
  cells.plane_pitch = plane_pitch_;
  const auto sum = [&](auto of_sphere) {
    surface_.assign(values_held(), 0);
    solid_.assign(values_held(), 0);
    cells.surface = surface_.data();
    cells.solid = solid_.data();
    for (const LatticeSphere& s : spheres) of_sphere(s.position, s.radius, cells);
  };
  if (law.reach > 0 && sizes_differ(spheres)) {
    sum(add_radius);
    range_.assign(values_held(), 1);  // between the rows, too, where packs end
    cells.range = range_.data();
    for (int z = 0; z < cells.cells[2]; ++z) range(cells, static_cast<float>(law.reach), kShortestRange, z);
  }
  sum(add);
  const PoreTerms terms{static_cast<float>(law.crowded / 6), static_cast<float>(law.narrow / 36),
                        static_cast<float>(law.tight / 1296), static_cast<float>(kOpenShare)};
  for (int z = 0; z < cells.cells[2]; ++z) narrow(cells, terms, z);
}

}  // namespace suffuse::coupling
