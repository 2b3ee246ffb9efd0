// What a step of a coupled simulation gives to the grains: the sums over their cells, brought together from
// all ranks, made loads, and written into the port's memory.
#include <mpi.h>

#include <algorithm>

#include "grain_arithmetic.h"
#include "suffuse/coupling/coupled_simulation.h"
#include "suffuse/coupling/hydrodynamic_load.h"
#include "suffuse/lbm/health.h"

namespace suffuse::coupling {

namespace {

/// What the next load refers to; `follows`: the record is of this fluid.
GrainHistory history_of(const GrainRecord& record, bool follows) {
  return {follows && record.known != 0,
          vector_at(record.velocity, 0),
          vector_at(record.angular_velocity, 0),
          {vector_at(record.surface_force, 0), vector_at(record.surface_torque, 0)},
          {vector_at(record.internal_fluid_momentum, 0), vector_at(record.internal_fluid_spin, 0)}};
}

/// A share of what a grain's virtual drag has withheld, as a force over the next fluid step.
void give_back(double* withheld, double* returned, double fluid_step) {
  const Vec3 impulse = kReturnedShare * vector_at(withheld, 0);
  keep(returned, impulse / fluid_step);
  keep(withheld, vector_at(withheld, 0) - impulse);
}

/// Of water that is no more, or of another method.
void forget_foreseen(GrainRecord& record) {
  record.added_mass = record.virtual_drag = record.virtual_spin_drag = 0;
  for (int a = 0; a < 3; ++a) {
    record.withheld_impulse[a] = record.withheld_spin[a] = 0;
    record.returned_force[a] = record.returned_torque[a] = 0;
  }
}

}  // namespace

/// Exchange and internal momentum of each sphere's cells on all ranks, summed at its owner, in SI.
void CoupledSimulation::collect_exchange(const GrainArrays& grains) {
  const double newton = units_.force_to_si(Vec3(1, 0, 0))[0], metre = units_.spacing(),
               second = units_.time_step();
  sums_.assign(static_cast<std::size_t>(grains.total), {});
  for (std::size_t n = 0; n < mapping_.loads().size(); ++n) {
    const LatticeLoad& load = mapping_.loads()[n];
    GrainSums& sums = sums_[n];
    const double arms = share_of_arms(grains.radius[n] / metre);
    for (std::size_t a = 0; a < 3; ++a) {
      sums.force[a] = load.force[a] * newton;
      sums.torque[a] = load.torque[a] * newton * metre * arms;
      sums.internal_fluid_momentum[a] = load.internal_fluid_momentum[a] * newton * second;
      sums.internal_fluid_spin[a] = load.internal_fluid_spin[a] * newton * metre * second * arms;
    }
  }
  grains_.sum_over_copies(sums_);
}

/// Of a grain, in the water's box; one that reaches over several of its faces loses a part at each.
double CoupledSimulation::immersed_share(const Vec3& position, double radius) const {
  const lbm::FaceConditions& faces = fluid_.settings().faces;
  double share = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const double low = position[axis] - origin_[axis],
                 high = fluid_.decomposition().cells()[a] * units_.spacing() - low;
    if (faces[2 * a].kind != lbm::FaceKind::periodic) share *= share_within(radius, low);
    if (faces[2 * a + 1].kind != lbm::FaceKind::periodic) share *= share_within(radius, high);
  }
  return share;
}

void CoupledSimulation::hand_over(const GrainArrays& grains) {
  LoadRule rule;
  rule.fluid_density = units_.density();
  // The memory may hold loads of another fluid: those of no step of this one are not referred to.
  const bool follows = loads_step_ != kNever;
  const long passed = follows ? std::max(1L, fluid_.steps() - loads_step_) : 1;
  rule.time_passed = static_cast<double>(passed) * units_.time_step();
  rule.spacing = units_.spacing();
  if (effects_.buoyancy != Switch::off) rule.buoyant_gravity = settings_.gravity;
  rule.average = settings_.average_force;
  rule.rotation = effects_.rotation != Switch::off;
  const GrainMemory memory = grains_.memory();
  for (int n = 0; n < grains.owned; ++n) {
    const GrainSums& sums = sums_[static_cast<std::size_t>(n)];
    const Load exchange{vector_at(sums.force, 0), vector_at(sums.torque, 0)};
    const InternalFluidMomentum internal{vector_at(sums.internal_fluid_momentum, 0),
                                         vector_at(sums.internal_fluid_spin, 0)};
    const double immersed = immersed_share(vector_at(grains.position, n), grains.radius[n]);
    const GrainState now{grains.radius[n], vector_at(grains.velocity, n),
                         vector_at(grains.angular_velocity, n), immersed};
    GrainRecord& record = memory.record[n];
    if (immersed == 0) {
      std::fill_n(memory.load + 6 * n, 6, 0.);
      forget_foreseen(record);
      record.known = 0;
      continue;
    }
    const GrainHistory before = history_of(record, follows);
    const Load surface = surface_load(exchange, internal, now, before, rule);
    const Load load = hydrodynamic_load(surface, now, before, rule);
    Eigen::Map<Vec3>(memory.load + 6 * n) = load.force;
    Eigen::Map<Vec3>(memory.load + 6 * n + 3) = load.torque;
    if (!before.known) forget_foreseen(record);
    keep(record.velocity, now.velocity);
    keep(record.angular_velocity, now.angular_velocity);
    keep(record.surface_force, surface.force);
    keep(record.surface_torque, surface.torque);
    keep(record.internal_fluid_momentum, internal.momentum);
    keep(record.internal_fluid_spin, internal.spin);
    record.known = 1;
  }
  loads_step_ = fluid_.steps();
}

/// The water's answer in the step that the grains are about to make with these loads, and what is given back
/// in it.
void CoupledSimulation::foresee() {
  const Stopwatch watch(times_.exchange);
  const GrainArrays grains = grains_.grains();
  const GrainMemory memory = grains_.memory();
  const double step = units_.time_step();
  const bool turning = effects_.rotation != Switch::off;
  for (int n = 0; n < grains.owned; ++n) {
    GrainRecord& record = memory.record[n];
    if (record.known == 0) continue;  // dry
    const double radius = grains.radius[n], mass = grains.mass[n];
    const VirtualInertia added = virtual_inertia(virtual_rule_, radius, mass);
    const double moment = micromechanics::sphere_inertia(mass, radius);
    record.virtual_drag = virtual_drag(added.mass, mass, substeps_, step);
    record.virtual_spin_drag = turning ? virtual_drag(added.moment, moment, substeps_, step) : 0;
    give_back(record.withheld_impulse, record.returned_force, step);
    give_back(record.withheld_spin, record.returned_torque, step);
  }
}

/// Before a discrete-element code is given what it would choke on.
void CoupledSimulation::require_finite(const GrainArrays& grains) const {
  double sum = 0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(grains.owned); ++n)
    for (std::size_t a = 0; a < 3; ++a) sum += 0 * sums_[n].force[a] + 0 * sums_[n].torque[a];
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

void CoupledSimulation::refresh_loads() {
  if (method_) return;  // every step hands them over
  if (loads_step_ == fluid_.steps() || !stepped_) return;
  (void)map();  // the sums are in the order of the grains as they are now
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
    const Vec3 impulse = vector_at(sums_[static_cast<std::size_t>(n)].force, 0) / newton;
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
    const double added =
        settings_.virtual_mass ? *settings_.virtual_mass * displaced : method_->virtual_masses()[grain];
    forget_foreseen(record);
    record.added_mass = wet ? added : 0;
    record.known = 1;
  }
  loads_step_ = fluid_.steps();
}

}  // namespace suffuse::coupling
