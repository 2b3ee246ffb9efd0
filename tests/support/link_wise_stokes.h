#pragma once

#include "drag_of_packings.h"

namespace suffuse::coupling {

enum class LinkRule {
  halfway,      ///< bounce-back half-way between centres: cells are solid or fluid
  interpolated  ///< CLI (docs key: ginzburg2008): second order in where a link cuts a sphere
};

/// K of held spheres by another method than the solver's partly covered cells, with code of its own: Stokes
/// flow on a D3Q19 lattice (linear equilibrium, TRT, magic number 3/16) in the cells whose centres are
/// outside all spheres, no slip on the links that leave them:
///
///   f_qbar(x, t+1) = f~_q(x) + (1 - 2 d)/(1 + 2 d) (f~_q(x - c_q) - f~_qbar(x)),
///
/// with d the distance from x to the sphere along c_q over |c_q|; 1/2 with LinkRule::halfway. Where x - c_q
/// is solid too, f_q(x, t) stands for f~_q(x - c_q): the same once steady. The result does not depend on the
/// relaxation time. Boxes and diameters as drag_of has them.
DragResult link_wise_drag(const Packing& packing, double diameter, LinkRule rule, double offset);

}  // namespace suffuse::coupling
