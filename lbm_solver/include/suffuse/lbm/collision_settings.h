#pragma once

#include <string>

namespace suffuse::lbm {

enum class CollisionOperator {
  bgk,  ///< one relaxation time (thesis eqs 3.20-3.22)
  trt,  ///< two relaxation times: even parts at the viscosity's rate, odd parts tied to it by `magic`
  /// TRT about the local velocity: moments in the frame of the fluid relax, not those of the lattice. The
  /// same as TRT in creeping flow. Where grains carry their fluid along at a speed V beyond V/nu = 2 (lattice
  /// units), TRT's flow between them falls behind them and the drag rises; here by less than half as much
  /// (docs/decisions/solid-operator.md). A third more time for the fluid.
  trt_comoving,
  central_moments,  ///< relaxes moments about the local velocity; for relaxation times near 0.5
};

/// Everything that a collision needs to know, in lattice units.
struct CollisionSettings {
  CollisionOperator collision_operator = CollisionOperator::trt;

  /// tau; kinematic viscosity = (tau - 1/2)/3 (thesis eq 3.23). Must be > 0.5.
  double relaxation_time = 0.8;

  /// TRT and TRT comoving only: Lambda = (1/w+ - 1/2)(1/w- - 1/2) > 0. With 3/16 a half-way bounce-back wall
  /// lies exactly half-way in Poiseuille flow and the permeability does not depend on the viscosity (docs
  /// key: ginzburg2008).
  double magic = 3. / 16;

  /// Smagorinsky constant C; the eddy viscosity is C^2 |S| in lattice units (docs key: hou1996). 0: none.
  double smagorinsky = 0.;

  /// He & Luo's incompressible equilibrium: the density's deviation acts as pressure only (docs key:
  /// heluo1997).
  bool incompressible = false;
};

constexpr double viscosity_of(double relaxation_time) {
  return (relaxation_time - 0.5) / 3;
}
constexpr double relaxation_time_of(double viscosity) {
  return 3 * viscosity + 0.5;
}

/// Whether it has two relaxation times, tied by `magic`.
constexpr bool has_magic(CollisionOperator collision_operator) {
  return collision_operator == CollisionOperator::trt ||
         collision_operator == CollisionOperator::trt_comoving;
}

/// Refuses settings that cannot work with a UserError that says what to change.
void check(const CollisionSettings& settings);

/// "bgk", "trt", "trt_comoving" or "central_moments".
std::string name_of(CollisionOperator collision_operator);

}  // namespace suffuse::lbm
