#include "suffuse/coupling/automatic_coefficient.h"

#include <algorithm>
#include <cmath>

#include "pore_kernels.h"
#include "suffuse/common/error.h"

namespace suffuse::coupling {

namespace {

/// A power of the resolution through the errors at 5 and 8 cells, where packings were run
/// (docs/results/data/coefficient_held_out_force.csv); as at 8 for finer ones.
double error_at(double cells, double at_five, double at_eight) {
  const double order = std::log(at_five / at_eight) / std::log(8. / 5);
  return at_five * std::pow(5 / std::clamp(cells, 1., 8.), order);
}

}  // namespace

double CoefficientLaw::operator()(double diameter, double surface_per_pore) const {
  return std::min(of_sphere(diameter) + of_pore(surface_per_pore), kLargestCoefficient);
}

CoefficientLaw coefficient_law(lbm::SolidOperator solid_operator) {
  switch (solid_operator) {
    case lbm::SolidOperator::force:
      return {1.76, 2.2, 13.3, 54.5};
    case lbm::SolidOperator::sc3:
      return {0.64, 2.25, 7.6, 30.1};
    default:
      throw_user_error({"lbm solid", "coefficient", "auto", "go with operator force or sc3",
                        "give a number, or change the operator"});
  }
}

double expected_permeability_error(double cells_per_sauter_diameter) {
  return error_at(cells_per_sauter_diameter, 0.015, 0.009);
}

double largest_permeability_error(double cells_per_sauter_diameter) {
  return error_at(cells_per_sauter_diameter, 0.049, 0.022);
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
  auto add = portable::add_smoothed;
  auto narrow = portable::narrow_plane;
#ifdef SUFFUSE_HAVE_X86_KERNELS
  if (instruction_set_ == lbm::InstructionSet::avx2) {
    add = avx2::add_smoothed;
    narrow = avx2::narrow_plane;
  } else if (instruction_set_ == lbm::InstructionSet::avx512) {
    add = avx512::add_smoothed;
    narrow = avx512::narrow_plane;
  }
#endif
  surface_.assign(values_held(), 0);
  solid_.assign(values_held(), 0);
  PoreCells cells{};
  for (int a = 0; a < 3; ++a) {
    cells.lo[a] = box_.lo[static_cast<std::size_t>(a)];
    cells.cells[a] = box_.extent(a);
  }
  cells.row_pitch = row_pitch_;
  cells.plane_pitch = plane_pitch_;
  cells.surface = surface_.data();
  cells.solid = solid_.data();
  for (const LatticeSphere& s : spheres) add(s.position, s.radius, cells);
  const PoreTerms terms{static_cast<float>(law.crowded / 6), static_cast<float>(law.narrow / 36),
                        static_cast<float>(kOpenShare)};
  for (int z = 0; z < cells.cells[2]; ++z) narrow(cells, terms, z);
}

}  // namespace suffuse::coupling
