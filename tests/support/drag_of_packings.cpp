#include "drag_of_packings.h"

#include <mpi.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "grading/grain_snapshot.h"

namespace suffuse::coupling {

namespace {

/// Density of grains over that of water, where they count as movable.
constexpr double kQuartz = 2.65;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// The packing repeated so often, with the edge of the whole in cells.
struct Scaled {
  int repeats, cells;
  double edge;
};

Scaled fit(const Packing& packing, double diameter) {
  const double wanted = diameter / sauter_diameter(packing.radii);
  Scaled best{1, static_cast<int>(std::lround(wanted)), 0};
  const auto miss = [&](int repeats, int cells) { return std::abs(cells / (wanted * repeats) - 1); };
  const int most = packing.array && wanted < 24 ? 24 / static_cast<int>(wanted + 1) + 1 : 1;
  for (int repeats = 1; repeats <= most; ++repeats) {
    const int cells = static_cast<int>(std::lround(wanted * repeats));
    if (miss(repeats, cells) < miss(best.repeats, best.cells) - 1e-3) best = {repeats, cells, 0};
  }
  best.edge = static_cast<double>(best.cells) / best.repeats;
  return best;
}

/// A packing on the lattice, and how it is run.
struct Scene {
  lbm::Index3 cells;
  std::vector<PrescribedGrains::Grain> list;
  double total = 0, phi = 0, diameter = 0, nu = 0;
  CoupledSettings settings;
};

/// Mean D s/6 over partly covered cells, s the surface per volume of pore that the automatic coefficient
/// sees.
double mean_crowding(CoupledSettings settings, const lbm::Index3& cells, double diameter,
                     PrescribedGrains grains) {
  settings.solids.automatic_coefficient = true;
  settings.solids.cells.weighting = lbm::SolidWeighting::viscosity_independent;
  settings.solids.law = CoefficientLaw{{1, 0, 1, 0}};  // k = 1 + s/6
  CoupledSimulation simulation(settings, lbm::Decomposition::balanced(MPI_COMM_WORLD, cells), Vec3::Zero(),
                               grains);
  simulation.map();
  double sum = 0, covered = 0;
  lbm::for_each_cell({{0, 0, 0}, cells}, [&](int x, int y, int z) {
    const double fraction = simulation.fluid().solid_fraction({x, y, z}), weight = fraction * (1 - fraction);
    if (weight > 0) sum += weight * (simulation.solid_coefficient({x, y, z}) - 1);
    covered += weight;
  });
  return sum / covered * diameter;
}

Scene make_scene(const Packing& packing, double diameter, const DragRun& run) {
  const Scaled scaled = fit(packing, diameter);
  const int layer = static_cast<int>(std::lround(run.water * scaled.cells));
  Scene scene;
  scene.cells = {scaled.cells, scaled.cells, scaled.cells + 2 * layer};
  const Vec3 shift(run.offset, 0.37 * run.offset, layer + 0.71 * run.offset);
  double solid = 0, surface = 0;
  for (int k = 0; k < scaled.repeats; ++k)
    for (int j = 0; j < scaled.repeats; ++j)
      for (int i = 0; i < scaled.repeats; ++i)
        for (std::size_t n = 0; n < packing.radii.size(); ++n) {
          PrescribedGrains::Grain grain;
          grain.position = scaled.edge * (packing.centres[n] + Vec3(i, j, k)) + shift;
          for (int a = 0; a < 3; ++a) {
            const double edge = scene.cells[static_cast<std::size_t>(a)];
            grain.position[a] -= edge * std::floor(grain.position[a] / edge);
          }
          grain.radius = scaled.edge * packing.radii[n];
          grain.density = kQuartz;
          solid += sphere_volume(grain.radius);
          surface += 4 * std::numbers::pi * grain.radius * grain.radius;
          scene.list.push_back(grain);
        }
  scene.total = static_cast<double>(scene.cells[0]) * scene.cells[1] * scene.cells[2];
  scene.phi = solid / scene.total;
  scene.diameter = 6 * solid / surface;
  scene.nu = lbm::viscosity_of(run.relaxation_time);
  CoupledSettings& settings = scene.settings;
  settings.units.density = 1;
  settings.units.viscosity = scene.nu;
  settings.units.spacing = 1;
  settings.units.time_step = 1;
  settings.fluid.collision.collision_operator = run.collision;
  settings.fluid.collision.magic = run.magic;
  settings.fluid.precision = run.single ? lbm::Precision::float_precision : lbm::Precision::double_precision;
  settings.solids.cells.solid_operator = run.solid_operator;
  settings.solids.cells.weighting = run.weighting;
  settings.solids.automatic_coefficient = run.coefficient <= 0;
  if (run.coefficient > 0) settings.solids.cells.coefficient = run.coefficient;
  settings.solids.law = run.law;
  settings.solids.fraction = run.fraction;
  settings.effects.motion = run.movable ? Switch::on : Switch::off;
  settings.substeps = 1;
  return scene;
}

PrescribedGrains grains_of(const Scene& scene) {
  return PrescribedGrains(scene.list, Vec3(scene.cells[0], scene.cells[1], scene.cells[2]),
                          {true, true, true}, 1.);
}

/// Two spheres with a gap (diameters) on an oblique line: neither along the lattice nor along the flow.
Packing pair_packing(double phi, double gap) {
  Packing packing;
  const double radius = std::cbrt(phi / 2 * 3 / (4 * std::numbers::pi));
  const Vec3 centre = Vec3::Constant(0.5), half = (1 + gap) * radius * Vec3(0.6, 0.64, 0.48);
  packing.centres = {centre - half, centre + half};
  packing.radii = {radius, radius};
  return packing;
}

/// The last snapshot of a periodic cube of grains.
Packing dumped_packing(const std::string& path) {
  const analysis::GrainSnapshot snapshot = analysis::read_grain_snapshot(path, "packing", true);
  const Vec3 size = snapshot.box.high - snapshot.box.low;
  if ((size - Vec3::Constant(size[0])).norm() > 1e-5 * size[0])
    throw std::runtime_error("no cube in " + path);
  Packing packing;
  for (const analysis::Sphere& grain : snapshot.grains) {
    packing.centres.emplace_back((grain.centre - snapshot.box.low) / size[0]);
    packing.radii.push_back(grain.radius / size[0]);
  }
  return packing;
}

}  // namespace

Packing array_packing(double c, bool face_centred) {
  Packing packing;
  packing.array = true;
  packing.centres = {Vec3(0, 0, 0)};
  if (face_centred)
    packing.centres.insert(packing.centres.end(), {Vec3(0, .5, .5), Vec3(.5, 0, .5), Vec3(.5, .5, 0)});
  const double volume = c / static_cast<double>(packing.centres.size());
  packing.radii.assign(packing.centres.size(), std::cbrt(volume * 3 / (4 * std::numbers::pi)));
  return packing;
}

Packing make_packing(const std::string& text) {
  const std::vector<std::string> words = split(text, ':');
  const auto number = [&](std::size_t n) { return std::stod(words.at(n)); };
  const auto whole = [&](std::size_t n) { return std::stoi(words.at(n)); };
  const std::string& kind = words.at(0);
  if (kind == "sc" || kind == "fcc") return array_packing(number(1), kind == "fcc");
  if (kind == "pair") return pair_packing(number(1), number(2));
  if (kind == "dump") return dumped_packing(words.at(1));
  Packing packing;
  PackingRequest request;
  if (kind == "random") {
    request.radii.assign(static_cast<std::size_t>(whole(2)), 1.);
    request.seed = static_cast<std::uint64_t>(whole(3));
  } else if (kind == "spread") {
    request.radii = spread_radii(whole(2), number(4));
    request.seed = static_cast<std::uint64_t>(whole(3));
  } else if (kind == "appendix_c") {
    request.radii = appendix_c_radii();
    request.seed = static_cast<std::uint64_t>(whole(2));
  } else if (kind == "grading") {
    request.radii = grading_radii(words.at(3), whole(2));
    request.seed = static_cast<std::uint64_t>(whole(4));
  } else if (kind == "gap") {
    request.radii = gap_graded_radii(whole(2), number(4), number(5));
    request.seed = static_cast<std::uint64_t>(whole(3));
  } else {
    throw std::runtime_error("unknown packing " + text);
  }
  const double scale = std::cbrt(number(1) / volume_of(request.radii));
  for (double& r : request.radii) r *= scale;
  packing.centres = random_packing(request);
  packing.radii = request.radii;
  return packing;
}

DragResult drag_of(const Packing& packing, double diameter, const DragRun& run) {
  Scene scene = make_scene(packing, diameter, run);
  // So weak that U, about G d^2/nu at most, leaves Re and Ma far below what shows.
  const double gradient = 1e-6 * scene.nu * scene.nu;
  const int along = run.through ? 2 : 0;
  scene.settings.pressure_gradient[along] = gradient;
  PrescribedGrains grains = grains_of(scene);
  DragResult result;
  result.crowding = mean_crowding(scene.settings, scene.cells, scene.diameter, grains);
  CoupledSimulation simulation(scene.settings, lbm::Decomposition::balanced(MPI_COMM_WORLD, scene.cells),
                               Vec3::Zero(), grains);
  simulation.map();
  double before = 0, flux = 0;
  constexpr int interval = 100;
  int settled = 0;
  do {
    simulation.fluid().run(interval);
    before = flux;
    // The mean of a step's begin and end; once steady, what the gradient gives the grains take.
    flux = simulation.fluid().momentum()[along] / scene.total - 0.5 * gradient;
    settled = std::abs(flux - before) < 2e-6 * std::abs(flux) ? settled + 1 : 0;
  } while (settled < 2 && simulation.fluid().steps() < 100000);
  result.phi = scene.phi;
  result.diameter = scene.diameter;
  result.drag = gradient * scene.diameter * scene.diameter / (18 * scene.phi * scene.nu * flux);
  result.cells = scene.cells[0];
  result.steps = simulation.fluid().steps();
  return result;
}

MovingResult moving_drag_of(const Packing& packing, double diameter, const DragRun& run, double speed,
                            double flow) {
  const DragResult held = drag_of(packing, diameter, run);
  Scene scene = make_scene(packing, diameter, run);
  const double gradient = 18 * scene.phi * held.drag * scene.nu * flow / (scene.diameter * scene.diameter);
  scene.settings.pressure_gradient = Vec3(gradient, 0, 0);
  const Vec3 motion = speed * (run.oblique ? Vec3::Constant(1 / std::sqrt(3.)) : Vec3(1, 0, 0));
  for (auto& g : scene.list) g.velocity = motion;
  PrescribedGrains grains = grains_of(scene);
  grains.mobile = true;
  CoupledSimulation simulation(scene.settings, lbm::Decomposition::balanced(MPI_COMM_WORLD, scene.cells),
                               Vec3::Zero(), grains);
  simulation.fluid().set_equilibrium([&](const lbm::Index3&) {
    return lbm::FluidPoint{1, motion + Vec3(flow, 0, 0)};
  });
  MovingResult result;
  result.held = held.drag;
  // Until boundary layers have grown, then over whole crossings of a cell.
  const double settling = scene.diameter * scene.diameter / scene.nu;
  const int steps = static_cast<int>(settling) + 500, measured = 400;
  const double share = gradient * scene.total / static_cast<double>(scene.list.size());
  double flux = 0, squares = 0, mean = 0;
  for (int n = 0; n < steps + measured; ++n) {
    simulation.step();
    if (n % 50 == 0 && !(simulation.fluid().extremes().largest_speed < 0.5)) return result;
    if (n < steps) continue;
    flux += (simulation.fluid().momentum()[0] / scene.total - 0.5 * gradient - motion[0]) / measured;
    const double force = grains.force_on(0)[0];
    mean += force / measured;
    squares += force * force / measured;
  }
  result.stable = true;
  result.drag = gradient * scene.diameter * scene.diameter / (18 * scene.phi * scene.nu * flux);
  result.noise = std::sqrt(std::max(0., squares - mean * mean)) / share;
  return result;
}

}  // namespace suffuse::coupling
