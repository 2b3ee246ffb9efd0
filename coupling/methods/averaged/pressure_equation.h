#pragma once

#include <array>
#include <vector>

#include "averaged/pressure_solver.h"
#include "averaged/staggered_grid.h"
#include "suffuse/coupling/methods/water_method.h"

namespace suffuse::coupling::averaged {

/// One value a face, for the three axes.
using FaceValues = std::array<std::vector<double>, 3>;

/// div(q* + J - K grad p) = 0 on the cells, for a conductance K (m^2 s/kg... q per pressure gradient) on each
/// face; K is 0 where a face's flux is given. Without a pressure face the pressure has the mean zero.
class PressureEquation {
 public:
  PressureEquation(const StaggeredGrid& grid, double spacing, const WaterFaces& faces);

  /// Solves for `pressure` (one a cell; its values are the start).
  void solve(const FaceValues& flux, const FaceValues& solid_flux, const FaceValues& conductance,
             const WaterFaces& faces, std::vector<double>& pressure);

  /// Pressure gradient across a face, Pa/m; meaningless on faces of given flux.
  double gradient(std::size_t axis, const Index3& at, const WaterFaces& faces,
                  const std::vector<double>& pressure) const;

 private:
  struct Entries {
    double *low_low, *high_high, *low_high, *high_low;
  };
  double* entry(std::size_t row, std::size_t column);

  const StaggeredGrid& grid_;
  double spacing_;
  bool floating_ = true;  ///< no face gives a pressure
  Eigen::SparseMatrix<double> matrix_;
  std::array<std::vector<Entries>, 3> entries_;
  Eigen::VectorXd right_side_, solution_;
  PressureSolver solver_;
};

/// The face of the box that a face lies on; side: StaggeredGrid::side, not 0.
inline const WaterFace& box_face(const WaterFaces& faces, std::size_t axis, int side) {
  return faces[2 * axis + (side > 0 ? 1 : 0)];
}

}  // namespace suffuse::coupling::averaged
