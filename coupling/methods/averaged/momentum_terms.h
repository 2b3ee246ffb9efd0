#pragma once

#include "averaged/pressure_equation.h"
#include "averaged/staggered_grid.h"
#include "suffuse/coupling/methods/water_method.h"

namespace suffuse::coupling::averaged {

/// What carries momentum between the faces of a staggered grid. Values of one step; `n` is the number of the
/// face `at` across `axis`.
struct MomentumTerms {
  const StaggeredGrid& grid;
  const WaterFaces& faces;
  double spacing, mu;                 ///< m; dynamic viscosity, Pa s
  const FaceValues &velocity, &flux;  ///< u and q = e u, m/s

  /// mu laplace(u), N/m^3.
  double viscous(std::size_t axis, const Index3& at, std::size_t n) const;
  /// div(q u) around a face, upwind, m/s^2.
  double inertia(std::size_t axis, const Index3& at, std::size_t n) const;

 private:
  /// Velocity along `axis` one cell further along `along`; walls and the box's other sides where they are.
  double beyond(std::size_t axis, const Index3& at, std::size_t along, int direction, double here) const;
};

}  // namespace suffuse::coupling::averaged
