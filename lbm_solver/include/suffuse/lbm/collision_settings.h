#pragma once

#include <string>
#include <utility>
#include <vector>

#include "suffuse/lbm/collision_operators.h"

namespace suffuse::lbm {

/// Everything that a collision needs to know, in lattice units.
struct CollisionSettings {
  CollisionOperator collision_operator = CollisionOperator::trt;

  /// tau; kinematic viscosity = (tau - 1/2)/3 (thesis eq 3.23). Must be > 0.5.
  double relaxation_time = 0.8;

  /// Of operators with two relaxation times: Lambda = (1/w+ - 1/2)(1/w- - 1/2) > 0. With 3/16 a half-way
  /// bounce-back wall lies exactly half-way in Poiseuille flow and the permeability does not depend on the
  /// viscosity (docs key: ginzburg2008).
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

/// Whether it has two relaxation times, tied by `magic`.
constexpr bool has_magic(CollisionOperator collision_operator) {
  return facts_of(collision_operator).odd_rate == OddRate::magic;
}

/// Refuses settings that cannot work with a UserError that says what to change.
void check(const CollisionSettings& settings);

/// Its word in scripts.
std::string name_of(CollisionOperator collision_operator);

/// Words and what they mean, in the order of the list.
std::vector<std::pair<std::string, CollisionOperator>> collision_words();

/// "trt or trt_comoving": for messages.
std::string words_with_magic();

}  // namespace suffuse::lbm
