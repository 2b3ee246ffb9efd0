#pragma once

namespace suffuse::lbm {

/// How a cell that solids cover in part treats the fluid in it. SC1 to SC3 replace a share B of the collision
/// by a solid operator: f' = f + (1-B) Omega_fluid + B Omega_solid (thesis eq 3.33; docs key:
/// nobletorczynski1998). With e the equilibrium, o the opposite direction, u the fluid's and us the solid's
/// velocity:
enum class SolidOperator {
  sc1,    ///< f_o - f_i + e_i(us) - e_o(u): bounce-back of the non-equilibrium part (docs key:
          ///< nobletorczynski1998)
  sc2,    ///< e_i(us) - f_i + (1-rate)(f_i - e_i(u)): relaxation towards the solid's equilibrium
  sc3,    ///< f_o - f_i + e_i(us) - e_o(us): bounce-back in the solid's frame (docs key: owen2011)
  force,  ///< full collision with a Guo force F = F_ext - 2B (j + F_ext/2 - rho us): a drag inside the cell
};

/// B as a function of the solid fraction eps, with t = tau - 1/2.
enum class SolidWeighting {
  fraction,               ///< B = eps
  noble_torczynski,       ///< B = eps t / ((1 - eps) + t) (thesis eq 3.34)
  viscosity_independent,  ///< B = k eps t / ((1 - eps) + r + k eps t): drag/viscosity depends on eps alone
};

/// r of the viscosity-independent weighting: what a whole cell keeps open. With r = 0 the velocity in a whole
/// cell becomes the solid's at half step, and its momentum overshoots by as much as it was away: inside a
/// grain it would swing to and fro for ever, and with it the force on a grain that is accelerated.
inline constexpr double kLeastOpenShare = 0.05;

}  // namespace suffuse::lbm
