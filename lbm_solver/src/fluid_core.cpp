#include "fluid_core.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "lattice_vectors.h"

namespace suffuse::lbm {

namespace {

/// Cells ahead that arrays of partly covered cells are fetched: two cache lines of floats.
constexpr std::ptrdiff_t kSolidsAhead = 128;

}  // namespace

FluidCoreBase::FluidCoreBase(const FluidSettings& s, const Decomposition& d)
    : settings(s), decomposition(d), instruction_set(s.instruction_set.value_or(default_instruction_set())) {
  check(settings.collision);
  check(settings.faces, decomposition.cells());
}

FluidPoint FluidCoreBase::at(int x, int y, int z) const {
  if (is_solid(x, y, z)) return {};
  double deviation = population(0, x, y, z);
  Vec3 momentum = 0.5 * force;
  for (int i = 1; i < kDirections; ++i) {
    const double g = population(i, x, y, z);
    deviation += g;
    momentum += g * velocity_of(i);
  }
  return point_of(deviation, momentum, partial_solid(x, y, z));
}

FluidPoint FluidCoreBase::point_of(double deviation, const Vec3& momentum,
                                   const PartialSolidCell& solids) const {
  const double density = settings.collision.incompressible ? 1 : 1 + deviation;
  // A grain may cover so little of a cell that its strength is rounded to nothing.
  if (!(solids.strength > 0)) return {1 + deviation, momentum / density};
  // What the cell's fluid and solids move at together.
  const double weight = mean_share(*partial_solids, solids, settings.collision.relaxation_time);
  return {1 + deviation, (1 - weight) * momentum / density + weight * solids.momentum / solids.strength};
}

template <class T>
FluidCore<T>::FluidCore(const FluidSettings& s, const Decomposition& d)
    : FluidCoreBase(s, d), populations_(d.local_box().extents()), halo_(d, s.faces), patches_(d, s.faces) {}

/// See solid_weight, whose formulas these are.
template <class T>
WeightingTerms<T> weighting_terms(const PartialSolidSettings& settings, double relaxation_time) {
  const T t = static_cast<T>(relaxation_time - 0.5);
  switch (settings.weighting) {
    case SolidWeighting::fraction:
      return {1, 0, 0, 1};
    case SolidWeighting::noble_torczynski:
      return {t, 1, 0, t};
    case SolidWeighting::viscosity_independent:
      break;
  }
  const T strength = t * static_cast<T>(settings.own_coefficients ? 1 : settings.coefficient);
  return {strength, 1, strength, static_cast<T>(kLeastOpenShare)};
}

template <class T>
KernelCall<T> FluidCore<T>::kernel_call() {
  const CollisionSettings& c = settings.collision;
  const double half = c.relaxation_time - 0.5;
  const bool single = facts_of(c.collision_operator).odd_rate == OddRate::one;
  KernelCall<T> call{};
  // AA pattern. Even step: each direction from the cell's own slot. Odd step: from the neighbour it comes
  // from, where the even step left it in the slot of the opposite direction.
  for (int i = 0; i < kDirections; ++i)
    call.place[i] = odd ? populations_.slot(opposite(i)) - populations_.offset_of(i) : populations_.slot(i);
  call.row_pitch = populations_.row_pitch();
  call.plane_pitch = populations_.plane_pitch();
  call.cells_x = populations_.cells()[0];
  call.end_y = populations_.cells()[1];
  call.end_z = populations_.cells()[2];
  call.relaxation_time = static_cast<T>(c.relaxation_time);
  call.even_rate = static_cast<T>(1 / c.relaxation_time);
  call.odd_rate = static_cast<T>(single ? 1 / c.relaxation_time : half / (0.5 * half + c.magic));
  call.magic = static_cast<T>(c.magic);
  call.single_rate = single;
  call.eddy_coefficient = static_cast<T>(18 * std::sqrt(2.) * c.smagorinsky * c.smagorinsky);
  call.compressibility = c.incompressible ? T(0) : T(1);
  for (int a = 0; a < 3; ++a) call.force[a] = static_cast<T>(force[a]);
  call.solid = labels_ ? labels_->data() : nullptr;
  if (store_) {
    store_->give_to(call);
    call.solids_ahead = kSolidsAhead;
    call.exchange_ahead = true;
    call.solid_operator = partial_solids->solid_operator;
    call.weighting = weighting_terms<T>(*partial_solids, c.relaxation_time);
  }
  return call;
}

template <class T>
void FluidCore<T>::sweep(Kernel<T> kernel, RowVisitor* visitor) {
  const int planes = populations_.cells()[2];
  if (!halo_.can_start_early(odd)) {
    sweep_planes(kernel, visitor, 0, planes);
    return;
  }
  sweep_planes(kernel, visitor, 0, 1);
  sweep_planes(kernel, visitor, std::max(1, planes - 1), planes);
  halo_.start_early(populations_, odd);
  sweep_planes(kernel, visitor, 1, planes - 1);
}

/// A few rows at a time, at most 0.4 MB: what the kernel wrote is still in the second-level cache. As many in
/// all blocks of a plane, as near as that goes.
template <class T>
int FluidCore<T>::rows_per_block() const {
  constexpr std::ptrdiff_t bytes = 400000;
  const int most = static_cast<int>(std::max<std::ptrdiff_t>(
      1, bytes / (populations_.row_pitch() * kDirections * std::ptrdiff_t{sizeof(T)})));
  const int rows = populations_.cells()[1], blocks = (rows + most - 1) / most;
  return (rows + blocks - 1) / blocks;
}

template <class T>
void FluidCore<T>::sweep_planes(Kernel<T> kernel, RowVisitor* visitor, int begin_z, int end_z) {
  KernelCall<T> call = kernel_call();
  call.begin_z = begin_z;
  call.end_z = end_z;
  if (visitor == nullptr && !patches_.has_near_rows() && !halo_.has_near_rows()) {
    kernel(call);
    clear_exchange_of_closed(call);
    return;
  }
  const int rows = rows_per_block();
  const Index3& cells = populations_.cells();
  if (visitor != nullptr) {  // writes the arrays of the next block next, and reads the exchange
    call.solids_ahead = call.row_pitch * rows;
    call.exchange_ahead = !visitor->reads_exchange();
  }
  for (int z = begin_z; z < end_z; ++z)
    for (int y = 0; y < cells[1]; y += rows) {
      call.begin_z = z;
      call.end_z = z + 1;
      call.begin_y = y;
      call.end_y = std::min(y + rows, cells[1]);
      sweep_rows(call, kernel, visitor);
    }
}

template <class T>
void FluidCore<T>::sweep_rows(KernelCall<T>& call, Kernel<T> kernel, RowVisitor* visitor) {
  const RowBlock block{call.begin_z, call.begin_y, call.end_y};
  if (visitor != nullptr) {
    visitor->before(block);
    if (visitor->reads_exchange()) store_->give_rows_to(call, block, rows_per_block());
  }
  kernel(call);
  clear_exchange_of_closed(call);
  if (visitor != nullptr && visitor->reads_exchange())
    visitor->after(block, PartialSolidStore<T>::exchange_of(call));
  halo_.apply_near_rows(populations_, odd, block.begin_y, block.end_y, block.z);
  patches_.apply_near_rows(populations_, odd, block.begin_y, block.end_y, block.z);
}

/// A grain that leans over a wall gets nothing from the cells behind it.
template <class T>
void FluidCore<T>::clear_exchange_of_closed(const KernelCall<T>& call) const {
  if (closed_.empty() || !store_) return;
  const auto length = static_cast<std::size_t>(call.cells_x);
  for (int z = call.begin_z; z < call.end_z; ++z)
    for (int y = call.begin_y; y < call.end_y; ++y) {
      const std::uint8_t* row =
          closed_.data() + length * static_cast<std::size_t>(y + populations_.cells()[1] * z);
      if (std::memchr(row, 1, length) == nullptr) continue;
      for (T* exchange : call.exchange) {
        T* values = exchange + populations_.index(0, y, z);
        for (std::size_t x = 0; x < length; ++x) values[x] = row[x] != 0 ? T(0) : values[x];
      }
    }
}

template <class T>
void FluidCore<T>::set_walls(const Walls& walls) {
  int mine = walls.empty() ? 0 : 1, somewhere = 0;
  MPI_Allreduce(&mine, &somewhere, 1, MPI_INT, MPI_MAX, decomposition.communicator());
  walls_.reset();
  closed_ = walls.closed;
  if (somewhere != 0) walls_ = std::make_unique<WallLinks<T>>(decomposition, populations_, walls);
}

template <class T>
SolidKind FluidCore<T>::solid_kind() const {
  if (labels_) return SolidKind::mask;
  if (!store_) return SolidKind::none;
  return kind_of(partial_solids->solid_operator);
}

template <class T>
PartialSolidArrays FluidCore<T>::use_partial_solids(const PartialSolidSettings& s) {
  check(s);
  if (labels_) throw std::logic_error("FluidCore: a mask of solid cells and partly covered cells together");
  partial_solids = s;
  store_ = std::make_unique<PartialSolidStore<T>>(populations_, s.own_coefficients);
  return store_->arrays();
}

template <class T>
void FluidCore<T>::step(RowVisitor* visitor) {
  const CollisionSettings& c = settings.collision;
  const KernelVariant variant{!force.isZero(0), c.smagorinsky > 0, solid_kind()};
  sweep(kernel_for<T>(instruction_set, c.collision_operator, variant), visitor);
  const FaceContext context{force, c.incompressible};
  // Pressure faces first, so that the exchange carries what enters by them on to other ranks; walls and
  // solids last, because the exchange also copies places that they then overwrite with what really enters.
  patches_.read_moments(populations_, settings.faces, context, odd);
  if (odd) {
    patches_.extend_fold(populations_, settings.faces, context);
    halo_.fold(populations_);
    patches_.fold(populations_, settings.faces, context);
    if (links_) links_->fold(populations_);
    if (walls_) walls_->fold(populations_);
  } else {
    patches_.extend_fill(populations_, settings.faces, context);
    halo_.fill(populations_);
    patches_.fill(populations_, settings.faces, context);
    if (links_) links_->fill(populations_);
    if (walls_) walls_->fill(populations_);
  }
  odd = !odd;
  ++steps;
}

template <class T>
void FluidCore<T>::bare_update() {
  KernelCall<T> call = kernel_call();
  call.even_rate = 1;
  call.force[0] = 0;
  bare_update_for<T>(instruction_set)(call);
}

template <class T>
std::ptrdiff_t FluidCore<T>::place(int direction, int x, int y, int z) const {
  return populations_.index(x, y, z) - (odd ? populations_.offset_of(direction) : 0);
}

template <class T>
double FluidCore<T>::population(int direction, int x, int y, int z) const {
  return static_cast<double>(
      populations_.slot(odd ? opposite(direction) : direction)[place(direction, x, y, z)]);
}

template <class T>
void FluidCore<T>::moments_of_row(int y, int z, RowMoments& moments) const {
  constexpr int block = 8;  // cells whose sums stay in registers
  const T* rows[kDirections];
  for (int i = 0; i < kDirections; ++i)
    rows[i] = populations_.slot(odd ? opposite(i) : i) + place(i, 0, y, z);
  const int n = populations_.cells()[0];
  moments.resize(static_cast<std::size_t>((n + block - 1) / block * block));
  for (int begin = 0; begin < n; begin += block) {
    double deviation[block] = {}, momentum[3][block];
    for (int a = 0; a < 3; ++a) std::fill_n(momentum[a], block, 0.5 * force[a]);
    double g[block] = {};
    for (int i = 0; i < kDirections; ++i) {
      const T* row = rows[i] + begin;
      if (begin + block <= n)
        for (int x = 0; x < block; ++x) g[x] = static_cast<double>(row[x]);
      else
        for (int x = 0; x < n - begin; ++x) g[x] = static_cast<double>(row[x]);
      for (int x = 0; x < block; ++x) deviation[x] += g[x];
      for (int a = 0; a < 3; ++a) {
        const double along = kVelocity[i][a];
        if (along == 0) continue;
        for (int x = 0; x < block; ++x) momentum[a][x] += along * g[x];
      }
    }
    std::copy_n(deviation, block, &moments.deviation[static_cast<std::size_t>(begin)]);
    for (int a = 0; a < 3; ++a)
      std::copy_n(momentum[a], block, &moments.momentum[a][static_cast<std::size_t>(begin)]);
  }
}

template <class T>
void FluidCore<T>::set_population(int direction, int x, int y, int z, double value) {
  populations_.slot(odd ? opposite(direction) : direction)[place(direction, x, y, z)] = static_cast<T>(value);
}

template <class T>
void FluidCore<T>::set_solids(const std::function<std::uint8_t(const Index3& cell)>& label_of) {
  if (store_) throw std::logic_error("FluidCore: a mask of solid cells and partly covered cells together");
  const CellBox& box = decomposition.local_box();
  labels_ = std::make_unique<CellLabels>(box.extents(), populations_.row_pitch(), populations_.plane_pitch());
  bool any = false;
  const Index3 n = box.extents();
  for_each_cell({{-1, -1, -1}, {n[0] + 1, n[1] + 1, n[2] + 1}}, [&](int x, int y, int z) {
    Index3 cell{box.lo[0] + x, box.lo[1] + y, box.lo[2] + z};
    for (std::size_t a = 0; a < 3; ++a) {
      const int cells = decomposition.cells()[a];
      if (cell[a] >= 0 && cell[a] < cells) continue;
      switch (settings.faces[2 * a + (cell[a] < 0 ? 0 : 1)].kind) {
        case FaceKind::periodic:
          cell[a] = (cell[a] + cells) % cells;
          break;
        case FaceKind::free_slip:
        case FaceKind::pressure:
          cell[a] = cell[a] < 0 ? 0 : cells - 1;
          break;
        default:
          return;  // beyond a wall there is nothing; the face's own rule holds
      }
    }
    const std::uint8_t label = label_of(cell);
    labels_->at(x, y, z) = label;
    any |= label != 0;
  });
  int mine = any ? 1 : 0, somewhere = 0;
  MPI_Allreduce(&mine, &somewhere, 1, MPI_INT, MPI_MAX, decomposition.communicator());
  links_.reset();
  if (somewhere == 0) {  // the same kernel on every rank, so that results do not depend on their number
    labels_.reset();
    return;
  }
  links_ = std::make_unique<SolidLinks<T>>(decomposition, settings.faces, populations_, *labels_);
}

template class FluidCore<double>;
template class FluidCore<float>;

}  // namespace suffuse::lbm
