#include "face_patches.h"

#include <algorithm>

#include "lattice_vectors.h"

namespace suffuse::lbm {

namespace {

/// The part of the sub-box whose cells lie in the given boundary layers: side[a] -1 low, +1 high, 0 the cells
/// that are in neither layer named by `avoid[a]`.
CellBox part_of(const Index3& cells, const Index3& side, const Index3& avoid) {
  CellBox box{{0, 0, 0}, cells};
  for (std::size_t a = 0; a < 3; ++a) {
    if (side[a] < 0) box.hi[a] = 1;
    if (side[a] > 0) box.lo[a] = cells[a] - 1;
    if (side[a] == 0 && avoid[a] < 0) box.lo[a] = 1;
    if (side[a] == 0 && avoid[a] > 0) box.hi[a] = cells[a] - 1;
  }
  return box;
}

bool is_velocity(const FaceCondition& face) {
  return face.kind == FaceKind::velocity;
}

/// Of velocity faces one at rest, too: along an edge with a moving one its densities are taken for both.
bool needs_moments(const FaceCondition& condition, const FaceConditions& all, const FaceContext& context) {
  if (condition.kind == FaceKind::pressure) return true;
  return is_velocity(condition) && !context.incompressible &&
         std::any_of(all.begin(), all.end(),
                     [](const FaceCondition& face) { return is_velocity(face) && !face.velocity.isZero(0); });
}

/// What a velocity face misses along its edge with another face, over what its straight link pushes: a
/// diagonal link pushes half as much (1/36 of weight, not 1/18).
double missing_beside(FaceKind kind) {
  if (kind == FaceKind::no_slip) return 0.5;
  return kind == FaceKind::velocity ? 0.25 : 0;  // velocity: the mean of both is pushed
}

bool is_straight(int direction) {
  return velocity_of(direction).squaredNorm() == 1;
}

}  // namespace

template <class T>
FacePatches<T>::FacePatches(const Decomposition& decomposition, const FaceConditions& faces) {
  const Index3 cells = decomposition.local_box().extents();
  whole_ = {{0, 0, 0}, cells};
  for (int i = 1; i < kDirections; ++i) {
    Index3 towards{0, 0, 0};  // the global faces that this direction can cross here
    for (int a = 0; a < 3; ++a)
      if (kVelocity[i][a] != 0 && decomposition.at_global_face(face_at(a, kVelocity[i][a] > 0)))
        towards[static_cast<std::size_t>(a)] = kVelocity[i][a];
    for (int subset = 1; subset < 8; ++subset) {
      Index3 crossed{0, 0, 0};
      bool possible = true;
      for (std::size_t a = 0; a < 3; ++a)
        if ((subset >> a & 1) != 0) {
          crossed[a] = towards[a];
          possible &= towards[a] != 0;
        }
      const CellBox box = part_of(cells, crossed, towards);
      if (!possible || box.empty()) continue;
      const LinkRule rule = link_rule(faces, crossed);
      if (rule.action == LinkRule::Action::bounce || rule.action == LinkRule::Action::anti_bounce)
        add({i, box, rule}, cells,
            subset == 1 && faces[static_cast<std::size_t>(rule.face)].kind == FaceKind::no_slip);
    }
  }
  for (int f = 0; f < kFaces; ++f) {
    const Face face = static_cast<Face>(f);
    Index3 side{0, 0, 0};
    side[static_cast<std::size_t>(axis_of(face))] = is_high(face) ? 1 : -1;
    FaceMoments& moments = moments_[static_cast<std::size_t>(f)];
    const FaceKind kind = faces[static_cast<std::size_t>(f)].kind;
    if (decomposition.at_global_face(face))
      missing_at_edges_[static_cast<std::size_t>(f)] = missing_beside(kind);
    if (!decomposition.at_global_face(face) || (kind != FaceKind::velocity && kind != FaceKind::pressure))
      continue;
    moments.cells = part_of(cells, side, {0, 0, 0});
    moments.density.resize(moments.cells.volume());
    for (auto& component : moments.velocity) component.resize(moments.cells.volume());
  }
}

/// A wall across x is split into its inner part, done row by row behind the kernel, and the rim that is left.
template <class T>
void FacePatches<T>::add(const Patch& patch, const Index3& cells, bool wall_across_x) {
  Patch inner = patch;
  for (std::size_t a = 1; a < 3; ++a) {
    inner.cells.lo[a] = std::max(patch.cells.lo[a], 1);
    inner.cells.hi[a] = std::min(patch.cells.hi[a], cells[a] - 1);
  }
  if (!wall_across_x || inner.cells.empty()) {
    patches_.push_back(patch);
    return;
  }
  near_patches_.push_back(inner);
  const auto add_rim = [&](std::size_t axis, int lo, int hi, const CellBox& from) {
    Patch rim = patch;
    rim.cells = from;
    rim.cells.lo[axis] = lo;
    rim.cells.hi[axis] = hi;
    if (!rim.cells.empty()) patches_.push_back(rim);
  };
  add_rim(2, patch.cells.lo[2], inner.cells.lo[2], patch.cells);
  add_rim(2, inner.cells.hi[2], patch.cells.hi[2], patch.cells);
  CellBox between = patch.cells;
  between.lo[2] = inner.cells.lo[2];
  between.hi[2] = inner.cells.hi[2];
  add_rim(1, patch.cells.lo[1], inner.cells.lo[1], between);
  add_rim(1, inner.cells.hi[1], patch.cells.hi[1], between);
}

template <class T>
void FacePatches<T>::apply_near_rows(Populations<T>& populations, bool after_odd_step, int begin_y, int end_y,
                                     int z) const {
  for (const Patch& patch : near_patches_) {
    if (z < patch.cells.lo[2] || z >= patch.cells.hi[2]) continue;
    T* own = populations.slot(opposite(patch.direction));
    T* beyond = populations.slot(patch.direction) + populations.offset_of(patch.direction);
    const T* from = after_odd_step ? beyond : own;
    T* to = after_odd_step ? own : beyond;
    const int last = std::min(end_y, patch.cells.hi[1]);
    for (int y = std::max(begin_y, patch.cells.lo[1]); y < last; ++y) {
      const std::ptrdiff_t cell = populations.index(patch.cells.lo[0], y, z);
      to[cell] = from[cell];
    }
  }
}

template <class T>
template <bool kOddStep>
void FacePatches<T>::read_moments_of(FaceMoments& moments, const Populations<T>& populations,
                                     const FaceContext& context) const {
  std::size_t n = 0;
  std::ptrdiff_t offset[kDirections];
  const T* place[kDirections];
  for (int i = 0; i < kDirections; ++i) {
    offset[i] = kOddStep ? populations.offset_of(i) : 0;
    place[i] = populations.slot(kOddStep ? i : opposite(i)) + offset[i];
  }
  for_each_cell(moments.cells, [&](int x, int y, int z) {
    const std::ptrdiff_t cell = populations.index(x, y, z);
    double deviation = static_cast<double>(place[0][cell]), momentum[3] = {0, 0, 0};
#pragma GCC unroll 9
    for (int i = 1; i < kDirections; i += 2) {
      const double forward = static_cast<double>(place[i][cell]),
                   backward = static_cast<double>(place[i + 1][cell]);
      deviation += forward + backward;
      for (int a = 0; a < 3; ++a) momentum[a] += kVelocity[i][a] * (forward - backward);
    }
    // After the collision the momentum holds the whole force; the velocity is defined with half of it.
    const double density = 1 + deviation, divisor = context.incompressible ? 1 : density;
    moments.density[n] = density;
    for (int a = 0; a < 3; ++a) moments.velocity[a][n] = (momentum[a] - 0.5 * context.force[a]) / divisor;
    ++n;
  });
}

template <class T>
void FacePatches<T>::read_moments(const Populations<T>& populations, const FaceConditions& faces,
                                  const FaceContext& context, bool after_odd_step) {
  for (std::size_t f = 0; f < kFaces; ++f) {
    if (moments_[f].cells.empty() || !needs_moments(faces[f], faces, context)) continue;
    if (after_odd_step)
      read_moments_of<true>(moments_[f], populations, context);
    else
      read_moments_of<false>(moments_[f], populations, context);
  }
}

template <class T>
template <bool kOddStep>
void FacePatches<T>::extend(Populations<T>& populations, const FaceConditions& faces,
                            const FaceContext& context) const {
  for (std::size_t f = 0; f < kFaces; ++f) {
    const FaceMoments& moments = moments_[f];
    if (moments.cells.empty() || faces[f].kind != FaceKind::pressure) continue;
    const int axis = static_cast<int>(f) / 2, outward = f % 2 == 1 ? 1 : -1;
    Index3 step{0, 0, 0};
    step[static_cast<std::size_t>(axis)] = outward;
    const std::ptrdiff_t beyond = populations.index(step[0], step[1], step[2]);
    for (int j = 1; j < kDirections; ++j) {
      if (kVelocity[j][axis] != -outward) continue;
      // After an even step direction j of cell y lies in y's slot of the opposite direction and is wanted one
      // cell further out; after an odd step it lies at y + c_j in slot j and, again, is wanted one cell
      // further out.
      T* slot = kOddStep ? populations.slot(j) + populations.offset_of(j) : populations.slot(opposite(j));
      const double w = kWeight[j], cx = kVelocity[j][0], cy = kVelocity[j][1], cz = kVelocity[j][2];
      const double face_density = faces[f].density, quadratic = context.incompressible ? 0. : 1.;
      const auto length = static_cast<std::size_t>(moments.cells.extent(0));
      std::size_t n = 0;
      for (int z = moments.cells.lo[2]; z < moments.cells.hi[2]; ++z)
        for (int y = moments.cells.lo[1]; y < moments.cells.hi[1]; ++y, n += length) {
          const T* inside = slot + populations.index(moments.cells.lo[0], y, z);
          T* ghost = slot + populations.index(moments.cells.lo[0], y, z) + beyond;
          const double *density = moments.density.data() + n, *ux = moments.velocity[0].data() + n,
                       *uy = moments.velocity[1].data() + n, *uz = moments.velocity[2].data() + n;
          for (std::size_t x = 0; x < length; ++x) {
            const double cu = cx * ux[x] + cy * uy[x] + cz * uz[x];
            const double u2 = ux[x] * ux[x] + uy[x] * uy[x] + uz[x] * uz[x];
            const double shape = w * (1 + quadratic * (3 * cu + 4.5 * cu * cu - 1.5 * u2));
            ghost[x] =
                static_cast<T>(static_cast<double>(inside[x]) + 2 * (face_density - density[x]) * shape);
          }
        }
    }
  }
}

template <class T>
void FacePatches<T>::extend_fill(Populations<T>& populations, const FaceConditions& faces,
                                 const FaceContext& context) const {
  extend<false>(populations, faces, context);
}

template <class T>
void FacePatches<T>::extend_fold(Populations<T>& populations, const FaceConditions& faces,
                                 const FaceContext& context) const {
  extend<true>(populations, faces, context);
}

template <class T>
Vec3 FacePatches<T>::missing_velocity(const Patch& patch, const FaceConditions& faces,
                                      const Index3& cell) const {
  const auto own = static_cast<std::size_t>(patch.rule.face);
  Vec3 missing = Vec3::Zero();
  for (std::size_t a = 0; a < 3; ++a) {
    if (a == own / 2) continue;
    for (const std::size_t f : {2 * a, 2 * a + 1}) {
      const int edge = f % 2 == 0 ? whole_.lo[a] : whole_.hi[a] - 1;
      if (missing_at_edges_[f] == 0 || cell[a] != edge) continue;
      const bool moves = faces[f].kind == FaceKind::velocity;
      missing +=
          missing_at_edges_[f] * (moves ? faces[own].velocity - faces[f].velocity : faces[own].velocity);
    }
  }
  return missing;
}

template <class T>
template <bool kOddStep>
void FacePatches<T>::apply(Populations<T>& populations, const FaceConditions& faces,
                           const FaceContext& context) {
  for (const Patch& patch : patches_) {
    const int i = patch.direction;
    const FaceCondition& one = faces[static_cast<std::size_t>(patch.rule.face)];
    const FaceCondition& two = faces[static_cast<std::size_t>(patch.rule.other)];
    const std::ptrdiff_t offset = populations.offset_of(i);
    T* own = populations.slot(opposite(i));
    T* beyond = populations.slot(i) + offset;
    const T* from = kOddStep ? beyond : own;
    T* to = kOddStep ? own : beyond;
    const double w = kWeight[i];
    const Vec3 c = velocity_of(i);

    const bool still = one.kind == FaceKind::no_slip || (one.velocity.isZero(0) && two.velocity.isZero(0));
    if (patch.rule.action == LinkRule::Action::bounce && still) {
      for_each_cell(patch.cells, [&](int x, int y, int z) {
        const std::ptrdiff_t cell = populations.index(x, y, z);
        to[cell] = from[cell];
      });
      continue;
    }
    const FaceMoments& moments = moments_[static_cast<std::size_t>(patch.rule.face)];
    const auto moment_index = [&](int x, int y, int z) {
      const CellBox& b = moments.cells;
      return static_cast<std::size_t>((x - b.lo[0]) +
                                      b.extent(0) * ((y - b.lo[1]) + b.extent(1) * (z - b.lo[2])));
    };
    if (patch.rule.action == LinkRule::Action::bounce) {
      const Vec3 velocity = 0.5 * (one.velocity + two.velocity);
      const bool unit_density = context.incompressible, straight = is_straight(i);
      for_each_cell(patch.cells, [&](int x, int y, int z) {
        const std::ptrdiff_t cell = populations.index(x, y, z);
        const double density = unit_density ? 1. : moments.density[moment_index(x, y, z)];
        const Vec3 pushed = straight ? Vec3(velocity + missing_velocity(patch, faces, {x, y, z})) : velocity;
        const double push = 6 * w * c.dot(pushed);
        to[cell] = static_cast<T>(static_cast<double>(from[cell]) - density * push);
      });
    } else {
      const double density = 0.5 * (one.density + two.density),
                   inertial = context.incompressible ? 1. : density;
      for_each_cell(patch.cells, [&](int x, int y, int z) {
        const std::ptrdiff_t cell = populations.index(x, y, z);
        const std::size_t n = moment_index(x, y, z);
        const Vec3 u(moments.velocity[0][n], moments.velocity[1][n], moments.velocity[2][n]);
        const double cu = c.dot(u);
        const double even = (density - 1) + inertial * (4.5 * cu * cu - 1.5 * u.squaredNorm());
        to[cell] = static_cast<T>(2 * w * even - static_cast<double>(from[cell]));
      });
    }
  }
}

template <class T>
void FacePatches<T>::fill(Populations<T>& populations, const FaceConditions& faces,
                          const FaceContext& context) {
  apply<false>(populations, faces, context);
}

template <class T>
void FacePatches<T>::fold(Populations<T>& populations, const FaceConditions& faces,
                          const FaceContext& context) {
  apply<true>(populations, faces, context);
}

template class FacePatches<double>;
template class FacePatches<float>;

}  // namespace suffuse::lbm
