#include "driven_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "../liggghts/fine_diameter.h"
#include "../liggghts/fluid_box.h"
#include "../liggghts/script_walls.h"
#include "suffuse/coupling/accuracy_choice.h"
#include "suffuse/coupling/effects.h"
#include "suffuse/micromechanics/seepage.h"

namespace suffuse::coupling {

namespace {

/// Water between grains at its fastest, over its mean there: in packings of spheres some two to three.
constexpr double kFastestInPores = 2.5;
/// Solid fraction below which Ergun's law, made for beds, says nothing of the speed.
constexpr double kSparse = 0.05;
/// Of the critical gradient: what a bed whose drive is not known yet will be driven by.
constexpr double kDriveOfBed = 1.5;

/// What the script says of flow and grains, SI.
struct Drive {
  double superficial = 0, pressure_range = 0, grain_speed = 0;
  int axis = 2;      ///< of the flow
  std::string from;  ///< in words
};

/// Drops of pressure along each axis, Pa, from faces and gradient as they are now.
Vec3 pressure_drops(LAMMPS_NS::LAMMPS* lmp, const LbmRequest& settings, const Vec3& size) {
  Vec3 drops = settings.pressure_gradient.now(lmp).cwiseProduct(size).cwiseAbs();
  for (std::size_t a = 0; a < 3; ++a) {
    const ScriptFace &low = settings.faces[2 * a], &high = settings.faces[2 * a + 1];
    if (low.kind == lbm::FaceKind::pressure && high.kind == lbm::FaceKind::pressure)
      drops[static_cast<int>(a)] = std::abs(low.pressure.now(lmp) - high.pressure.now(lmp));
  }
  return drops;
}

/// Of the fastest face, m/s.
Vec3 velocity_of_faces(LAMMPS_NS::LAMMPS* lmp, const LbmRequest& settings) {
  Vec3 fastest = Vec3::Zero();
  for (const ScriptFace& face : settings.faces)
    if (face.kind == lbm::FaceKind::velocity)
      if (const Vec3 now = face.velocity.now(lmp); now.norm() > fastest.norm()) fastest = now;
  return fastest;
}

int largest_component(const Vec3& vector) {
  int axis = 0;
  vector.cwiseAbs().maxCoeff(&axis);
  return axis;
}

/// In a bed water flows as Ergun says, and grains that may move are lifted and go with it; grains apart from
/// each other fall alone.
Drive drive_of(LAMMPS_NS::LAMMPS* lmp, const LbmRequest& settings, const LiggghtsPort::Summary& grains,
               bool grains_move, const Vec3& size) {
  const lbm::UnitsRequest& units = settings.units;
  const double gravity = settings.gravity.now(lmp).norm(), heavier = grains.largest_density / units.density;
  const bool bed = grains.packing > kLeastBed;
  const double porosity = 1 - std::min(grains.packing, 0.7);
  const micromechanics::SeepageFluid water{units.density, units.viscosity, 9.81};
  const Vec3 drops = pressure_drops(lmp, settings, size);
  Drive drive;
  const Vec3 at_faces = velocity_of_faces(lmp, settings), gradients = drops.cwiseQuotient(size);
  drive.superficial = at_faces.norm();
  drive.from = "the faces' velocity";
  drive.pressure_range = drops.maxCoeff();
  if (grains.packing > kSparse) {
    const double by_faces =
        micromechanics::gradient_ergun(at_faces.norm(), grains.sauter_diameter, porosity, water);
    drive.pressure_range = std::max(
        drive.pressure_range, by_faces * units.density * 9.81 * grains.extent[largest_component(at_faces)]);
  }
  double gradient = gradients.maxCoeff() / (units.density * 9.81);
  drive.axis = largest_component(gradient > 0          ? gradients
                                 : at_faces.norm() > 0 ? at_faces
                                                       : settings.gravity.now(lmp));
  if (bed && grains_move && gravity > 0) {
    const double lifting = kDriveOfBed * std::abs(heavier - 1) * grains.packing * gravity / 9.81;
    gradient = std::max(gradient, lifting);
    drive.pressure_range = std::max(drive.pressure_range, lifting * units.density * 9.81 * size.maxCoeff());
  }
  if (grains.packing > kSparse && gradient > 0) {
    const double by_ergun = micromechanics::velocity_ergun(gradient, grains.sauter_diameter, porosity, water);
    if (by_ergun > drive.superficial)
      drive.from = fmt::format("Ergun's at a gradient of {:.3g}", gradient), drive.superficial = by_ergun;
  }
  if (grains_move && bed) drive.grain_speed = drive.superficial / porosity;
  if (grains_move && !bed) {
    drive.grain_speed = std::max(
        grains.speed, free_settling_velocity(2 * grains.largest_radius, heavier, gravity, units.viscosity));
    if (drive.grain_speed > drive.superficial) drive.from = "the fall of the largest grain alone";
  }
  return drive;
}

/// In which a grain of this diameter follows the water around it, s: Stokes' law, in a bed with the drag of
/// Ergun's viscous term on each grain, 150/18 of the solid fraction over the porosity squared (key:
/// ergun1952).
double response_time(double diameter, const LiggghtsPort::Summary& grains, const lbm::UnitsRequest& units) {
  const double solids = std::min(grains.packing, 0.7), porosity = 1 - solids;
  const double drag = std::max(1., 150. / 18 * solids / (porosity * porosity));
  return grains.smallest_density / units.density * diameter * diameter / (18 * units.viscosity * drag);
}

/// Sums over grains differ in their last digits from one number of ranks to another; what is chosen by them
/// does not.
double six_digits(double value) {
  return std::stod(fmt::format("{:.6g}", value));
}

/// With room for water between the bed and its face of the box; along periodic axes there is none.
int free_surfaces(const LiggghtsPort& port, const LiggghtsPort::Summary& grains, const FluidBox& box,
                  int axis) {
  if (port.periodic()[static_cast<std::size_t>(axis)]) return 0;
  const double below = grains.low[axis] - box.low[axis];
  const double above = box.low[axis] + box.size[axis] - (grains.low[axis] + grains.extent[axis]);
  return (below > grains.sauter_diameter ? 1 : 0) + (above > grains.sauter_diameter ? 1 : 0);
}

/// Does a wall of the script lie within the water's box, and act on it?
bool has_walls_inside(LAMMPS_NS::LAMMPS* lmp, const LbmRequest& settings, const FluidBox& box) {
  constexpr double unit = 1;  // positions in metres from the box's low corner
  for (const ScriptWall& wall : walls_of_script(lmp, settings.walls.open, box.low, unit)) {
    const auto* plane = std::get_if<lbm::PlaneWall>(&wall.shape);
    const double size = plane == nullptr ? 0 : box.size[plane->axis], near = 1e-3 * size;
    const bool outside = plane != nullptr && (plane->position < near || plane->position > size - near);
    if (!wall.open && !outside) return true;
  }
  return false;
}

/// What of the script the averaged flow has not; empty: nothing.
std::string not_averaged(LAMMPS_NS::LAMMPS* lmp, const LbmRequest& settings, const FluidBox& box) {
  const LbmRequest standard;
  const lbm::PartialSolidSettings &solids = settings.solids.cells, &usual = standard.solids.cells;
  if (settings.collision.collision_operator != standard.collision.collision_operator ||
      solids.solid_operator != usual.solid_operator || solids.weighting != usual.weighting)
    return "the script asks for operators of the resolved flow";
  if (settings.effects.turbulence == Switch::on || settings.effects.lubrication == Switch::on)
    return "it has neither turbulence nor films";
  if (has_walls_inside(lmp, settings, box)) return "it has no walls inside the water";
  return "";
}

}  // namespace

DrivenScene driven_scene(LAMMPS_NS::LAMMPS* lmp, const LiggghtsPort& port, const LbmRequest& settings,
                         std::optional<double> largest_velocity, const std::string& region) {
  const LiggghtsPort::Summary grains = port.summary();
  const FluidBox box = fluid_box(lmp, port, region);
  DrivenScene driven;
  AccuracyScene& scene = driven.scene;
  scene.size = box.size;
  scene.density = settings.units.density;
  scene.viscosity = settings.units.viscosity;
  if (grains.grains == 0) {
    scene.velocity = largest_velocity.value_or(0);
    return driven;
  }
  const bool grains_move = port.anything_moves();
  scene.counted_diameter = counted_diameter(fine_diameter(port, grains), grains.sauter_diameter);
  scene.solid_fraction = grains.packing;
  const Drive drive = drive_of(lmp, settings, grains, grains_move, scene.size);
  const double porosity = 1 - std::min(grains.packing, 0.7);
  const double fastest = grains.packing > kLeastBed ? kFastestInPores * drive.superficial / porosity
                                                    : std::max(1.5 * drive.superficial, drive.grain_speed);
  driven.velocity_from = largest_velocity ? "as given" : "from " + drive.from;
  scene.velocity = largest_velocity.value_or(fastest);
  scene.pressure_range = drive.pressure_range;
  // A bed's grains carry their water along; a grain alone does not.
  if (grains.packing > kLeastBed && grains_move)
    scene.grain_speed = std::min(drive.grain_speed, scene.velocity);
  if (grains_move) scene.response_time = response_time(2 * grains.smallest_radius, grains, settings.units);
  scene.sauter_diameter = grains.sauter_diameter;
  scene.smallest_diameter = 2 * grains.smallest_radius;
  scene.bed_length = grains.extent[drive.axis];
  scene.free_surfaces = free_surfaces(port, grains, box, drive.axis);
  if (grains_move)
    scene.falling =
        settings.gravity.now(lmp).norm() * std::abs(1 - settings.units.density / grains.smallest_density);
  if (scene.falling > 0 && grains.packing > kLeastBed) {
    scene.bed_stress = scene.falling * grains.smallest_density * grains.packing * scene.bed_length;
    scene.stiffness_number = port.stiffness_number(scene.bed_stress);
  }
  scene.not_averaged = not_averaged(lmp, settings, box);
  for (double* value : {&scene.counted_diameter, &scene.velocity, &scene.grain_speed, &scene.pressure_range,
                        &scene.sauter_diameter, &scene.solid_fraction, &scene.bed_length, &scene.falling})
    *value = six_digits(*value);
  return driven;
}

}  // namespace suffuse::coupling
