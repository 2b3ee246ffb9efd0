#include "water_walls.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "checkpoint_contents.h"
#include "suffuse/common/count_text.h"
#include "suffuse/common/error.h"
#include "suffuse/lbm/wall_shapes.h"
#include "suffuse/lbm/wall_spaces.h"

namespace suffuse::coupling {

namespace {

lbm::Index3 cell_of(const Vec3& point, const Vec3& origin, double spacing, const lbm::Fluid& fluid) {
  lbm::Index3 cell{};
  for (int a = 0; a < 3; ++a) {
    const auto at = static_cast<std::size_t>(a);
    const int cells = fluid.decomposition().cells()[at];
    constexpr double far = 1e9;  // lost grains are told elsewhere
    cell[at] = static_cast<int>(std::clamp(std::floor((point[a] - origin[a]) / spacing), -far, far));
    if (fluid.settings().faces[2 * at].kind == lbm::FaceKind::periodic)
      cell[at] = (cell[at] % cells + cells) % cells;
  }
  return cell;
}

/// Cells whose spaces hold water; none: all spaces do.
std::vector<lbm::Index3> wet_cells(const Scene& scene, const WallSettings& settings) {
  const CoupledSimulation& simulation = scene.simulation;
  using Water = WallSettings::Water;
  std::vector<Vec3> points;
  if (settings.water == Water::at_points) points = settings.points;
  if (settings.water == Water::with_grains && !inserts_grains(scene.lmp)) points = scene.port.centres();
  std::vector<lbm::Index3> cells;
  for (const Vec3& point : points) {
    cells.push_back(cell_of(point, simulation.origin(), simulation.units().spacing(), simulation.fluid()));
    for (std::size_t a = 0; a < 3 && settings.water == Water::at_points; ++a)
      if (cells.back()[a] < 0 || cells.back()[a] >= simulation.fluid().decomposition().cells()[a])
        throw_user_error({"lbm walls", "water at",
                          fmt::format("{:g} {:g} {:g}", point[0], point[1], point[2]), "lie in the fluid",
                          "give a point (m) on the side of the walls that holds water"});
  }
  return cells;
}

/// On which face of the water does a plane lie? Nothing if on none.
std::optional<lbm::Face> face_under(const lbm::WallShape& shape, const lbm::Index3& cells) {
  const auto* plane = std::get_if<lbm::PlaneWall>(&shape);
  if (plane == nullptr) return std::nullopt;
  const double high = cells[static_cast<std::size_t>(plane->axis)];
  if (std::abs(plane->position) < lbm::kOnFace) return lbm::face_at(plane->axis, false);
  if (std::abs(plane->position - high) < lbm::kOnFace) return lbm::face_at(plane->axis, true);
  return std::nullopt;
}

std::string state_text(const ScriptWall& wall, bool acts, const lbm::Fluid& fluid) {
  if (wall.open) return "open to water, as asked for";
  if (acts) return "solid for water";
  if (const auto face = face_under(wall.shape, fluid.decomposition().cells()))
    return fmt::format("on face {}, which is {} for water", lbm::name_of(*face),
                       lbm::name_of(fluid.settings().faces[static_cast<std::size_t>(*face)].kind));
  return "outside of the water, or on its faces";
}

/// What to write for water to pass one of these walls.
std::string how_to_open(const std::vector<ScriptWall>& walls) {
  if (walls.size() == 1) return fmt::format("`lbm walls open {}`", walls.front().id);
  std::string ids;
  for (const ScriptWall& wall : walls) ids += (ids.empty() ? "" : ", ") + wall.id;
  return fmt::format("`lbm walls open ID` (of {})", ids);
}

/// Share of all cells that lie behind walls. Collective.
double closed_share(const lbm::Walls& walls, const lbm::Decomposition& decomposition) {
  double closed = std::accumulate(walls.closed.begin(), walls.closed.end(), 0.);
  MPI_Allreduce(MPI_IN_PLACE, &closed, 1, MPI_DOUBLE, MPI_SUM, decomposition.communicator());
  return closed / static_cast<double>(lbm::CellBox{{0, 0, 0}, decomposition.cells()}.volume());
}

/// Faces through which water should pass, and that lie behind walls with all of their cells: the walls are to
/// be sieves. Collective.
void refuse_faces_behind(const lbm::Walls& walls, const lbm::Fluid& fluid, const std::string& opening) {
  const lbm::CellBox& box = fluid.decomposition().local_box();
  std::array<int, lbm::kFaces> open{};  // has it a cell with water?
  std::size_t n = 0;
  lbm::for_each_cell(box, [&](int x, int y, int z) {
    const lbm::Index3 cell{x, y, z};
    const bool closed = !walls.closed.empty() && walls.closed[n] != 0;
    ++n;
    for (std::size_t f = 0; f < lbm::kFaces && !closed; ++f) {
      const int last = lbm::is_high(static_cast<lbm::Face>(f)) ? fluid.decomposition().cells()[f / 2] - 1 : 0;
      if (cell[f / 2] == last) open[f] = 1;
    }
  });
  MPI_Allreduce(MPI_IN_PLACE, open.data(), lbm::kFaces, MPI_INT, MPI_MAX,
                fluid.decomposition().communicator());
  for (std::size_t f = 0; f < lbm::kFaces; ++f) {
    const lbm::FaceKind kind = fluid.settings().faces[f].kind;
    if (open[f] != 0 || (kind != lbm::FaceKind::pressure && kind != lbm::FaceKind::velocity)) continue;
    throw_user_error(
        {"lbm walls", "face " + lbm::name_of(static_cast<lbm::Face>(f)), lbm::name_of(kind) + " behind walls",
         "let water pass",
         fmt::format("{} makes a wall let it pass, `lbm walls water all` fills both sides of walls; or write "
                     "`lbm boundary {} noslip`",
                     opening, lbm::name_of(static_cast<lbm::Face>(f)))});
  }
}

}  // namespace

bool WaterWalls::follow(const Scene& scene, const WallSettings& settings, const std::string& saved_state) {
  CoupledSimulation& simulation = scene.simulation;
  const lbm::Fluid& fluid = simulation.fluid();
  origin_ = simulation.origin();
  spacing_ = simulation.units().spacing();
  const std::vector<ScriptWall> walls = walls_of_script(scene.lmp, settings.open, origin_, spacing_);
  std::string now;
  for (const ScriptWall& wall : walls)
    now += fmt::format("{} {}{}; ", wall.name, wall.geometry, wall.open ? " open" : "");
  if (now == known_) return false;
  std::vector<lbm::WallShape> shapes;
  for (const ScriptWall& wall : walls)
    shapes.push_back(wall.open ? lbm::WallShape(lbm::MeshWall{}) : wall.shape);
  lbm::WallCuts cuts = lbm::cut_links(fluid.decomposition(), fluid.settings().faces, shapes);
  std::string acting;
  acting_.clear();
  lines_.clear();
  for (std::size_t n = 0; n < walls.size(); ++n) {
    const ScriptWall& wall = walls[n];
    const bool acts = cuts.count[n] > 0;
    if (acts && wall.slides) refuse_sliding(wall);
    lines_.push_back(fmt::format("{:<12}{} ({}): {}", n == 0 ? "walls" : "", wall.name, wall.geometry,
                                 state_text(wall, acts, fluid)));
    if (!acts) continue;
    acting_.push_back(wall);
    acting += fmt::format("{} {}; ", wall.name, wall.geometry);
  }
  const auto saved =
      saved_state.empty() ? std::nullopt : load_closed_cells(saved_state, fluid.decomposition(), acting);
  const lbm::Walls water =
      saved ? lbm::divide(fluid.decomposition(), fluid.settings().faces, std::move(cuts.links), *saved)
            : lbm::divide(fluid.decomposition(), fluid.settings().faces, std::move(cuts.links),
                          wet_cells(scene, settings));
  if (const double share = closed_share(water, fluid.decomposition()); share > 0)
    lines_.push_back(
        fmt::format("{:<12}{:.3g} % of the box lie behind them, without water (`lbm walls water` decides)",
                    "", 100 * share));
  refuse_faces_behind(water, fluid, how_to_open(acting_));
  simulation.set_walls(water, acting);
  known_ = now;
  return true;
}

void refuse_grains_behind_walls(const CoupledSimulation& simulation) {
  if (const long grains = simulation.grains_behind_walls(); grains > 0)
    throw_user_error(
        {"lbm run", "grains", count_text(grains, "grain") + " behind walls, where there is no water",
         "stay on the sides of the walls that hold water",
         "write `lbm walls water all`, or `lbm walls water at X Y Z` for each space with water"});
}

std::vector<std::pair<int, double>> WaterWalls::planes() const {
  std::vector<std::pair<int, double>> planes;
  for (const ScriptWall& wall : acting_)
    if (const auto* plane = std::get_if<lbm::PlaneWall>(&wall.shape))
      planes.emplace_back(plane->axis, origin_[plane->axis] + spacing_ * plane->position);
  return planes;
}

}  // namespace suffuse::coupling
