#include "suffuse/coupling/coupled_simulation.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "coupled_setup.h"
#include "grain_arithmetic.h"
#include "suffuse/common/error.h"
#include "suffuse/coupling/hydrodynamic_load.h"
#include "suffuse/lbm/health.h"

namespace suffuse::coupling {

namespace {

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
  coefficients_.clear();  // their coefficients are cut otherwise where nothing moves them
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
  if (!method_) return fluid_.set_faces(faces);
  lbm::FaceConditions kinds;  // which are those of the lattice, and may not change
  for (std::size_t f = 0; f < kinds.size(); ++f) kinds[f] = {faces[f].kind};
  fluid_.set_faces(kinds);
  method_->set_faces(faces_si(faces, units_));
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

bool CoupledSimulation::holds(const Vec3& point) const {
  const lbm::Index3& cells = fluid_.decomposition().cells();
  const Eigen::Array3d at = (point - origin_).array() / units_.spacing();
  return (at >= 0).all() && (at <= Eigen::Array3d(cells[0], cells[1], cells[2])).all();
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

MappedScene CoupledSimulation::map() {
  if (method_) {
    grains_.refresh();
    method_->place(grains_.grains());
  } else {
    place_spheres();
    const Stopwatch watch(times_.mapping);
    mapping_.write();
  }
  return MappedScene(*this);
}

MappedScene CoupledSimulation::map_anew() {
  mapping_.forget();
  return map();
}

MappedScene::MappedScene(const CoupledSimulation& simulation)
    : simulation_(simulation), step_(simulation.fluid().steps()) {}

const CoupledSimulation& MappedScene::simulation() const {
  if (simulation_.fluid().steps() != step_)
    throw std::logic_error("a MappedScene was asked for cells after its simulation had gone on");
  return simulation_;
}

void CoupledSimulation::place_spheres() {
  grains_.refresh();
  const GrainArrays grains = grains_.grains();
  const Stopwatch watch(times_.mapping);
  read_spheres(grains);
  remapped_ = mapping_.place(spheres_);
  if (settings_.solids.automatic_coefficient && survey_due(grains)) survey(grains);
}

/// The same answer on all ranks.
bool CoupledSimulation::survey_due(const GrainArrays& grains) {
  const SolidSettings& solids = settings_.solids;
  const bool in_turn = fluid_.steps() % solids.survey_every == 0;
  const double distance = solids.survey_distance * units_.spacing();
  const GrainMemory memory = grains_.memory();
  std::uint64_t sums[3] = {0, static_cast<std::uint64_t>(grains.owned), 0};
  for (int n = 0; n < grains.owned; ++n) sums[2] += std::bit_cast<std::uint64_t>(grains.radius[n]);
  for (int n = 0; n < grains.owned && sums[0] == 0; ++n) {
    const GrainRecord& record = memory.record[n];
    const Vec3 moved = vector_at(grains.position, n) - vector_at(record.surveyed_at, 0);
    if (record.surveyed == 0 || (in_turn && moved.norm() > distance)) sums[0] = 1;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_UINT64_T, MPI_SUM, fluid_.decomposition().communicator());
  const auto count = static_cast<long>(sums[1]);
  // Sums of radii as whole numbers do not depend on the order: another sum, other grains.
  const bool same_grains =
      surveyed_grains_ == kWhoeverIsThere || (count == surveyed_grains_ && sums[2] == surveyed_radii_);
  surveyed_grains_ = count;
  surveyed_radii_ = sums[2];
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

CoupledSimulation::Coefficients CoupledSimulation::coefficients_of(double radius, double mass) const {
  if (!settings_.solids.automatic_coefficient)
    return {radius, mass, settings_.solids.cells.coefficient, kSafeCoefficient};
  const double cells = radius / units_.spacing();
  const double displaced = units_.density() * sphere_volume(radius);
  const double ratio =
      effects_.motion == Switch::off ? std::numeric_limits<double>::infinity() : mass / displaced;
  return {radius, mass, law_.of_sphere(2 * cells), largest_coefficient(cells, ratio)};
}

void CoupledSimulation::read_spheres(const GrainArrays& grains) {
  const double length = 1 / units_.spacing(), speed = units_.velocity_to_lattice(1.),
               turn = units_.time_step();
  spheres_.resize(static_cast<std::size_t>(grains.total));
  coefficients_.resize(spheres_.size());
  const double of_speed = 1 / lbm::viscosity_of(units_.relaxation_time());
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
    Coefficients& known = coefficients_[static_cast<std::size_t>(n)];
    if (known.radius != grains.radius[n] || known.mass != grains.mass[n])
      known = coefficients_of(grains.radius[n], grains.mass[n]);
    sphere.coefficient = known.of_sphere;
    if (settings_.solids.automatic_coefficient)
      sphere.coefficient_share = law_.share_at(of_speed * vector_at(sphere.velocity, 0).lpNorm<1>());
    sphere.largest_coefficient = known.largest;
  }
  spheres_finite_ = finite == 0;
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

namespace {

bool all_finite(const GrainArrays& grains, MPI_Comm communicator) {
  double sum = 0;
  for (std::size_t n = 0; n < 3 * static_cast<std::size_t>(grains.owned); ++n)
    sum += 0 * grains.position[n] + 0 * grains.velocity[n] + 0 * grains.angular_velocity[n];
  int broken = sum == 0 ? 0 : 1;
  MPI_Allreduce(MPI_IN_PLACE, &broken, 1, MPI_INT, MPI_MAX, communicator);
  return broken == 0;
}

}  // namespace

void CoupledSimulation::step_method() {
  grains_.refresh();
  const GrainArrays grains = grains_.grains();
  if (!all_finite(grains, fluid_.decomposition().communicator())) throw_lost_grain("lbm run", time_si());
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
  if (loads_wanted) {
    keep_ledger(hand_loads_over());
    foresee();
  } else {
    ++ledger_.steps_unknown;
  }
  const Stopwatch watch(times_.grains);
  grains_.advance(substeps_);
}

}  // namespace suffuse::coupling
