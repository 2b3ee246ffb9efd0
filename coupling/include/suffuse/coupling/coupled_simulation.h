#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "suffuse/coupling/automatic_coefficient.h"
#include "suffuse/coupling/methods/water_method.h"
#include "suffuse/coupling/particle_port.h"
#include "suffuse/coupling/settings.h"
#include "suffuse/coupling/solid_mapping.h"
#include "suffuse/coupling/virtual_mass.h"

namespace suffuse::coupling {

/// Where the time of a run went, seconds of this rank.
struct CoupledTimes {
  double mapping = 0, fluid = 0, exchange = 0, grains = 0, output = 0;
};

/// By which a simulation with these settings gives grains inertia of the fluid.
VirtualMassRule virtual_mass_rule(const CoupledSettings& settings, const lbm::Units& units);

/// A LostRun: a grain whose position, velocity or spin is no number.
[[noreturn]] void throw_lost_grain(const std::string& who, double time_si);

/// What the lattice should have gained of momentum since the simulation began, lattice units. Loads that are
/// not formed, since nothing moves the grains, leave it unknown what they took.
struct MomentumLedger {
  Vec3 force = Vec3::Zero();   ///< of the uniform force, each cell, summed over the steps
  double force_magnitude = 0;  ///< the same, of its magnitude
  Vec3 grains = Vec3::Zero();  ///< what this rank's grains took over
  double grains_magnitude = 0;
  long steps_unknown = 0;
};

class CoupledSimulation;

/// A simulation whose cells are covered as its grains lie: what looks at covered cells takes one of these,
/// and CoupledSimulation::map gives it. Good until the simulation's next step.
class MappedScene {
 public:
  /// std::logic_error if it has made a step since.
  const CoupledSimulation& simulation() const;

 private:
  friend class CoupledSimulation;
  explicit MappedScene(const CoupledSimulation& simulation);
  const CoupledSimulation& simulation_;
  long step_;
};

/// A box of fluid with grains in it. Every step maps the grains to cells, advances the fluid by one step,
/// hands what it exerted to the grains and advances these.
///
/// Positions are SI with `origin` at the low corner of the fluid's box.
class CoupledSimulation {
 public:
  /// Collective. The fluid is at rest, no grain is mapped yet. A UserError where settings cannot work
  /// together.
  CoupledSimulation(const CoupledSettings& settings, const lbm::Decomposition& decomposition,
                    const Vec3& origin, ParticlePort& grains);

  /// One fluid step and the DEM steps that belong to it. A UserError if the fluid's forces are no numbers any
  /// more. `loads_asked_for`: somebody will ask for loads after one of the next loads_span() steps, this one
  /// among them. Collective.
  void step(bool loads_asked_for = false);

  /// Fluid steps, the one of the question among them, whose sums a load is made of: it holds the change of
  /// momentum over a step, and with `average_force` is the mean of two loads.
  int loads_span() const { return settings_.average_force ? 3 : 2; }

  /// Maps the grains as they are; `step` does so itself. For output before the first step. Collective.
  MappedScene map();

  /// As `map`, as if no grain had been mapped before: what a simulation does that takes a saved state up.
  MappedScene map_anew();

  /// Brings the loads in the port's memory up to date where `step` left them because nothing moves the
  /// grains. The same values however often this is called if the steps before were told (`loads_asked_for`);
  /// otherwise rates of change are means over the time since the last loads. Collective.
  void refresh_loads();

  /// After a saved state has been read: loads of the next step refer to those that the port's memory has, if
  /// it is of the same step. Without this call, to nothing.
  void continue_loads() { loads_step_ = fluid_.steps(); }

  /// The lattice. With a method of its own for the water it only keeps cells, ranks, faces and steps.
  lbm::Fluid& fluid() { return fluid_; }
  const lbm::Fluid& fluid() const { return fluid_; }
  const lbm::Units& units() const { return units_; }
  const CoupledSettings& settings() const { return settings_; }
  const SolidMapping& mapping() const { return mapping_; }
  /// What computes the water instead of the lattice; null if the lattice does.
  const WaterMethod* method() const { return method_.get(); }
  WaterMethod* method() { return method_.get(); }

  /// The water in the cells of this rank, whoever computes it (lbm::Fluid::for_each_point): of a method's
  /// cells the volume flux of water and grains together. After `map`.
  lbm::StoredMomentum for_each_point(const lbm::Fluid::PointVisitor& visit) const;
  /// Share of a cell of this rank that grains cover, and the part of its velocity that is theirs, cells a
  /// step.
  double solid_fraction(const lbm::Index3& cell) const;
  Vec3 solid_flux(const lbm::Index3& cell) const;
  lbm::FluidExtremes extremes() const;
  /// A UserError where the flow is no number any more, or faster than a lattice can be.
  void require_stable(const lbm::FluidExtremes& extremes, double largest_mach, const std::string& who) const;
  /// For progress lines.
  std::string health_text(const lbm::FluidExtremes& extremes) const;
  const Vec3& origin() const { return origin_; }
  /// Whether a point (m) lies in the water's box: a grain whose centre does not is dry.
  bool holds(const Vec3& point) const;
  /// This rank's spheres as they were last read, copies included, in lattice units.
  const std::vector<LatticeSphere>& spheres() const { return spheres_; }
  ParticlePort& grains() { return grains_; }

  /// DEM steps a fluid step.
  int substeps() const { return substeps_; }
  /// From the next step on; the grains' time step must fill a fluid step then (a UserError otherwise).
  void set_substeps(int substeps);
  double time_si() const { return units_.time_to_si(static_cast<double>(fluid_.steps())); }

  /// Volume by which grains as they were last mapped cover cells more than once, in cells. Collective.
  double overlap() const;

  /// k in a cell of this rank as the last step mapped it, the mean of the spheres there; 0 without.
  double solid_coefficient(const lbm::Index3& cell) const;
  /// Memory that this rank holds for fluid and solids.
  std::size_t bytes() const {
    return fluid_.bytes() + mapping_.bytes() + pores_.bytes() + (method_ ? method_->bytes() : 0);
  }
  /// What the pores add to automatic coefficients in each cell of this rank, x fastest; empty before a survey
  /// and without them. A saved state needs it, for the grains have moved on since.
  std::vector<float> pore_coefficients() const { return pores_.values(); }
  void set_pore_coefficients(const std::vector<float>& values);
  /// How often automatic coefficients were found.
  long surveys() const { return surveys_; }

  /// Steps of the water's rest that were not computed (CoupledSettings::skip_rest).
  long rested_steps() const { return rested_steps_; }

  /// Spheres (copies included) that the last step mapped anew on this rank.
  std::size_t remapped() const { return remapped_; }
  const MomentumLedger& ledger() const { return ledger_; }
  CoupledTimes& times() { return times_; }
  const CoupledTimes& times() const { return times_; }

  /// Walls for the water from the next step on, instead of those before; `acting` describes them, so that a
  /// saved state can tell whether they are the same. Grains get no load from cells behind them. Collective.
  void set_walls(const lbm::Walls& walls, const std::string& acting);
  const std::string& acting_walls() const { return acting_walls_; }

  /// Grains, as they were last read, whose centre lies in a cell behind walls: they have no water. Those
  /// below 1.74 cells per diameter are not looked at: the cell of their centre may lie on the other side of a
  /// wall that they touch. Collective.
  long grains_behind_walls() const;

  /// What effects have come to, from the next step on: operator and eddy viscosity of the collision,
  /// buoyancy, torque. At first those of the settings.
  void set_effects(const EffectSettings& effects);
  const EffectSettings& effects() const { return effects_; }

  /// New values from the next step on, SI.
  void set_faces(const lbm::FaceConditions& faces);
  void set_gravity(const Vec3& si) { settings_.gravity = si; }
  void set_pressure_gradient(const Vec3& si);

 private:
  void place_spheres();
  void step_fluid(bool loads_wanted);
  bool water_rests();
  bool is_at_rest() const;
  bool is_driven() const;
  void rest(bool loads_wanted);
  void step_method();
  void hand_method_loads_over(const GrainArrays& grains);
  int hand_loads_over();
  void read_spheres(const GrainArrays& grains);
  /// What a sphere's cells need of it beside its place: follows from radius (m) and mass (kg).
  struct Coefficients {
    double radius = -1, mass = 0;
    double of_sphere = 1, largest = 1;
  };
  Coefficients coefficients_of(double radius, double mass) const;
  bool survey_due(const GrainArrays& grains);
  void survey(const GrainArrays& grains);
  void collect_exchange(const GrainArrays& grains);
  void hand_over(const GrainArrays& grains);
  double immersed_share(const Vec3& position, double radius) const;
  void foresee();
  void keep_ledger(int owned);
  void require_finite(const GrainArrays& grains) const;

  CoupledSettings settings_;
  EffectSettings effects_;
  lbm::Units units_;
  VirtualMassRule virtual_rule_;
  Vec3 origin_;
  ParticlePort& grains_;
  lbm::Fluid fluid_;
  lbm::PartialSolidArrays cells_;
  SolidMapping mapping_;
  std::unique_ptr<WaterMethod> method_;
  PoreSurvey pores_;
  CoefficientLaw law_;
  int substeps_ = 1;
  std::size_t remapped_ = 0;
  static constexpr long kNever = -1, kWhoeverIsThere = -2;
  long surveys_ = 0;
  long surveyed_grains_ = kNever;  ///< of all ranks, at the last survey
  std::uint64_t surveyed_radii_ = 0;
  long rested_steps_ = 0;
  long rested_at_ = kNever;                 ///< step after which the water is known to be at rest
  bool has_flowed_ = false;                 ///< it is never at rest again, to the last digit
  bool stepped_ = false;                    ///< since this simulation began
  long loads_step_ = kNever;                ///< fluid step of the loads in the port's memory
  std::vector<LatticeSphere> spheres_;      ///< as they are; mapping_ remembers how the cells have them
  std::vector<Coefficients> coefficients_;  ///< of these spheres, where they are still of this size and mass
  bool spheres_finite_ = true;              ///< of this rank: every position, velocity and spin is a number
  std::string acting_walls_;
  std::vector<GrainSums> sums_;  ///< of the last loads that were formed
  MomentumLedger ledger_;
  CoupledTimes times_;
};

}  // namespace suffuse::coupling
