#include "suffuse/lbm/fluid.h"

#include <algorithm>
#include <cmath>

#include "fluid_core.h"
#include "lattice_vectors.h"
#include "suffuse/common/error.h"

namespace suffuse::lbm {

namespace {

std::unique_ptr<FluidCoreBase> make_core(const FluidSettings& settings, const Decomposition& decomposition) {
  if (settings.precision == Precision::float_precision)
    return std::make_unique<FluidCore<float>>(settings, decomposition);
  return std::make_unique<FluidCore<double>>(settings, decomposition);
}

CellBox local_cells(const FluidCoreBase& core) {
  return {{0, 0, 0}, core.decomposition.local_box().extents()};
}

/// Equilibrium less the weight (thesis eq 3.25), or He & Luo's; half of the force is taken off the momentum
/// so that the velocity read back is the one asked for.
double equilibrium_deviation(int i, const FluidPoint& point, const Vec3& force, bool incompressible) {
  const Vec3 c = velocity_of(i);
  const double cu = c.dot(point.velocity), density = incompressible ? 1 : point.density;
  return kWeight[i] *
         ((point.density - 1) + density * (3 * cu + 4.5 * cu * cu - 1.5 * point.velocity.squaredNorm()) -
          1.5 * c.dot(force));
}

void add_to(StoredMomentum& stored, const FluidCoreBase::RowMoments& row, int cells, const Vec3& force) {
  for (int a = 0; a < 3; ++a) {
    double sum = 0, magnitude = 0;
    for (std::size_t x = 0; x < static_cast<std::size_t>(cells); ++x) {
      const double value = row.momentum[a][x] - 0.5 * force[a];
      sum += value;
      magnitude += std::abs(value);
    }
    stored.sum[a] += sum;
    stored.magnitude += magnitude;
  }
}

/// All cells of a rank, local numbers; a solid one is at rest.
template <class Visit>
StoredMomentum visit_points(const FluidCoreBase& core, Visit&& visit) {
  const CellBox& box = core.decomposition.local_box();
  StoredMomentum stored;
  FluidCoreBase::RowMoments row;
  for (int z = 0; z < box.extent(2); ++z)
    for (int y = 0; y < box.extent(1); ++y) {
      core.moments_of_row(y, z, row);
      add_to(stored, row, box.extent(0), core.force);
      for (int x = 0; x < box.extent(0); ++x) {
        const auto n = static_cast<std::size_t>(x);
        if (core.is_solid(x, y, z)) {
          visit(x, y, z, true, FluidPoint{}, 1.);
          continue;
        }
        const PartialSolidCell solids = core.partial_solid(x, y, z);
        const Vec3 momentum(row.momentum[0][n], row.momentum[1][n], row.momentum[2][n]);
        visit(x, y, z, false, core.point_of(row.deviation[n], momentum, solids),
              std::min(1., solids.fraction));
      }
    }
  return stored;
}

}  // namespace

Fluid::Fluid(const FluidSettings& settings, const Decomposition& decomposition)
    : core_(make_core(settings, decomposition)) {}
Fluid::~Fluid() = default;
Fluid::Fluid(Fluid&&) noexcept = default;
Fluid& Fluid::operator=(Fluid&&) noexcept = default;

const Decomposition& Fluid::decomposition() const {
  return core_->decomposition;
}
const FluidSettings& Fluid::settings() const {
  return core_->settings;
}
InstructionSet Fluid::instruction_set() const {
  return core_->instruction_set;
}
void Fluid::set_force(const Vec3& force) {
  core_->force = force;
}
const Vec3& Fluid::force() const {
  return core_->force;
}
void Fluid::step() {
  core_->step(nullptr);
}
void Fluid::step(RowVisitor& visitor) {
  if (!core_->partial_solids) throw std::logic_error("Fluid: a visitor without partly covered cells");
  core_->step(&visitor);
}
int Fluid::rows_per_block() const {
  return core_->rows_per_block();
}
void Fluid::bare_update() {
  core_->bare_update();
}
long Fluid::steps() const {
  return core_->steps;
}
bool Fluid::at_odd_step() const {
  return core_->odd;
}
std::size_t Fluid::bytes() const {
  return core_->bytes();
}

void Fluid::set_progress(long steps, bool at_odd_step) {
  core_->steps = steps;
  core_->odd = at_odd_step;
}

void Fluid::set_equilibrium(const std::function<FluidPoint(const Index3& cell)>& state) {
  set_progress(0, false);
  const Index3& lo = core_->decomposition.local_box().lo;
  for_each_cell(local_cells(*core_), [&](int x, int y, int z) {
    if (core_->is_solid(x, y, z)) return;
    const FluidPoint point = state({lo[0] + x, lo[1] + y, lo[2] + z});
    for (int i = 0; i < kDirections; ++i)
      core_->set_population(
          i, x, y, z,
          equilibrium_deviation(i, point, core_->force, core_->settings.collision.incompressible));
  });
}

void Fluid::set_solids(const std::function<std::uint8_t(const Index3& cell)>& label_of) {
  if (core_->odd) throw std::logic_error("Fluid::set_solids after an odd number of steps");
  core_->set_solids(label_of);
  for_each_cell(local_cells(*core_), [&](int x, int y, int z) {
    if (!core_->is_solid(x, y, z)) return;
    for (int i = 0; i < kDirections; ++i) core_->set_population(i, x, y, z, 0);
  });
}

void Fluid::set_walls(const Walls& walls) {
  core_->set_walls(walls);
}

bool Fluid::is_closed(const Index3& cell) const {
  const Index3& lo = core_->decomposition.local_box().lo;
  return core_->is_closed(cell[0] - lo[0], cell[1] - lo[1], cell[2] - lo[2]);
}

bool Fluid::has_closed_cells() const {
  return core_->has_closed();
}

PartialSolidArrays Fluid::use_partial_solids(const PartialSolidSettings& settings) {
  return core_->use_partial_solids(settings);
}

double Fluid::solid_fraction(const Index3& cell) const {
  if (is_solid(cell)) return 1;
  const Index3& lo = core_->decomposition.local_box().lo;
  return std::min(1., core_->partial_solid(cell[0] - lo[0], cell[1] - lo[1], cell[2] - lo[2]).fraction);
}

void Fluid::set_collision(const CollisionSettings& collision) {
  check(collision);
  const CollisionSettings& now = core_->settings.collision;
  if (collision.relaxation_time != now.relaxation_time || collision.incompressible != now.incompressible)
    throw std::logic_error("Fluid::set_collision: another relaxation time or equilibrium");
  core_->settings.collision = collision;
}

void Fluid::set_faces(const FaceConditions& faces) {
  for (std::size_t f = 0; f < kFaces; ++f)
    if (faces[f].kind != core_->settings.faces[f].kind)
      throw_user_error({"fluid boundary " + name_of(static_cast<Face>(f)), "kind", name_of(faces[f].kind),
                        "stay " + name_of(core_->settings.faces[f].kind) + " during a run", ""});
  check(faces, core_->decomposition.cells());
  core_->settings.faces = faces;
}

bool Fluid::is_solid(const Index3& cell) const {
  const Index3& lo = core_->decomposition.local_box().lo;
  return core_->is_solid(cell[0] - lo[0], cell[1] - lo[1], cell[2] - lo[2]);
}

std::uint8_t Fluid::solid_label(const Index3& cell) const {
  const Index3& lo = core_->decomposition.local_box().lo;
  return core_->solid_label(cell[0] - lo[0], cell[1] - lo[1], cell[2] - lo[2]);
}

FluidPoint Fluid::at(const Index3& cell) const {
  const Index3& lo = core_->decomposition.local_box().lo;
  return core_->at(cell[0] - lo[0], cell[1] - lo[1], cell[2] - lo[2]);
}

StoredMomentum Fluid::for_each_point(const PointVisitor& visit) const {
  const Index3& lo = core_->decomposition.local_box().lo;
  return visit_points(*core_, [&](int x, int y, int z, bool, const FluidPoint& point, double solid_fraction) {
    visit({lo[0] + x, lo[1] + y, lo[2] + z}, point, solid_fraction);
  });
}

double Fluid::population(int direction, const Index3& cell) const {
  const Index3& lo = core_->decomposition.local_box().lo;
  return core_->population(direction, cell[0] - lo[0], cell[1] - lo[1], cell[2] - lo[2]);
}

void Fluid::set_population(int direction, const Index3& cell, double value) {
  const Index3& lo = core_->decomposition.local_box().lo;
  core_->set_population(direction, cell[0] - lo[0], cell[1] - lo[1], cell[2] - lo[2], value);
}

Vec3 Fluid::solid_force(std::uint8_t label) const {
  const Vec3 mine = core_->local_solid_force(label);
  Vec3 all = Vec3::Zero();
  MPI_Allreduce(mine.data(), all.data(), 3, MPI_DOUBLE, MPI_SUM, core_->decomposition.communicator());
  return all;
}

double Fluid::mass_deviation() const {
  double mine = 0, all = 0;
  for_each_cell(local_cells(*core_), [&](int x, int y, int z) {
    if (core_->is_solid(x, y, z)) return;
    double cell = 0;
    for (int i = 0; i < kDirections; ++i) cell += core_->population(i, x, y, z);
    mine += cell;
  });
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, core_->decomposition.communicator());
  return all;
}

Vec3 Fluid::momentum() const {
  Vec3 mine = Vec3::Zero(), all = Vec3::Zero();
  for_each_cell(local_cells(*core_), [&](int x, int y, int z) {
    if (core_->is_solid(x, y, z)) return;
    for (int i = 1; i < kDirections; ++i) mine += core_->population(i, x, y, z) * velocity_of(i);
    mine += 0.5 * core_->force;
  });
  MPI_Allreduce(mine.data(), all.data(), 3, MPI_DOUBLE, MPI_SUM, core_->decomposition.communicator());
  return all;
}

FluidExtremes Fluid::extremes() const {
  double speed_squared = 0, high = -1e300, minus_low = -1e300, broken = 0, stored = 0;
  const auto look = [&](int, int, int, bool is_solid, const FluidPoint& point, double) {
    stored += point.density - 1;
    if (is_solid) return;
    if (!std::isfinite(point.density) || !point.velocity.allFinite()) broken = 1;
    speed_squared = std::max(speed_squared, point.velocity.squaredNorm());
    high = std::max(high, point.density);
    minus_low = std::max(minus_low, -point.density);
  };
  StoredMomentum momentum = visit_points(*core_, look);
  const double mine[4] = {speed_squared, high, minus_low, broken};
  double all[4];
  MPI_Allreduce(mine, all, 4, MPI_DOUBLE, MPI_MAX, core_->decomposition.communicator());
  double sums[5] = {stored, momentum.sum[0], momentum.sum[1], momentum.sum[2], momentum.magnitude};
  MPI_Allreduce(MPI_IN_PLACE, sums, 5, MPI_DOUBLE, MPI_SUM, core_->decomposition.communicator());
  momentum = {Vec3(sums[1], sums[2], sums[3]), sums[4]};
  return {std::sqrt(all[0]), -all[2], all[1], all[3] == 0, sums[0], momentum};
}

}  // namespace suffuse::lbm
