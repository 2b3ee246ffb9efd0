#include "grading/packing_constrictions.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include "grading/tangent_spheres.h"
#include "suffuse/common/error.h"

namespace suffuse::analysis {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_3<std::size_t, Kernel,
                                                CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using CellBase = CGAL::Triangulation_cell_base_with_info_3<std::size_t, Kernel,
                                                           CGAL::Regular_triangulation_cell_base_3<Kernel>>;
using Triangulation =
    CGAL::Regular_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;

/// Offset of the period that is counted, in box lengths: discs of regular arrays do not lie on its faces.
const Vec3 kOffset(0.01234, 0.02345, 0.03456);

/// Which cells are one pore.
class UnionFind {
 public:
  explicit UnionFind(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j) { parent_[root(i)] = root(j); }

 private:
  std::vector<std::size_t> parent_;
};

void check(std::span<const Sphere> grains, const SphereBox& box) {
  const auto refuse = [](const char* what, const std::string& value, const char* rule) {
    throw_user_error({"constriction", what, value, rule, ""});
  };
  if (grains.size() < 4) refuse("grains", fmt::format("{}", grains.size()), "be at least four");
  for (const Sphere& grain : grains) {
    if (!(std::isfinite(grain.radius) && grain.radius > 0))
      refuse("radius", fmt::format("{:g} m", grain.radius), "be positive and finite");
    if (!grain.centre.allFinite()) refuse("position of a grain", "not a number", "be finite");
  }
  for (int axis = 0; axis < 3; ++axis) {
    const double length = box.high[axis] - box.low[axis];
    if (!(std::isfinite(length) && length > 0))
      refuse("box", fmt::format("{:g} m long", length), "have a length");
  }
}

/// The analysis of one triangulation with images up to `margin` beyond the box.
class Network {
 public:
  Network(std::span<const Sphere> grains, const SphereBox& box, double margin) : box_(box) {
    for (const Sphere& grain : grains) {
      largest_radius_ = std::max(largest_radius_, grain.radius);
      low_ = low_.cwiseMin(grain.centre);
      high_ = high_.cwiseMax(grain.centre);
    }
    add_images(grains, margin);
    grid_.emplace(grains_);
    triangulate();
    void_spheres();
  }

  /// Of the void spheres between grains: those of flat tetrahedra on a free surface stand far outside of it.
  double largest_void_radius() const {
    double largest = 0;
    for (const VoidSphere& sphere : spheres_)
      if (counted(sphere.centre) && between_grains(sphere.centre)) largest = std::max(largest, sphere.radius);
    return largest;
  }

  PackingConstrictions constrictions(double merge_overlap);

 private:
  void add_images(std::span<const Sphere> grains, double margin);
  void triangulate();
  void void_spheres();
  bool counted(const Vec3& point) const;
  bool between_grains(const Vec3& point) const;
  Vec3 wrapped(const Vec3& point) const;
  Vec3 middle_of(std::size_t cell) const;
  bool near_period(const Vec3& point) const;
  bool overlap(std::size_t cell, std::size_t other, double share) const;
  void join_flat_cells(UnionFind& pores, double merge_overlap) const;
  std::optional<Constriction> constriction_of(const Triangulation::Facet& facet) const;
  const Sphere& grain(Triangulation::Vertex_handle vertex) const { return grains_[vertex->info()]; }

  SphereBox box_;
  std::vector<Sphere> grains_;  ///< with images
  double largest_radius_ = 0;
  Vec3 low_ = Vec3::Constant(std::numeric_limits<double>::max()), high_ = -low_;  ///< of the centres
  std::optional<SphereGrid> grid_;
  Triangulation triangulation_;
  std::vector<std::vector<std::size_t>> beside_;  ///< neighbours of each grain in the triangulation
  std::vector<Triangulation::Cell_handle> cells_;
  std::vector<VoidSphere> spheres_;  ///< of each finite cell; radius 0 where there is none
};

void Network::add_images(std::span<const Sphere> grains, double margin) {
  const Vec3 length = box_.high - box_.low;
  std::array<std::vector<double>, 3> shifts;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    const int images = box_.periodic[axis] ? static_cast<int>(std::ceil(margin / length[i] + 0.04)) : 0;
    for (int image = -images; image <= images; ++image) shifts[axis].push_back(image * length[i]);
  }
  for (const double x : shifts[0])
    for (const double y : shifts[1])
      for (const double z : shifts[2])
        for (const Sphere& original : grains) {
          const Vec3 centre = original.centre + Vec3(x, y, z);
          bool near = true;
          for (int axis = 0; axis < 3; ++axis)
            if (box_.periodic[static_cast<std::size_t>(axis)])
              near = near && centre[axis] >= box_.low[axis] - margin &&
                     centre[axis] <= box_.high[axis] + margin + kOffset[axis] * length[axis];
          if (near) grains_.push_back({centre, original.radius});
        }
}

void Network::triangulate() {
  std::vector<std::pair<Kernel::Weighted_point_3, std::size_t>> points;
  points.reserve(grains_.size());
  for (std::size_t i = 0; i < grains_.size(); ++i) {
    const Vec3& c = grains_[i].centre;
    points.emplace_back(
        Kernel::Weighted_point_3(Kernel::Point_3(c.x(), c.y(), c.z()), grains_[i].radius * grains_[i].radius),
        i);
  }
  triangulation_.insert(points.begin(), points.end());
  if (triangulation_.dimension() < 3)
    throw_user_error({"constriction", "grains", "all in one plane", "fill a volume", ""});
  beside_.resize(grains_.size());
  for (auto edge = triangulation_.finite_edges_begin(); edge != triangulation_.finite_edges_end(); ++edge) {
    const std::size_t one = edge->first->vertex(edge->second)->info(),
                      other = edge->first->vertex(edge->third)->info();
    beside_[one].push_back(other);
    beside_[other].push_back(one);
  }
}

void Network::void_spheres() {
  for (const auto cell : triangulation_.finite_cell_handles()) {
    cell->info() = cells_.size();
    cells_.push_back(cell);
    std::array<const Sphere*, 4> corners{};
    for (int i = 0; i < 4; ++i) corners[static_cast<std::size_t>(i)] = &grain(cell->vertex(i));
    std::optional<VoidSphere> sphere = tangent_sphere(corners);
    if (sphere)
      for (int i = 0; i < 4; ++i)
        for (const std::size_t other : beside_[cell->vertex(i)->info()])
          sphere->radius = std::min(sphere->radius,
                                    (grains_[other].centre - sphere->centre).norm() - grains_[other].radius);
    spheres_.push_back(sphere && sphere->radius > 0 ? *sphere : VoidSphere{});
  }
}

bool Network::counted(const Vec3& point) const {
  const Vec3 length = box_.high - box_.low;
  for (int axis = 0; axis < 3; ++axis) {
    if (!box_.periodic[static_cast<std::size_t>(axis)]) continue;
    const double from_low = point[axis] - box_.low[axis] - kOffset[axis] * length[axis];
    if (from_low < 0 || from_low >= length[axis]) return false;
  }
  return true;
}

/// Along directions that are not periodic, not beyond the outermost centres.
bool Network::between_grains(const Vec3& point) const {
  for (int axis = 0; axis < 3; ++axis)
    if (!box_.periodic[static_cast<std::size_t>(axis)] &&
        (point[axis] < low_[axis] || point[axis] > high_[axis]))
      return false;
  return true;
}

Vec3 Network::middle_of(std::size_t cell) const {
  Vec3 middle = Vec3::Zero();
  for (int i = 0; i < 4; ++i) middle += grain(cells_[cell]->vertex(i)).centre / 4;
  return middle;
}

/// In the counted period or within half of the largest grain of it.
bool Network::near_period(const Vec3& point) const {
  const Vec3 length = box_.high - box_.low;
  for (int axis = 0; axis < 3; ++axis) {
    if (!box_.periodic[static_cast<std::size_t>(axis)]) continue;
    const double from_low = point[axis] - box_.low[axis] - kOffset[axis] * length[axis];
    if (from_low < -largest_radius_ || from_low >= length[axis] + largest_radius_) return false;
  }
  return true;
}

Vec3 Network::wrapped(const Vec3& point) const {
  const Vec3 length = box_.high - box_.low;
  Vec3 result = point;
  for (int axis = 0; axis < 3; ++axis)
    if (box_.periodic[static_cast<std::size_t>(axis)])
      result[axis] -=
          length[axis] * std::floor((point[axis] - box_.low[axis]) / length[axis] - kOffset[axis]);
  return result;
}

std::optional<Constriction> Network::constriction_of(const Triangulation::Facet& facet) const {
  std::array<const Sphere*, 3> corner{};
  std::size_t next = 0;
  for (int i = 0; i < 4; ++i)
    if (i != facet.second) corner[next++] = &grain(facet.first->vertex(i));
  const Vec3 along = (corner[1]->centre - corner[0]->centre).normalized();
  const Vec3 normal = along.cross(corner[2]->centre - corner[0]->centre).normalized();
  const Vec3 across = normal.cross(along);
  const auto in_plane = [&](const Vec3& point) {
    const Vec3 from = point - corner[0]->centre;
    return Eigen::Vector2d(from.dot(along), from.dot(across));
  };
  std::array<Circle, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = {in_plane(corner[i]->centre), corner[i]->radius};
  const std::optional<Circle> between = disc_between(corners);
  if (!between) return std::nullopt;
  const auto in_space = [&](const Circle& disc) -> Vec3 {
    return corner[0]->centre + disc.centre.x() * along + disc.centre.y() * across;
  };
  // Grains that cut the plane near the disc between the corners, or near the face itself.
  std::vector<Circle> around;
  const auto look = [&](const Vec3& centre, double radius) {
    grid_->near(centre, radius, [&](std::size_t other) {
      const Sphere& sphere = grains_[other];
      if (&sphere == corner[0] || &sphere == corner[1] || &sphere == corner[2]) return;
      const double height = (sphere.centre - corner[0]->centre).dot(normal);
      if (std::abs(height) < sphere.radius)
        around.push_back(
            {in_plane(sphere.centre), std::sqrt(sphere.radius * sphere.radius - height * height)});
    });
  };
  const Vec3 middle = (corner[0]->centre + corner[1]->centre + corner[2]->centre) / 3;
  double reach = 0;
  for (const Sphere* one : corner) reach = std::max(reach, (one->centre - middle).norm());
  // A disc larger than the face lies mostly outside of it (corners almost in a line) and is not its
  // constriction.
  const bool is_of_face = between->radius <= reach;
  if (is_of_face) look(in_space(*between), between->radius);
  if (is_of_face && std::all_of(around.begin(), around.end(),
                                [&](const Circle& circle) { return are_apart(*between, circle); }))
    return Constriction{in_space(*between), normal, 2 * between->radius};
  around.clear();
  look(middle, reach);
  const std::optional<Circle> disc = disc_beside_intruders(corners, around);
  if (!disc) return std::nullopt;
  return Constriction{in_space(*disc), normal, 2 * disc->radius};
}

/// The same disc found in several faces, but for round-off, is kept once.
std::vector<Constriction> without_repeats(std::vector<Constriction> all) {
  std::sort(all.begin(), all.end(),
            [](const Constriction& a, const Constriction& b) { return a.centre.x() < b.centre.x(); });
  std::vector<Constriction> kept;
  for (const Constriction& one : all) {
    const double tolerance = 1e-6 * one.diameter;
    bool known = false;
    for (auto other = kept.rbegin();
         !known && other != kept.rend() && other->centre.x() >= one.centre.x() - tolerance; ++other)
      known = (other->centre - one.centre).norm() <= tolerance &&
              std::abs(other->diameter - one.diameter) <= tolerance;
    if (!known) kept.push_back(one);
  }
  return kept;
}

/// Whether the void spheres of two cells overlap by more than a share of the smaller one's diameter.
bool Network::overlap(std::size_t cell, std::size_t other, double share) const {
  const VoidSphere &one = spheres_[cell], &two = spheres_[other];
  const double smaller = std::min(one.radius, two.radius);
  return smaller > 0 &&
         one.radius + two.radius - (one.centre - two.centre).norm() > 2 * smaller * share * (1 - kTouch);
}

/// A cell without a void sphere of its own (four grains nearly in a plane) is a window: its neighbours are
/// compared with each other through it, and it goes to the one behind its widest face.
void Network::join_flat_cells(UnionFind& pores, double merge_overlap) const {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (spheres_[i].radius > 0 || !near_period(middle_of(i))) continue;
    double widest = 0;
    std::optional<std::size_t> behind;
    std::vector<std::size_t> neighbours;
    for (int face = 0; face < 4; ++face) {
      const auto other = cells_[i]->neighbor(face);
      if (triangulation_.is_infinite(other)) continue;
      for (const std::size_t known : neighbours)
        if (overlap(known, other->info(), merge_overlap)) pores.join(known, other->info());
      neighbours.push_back(other->info());
      const std::optional<Constriction> disc = constriction_of({cells_[i], face});
      if (disc && disc->diameter > widest) {
        widest = disc->diameter;
        behind = other->info();
      }
    }
    if (behind) pores.join(i, *behind);
  }
}

PackingConstrictions Network::constrictions(double merge_overlap) {
  UnionFind pores(cells_.size());
  for (const auto& facet : triangulation_.finite_facets()) {
    const auto other = facet.first->neighbor(facet.second);
    if (triangulation_.is_infinite(facet.first) || triangulation_.is_infinite(other)) continue;
    if (overlap(facet.first->info(), other->info(), merge_overlap))
      pores.join(facet.first->info(), other->info());
  }
  join_flat_cells(pores, merge_overlap);
  PackingConstrictions result;
  std::vector<Constriction> found;
  for (const auto& facet : triangulation_.finite_facets()) {
    const auto other = facet.first->neighbor(facet.second);
    if (triangulation_.is_infinite(facet.first) || triangulation_.is_infinite(other)) continue;
    if (pores.root(facet.first->info()) == pores.root(other->info())) continue;
    Vec3 middle = Vec3::Zero();  // a face is of the period that its middle is in
    for (int i = 0; i < 4; ++i)
      if (i != facet.second) middle += grain(facet.first->vertex(i)).centre / 3;
    if (!counted(middle)) continue;
    if (const std::optional<Constriction> one = constriction_of(facet))
      found.push_back({wrapped(one->centre), one->normal, one->diameter});
    else
      ++result.closed;
  }
  result.constrictions = without_repeats(std::move(found));
  std::map<std::size_t, std::size_t> largest;  // pore → the cell with its largest sphere
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (spheres_[i].radius <= 0) continue;
    const auto [at, is_new] = largest.try_emplace(pores.root(i), i);
    if (!is_new && spheres_[i].radius > spheres_[at->second].radius) at->second = i;
    if (counted(spheres_[i].centre)) ++result.cells;
  }
  for (const auto& [pore, cell] : largest)
    if (counted(spheres_[cell].centre)) result.pore_diameters.push_back(2 * spheres_[cell].radius);
  return result;
}

}  // namespace

PackingConstrictions packing_constrictions(std::span<const Sphere> grains, const SphereBox& box,
                                           double merge_overlap) {
  check(grains, box);
  if (!(merge_overlap >= 0 && merge_overlap <= 1))
    throw_user_error(
        {"constriction", "merge overlap", fmt::format("{:g}", merge_overlap), "be between 0 and 1", ""});
  std::vector<Sphere> wrapped(grains.begin(), grains.end());
  for (Sphere& grain : wrapped)
    for (int axis = 0; axis < 3; ++axis)
      if (box.periodic[static_cast<std::size_t>(axis)]) {
        const double length = box.high[axis] - box.low[axis];
        grain.centre[axis] -= length * std::floor((grain.centre[axis] - box.low[axis]) / length);
      }
  double largest = 0;
  for (const Sphere& grain : wrapped) largest = std::max(largest, 2 * grain.radius);
  double margin = 1.5 * largest;
  for (int attempt = 0;; ++attempt) {
    Network network(wrapped, box, margin);
    // Grains that a void sphere of the period may touch are within its radius and theirs; their neighbours
    // further.
    const double reach = network.largest_void_radius() + largest;
    if (reach <= margin || attempt == 3 ||
        std::none_of(box.periodic.begin(), box.periodic.end(), [](bool p) { return p; }))
      return network.constrictions(merge_overlap);
    margin = 1.1 * reach;
  }
}

}  // namespace suffuse::analysis
