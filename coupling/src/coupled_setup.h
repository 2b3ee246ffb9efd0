#pragma once

#include <memory>

#include "suffuse/coupling/coupled_simulation.h"

namespace suffuse::coupling {

// What the parts of a coupled simulation are made with.

/// As effects want it: left as it is where one is automatic and nobody has decided.
lbm::CollisionSettings collision_with(const EffectSettings& effects, lbm::CollisionSettings collision);

lbm::FluidSettings fluid_settings(const CoupledSettings& settings, const lbm::Units& units);

WaterFaces faces_si(const lbm::FaceConditions& faces, const lbm::Units& units);

/// Null where the lattice computes the water.
std::unique_ptr<WaterMethod> method_of(const CoupledSettings& settings, const lbm::Units& units,
                                       const lbm::Decomposition& decomposition, const Vec3& origin);

/// The settings with what follows from them about coefficients of single spheres.
CoupledSettings with_coefficients(CoupledSettings settings);

CoefficientLaw law_of(const SolidSettings& solids);

/// DEM steps a fluid step: as asked for, or as many as the grains' time step needs. The two clocks must agree
/// to a part in a million, or forces would act for another time than the fluid's: a UserError otherwise.
int checked_substeps(int asked, const lbm::Units& units, double grain_step);

}  // namespace suffuse::coupling
