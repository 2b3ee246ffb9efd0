#include "coupled_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "suffuse/common/error.h"
#include "suffuse/coupling/methods/averaged_flow.h"

namespace suffuse::coupling {

lbm::CollisionSettings collision_with(const EffectSettings& effects, lbm::CollisionSettings collision) {
  using enum lbm::CollisionOperator;
  if (effects.turbulence != Switch::automatic)
    collision.smagorinsky = effects.turbulence == Switch::on ? effects.smagorinsky : 0;
  if (effects.comoving == Switch::on && collision.collision_operator == trt)
    collision.collision_operator = trt_comoving;
  return collision;
}

lbm::FluidSettings fluid_settings(const CoupledSettings& settings, const lbm::Units& units) {
  lbm::FluidSettings fluid = settings.fluid;
  fluid.collision = collision_with(settings.effects, fluid.collision);
  fluid.collision.relaxation_time = units.relaxation_time();
  if (!settings.averaged) return fluid;
  fluid.collision = {};  // nothing collides: the lattice keeps cells, ranks, kinds of faces and steps
  fluid.collision.relaxation_time = 1;
  for (lbm::FaceCondition& face : fluid.faces) face = {face.kind};
  return fluid;
}

WaterFaces faces_si(const lbm::FaceConditions& faces, const lbm::Units& units) {
  WaterFaces si;
  for (std::size_t f = 0; f < lbm::kFaces; ++f)
    si[f] = {faces[f].kind, units.velocity_to_si(faces[f].velocity),
             units.density_lattice_to_pressure(faces[f].density)};
  return si;
}

std::unique_ptr<WaterMethod> method_of(const CoupledSettings& settings, const lbm::Units& units,
                                       const lbm::Decomposition& decomposition, const Vec3& origin) {
  if (!settings.averaged) return nullptr;
  AveragedFlowSetup setup;
  setup.cells = decomposition.cells();
  setup.origin = origin;
  setup.spacing = units.spacing();
  setup.time_step = units.time_step();
  setup.density = units.density();
  setup.viscosity = units.viscosity_si();
  setup.faces = faces_si(settings.fluid.faces, units);
  setup.closures = *settings.averaged;
  setup.communicator = decomposition.communicator();
  return averaged_flow(setup);
}

CoupledSettings with_coefficients(CoupledSettings settings) {
  SolidSettings& solids = settings.solids;
  solids.automatic_coefficient &= !settings.averaged;
  solids.automatic_coefficient &= solids.cells.weighting == lbm::SolidWeighting::viscosity_independent;
  solids.cells.own_coefficients |= solids.automatic_coefficient;
  return settings;
}

CoefficientLaw law_of(const SolidSettings& solids) {
  if (!solids.automatic_coefficient) return {};
  return solids.law ? *solids.law : coefficient_law(solids.cells.solid_operator);
}

int checked_substeps(int asked, const lbm::Units& units, double grain_step) {
  const double ratio = units.time_step() / grain_step;
  const int substeps = asked > 0 ? asked : std::max(1, static_cast<int>(std::lround(ratio)));
  if (std::abs(ratio / substeps - 1) > 1e-6)
    throw_user_error(
        {"lbm couple", "substeps", fmt::format("{} of {:.8g} s", substeps, grain_step),
         fmt::format("fill one fluid step of {:.8g} s", units.time_step()),
         fmt::format("timestep {:.10g}", units.time_step() / std::max(1., std::ceil(ratio - 1e-9)))});
  return substeps;
}

VirtualMassRule virtual_mass_rule(const CoupledSettings& settings, const lbm::Units& units) {
  return {settings.virtual_mass, units.density(), units.relaxation_time(), units.spacing(),
          with_coefficients(settings).solids.cells};
}

}  // namespace suffuse::coupling
