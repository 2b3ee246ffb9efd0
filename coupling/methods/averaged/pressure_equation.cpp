#include "averaged/pressure_equation.h"

namespace suffuse::coupling::averaged {

namespace {
bool is_open(const WaterFace& face) {
  return face.kind == lbm::FaceKind::pressure;
}
}  // namespace

PressureEquation::PressureEquation(const StaggeredGrid& grid, double spacing, const WaterFaces& faces)
    : grid_(grid), spacing_(spacing) {
  for (const WaterFace& face : faces) floating_ &= !is_open(face);
  const auto cells = static_cast<Eigen::Index>(grid.cell_count());
  std::vector<Eigen::Triplet<double>> pattern;
  const auto index = [&](const Index3& at) { return static_cast<int>(grid.cell(at)); };
  for (int n = 0; n < cells; ++n) pattern.emplace_back(n, n, 1.);
  for (std::size_t axis = 0; axis < 3; ++axis)
    grid.for_each_face(axis, [&](const Index3& at, std::size_t) {
      const auto [low, high] = grid.cells_beside(axis, at);
      pattern.emplace_back(index(low), index(high), 1.);
      pattern.emplace_back(index(high), index(low), 1.);
    });
  matrix_.resize(cells, cells);
  matrix_.setFromTriplets(pattern.begin(), pattern.end());
  matrix_.makeCompressed();
  for (std::size_t axis = 0; axis < 3; ++axis)
    grid.for_each_face(axis, [&](const Index3& at, std::size_t) {
      const auto [low, high] = grid.cells_beside(axis, at);
      const std::size_t l = grid.cell(low), h = grid.cell(high);
      entries_[axis].push_back({entry(l, l), entry(h, h), entry(l, h), entry(h, l)});
    });
  right_side_.resize(cells);
  solution_.setZero(cells);
}

double* PressureEquation::entry(std::size_t row, std::size_t column) {
  return &matrix_.coeffRef(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
}

double PressureEquation::gradient(std::size_t axis, const Index3& at, const WaterFaces& faces,
                                  const std::vector<double>& pressure) const {
  const auto [low, high] = grid_.cells_beside(axis, at);
  const int side = grid_.side(axis, at);
  if (side == 0) return (pressure[grid_.cell(high)] - pressure[grid_.cell(low)]) / spacing_;
  return side * (box_face(faces, axis, side).pressure - pressure[grid_.cell(low)]) / (0.5 * spacing_);
}

void PressureEquation::solve(const FaceValues& flux, const FaceValues& solid_flux,
                             const FaceValues& conductance, const WaterFaces& faces,
                             std::vector<double>& pressure) {
  Eigen::Map<Eigen::VectorXd>(matrix_.valuePtr(), matrix_.nonZeros()).setZero();
  right_side_.setZero();
  for (std::size_t axis = 0; axis < 3; ++axis)
    grid_.for_each_face(axis, [&](const Index3& at, std::size_t n) {
      const auto [low, high] = grid_.cells_beside(axis, at);
      const auto l = static_cast<Eigen::Index>(grid_.cell(low)),
                 h = static_cast<Eigen::Index>(grid_.cell(high));
      const int side = grid_.side(axis, at);
      const double through = (flux[axis][n] + solid_flux[axis][n]) / spacing_;
      const double k = conductance[axis][n] / (spacing_ * spacing_);
      if (side <= 0) right_side_[h] += through;
      if (side >= 0) right_side_[l] -= through;
      const Entries& to = entries_[axis][n];
      if (side == 0 && l != h) {
        *to.low_low += k;
        *to.high_high += k;
        *to.low_high -= k;
        *to.high_low -= k;
      } else if (side != 0 && k > 0) {
        *to.low_low += 2 * k;
        right_side_[l] += 2 * k * box_face(faces, axis, side).pressure;
      }
    });
  solution_ = Eigen::Map<const Eigen::VectorXd>(pressure.data(), static_cast<Eigen::Index>(pressure.size()));
  if (floating_) {
    right_side_.array() -= right_side_.mean();  // round-off, and grains that came or went
    *entry(0, 0) += matrix_.coeff(0, 0) > 0 ? matrix_.coeff(0, 0) : 1;
  }
  solver_.solve(matrix_, right_side_, solution_);
  if (floating_) solution_.array() -= solution_.mean();
  Eigen::Map<Eigen::VectorXd>(pressure.data(), static_cast<Eigen::Index>(pressure.size())) = solution_;
}

}  // namespace suffuse::coupling::averaged
