#pragma once

#include <optional>
#include <string>

#include "suffuse/common/linear_algebra.h"
#include "suffuse/coupling/automatic_coefficient.h"
#include "suffuse/coupling/mapped_sphere.h"
#include "suffuse/coupling/methods/averaged_settings.h"
#include "suffuse/lbm/fluid.h"
#include "suffuse/lbm/units.h"

namespace suffuse::coupling {

struct SolidSettings {
  lbm::PartialSolidSettings cells;
  /// Calibrated, from each grain's diameter and the pores around it; with the viscosity-independent weighting
  /// only. Found anew when grains come, and at steps that are multiples of `survey_every` if a grain has
  /// moved by `survey_distance` (cells) since: the coefficients stay where they are while grains move on.
  /// Grains of a dense packing that are a cell further feel 0.5 % less drag, two and a half cells 3 %.
  bool automatic_coefficient = true;
  std::optional<CoefficientLaw> law;  ///< else coefficient_law of the operator
  int survey_every = 10;
  double survey_distance = 0.4;
  FractionMethod fraction = FractionMethod::exact;
  int subcells = 5;              ///< per edge, for FractionMethod::subcells
  double remap_distance = 1e-3;  ///< cells: a grain that moved less is not mapped again
  double remap_velocity = 1e-7;  ///< cells a step: nor one whose velocity changed by less

  /// Do the expected errors hold? They were measured with the defaults of these three.
  bool errors_are_known() const {
    return automatic_coefficient && cells.solid_operator == lbm::SolidOperator::force &&
           cells.weighting == lbm::SolidWeighting::viscosity_independent;
  }
};

enum class Switch { off, on, automatic };

/// Effects that a scene may call for; what `automatic` decides is in effects.h. Where nobody decides, as in a
/// CoupledSimulation by itself, automatic ones that need no velocity (buoyancy, rotation) act and the others
/// are left as the collision's settings have them.
struct EffectSettings {
  Switch motion = Switch::on;              ///< off: nothing moves the grains (largest_coefficient)
  Switch turbulence = Switch::automatic;   ///< Smagorinsky's eddy viscosity
  Switch comoving = Switch::automatic;     ///< `trt_comoving` in place of `trt`
  Switch lubrication = Switch::automatic;  ///< forces in gaps that the lattice does not resolve
  Switch buoyancy = Switch::on;            ///< displaced fluid's weight on grains under `gravity`
  Switch rotation = Switch::on;            ///< torque of the fluid on grains
  double smagorinsky = 0.1;                ///< constant of the eddy viscosity where turbulence is on
};

struct CoupledSettings {
  lbm::UnitsRequest units;
  /// Averaged flow on cells larger than the grains; without, the lattice resolves the flow between them.
  std::optional<AveragedSettings> averaged;
  lbm::FluidSettings fluid;  ///< its relaxation time is set from the units, its operator may follow effects
  SolidSettings solids;
  EffectSettings effects;
  /// Steps of water that is at rest to the last digit, and that nothing moves, are not computed: they would
  /// change nothing.
  bool skip_rest = false;
  int substeps = 0;                       ///< DEM steps a fluid step; 0: from the DEM time step, as it is
  bool average_force = false;             ///< loads are the mean of the last two fluid steps'
  std::optional<double> virtual_mass;     ///< VirtualMassRule::coefficient
  Vec3 gravity = Vec3::Zero();            ///< m/s^2; pressures are those in excess of the hydrostatic one
  Vec3 pressure_gradient = Vec3::Zero();  ///< Pa/m along the flow
};

}  // namespace suffuse::coupling
