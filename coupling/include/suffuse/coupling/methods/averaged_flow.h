#pragma once

#include <mpi.h>

#include <memory>

#include "suffuse/coupling/methods/averaged_settings.h"
#include "suffuse/coupling/methods/water_method.h"

namespace suffuse::coupling {

/// Box, water and closures of an averaged flow, SI.
struct AveragedFlowSetup {
  lbm::Index3 cells{};
  Vec3 origin = Vec3::Zero();  ///< the box's low corner, m
  double spacing = 0;          ///< m
  double time_step = 0;        ///< s
  double density = 1000;       ///< kg/m^3
  double viscosity = 1e-6;     ///< kinematic, m^2/s
  WaterFaces faces;
  AveragedSettings closures;
  MPI_Comm communicator = MPI_COMM_WORLD;
};

/// Volume-averaged (unresolved) flow on cells larger than the grains, thesis eqs 2.18 to 2.28:
///
///   div(q + J) = 0,   q = e u,   J = sum of V v W / cell
///   rho (e u - q_before)/dt + rho div(q u) = e s - b u + b_v,   s = G - grad p + mu laplace(u)
///   F of a grain = z (u - v) + V s,   b = sum of z W / cell,   b_v = sum of z v W / cell
///
/// e is the porosity, W the shares of a grain (axis_shares.h), z = 3 pi mu d e F its drag coefficient
/// (drag_laws.h), p the pressure in excess of the hydrostatic one and G a driving gradient. Velocities live
/// on the faces between cells. The drag is implicit in u, viscous stress and inertia are explicit, with as
/// many sub-steps as they need. What the grains get the water loses, to round-off.
///
/// Not in it: added mass, lift, torque, turbulence. A UserError where grains leave less than 5 % of a cell to
/// the water, or where velocity faces let in other than they let out.
std::unique_ptr<WaterMethod> averaged_flow(const AveragedFlowSetup& setup);

}  // namespace suffuse::coupling
