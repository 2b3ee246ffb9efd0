#include "suffuse/lbm/wall_shapes.h"

#include <mpi.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "suffuse/lbm/boundary.h"
#include "suffuse/lbm/lattice.h"

namespace suffuse::lbm {

namespace {

std::size_t at(int n) {
  return static_cast<std::size_t>(n);
}

/// Farther than this from a surface no link of a cell reaches it: sqrt(2) and the rounding. The mirror image
/// of a link begins a cell farther out at most.
constexpr double kReach = 1.45, kMirroredReach = 2.9;

/// Edges of triangles are as much wider, so that no link slips through between two of them (cells).
constexpr double kEdge = 1e-6;
/// Distances below this from a triangle's plane are round-off.
constexpr double kRoundOff = 1e-9;

struct Bounds {
  Vec3 low = Vec3::Constant(-std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(std::numeric_limits<double>::infinity());
};

/// A surface answers: how far is a point (at least), where does a segment from `start` along `along` cross it
/// (0 to 1), where does it end, does it lie on a plane normal to an axis?
struct PlaneSurface {
  PlaneWall plane;
  Bounds bounds() const {
    Bounds b;
    b.low[plane.axis] = b.high[plane.axis] = plane.position;
    return b;
  }
  double distance(const Vec3& point) const { return std::abs(point[plane.axis] - plane.position); }
  std::optional<double> crossing(const Vec3& start, const Vec3& along) const {
    const double from = start[plane.axis] - plane.position, to = from + along[plane.axis];
    if ((from >= 0) == (to >= 0)) return std::nullopt;
    return from / (from - to);
  }
  bool lies_on(int axis, double position) const {
    return axis == plane.axis && std::abs(plane.position - position) < kOnFace;
  }
};

struct CylinderSurface {
  CylinderWall cylinder;
  Bounds bounds() const {
    Bounds b;
    for (int a = 0; a < 3; ++a)
      if (a != cylinder.axis) {
        b.low[a] = cylinder.centre[a] - cylinder.radius;
        b.high[a] = cylinder.centre[a] + cylinder.radius;
      }
    return b;
  }
  Vec3 across(Vec3 vector) const {
    vector[cylinder.axis] = 0;
    return vector;
  }
  double distance(const Vec3& point) const {
    return std::abs(across(point - cylinder.centre).norm() - cylinder.radius);
  }
  std::optional<double> crossing(const Vec3& start, const Vec3& along) const {
    const Vec3 from = across(start - cylinder.centre), way = across(along);
    const double square = cylinder.radius * cylinder.radius;
    const double c = from.squaredNorm() - square, end = (from + way).squaredNorm() - square;
    if ((c >= 0) == (end >= 0)) return std::nullopt;
    const double a = way.squaredNorm(), b = from.dot(way), root = std::sqrt(std::max(0., b * b - a * c));
    return std::clamp((c >= 0 ? -b - root : -b + root) / a, 0., 1.);
  }
  bool lies_on(int, double) const { return false; }
};

class TriangleSurface {
 public:
  explicit TriangleSurface(const std::array<Vec3, 3>& corners) : corners_(corners) {
    normal_ = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double twice_area = normal_.norm();
    degenerate_ = !(twice_area > 0);
    if (degenerate_) return;
    normal_ /= twice_area;
    Eigen::Index largest = 0;
    normal_.cwiseAbs().maxCoeff(&largest);
    if (normal_[largest] < 0) {  // one upper side for neighbours that are turned otherwise
      normal_ = -normal_;
      std::swap(corners_[1], corners_[2]);
    }
    for (std::size_t e = 0; e < 3; ++e)
      inward_[e] = normal_.cross(corners_[(e + 1) % 3] - corners_[e]).normalized();
  }
  bool degenerate() const { return degenerate_; }
  Bounds bounds() const {
    return {corners_[0].cwiseMin(corners_[1]).cwiseMin(corners_[2]),
            corners_[0].cwiseMax(corners_[1]).cwiseMax(corners_[2])};
  }
  double distance(const Vec3& point) const { return std::abs(normal_.dot(point - corners_[0])); }
  std::optional<double> crossing(const Vec3& start, const Vec3& along) const {
    const double from = height(start), to = height(start + along);
    if ((from >= 0) == (to >= 0)) return std::nullopt;
    const double share = from / (from - to);
    const Vec3 point = start + share * along;
    for (std::size_t e = 0; e < 3; ++e)
      if (inward_[e].dot(point - corners_[e]) < -kEdge) return std::nullopt;
    return share;
  }
  bool lies_on(int axis, double position) const {
    return std::all_of(corners_.begin(), corners_.end(),
                       [&](const Vec3& c) { return std::abs(c[axis] - position) < kOnFace; });
  }

 private:
  double height(const Vec3& point) const {
    const double h = normal_.dot(point - corners_[0]);
    return std::abs(h) < kRoundOff ? 0 : h;
  }
  std::array<Vec3, 3> corners_;
  std::array<Vec3, 3> inward_;
  Vec3 normal_;
  bool degenerate_ = false;
};

/// The same answer for a segment and for its reverse, whichever end asks.
template <class Surface>
std::optional<double> crossing(const Surface& surface, const Vec3& start, const Vec3& along) {
  for (int a = 0; a < 3; ++a) {
    if (along[a] > 0) break;
    if (along[a] == 0) continue;
    const auto reverse = surface.crossing(start + along, -along);
    return reverse ? std::optional(1 - *reverse) : std::nullopt;
  }
  return surface.crossing(start, along);
}

struct Hit {
  std::size_t cell;  ///< of this rank, x fastest
  int direction;
  double distance;
  bool before(const Hit& other) const {
    if (cell != other.cell) return cell < other.cell;
    return direction != other.direction ? direction < other.direction : distance < other.distance;
  }
};

/// Finds the links of one rank's cells that surfaces cut.
class LinkCutter {
 public:
  LinkCutter(const Decomposition& decomposition, const FaceConditions& faces)
      : box_(decomposition.local_box()), cells_(decomposition.cells()), faces_(faces) {
    for (std::size_t a = 0; a < 3; ++a) periodic_[a] = faces[2 * a].kind == FaceKind::periodic;
    for (const FaceCondition& face : faces)
      if (face.kind == FaceKind::free_slip) reach_ = kMirroredReach;
  }

  std::int64_t cut(const WallShape& shape) {
    const std::size_t before = hits_.size();
    if (const auto* plane = std::get_if<PlaneWall>(&shape)) cut_by(PlaneSurface{*plane});
    if (const auto* cylinder = std::get_if<CylinderWall>(&shape)) cut_by(CylinderSurface{*cylinder});
    if (const auto* mesh = std::get_if<MeshWall>(&shape))
      for (const auto& corners : mesh->triangles)
        if (const TriangleSurface triangle(corners); !triangle.degenerate()) cut_by(triangle);
    return static_cast<std::int64_t>(hits_.size() - before);
  }

  /// The nearest surface of each link.
  std::vector<WallLink> links() {
    std::sort(hits_.begin(), hits_.end(), [](const Hit& a, const Hit& b) { return a.before(b); });
    std::vector<WallLink> links;
    const Hit* last = nullptr;
    for (const Hit& hit : hits_) {
      if (last == nullptr || last->cell != hit.cell || last->direction != hit.direction)
        links.push_back({cell_at(hit.cell), hit.direction, hit.distance, -1});
      last = &hit;
    }
    return links;
  }

 private:
  Index3 cell_at(std::size_t n) const {
    const auto nx = at(box_.extent(0)), ny = at(box_.extent(1));
    return {box_.lo[0] + static_cast<int>(n % nx), box_.lo[1] + static_cast<int>(n / nx % ny),
            box_.lo[2] + static_cast<int>(n / nx / ny)};
  }

  template <class Surface>
  void cut_by(const Surface& surface) {
    for (int a = 0; a < 3; ++a)
      if (!periodic_[at(a)] && (surface.lies_on(a, 0) || surface.lies_on(a, cells_[at(a)]))) return;
    const auto shifts = [&](int axis) { return periodic_[at(axis)] ? 1 : 0; };
    for (int k = -shifts(2); k <= shifts(2); ++k)
      for (int j = -shifts(1); j <= shifts(1); ++j)
        for (int i = -shifts(0); i <= shifts(0); ++i) cut_image(surface, {i, j, k});
  }

  /// Cells as they are, or moved by whole boxes: then only links that cross that side count.
  template <class Surface>
  void cut_image(const Surface& surface, const Index3& shift) {
    const Bounds bounds = surface.bounds();
    CellBox range = box_;
    Vec3 moved;
    for (int a = 0; a < 3; ++a) {
      moved[a] = shift[at(a)] * cells_[at(a)];
      const double low = std::floor(bounds.low[a] - reach_ - moved[a]),
                   high = std::ceil(bounds.high[a] + reach_ - moved[a]);
      range.lo[at(a)] = static_cast<int>(std::clamp<double>(low, range.lo[at(a)], range.hi[at(a)]));
      range.hi[at(a)] = static_cast<int>(std::clamp<double>(high, range.lo[at(a)], range.hi[at(a)]));
      if (shift[at(a)] < 0) range.lo[at(a)] = std::max(range.lo[at(a)], cells_[at(a)] - 1);
      if (shift[at(a)] > 0) range.hi[at(a)] = std::min(range.hi[at(a)], 1);
    }
    if (range.empty()) return;
    for_each_cell(range, [&](int x, int y, int z) {
      const Vec3 start = moved + Vec3(x + 0.5, y + 0.5, z + 0.5);
      if (surface.distance(start) > reach_) return;
      for (int i = 1; i < kDirections; ++i) cut_link(surface, {x, y, z}, i, shift, start);
    });
  }

  template <class Surface>
  void cut_link(const Surface& surface, const Index3& cell, int direction, const Index3& shift,
                const Vec3& start) {
    Index3 crossed{0, 0, 0};
    for (std::size_t a = 0; a < 3; ++a) {
      const int there = cell[a] + kVelocity[direction][a];
      if (there < 0 || there >= cells_[a]) crossed[a] = kVelocity[direction][a];
      if (shift[a] != 0 && crossed[a] != -shift[a]) return;
    }
    const Vec3 along(kVelocity[direction][0], kVelocity[direction][1], kVelocity[direction][2]);
    const auto first = crossing(surface, start, along);
    if (crossed == Index3{0, 0, 0}) {
      if (first) add(cell, direction, *first);
      return;
    }
    const LinkRule::Action action = link_rule(faces_, crossed).action;
    if (action == LinkRule::Action::stream || action == LinkRule::Action::extend) {
      if (first) add(cell, direction, *first);
    } else if (action == LinkRule::Action::mirror) {
      Vec3 image = start, mirrored = along;
      for (int a = 0; a < 3; ++a) {
        if (crossed[at(a)] == 0 || periodic_[at(a)]) continue;
        image[a] += along[a];
        mirrored[a] = -along[a];
      }
      if (first && *first <= 0.5) add(cell, direction, *first);
      if (const auto second = crossing(surface, image, mirrored); second && *second >= 0.5)
        add(cell, direction, *second);
    } else if (first && *first < 0.5) {
      add(cell, direction, *first);
    }
  }

  void add(const Index3& cell, int direction, double distance) {
    const std::size_t n =
        at(cell[0] - box_.lo[0]) +
        at(box_.extent(0)) * (at(cell[1] - box_.lo[1]) + at(box_.extent(1)) * at(cell[2] - box_.lo[2]));
    hits_.push_back({n, direction, distance});
  }

  CellBox box_;
  Index3 cells_;
  FaceConditions faces_;
  std::array<bool, 3> periodic_{};
  double reach_ = kReach;
  std::vector<Hit> hits_;
};

}  // namespace

WallCuts cut_links(const Decomposition& decomposition, const FaceConditions& faces,
                   const std::vector<WallShape>& shapes) {
  LinkCutter cutter(decomposition, faces);
  WallCuts cuts;
  for (const WallShape& shape : shapes) cuts.count.push_back(cutter.cut(shape));
  MPI_Allreduce(MPI_IN_PLACE, cuts.count.data(), static_cast<int>(cuts.count.size()), MPI_INT64_T, MPI_SUM,
                decomposition.communicator());
  cuts.links = cutter.links();
  return cuts;
}

}  // namespace suffuse::lbm
