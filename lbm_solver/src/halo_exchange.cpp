#include "halo_exchange.h"

#include <algorithm>

namespace suffuse::lbm {

namespace {

/// The five directions that leave through a face.
std::array<int, 5> leaving(int axis, bool high) {
  std::array<int, 5> directions{};
  std::size_t n = 0;
  for (int i = 0; i < kDirections; ++i)
    if (kVelocity[i][axis] == (high ? 1 : -1)) directions[n++] = i;
  return directions;
}

template <class T>
void pack(const Populations<T>& populations, const std::array<int, 5>& directions, const CellBox& box,
          std::vector<T>& buffer) {
  buffer.resize(5 * box.volume());
  T* to = buffer.data();
  for (const int i : directions) {
    const T* slot = populations.slot(i);
    for (int z = box.lo[2]; z < box.hi[2]; ++z)
      for (int y = box.lo[1]; y < box.hi[1]; ++y)
        to = std::copy_n(slot + populations.index(box.lo[0], y, z), box.extent(0), to);
  }
}

template <class T>
void unpack(Populations<T>& populations, const std::array<int, 5>& directions, const CellBox& box,
            const std::vector<T>& buffer) {
  const T* from = buffer.data();
  for (const int i : directions) {
    T* slot = populations.slot(i);
    for (int z = box.lo[2]; z < box.hi[2]; ++z)
      for (int y = box.lo[1]; y < box.hi[1]; ++y, from += box.extent(0))
        std::copy_n(from, box.extent(0), slot + populations.index(box.lo[0], y, z));
  }
}

template <class T>
constexpr MPI_Datatype mpi_type();
template <>
MPI_Datatype mpi_type<double>() {
  return MPI_DOUBLE;
}
template <>
MPI_Datatype mpi_type<float>() {
  return MPI_FLOAT;
}

}  // namespace

template <class T>
HaloExchange<T>::HaloExchange(const Decomposition& decomposition, const FaceConditions& faces)
    : communicator_(decomposition.communicator()) {
  for (int f = 0; f < kFaces; ++f) {
    const Face face = static_cast<Face>(f);
    const auto at = static_cast<std::size_t>(f);
    const FaceKind kind = faces[at].kind;
    neighbours_[at] = decomposition.neighbour(face);
    const bool streams = !decomposition.at_global_face(face) || kind == FaceKind::periodic;
    pressure_[at] = decomposition.at_global_face(face) && kind == FaceKind::pressure;
    partners_[at] = streams ? neighbours_[at] == decomposition.rank() ? Partner::self : Partner::other
                    : kind == FaceKind::free_slip ? Partner::mirror
                                                  : Partner::none;
  }
}

/// The layer of cells at `position` across `axis`: axes before it with their ghost cells, axes after it with
/// those beyond pressure faces.
template <class T>
CellBox HaloExchange<T>::layer(const Index3& cells, int axis, int position) const {
  CellBox box;
  for (int a = 0; a < 3; ++a) {
    const auto at = static_cast<std::size_t>(a);
    box.lo[at] = a < axis || pressure_[2 * at] ? -1 : 0;
    box.hi[at] = cells[at] + (a < axis || pressure_[2 * at + 1] ? 1 : 0);
  }
  box.lo[static_cast<std::size_t>(axis)] = position;
  box.hi[static_cast<std::size_t>(axis)] = position + 1;
  return box;
}

template <class T>
void HaloExchange<T>::fill(Populations<T>& populations) {
  for (int axis = 0; axis < 3; ++axis) run_axis(populations, axis, false);
}

template <class T>
void HaloExchange<T>::fold(Populations<T>& populations) {
  for (int axis = 2; axis >= 0; --axis) run_axis(populations, axis, true);
}

template <class T>
void HaloExchange<T>::run_axis(Populations<T>& populations, int axis, bool folding) {
  const auto low = static_cast<std::size_t>(face_at(axis, false));
  if (axis == 2 && started_)
    finish(populations, axis, folding);
  else if (axis > 0 || partners_[low] != Partner::self)
    exchange(populations, axis, folding);
  if (axis == 2) started_ = false;
  for (const bool high : {false, true}) {
    const std::size_t face = low + (high ? 1 : 0);
    if (axis == 0 && is_local(face))
      copy_far_rows(populations, high, folding);
    else if (partners_[face] == Partner::mirror)
      mirror(populations, axis, high, folding);
  }
}

/// Cells of a sub-box's layers across x whose places for a direction are written by cells of the sub-box: all
/// by an even step, by an odd one those whose neighbour against the direction is inside along y and z.
template <class T>
CellBox HaloExchange<T>::near_rows(const Index3& cells, int direction, bool folding) {
  CellBox box{{0, 0, 0}, {1, cells[1], cells[2]}};
  if (!folding) return box;
  for (std::size_t a = 1; a < 3; ++a) {
    box.lo[a] += std::max(0, kVelocity[direction][a]);
    box.hi[a] += std::min(0, kVelocity[direction][a]);
  }
  return box;
}

/// One direction that leaves across x, in the given rows: what `fill` and `fold` copy for a local face.
template <class T>
void HaloExchange<T>::copy_rows(Populations<T>& populations, int direction, bool folding,
                                const CellBox& rows) const {
  const int cells = populations.cells()[0];
  const bool high = kVelocity[direction][0] > 0;
  const bool mirrors = partners_[high ? 1 : 0] == Partner::mirror;
  T* ghost = populations.slot(direction) + (high ? cells : -1);
  T* inside = mirrors ? populations.slot(reflected(direction, 0)) + (high ? cells - 1 : 0)
                      : populations.slot(direction) + (high ? 0 : cells - 1);
  const T* from = folding ? ghost : inside;
  T* to = folding ? inside : ghost;
  for (int z = rows.lo[2]; z < rows.hi[2]; ++z)
    for (int y = rows.lo[1]; y < rows.hi[1]; ++y) {
      const std::ptrdiff_t row = populations.index(0, y, z);
      to[row] = from[row];
    }
}

template <class T>
void HaloExchange<T>::apply_near_rows(Populations<T>& populations, bool after_odd_step, int begin_y,
                                      int end_y, int z) const {
  for (const bool high : {false, true}) {
    if (!is_local(high ? 1 : 0)) continue;
    for (const int i : leaving(0, high)) {
      // An odd step has written the places one cell along the direction.
      const int up = after_odd_step ? kVelocity[i][1] : 0, out = after_odd_step ? kVelocity[i][2] : 0;
      CellBox rows = near_rows(populations.cells(), i, after_odd_step);
      if (z + out < rows.lo[2] || z + out >= rows.hi[2]) continue;
      rows.lo[2] = z + out;
      rows.hi[2] = z + out + 1;
      rows.lo[1] = std::max(rows.lo[1], begin_y + up);
      rows.hi[1] = std::min(rows.hi[1], end_y + up);
      copy_rows(populations, i, after_odd_step, rows);
    }
  }
}

/// The rows of a local face across x that apply_near_rows leaves: those beyond pressure faces, and what came
/// in across y and z.
template <class T>
void HaloExchange<T>::copy_far_rows(Populations<T>& populations, bool high, bool folding) const {
  const CellBox all = layer(populations.cells(), 0, 0);
  for (const int i : leaving(0, high)) {
    const CellBox near = near_rows(populations.cells(), i, folding);
    CellBox below = all, above = all, before = near, behind = near;
    below.hi[2] = near.lo[2];
    above.lo[2] = near.hi[2];
    before.lo[1] = all.lo[1];
    before.hi[1] = near.lo[1];
    behind.lo[1] = near.hi[1];
    behind.hi[1] = all.hi[1];
    for (const CellBox& rows : {below, above, before, behind}) copy_rows(populations, i, folding, rows);
  }
}

template <class T>
void HaloExchange<T>::mirror(Populations<T>& populations, int axis, bool high, bool folding) {
  const int cells = populations.cells()[static_cast<std::size_t>(axis)];
  const CellBox ghost = layer(populations.cells(), axis, high ? cells : -1);
  Index3 step{0, 0, 0};
  step[static_cast<std::size_t>(axis)] = high ? -1 : 1;
  const std::ptrdiff_t inward = populations.index(step[0], step[1], step[2]);
  for (const int i : leaving(axis, high)) {
    T* outside = populations.slot(i);
    T* inside = populations.slot(reflected(i, axis)) + inward;
    for (int z = ghost.lo[2]; z < ghost.hi[2]; ++z)
      for (int y = ghost.lo[1]; y < ghost.hi[1]; ++y) {
        const std::ptrdiff_t row = populations.index(ghost.lo[0], y, z);
        if (folding)
          std::copy_n(outside + row, ghost.extent(0), inside + row);
        else
          std::copy_n(inside + row, ghost.extent(0), outside + row);
      }
  }
}

template <class T>
void HaloExchange<T>::exchange(Populations<T>& populations, int axis, bool folding) {
  post(populations, axis, folding);
  finish(populations, axis, folding);
}

template <class T>
void HaloExchange<T>::post(Populations<T>& populations, int axis, bool folding) {
  const int cells = populations.cells()[static_cast<std::size_t>(axis)];
  Messages& messages = messages_[static_cast<std::size_t>(axis)];
  // The ghost layer beyond a face and the first layer inside that face's neighbour are the same places of the
  // whole box, for the directions that leave through the face: filling copies inside -> ghost, folding ghost
  // -> inside.
  for (const bool high : {false, true}) {
    const auto face = static_cast<std::size_t>(face_at(axis, high));
    const auto against = static_cast<std::size_t>(face_at(axis, !high));
    const std::array<int, 5> directions = leaving(axis, high);
    const CellBox ghost = layer(populations.cells(), axis, high ? cells : -1);
    const CellBox inside = layer(populations.cells(), axis, high ? 0 : cells - 1);
    const std::size_t from = folding ? face : against, to = folding ? against : face;
    std::vector<T>&out = messages.send[high], &in = messages.receive[high];
    if (partners_[from] == Partner::other || partners_[from] == Partner::self)
      pack(populations, directions, folding ? ghost : inside, out);
    if (partners_[from] == Partner::self) {
      unpack(populations, directions, folding ? inside : ghost, out);
      continue;
    }
    if (partners_[to] == Partner::other) {
      in.resize(5 * ghost.volume());
      MPI_Irecv(in.data(), static_cast<int>(in.size()), mpi_type<T>(), neighbours_[to], 2 * axis + high,
                communicator_, &messages.requests[messages.pending++]);
    }
    if (partners_[from] == Partner::other)
      MPI_Isend(out.data(), static_cast<int>(out.size()), mpi_type<T>(), neighbours_[from], 2 * axis + high,
                communicator_, &messages.requests[messages.pending++]);
  }
}

template <class T>
void HaloExchange<T>::finish(Populations<T>& populations, int axis, bool folding) {
  const int cells = populations.cells()[static_cast<std::size_t>(axis)];
  Messages& messages = messages_[static_cast<std::size_t>(axis)];
  MPI_Waitall(messages.pending, messages.requests, MPI_STATUSES_IGNORE);
  messages.pending = 0;
  for (const bool high : {false, true}) {
    const auto to = static_cast<std::size_t>(face_at(axis, folding ? !high : high));
    if (partners_[to] != Partner::other) continue;
    const CellBox box = folding ? layer(populations.cells(), axis, high ? 0 : cells - 1)
                                : layer(populations.cells(), axis, high ? cells : -1);
    unpack(populations, leaving(axis, high), box, messages.receive[high]);
  }
}

template <class T>
bool HaloExchange<T>::can_start_early(bool after_odd_step) const {
  bool possible = partners_[4] == Partner::other || partners_[5] == Partner::other;
  for (std::size_t face = 0; face < 4; ++face)
    possible &= !pressure_[face] && (after_odd_step || partners_[face] != Partner::other);
  return possible;
}

template <class T>
void HaloExchange<T>::start_early(Populations<T>& populations, bool after_odd_step) {
  const Index3& cells = populations.cells();
  if (!after_odd_step)
    for (const int z : {0, cells[2] - 1}) fill_rows_beyond_y(populations, z);
  post(populations, 2, after_odd_step);
  started_ = true;
}

/// Local faces across y, in one plane: what run_axis would do for it, and does again with the others.
template <class T>
void HaloExchange<T>::fill_rows_beyond_y(Populations<T>& populations, int z) const {
  const int cells = populations.cells()[1];
  for (const bool high : {false, true}) {
    const std::size_t face = high ? 3 : 2;
    if (!is_local(face)) continue;
    const bool mirrors = partners_[face] == Partner::mirror;
    for (const int i : leaving(1, high)) {
      const T* inside =
          mirrors ? populations.slot(reflected(i, 1)) + populations.index(-1, high ? cells - 1 : 0, z)
                  : populations.slot(i) + populations.index(-1, high ? 0 : cells - 1, z);
      std::copy_n(inside, populations.cells()[0] + 2,
                  populations.slot(i) + populations.index(-1, high ? cells : -1, z));
    }
  }
}

template class HaloExchange<double>;
template class HaloExchange<float>;

}  // namespace suffuse::lbm
