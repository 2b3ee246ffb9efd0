#include "lbm_accuracy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../liggghts/fine_diameter.h"
#include "../liggghts/fluid_box.h"
#include "suffuse/common/error.h"
#include "suffuse/coupling/accuracy_choice.h"
#include "suffuse/coupling/effects.h"
#include "suffuse/micromechanics/seepage.h"

namespace suffuse::coupling {

namespace {

/// Water between grains at its fastest, over its mean there: in packings of spheres some two to three.
constexpr double kFastestInPores = 2.5;
/// Solid fraction from which on grains are a bed, whose drag is Ergun's and which carries its water along.
constexpr double kBed = 0.3;
/// And below which Ergun's law, made for beds, says nothing of the speed.
constexpr double kSparse = 0.05;
/// Of the critical gradient: what a bed whose drive is not known yet will be driven by.
constexpr double kDriveOfBed = 1.5;

/// What the script says of flow and grains, SI.
struct Drive {
  double superficial = 0, pressure_range = 0, grain_speed = 0;
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

double speed_of_faces(LAMMPS_NS::LAMMPS* lmp, const LbmRequest& settings) {
  double speed = 0;
  for (const ScriptFace& face : settings.faces)
    if (face.kind == lbm::FaceKind::velocity) speed = std::max(speed, face.velocity.now(lmp).norm());
  return speed;
}

/// In a bed water flows as Ergun says, and grains that may move are lifted and go with it; grains apart from
/// each other fall alone.
Drive drive_of(LAMMPS_NS::LAMMPS* lmp, const LbmRequest& settings, const LiggghtsPort::Summary& grains,
               bool grains_move, const Vec3& size) {
  const lbm::UnitsRequest& units = settings.units;
  const double gravity = settings.gravity.now(lmp).norm(), heavier = grains.largest_density / units.density;
  const bool bed = grains.packing > kBed;
  const double porosity = 1 - std::min(grains.packing, 0.7);
  const micromechanics::SeepageFluid water{units.density, units.viscosity, 9.81};
  const Vec3 drops = pressure_drops(lmp, settings, size);
  Drive drive;
  drive.superficial = speed_of_faces(lmp, settings);
  drive.from = "the faces' velocity";
  drive.pressure_range = drops.maxCoeff();
  double gradient = drops.cwiseQuotient(size).maxCoeff() / (units.density * 9.81);
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

std::string percent(double share) {
  return fmt::format("{:.2g} %", 100 * share);
}

std::string lattice_line(const AccuracyChoice& choice, const AccuracyScene& scene,
                         const std::string& region) {
  return fmt::format("lbm lattice spacing {} relaxation_time {} max_velocity {} precision {}{}",
                     choice.spacing, choice.relaxation_time, scene.velocity,
                     choice.precision == lbm::Precision::float_precision ? "float" : "double",
                     region.empty() ? "" : " region " + region);
}

std::string neighbour_line(const char* name, double cells, double accuracy, const AccuracyScene& scene,
                           const AccuracyChoice& chosen) {
  if (fitting_spacing(scene.size, scene.fine_diameter / cells) <= 0) return "";
  const AccuracyChoice other = choice_with_cells(cells, accuracy, scene);
  return fmt::format("lbm accuracy: {:<11}{:.2g} cells: about {}, {:.2g} times the time\n", name, other.cells,
                     percent(other.errors.together()), other.cost / chosen.cost);
}

std::string text_of(const AccuracyChoice& choice, const AccuracyScene& scene, const AccuracyRequest& request,
                    const std::string& velocity_from) {
  const AccuracyErrors& errors = choice.errors;
  std::string text = fmt::format("lbm accuracy: {} asked for, about {} to be expected\n",
                                 percent(request.accuracy), percent(errors.together()));
  text += fmt::format(
      "lbm accuracy: cells      {:.3g} per diameter of the finest quarter of the grains' surface ({:.4g} m): "
      "{}, "
      "worst packing tried {}\n",
      choice.cells, scene.fine_diameter, percent(errors.resolution),
      percent(largest_permeability_error(choice.cells)));
  text += fmt::format(
      "lbm accuracy: time step  {:.4g} s, bound by {}: Mach number {:.2g} ({}) at {:.3g} m/s, {}; density "
      "{}\n",
      choice.time_step, choice.bound, choice.mach, percent(errors.compressibility), scene.velocity,
      velocity_from, percent(errors.density));
  text += fmt::format("lbm accuracy: precision  {}\n",
                      choice.precision == lbm::Precision::float_precision
                          ? "float: five digits are the same"
                          : "double: slow water, or fine accuracy, would lose digits");
  if (errors.motion > 0)
    text += fmt::format("lbm accuracy: collision  {}: grains at {:.2g} viscosities a cell ({})\n",
                        name_of(choice.collision), scene.grain_speed * choice.spacing / scene.viscosity,
                        percent(errors.motion));
  text += neighbour_line("cheaper", 0.8 * choice.cells, request.accuracy, scene, choice);
  text += neighbour_line("dearer", 1.25 * choice.cells, request.accuracy, scene, choice);
  return text + "lbm accuracy: the same is `" + lattice_line(choice, scene, request.region) + "`\n";
}

}  // namespace

DrivenScene driven_scene(LAMMPS_NS::LAMMPS* lmp, const LiggghtsPort& port, const LbmRequest& settings,
                         std::optional<double> largest_velocity, const std::string& region) {
  const LiggghtsPort::Summary grains = port.summary();
  DrivenScene driven;
  AccuracyScene& scene = driven.scene;
  scene.size = fluid_box(lmp, port, region).size;
  scene.density = settings.units.density;
  scene.viscosity = settings.units.viscosity;
  if (grains.grains == 0) {
    scene.velocity = largest_velocity.value_or(0);
    return driven;
  }
  const bool grains_move = port.anything_moves();
  scene.fine_diameter = fine_diameter(port, grains);
  const Drive drive = drive_of(lmp, settings, grains, grains_move, scene.size);
  const double porosity = 1 - std::min(grains.packing, 0.7);
  const double fastest = grains.packing > kBed ? kFastestInPores * drive.superficial / porosity
                                               : std::max(1.5 * drive.superficial, drive.grain_speed);
  driven.velocity_from = largest_velocity ? "as given" : "from " + drive.from;
  scene.velocity = largest_velocity.value_or(fastest);
  scene.pressure_range = drive.pressure_range;
  // A bed's grains carry their water along; a grain alone does not.
  if (grains.packing > kBed && grains_move) scene.grain_speed = std::min(drive.grain_speed, scene.velocity);
  if (grains_move) scene.response_time = response_time(2 * grains.smallest_radius, grains, settings.units);
  return driven;
}

void set_accuracy(LAMMPS_NS::LAMMPS* lmp, const AccuracyRequest& request, const LiggghtsPort& port,
                  LbmRequest& settings) {
  const auto [scene, velocity_from] =
      driven_scene(lmp, port, settings, request.largest_velocity, request.region);
  const AccuracyChoice choice = choose_for_accuracy(request.accuracy, scene);
  lbm::UnitsRequest& units = settings.units;
  units.spacing = choice.spacing;
  units.relaxation_time = choice.relaxation_time;
  units.time_step.reset();
  units.mach.reset();
  units.largest_velocity = scene.velocity;
  settings.precision = choice.precision;
  settings.collision.collision_operator = choice.collision;
  settings.region = request.region;
  settings.lattice_given = true;
  tell(lmp, text_of(choice, scene, request, velocity_from));
}

}  // namespace suffuse::coupling
