#include "suffuse/coupling/coupled_simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "suffuse/common/error.h"
#include "suffuse/coupling/hydrodynamic_load.h"
#include "suffuse/coupling/methods/averaged_flow.h"
#include "suffuse/lbm/health.h"

namespace suffuse::coupling {

namespace {

/// Left as it is where an effect is automatic and nobody has decided.
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

/// DEM steps a fluid step: as asked for, or as many as the grains' time step needs. The two clocks must agree
/// to a part in a million, or forces would act for another time than the fluid's.
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

/// How far the parts of a grain are from its centre, over how far the centres of its cells are, which mapping
/// takes for them. A grain below two cells is nearer to its centre than those: with their arms its spin would
/// give it many times the moment that its own surface could, and the grain would spin up without bound.
double share_of_arms(double radius) {
  return std::min(1., radius);
}

class Stopwatch {
 public:
  explicit Stopwatch(double& total) : total_(total), start_(MPI_Wtime()) {}
  ~Stopwatch() { total_ += MPI_Wtime() - start_; }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& total_;
  double start_;
};

Vec3 vector_at(const double* values, int n) {
  return Vec3(values[3 * n], values[3 * n + 1], values[3 * n + 2]);
}

void keep(double* values, const Vec3& vector) {
  Eigen::Map<Vec3>{values} = vector;
}

/// What the next load refers to; `follows`: the record is of this fluid.
GrainHistory history_of(const GrainRecord& record, bool follows) {
  return {follows && record.known != 0,
          vector_at(record.velocity, 0),
          vector_at(record.angular_velocity, 0),
          {vector_at(record.surface_force, 0), vector_at(record.surface_torque, 0)},
          {vector_at(record.lead, 0), vector_at(record.spin_lead, 0)}};
}

/// Maps the spheres to the rows that the fluid is about to sweep, and adds up what they received after it.
class MapAndSum final : public lbm::RowVisitor {
 public:
  MapAndSum(SolidMapping& mapping, CoupledTimes& times, bool loads_wanted)
      : mapping_(mapping), times_(times), loads_wanted_(loads_wanted) {}

  void before(const lbm::RowBlock& block) override {
    if (!mapping_.is_stale()) return;
    const Stopwatch watch(times_.mapping);
    mapping_.write_rows(block);
  }
  void after(const lbm::RowBlock& block, const lbm::ExchangeArrays& exchange) override {
    const Stopwatch watch(times_.exchange);
    mapping_.sum_rows(block, exchange);
  }
  bool reads_exchange() const override { return loads_wanted_; }

 private:
  SolidMapping& mapping_;
  CoupledTimes& times_;
  bool loads_wanted_;
};

}  // namespace

VirtualMassRule virtual_mass_rule(const CoupledSettings& settings, const lbm::Units& units) {
  return {settings.virtual_mass, units.density(), units.relaxation_time(), units.spacing(),
          with_coefficients(settings).solids.cells};
}

void throw_lost_grain(const std::string& who, double time_si) {
  throw_lost_run({who, fmt::format("motion of a grain at {:.5g} s", time_si), "not a number", "stay finite",
                  "take a smaller DEM step (`dem_timestep`), or see what forces the script adds"});
}

CoupledSimulation::CoupledSimulation(const CoupledSettings& settings, const lbm::Decomposition& decomposition,
                                     const Vec3& origin, ParticlePort& grains)
    : settings_(with_coefficients(settings)),
      effects_(settings.effects),
      units_(settings.units),
      virtual_rule_(virtual_mass_rule(settings_, units_)),
      origin_(origin),
      grains_(grains),
      fluid_(fluid_settings(settings, units_), decomposition),
      cells_(fluid_.use_partial_solids(settings_.solids.cells)),
      mapping_(settings_.solids, fluid_.instruction_set(), cells_, decomposition.local_box(),
               fluid_.rows_per_block()),
      method_(method_of(settings_, units_, decomposition, origin)),
      pores_(fluid_.instruction_set(), cells_, decomposition.local_box()),
      law_(law_of(settings_.solids)),
      substeps_(checked_substeps(settings.substeps, units_, grains.time_step())) {
  set_pressure_gradient(settings.pressure_gradient);
}

void CoupledSimulation::set_effects(const EffectSettings& effects) {
  effects_ = effects;
  if (method_) return;
  lbm::CollisionSettings collision = collision_with(effects, settings_.fluid.collision);
  collision.relaxation_time = units_.relaxation_time();
  fluid_.set_collision(collision);
}

void CoupledSimulation::set_substeps(int substeps) {
  substeps_ = checked_substeps(substeps, units_, grains_.time_step());
}

void CoupledSimulation::set_pressure_gradient(const Vec3& si) {
  settings_.pressure_gradient = si;
  if (method_) return method_->set_pressure_gradient(si);
  fluid_.set_force(units_.force_density_to_lattice(si));
}

void CoupledSimulation::set_faces(const lbm::FaceConditions& faces) {
  if (method_)
    method_->set_faces(faces_si(faces, units_));
  else
    fluid_.set_faces(faces);
}

void CoupledSimulation::set_walls(const lbm::Walls& walls, const std::string& acting) {
  if (method_ && !acting.empty())
    throw_user_error({"lbm method averaged", "walls in the water", acting,
                      "lie on the faces of the water's box: an averaged flow knows no others",
                      "write `lbm walls open ID`, or `lbm method resolved`"});
  fluid_.set_walls(walls);
  mapping_.set_closed(walls.closed);
  acting_walls_ = acting;
}

long CoupledSimulation::grains_behind_walls() const {
  if (!fluid_.has_closed_cells()) return 0;
  constexpr double least_radius = 0.87;  // half the diagonal of a cell
  const lbm::CellBox& box = fluid_.decomposition().local_box();
  long count = 0;
  for (const LatticeSphere& sphere : spheres_) {
    lbm::Index3 cell{};
    bool here = sphere.radius >= least_radius;
    for (std::size_t a = 0; a < 3; ++a) {
      const double at = std::floor(sphere.position[a]);
      here = here && at >= box.lo[a] && at < box.hi[a];
      if (here) cell[a] = static_cast<int>(at);
    }
    if (here && fluid_.is_closed(cell)) ++count;
  }
  MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_LONG, MPI_SUM, fluid_.decomposition().communicator());
  return count;
}

void CoupledSimulation::map() {
  if (method_) return method_->place(grains_.grains());
  place_spheres();
  const Stopwatch watch(times_.mapping);
  mapping_.write();
}

void CoupledSimulation::map_anew() {
  seen_ = {};
  mapping_.forget();
  map();
}

bool SeenGrains::same(const GrainArrays& grains) const {
  if (!has_seen_ || static_cast<std::size_t>(grains.total) != ids_.size()) return false;
  const auto equal = [&](const auto* now, const auto& then, std::size_t each) {
    return std::memcmp(now, then.data(), each * ids_.size() * sizeof(*now)) == 0;
  };
  return equal(grains.position, positions_, 3) && equal(grains.velocity, velocities_, 3) &&
         equal(grains.angular_velocity, spins_, 3) && equal(grains.radius, radii_, 1) &&
         equal(grains.id, ids_, 1);
}

void SeenGrains::keep(const GrainArrays& grains) {
  has_seen_ = true;
  positions_.assign(grains.position, grains.position + 3 * grains.total);
  velocities_.assign(grains.velocity, grains.velocity + 3 * grains.total);
  spins_.assign(grains.angular_velocity, grains.angular_velocity + 3 * grains.total);
  radii_.assign(grains.radius, grains.radius + grains.total);
  ids_.assign(grains.id, grains.id + grains.total);
}

void CoupledSimulation::place_spheres() {
  const GrainArrays grains = grains_.grains();
  const Stopwatch watch(times_.mapping);
  remapped_ = 0;
  if (settings_.solids.remap_distance < 0 || !seen_.same(grains)) {
    read_spheres(grains);
    remapped_ = mapping_.place(spheres_);
  }
  if (settings_.solids.automatic_coefficient && survey_due(grains)) survey(grains);
}

/// The same answer on all ranks.
bool CoupledSimulation::survey_due(const GrainArrays& grains) {
  const SolidSettings& solids = settings_.solids;
  const bool in_turn = fluid_.steps() % solids.survey_every == 0;
  const double distance = solids.survey_distance * units_.spacing();
  const GrainMemory memory = grains_.memory();
  long sums[2] = {0, grains.owned};
  for (int n = 0; n < grains.owned && sums[0] == 0; ++n) {
    const GrainRecord& record = memory.record[n];
    const Vec3 moved = vector_at(grains.position, n) - vector_at(record.surveyed_at, 0);
    if (record.surveyed == 0 || (in_turn && moved.norm() > distance)) sums[0] = 1;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_LONG, MPI_SUM, fluid_.decomposition().communicator());
  const bool same_grains = surveyed_grains_ == kWhoeverIsThere || sums[1] == surveyed_grains_;
  surveyed_grains_ = sums[1];
  return sums[0] > 0 || !same_grains;
}

void CoupledSimulation::set_pore_coefficients(const std::vector<float>& values) {
  pores_.set_values(values);
  mapping_.set_pore_coefficients(pores_.coefficients());
  surveyed_grains_ = kWhoeverIsThere;
}

/// Finds what the pores add to the coefficient in each cell.
void CoupledSimulation::survey(const GrainArrays& grains) {
  pores_.update(spheres_, law_);
  mapping_.set_pore_coefficients(pores_.coefficients());
  const GrainMemory memory = grains_.memory();
  for (int n = 0; n < grains.owned; ++n) {
    GrainRecord& record = memory.record[n];
    record.surveyed = 1;
    keep(record.surveyed_at, vector_at(grains.position, n));
  }
  ++surveys_;
}

void CoupledSimulation::read_spheres(const GrainArrays& grains) {
  seen_.keep(grains);
  const double length = 1 / units_.spacing(), speed = units_.velocity_to_lattice(1.),
               turn = units_.time_step();
  spheres_.resize(static_cast<std::size_t>(grains.total));
  double finite = 0;  // 0 times a number, unless it is none
  for (int n = 0; n < grains.total; ++n) {
    LatticeSphere& sphere = spheres_[static_cast<std::size_t>(n)];
    for (int a = 0; a < 3; ++a) {
      sphere.position[a] = (grains.position[3 * n + a] - origin_[a]) * length;
      sphere.velocity[a] = grains.velocity[3 * n + a] * speed;
      sphere.angular_velocity[a] = grains.angular_velocity[3 * n + a] * turn;
      finite += 0 * (sphere.position[a] + sphere.velocity[a] + sphere.angular_velocity[a]);
    }
    sphere.radius = grains.radius[n] * length;
    for (double& spin : sphere.angular_velocity) spin *= share_of_arms(sphere.radius);
    sphere.id = grains.id[n];
    sphere.coefficient = settings_.solids.automatic_coefficient ? law_.of_sphere(2 * sphere.radius)
                                                                : settings_.solids.cells.coefficient;
  }
  spheres_finite_ = finite == 0;
}

/// Exchange and lead of each sphere's cells on all ranks, summed at its owner, in SI.
void CoupledSimulation::collect_exchange(const GrainArrays& grains) {
  const double newton = units_.force_to_si(Vec3(1, 0, 0))[0], metre = units_.spacing(),
               second = units_.time_step();
  for (std::vector<double>* values : {&force_, &torque_, &lead_, &spin_lead_})
    values->assign(3 * static_cast<std::size_t>(grains.total), 0);
  for (std::size_t n = 0; n < mapping_.loads().size(); ++n) {
    const LatticeLoad& load = mapping_.loads()[n];
    const double arms = share_of_arms(grains.radius[n] / metre);
    for (std::size_t a = 0; a < 3; ++a) {
      force_[3 * n + a] = load.force[a] * newton;
      torque_[3 * n + a] = load.torque[a] * newton * metre * arms;
      lead_[3 * n + a] = load.lead[a] * newton * second;
      spin_lead_[3 * n + a] = load.spin_lead[a] * newton * metre * second * arms;
    }
  }
  grains_.sum_over_copies(force_, torque_);
  grains_.sum_over_copies(lead_, spin_lead_);
}

void CoupledSimulation::hand_over(const GrainArrays& grains) {
  LoadRule rule;
  rule.fluid_density = units_.density();
  // The memory may hold loads of another fluid: those of no step of this one are not referred to.
  const bool follows = loads_step_ != kNever;
  const long passed = follows ? std::max(1L, fluid_.steps() - loads_step_) : 1;
  rule.time_step = static_cast<double>(passed) * units_.time_step();
  rule.spacing = units_.spacing();
  if (effects_.buoyancy != Switch::off) rule.buoyant_gravity = settings_.gravity;
  rule.average = settings_.average_force;
  rule.rotation = effects_.rotation != Switch::off;
  const GrainMemory memory = grains_.memory();
  for (int n = 0; n < grains.owned; ++n) {
    const Load exchange{vector_at(force_.data(), n), vector_at(torque_.data(), n)};
    const Lead lead{vector_at(lead_.data(), n), vector_at(spin_lead_.data(), n)};
    const GrainState now{grains.radius[n], vector_at(grains.velocity, n),
                         vector_at(grains.angular_velocity, n)};
    GrainRecord& record = memory.record[n];
    const GrainHistory before = history_of(record, follows);
    const Load surface = surface_load(exchange, lead, now, before, rule);
    const Load load = hydrodynamic_load(surface, now, before, rule);
    Eigen::Map<Vec3>(memory.load + 6 * n) = load.force;
    Eigen::Map<Vec3>(memory.load + 6 * n + 3) = load.torque;
    if (before.known) {
      const auto follow = [&](double* mean, const Vec3& change) {
        const Vec3 past = vector_at(mean, 0);
        keep(mean, past + kPredictionRate * (change / rule.time_step - past));
      };
      follow(record.acceleration, now.velocity - before.velocity);
      follow(record.angular_acceleration, now.angular_velocity - before.angular_velocity);
    }
    const VirtualInertia added = virtual_inertia(virtual_rule_, now.radius, grains.mass[n]);
    record.virtual_mass = added.mass;
    record.virtual_moment = added.moment;
    keep(record.velocity, now.velocity);
    keep(record.angular_velocity, now.angular_velocity);
    keep(record.surface_force, surface.force);
    keep(record.surface_torque, surface.torque);
    keep(record.lead, lead.momentum);
    keep(record.spin_lead, lead.spin);
    record.known = 1;
  }
  loads_step_ = fluid_.steps();
}

/// Before a discrete-element code is given what it would choke on.
void CoupledSimulation::require_finite(const GrainArrays& grains) const {
  double sum = 0;
  for (std::size_t n = 0; n < 3 * static_cast<std::size_t>(grains.owned); ++n)
    sum += 0 * force_[n] + 0 * torque_[n];
  enum { fine, water, grain };
  int broken = sum == 0 ? fine : water;
  if (!spheres_finite_) broken = grain;
  MPI_Allreduce(MPI_IN_PLACE, &broken, 1, MPI_INT, MPI_MAX, fluid_.decomposition().communicator());
  if (broken == fine) return;
  if (broken == grain) throw_lost_grain("lbm run", time_si());
  lbm::FluidExtremes extremes;
  extremes.finite = false;
  lbm::require_stable(extremes, units_, time_si(), 1, "lbm run");
}

double CoupledSimulation::solid_coefficient(const lbm::Index3& cell) const {
  const lbm::Index3& lo = fluid_.decomposition().local_box().lo;
  const std::ptrdiff_t at =
      cell[0] - lo[0] + cells_.row_pitch * (cell[1] - lo[1]) + cells_.plane_pitch * (cell[2] - lo[2]);
  if (!(cells_.fraction[at] > 0)) return 0;
  const double k = static_cast<double>(cells_.strength[at]) / static_cast<double>(cells_.fraction[at]);
  return settings_.solids.cells.own_coefficients ? k : k * settings_.solids.cells.coefficient;
}

double CoupledSimulation::overlap() const {
  double sum = mapping_.overlap();
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, fluid_.decomposition().communicator());
  return sum;
}

void CoupledSimulation::refresh_loads() {
  if (method_) return;  // every step hands them over
  if (loads_step_ == fluid_.steps() || !stepped_) return;
  {
    const Stopwatch watch(times_.exchange);
    mapping_.sum(units_.relaxation_time());
  }
  hand_loads_over();
}

/// What the last step gave to the grains that this rank owns, summed over all ranks that hold cells of them.
void CoupledSimulation::keep_ledger(int owned) {
  const double newton = units_.force_to_si(Vec3(1, 0, 0))[0];
  for (int n = 0; n < owned; ++n) {
    const Vec3 impulse = vector_at(force_.data(), n) / newton;
    ledger_.grains += impulse;
    ledger_.grains_magnitude += impulse.norm();
  }
}

/// From the sums of `mapping_`; this rank's grains.
int CoupledSimulation::hand_loads_over() {
  const GrainArrays grains = grains_.grains();
  const Stopwatch watch(times_.exchange);
  collect_exchange(grains);
  require_finite(grains);
  hand_over(grains);
  return grains.owned;
}

void CoupledSimulation::step_fluid(bool loads_wanted) {
  const double start = MPI_Wtime(), before = times_.mapping + times_.exchange;
  if (loads_wanted || mapping_.is_stale()) {
    MapAndSum visitor(mapping_, times_, loads_wanted);
    if (loads_wanted) mapping_.begin_loads(units_.relaxation_time());
    fluid_.step(visitor);
    mapping_.finish_writing();
  } else {
    fluid_.step();
  }
  times_.fluid += MPI_Wtime() - start - (times_.mapping + times_.exchange - before);
}

void CoupledSimulation::step_method() {
  const GrainArrays grains = grains_.grains();
  {
    const Stopwatch watch(times_.fluid);
    method_->step(grains);
    fluid_.set_progress(fluid_.steps() + 1, false);
  }
  stepped_ = true;
  {
    const Stopwatch watch(times_.exchange);
    require_stable(extremes(), 1, "lbm run");
    hand_method_loads_over(grains);
  }
  const Stopwatch watch(times_.grains);
  grains_.advance(substeps_);
}

/// Force of the method and the weight of the displaced water; no torque.
void CoupledSimulation::hand_method_loads_over(const GrainArrays& grains) {
  const GrainMemory memory = grains_.memory();
  const Vec3 gravity = effects_.buoyancy == Switch::off ? Vec3(Vec3::Zero()) : settings_.gravity;
  for (int n = 0; n < grains.owned; ++n) {
    const auto grain = static_cast<std::size_t>(n);
    const double displaced = units_.density() * sphere_volume(grains.radius[n]);
    const bool wet = method_->is_wet(grain);
    Eigen::Map<Vec3> force(memory.load + 6 * n), torque(memory.load + 6 * n + 3);
    force = method_->forces()[grain];
    if (wet) force -= displaced * gravity;
    torque.setZero();
    GrainRecord& record = memory.record[n];
    // Added inertia resists: an acceleration on the other side would lag and feed the contacts' vibrations.
    for (int a = 0; a < 3; ++a) record.acceleration[a] = record.angular_acceleration[a] = 0;
    const double added =
        settings_.virtual_mass ? *settings_.virtual_mass * displaced : method_->virtual_masses()[grain];
    record.virtual_mass = wet ? added : 0;
    record.virtual_moment = 0;
    record.known = 1;
  }
  loads_step_ = fluid_.steps();
}

lbm::StoredMomentum CoupledSimulation::for_each_point(const lbm::Fluid::PointVisitor& visit) const {
  if (!method_) return fluid_.for_each_point(visit);
  lbm::for_each_cell(fluid_.decomposition().local_box(), [&](int x, int y, int z) {
    const WaterCell water = method_->at({x, y, z});
    const lbm::FluidPoint point{units_.pressure_to_density_lattice(water.pressure),
                                units_.velocity_to_lattice(water.flux)};
    visit({x, y, z}, point, water.solid_fraction);
  });
  return {};
}

double CoupledSimulation::solid_fraction(const lbm::Index3& cell) const {
  return method_ ? method_->at(cell).solid_fraction : fluid_.solid_fraction(cell);
}

Vec3 CoupledSimulation::solid_flux(const lbm::Index3& cell) const {
  return method_ ? units_.velocity_to_lattice(method_->at(cell).solid_flux) : mapping_.solid_flux(cell);
}

lbm::FluidExtremes CoupledSimulation::extremes() const {
  if (!method_) return fluid_.extremes();
  return {units_.velocity_to_lattice(method_->largest_speed()), 1, 1, method_->is_finite(), 0, {}};
}

void CoupledSimulation::require_stable(const lbm::FluidExtremes& extremes, double largest_mach,
                                       const std::string& who) const {
  if (!method_) return lbm::require_stable(extremes, units_, time_si(), largest_mach, who);
  if (!extremes.finite)
    throw_lost_run({who, fmt::format("flow at {:.5g} s", time_si()), "not a number", "stay finite",
                    fmt::format("use a timestep below {:.3g} s", 0.5 * units_.time_step())});
}

std::string CoupledSimulation::health_text(const lbm::FluidExtremes& extremes) const {
  if (!method_) return lbm::health_text(extremes);
  return fmt::format("water up to {:.3g} m/s", units_.velocity_to_si(extremes.largest_speed));
}

void CoupledSimulation::step(bool loads_asked_for) {
  if (method_) return step_method();
  place_spheres();
  const bool loads_wanted = loads_asked_for || grains_.reads_loads(loads_span() * substeps_);
  if (water_rests())
    rest(loads_wanted);
  else
    step_fluid(loads_wanted);
  stepped_ = true;
  ledger_.force += fluid_.force();
  ledger_.force_magnitude += fluid_.force().norm();
  if (loads_wanted)
    keep_ledger(hand_loads_over());
  else
    ++ledger_.steps_unknown;
  const Stopwatch watch(times_.grains);
  grains_.advance(substeps_);
}

}  // namespace suffuse::coupling
