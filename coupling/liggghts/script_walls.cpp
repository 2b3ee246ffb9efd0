#include "script_walls.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>

#include "fix_mesh_surface.h"
#include "fix_move_mesh.h"
#include "fix_wall_gran.h"
#include "lammps.h"
#include "modify.h"
#include "primitive_wall.h"
#include "suffuse/common/checksum.h"
#include "suffuse/common/count_text.h"
#include "suffuse/common/error.h"
#include "tri_mesh.h"

namespace suffuse::coupling {

namespace {

using LAMMPS_NS::FixMeshSurface;
using LAMMPS_NS::FixWallGran;
using LAMMPS_NS::LAMMPS;
using LAMMPS_NS::PrimitiveWall;

/// Vector from a point to the wall, m.
Vec3 to_wall(PrimitiveWall& wall, Vec3 point) {
  Vec3 vector = Vec3::Zero();
  wall.resolveContact(point.data(), 0, vector.data());
  return vector;
}

/// LIGGGHTS tells a plane by what it answers to points: at the origin, the position; where that is 0, the
/// axis shows at another point.
lbm::PlaneWall plane_of(PrimitiveWall& wall) {
  const Vec3 from_origin = to_wall(wall, Vec3::Zero()), from_ones = to_wall(wall, Vec3::Ones());
  lbm::PlaneWall plane;
  for (int a = 0; a < 3; ++a)
    if (from_origin[a] != 0 || from_ones[a] != 0) plane.axis = a;
  plane.position = from_origin[plane.axis];
  return plane;
}

lbm::CylinderWall cylinder_of(PrimitiveWall& wall) {
  lbm::CylinderWall cylinder;
  cylinder.axis = wall.axis();
  Vec3 point = Vec3::Zero(), offset = Vec3::Zero();
  wall.calcRadialDistance(point.data(), offset.data());
  if (cylinder.axis == 1) std::swap(offset[0], offset[2]);  // as it calls them
  cylinder.centre = -offset;
  cylinder.centre[cylinder.axis] = 0;
  // A metre from the axis: no wall of this kind is there, inside or outside.
  point = cylinder.centre;
  point[(cylinder.axis + 1) % 3] += 1;
  cylinder.radius = 1 + to_wall(wall, point)[(cylinder.axis + 1) % 3];
  return cylinder;
}

/// All triangles of a mesh, on every rank, in an order of their own. Before LIGGGHTS's first run every rank
/// has them all, later its own.
lbm::MeshWall mesh_of(FixMeshSurface& fix, MPI_Comm communicator) {
  constexpr std::size_t values = 9;
  using Triangle = std::array<double, values>;
  std::vector<Triangle> mine(static_cast<std::size_t>(fix.triMesh()->sizeLocal()));
  for (std::size_t i = 0; i < mine.size(); ++i)
    for (std::size_t corner = 0; corner < 3; ++corner)
      fix.triMesh()->node_slow(static_cast<int>(i), static_cast<int>(corner), mine[i].data() + 3 * corner);
  int ranks = 1, count = static_cast<int>(values * mine.size());
  MPI_Comm_size(communicator, &ranks);
  std::vector<int> counts(static_cast<std::size_t>(ranks)), offsets(counts.size(), 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, communicator);
  std::partial_sum(counts.begin(), counts.end() - 1, offsets.begin() + 1);
  std::vector<Triangle> all(static_cast<std::size_t>(offsets.back() + counts.back()) / values);
  MPI_Allgatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(), offsets.data(), MPI_DOUBLE,
                 communicator);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  lbm::MeshWall mesh;
  for (const Triangle& t : all)
    mesh.triangles.push_back({Vec3(t[0], t[1], t[2]), Vec3(t[3], t[4], t[5]), Vec3(t[6], t[7], t[8])});
  return mesh;
}

/// What moves a mesh or its surface; empty: nothing.
std::string mover_of(LAMMPS* lmp, FixMeshSurface& fix) {
  for (int i = 0; i < lmp->modify->nfix; ++i)
    if (auto* move = dynamic_cast<LAMMPS_NS::FixMoveMesh*>(lmp->modify->fix[i]);
        move != nullptr && move->fixMesh() == &fix)
      return fmt::format("`fix {} move/mesh`", move->id);
  if (fix.get_module("servo") != nullptr) return "its servo";
  if (fix.surfaceVel()) return "its surface velocity";
  return fix.mesh()->isMoving() ? "LIGGGHTS" : "";
}

[[noreturn]] void refuse(const std::string& id, const std::string& value, const std::string& rule,
                         const std::string& open_id) {
  throw_user_error(
      {"lbm walls", "fix " + id, value, rule,
       fmt::format("unfix it before `lbm run`, or write `lbm walls open {}` to let water pass", open_id)});
}

constexpr const char* kAtRest = "stand still to be solid for water";

template <class Point>
Point in_cells(const Point& point, const Vec3& origin, double spacing) {
  return (point - origin) / spacing;
}

ScriptWall primitive_wall(FixWallGran& fix, const Vec3& origin, double spacing) {
  ScriptWall wall;
  wall.id = wall.name = fix.id;
  PrimitiveWall& primitive = *fix.primitiveWall();
  if (primitive.axis() < 0) {
    lbm::PlaneWall plane = plane_of(primitive);
    wall.geometry = fmt::format("{}plane {:.10g} m", "xyz"[plane.axis], plane.position);
    plane.position = (plane.position - origin[plane.axis]) / spacing;
    wall.shape = plane;
    return wall;
  }
  lbm::CylinderWall cylinder = cylinder_of(primitive);
  const Vec3& centre = cylinder.centre;
  const int b = cylinder.axis == 0 ? 1 : 0, c = cylinder.axis == 2 ? 1 : 2;
  wall.geometry =
      fmt::format("{}cylinder, radius {:.10g} m about {} {:.10g}, {} {:.10g}", "xyz"[cylinder.axis],
                  cylinder.radius, "xyz"[b], centre[b], "xyz"[c], centre[c]);
  cylinder.centre = in_cells(centre, origin, spacing);
  cylinder.radius /= spacing;
  wall.shape = cylinder;
  return wall;
}

ScriptWall mesh_wall(LAMMPS* lmp, FixWallGran& fix, FixMeshSurface& mesh, const Vec3& origin,
                     double spacing) {
  ScriptWall wall;
  wall.id = mesh.id;
  wall.name = fmt::format("{} mesh {}", fix.id, mesh.id);
  lbm::MeshWall shape = mesh_of(mesh, lmp->world);
  Vec3 sum = Vec3::Zero(), low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  std::uint64_t print = 0;  // of the corners, in whatever order the triangles come
  for (auto& triangle : shape.triangles) {
    Checksum one;
    for (Vec3& corner : triangle) {
      for (const double x : corner) one.add_word(std::bit_cast<std::uint64_t>(x + 0.));
      sum += corner;
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
      corner = in_cells(corner, origin, spacing);
    }
    print += one.value() ^ (one.value() >> 32);
  }
  wall.geometry = count_text(static_cast<std::int64_t>(shape.triangles.size()), "triangle");
  if (!shape.triangles.empty())
    wall.geometry += fmt::format(" from {:.6g} {:.6g} {:.6g} to {:.6g} {:.6g} {:.6g} m, sum {:08x}", low[0],
                                 low[1], low[2], high[0], high[1], high[2], print & 0xffffffffU);
  wall.shape = std::move(shape);
  return wall;
}

bool names(const std::vector<std::string>& ids, const char* id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

}  // namespace

std::vector<ScriptWall> walls_of_script(LAMMPS* lmp, const std::vector<std::string>& open, const Vec3& origin,
                                        double spacing) {
  std::vector<ScriptWall> walls;
  for (int i = 0; i < lmp->modify->nfix; ++i) {
    LAMMPS_NS::Fix* fix = lmp->modify->fix[i];
    const std::string style = fix->style;
    if (!style.starts_with("wall")) continue;
    const bool fix_open = names(open, fix->id);
    auto* granular = dynamic_cast<FixWallGran*>(fix);
    if (granular == nullptr || !style.starts_with("wall/gran")) {
      if (!fix_open) refuse(fix->id, style, "be a wall/gran to be solid for water", fix->id);
      continue;
    }
    if (!granular->is_mesh_wall()) {
      walls.push_back(primitive_wall(*granular, origin, spacing));
      walls.back().slides = granular->is_moving() != 0;
      walls.back().open = fix_open;
      continue;
    }
    for (int m = 0; m < granular->n_meshes(); ++m) {
      FixMeshSurface& mesh = *granular->mesh_list()[m];
      const bool mesh_open = names(open, mesh.id) || fix_open;
      if (const std::string mover = mover_of(lmp, mesh); !mover.empty() && !mesh_open)
        refuse(fix->id, fmt::format("mesh {}, moved by {}", mesh.id, mover), kAtRest, mesh.id);
      walls.push_back(mesh_wall(lmp, *granular, mesh, origin, spacing));
      walls.back().open = mesh_open;
    }
  }
  return walls;
}

void refuse_sliding(const ScriptWall& wall) {
  refuse(wall.name, "a primitive wall with `shear`", kAtRest, wall.name);
}

void require_walls(LAMMPS* lmp, const std::vector<std::string>& ids) {
  std::vector<std::string> unknown = ids;
  for (int i = 0; i < lmp->modify->nfix; ++i) {
    if (!std::string(lmp->modify->fix[i]->style).starts_with("wall")) continue;
    std::erase(unknown, lmp->modify->fix[i]->id);
    if (auto* granular = dynamic_cast<FixWallGran*>(lmp->modify->fix[i]); granular != nullptr)
      for (int m = 0; m < granular->n_meshes(); ++m) std::erase(unknown, granular->mesh_list()[m]->id);
  }
  if (!unknown.empty())
    throw_user_error(
        {"lbm walls", "open", unknown.front(),
         "be the ID of a `fix wall/gran`, or of a mesh of one, that exists at the first `lbm run`",
         "drop it, or define the wall before"});
}

bool inserts_grains(LAMMPS* lmp) {
  for (int i = 0; i < lmp->modify->nfix; ++i)
    if (std::string(lmp->modify->fix[i]->style).starts_with("insert/")) return true;
  return false;
}

}  // namespace suffuse::coupling
