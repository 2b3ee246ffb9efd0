#include "drag_of_packings.h"

#include <mpi.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace suffuse::coupling {

namespace {

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

/// Mean x of the automatic coefficient over the grains.
double mean_crowding(CoupledSettings settings, const lbm::Index3& cells, PrescribedGrains grains) {
  settings.solids.automatic_coefficient = true;
  settings.solids.cells.weighting = lbm::SolidWeighting::viscosity_independent;
  settings.solids.law = CoefficientLaw{1, 0, 1, 0};  // x from k = 1 + x/D
  CoupledSimulation simulation(settings, lbm::Decomposition::balanced(MPI_COMM_WORLD, cells), Vec3::Zero(),
                               grains);
  simulation.map();
  double sum = 0;
  for (std::size_t n = 0; n < grains.list.size(); ++n)
    sum += (simulation.coefficient_of(n) - 1) * 2 * grains.list[n].radius;
  return sum / static_cast<double>(grains.list.size());
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
  const Scaled scaled = fit(packing, diameter);
  const int layer = static_cast<int>(std::lround(run.water * scaled.cells));
  const lbm::Index3 cells{scaled.cells, scaled.cells, scaled.cells + 2 * layer};
  std::vector<PrescribedGrains::Grain> list;
  const Vec3 shift(run.offset, 0.37 * run.offset, layer + 0.71 * run.offset);
  for (int k = 0; k < scaled.repeats; ++k)
    for (int j = 0; j < scaled.repeats; ++j)
      for (int i = 0; i < scaled.repeats; ++i)
        for (std::size_t n = 0; n < packing.radii.size(); ++n) {
          PrescribedGrains::Grain grain;
          grain.position = scaled.edge * (packing.centres[n] + Vec3(i, j, k)) + shift;
          for (int a = 0; a < 3; ++a) {
            const double edge = cells[static_cast<std::size_t>(a)];
            grain.position[a] -= edge * std::floor(grain.position[a] / edge);
          }
          grain.radius = scaled.edge * packing.radii[n];
          list.push_back(grain);
        }
  const double nu = lbm::viscosity_of(run.relaxation_time);
  CoupledSettings settings;
  settings.units.density = 1;
  settings.units.viscosity = nu;
  settings.units.spacing = 1;
  settings.units.time_step = 1;
  settings.fluid.collision.collision_operator = run.collision;
  settings.fluid.precision = run.single ? lbm::Precision::float_precision : lbm::Precision::double_precision;
  settings.solids.cells.solid_operator = run.solid_operator;
  settings.solids.cells.weighting = run.weighting;
  settings.solids.automatic_coefficient = run.coefficient <= 0;
  if (run.coefficient > 0) settings.solids.cells.coefficient = run.coefficient;
  settings.solids.law = run.law;
  settings.solids.fraction = run.fraction;
  settings.substeps = 1;
  // So weak that U, about G d^2/nu at most, leaves Re and Ma far below what shows.
  const double gradient = 1e-6 * nu * nu;
  const int along = run.through ? 2 : 0;
  settings.pressure_gradient[along] = gradient;
  PrescribedGrains grains(list, Vec3(cells[0], cells[1], cells[2]), {true, true, true}, 1.);
  DragResult result;
  result.crowding = mean_crowding(settings, cells, grains);
  CoupledSimulation simulation(settings, lbm::Decomposition::balanced(MPI_COMM_WORLD, cells), Vec3::Zero(),
                               grains);
  simulation.map();
  const double total = static_cast<double>(cells[0]) * cells[1] * cells[2];
  double before = 0, flux = 0;
  constexpr int interval = 100;
  int settled = 0;
  do {
    simulation.fluid().run(interval);
    before = flux;
    // The mean of a step's begin and end; once steady, what the gradient gives the grains take.
    flux = simulation.fluid().momentum()[along] / total - 0.5 * gradient;
    settled = std::abs(flux - before) < 2e-6 * std::abs(flux) ? settled + 1 : 0;
  } while (settled < 2 && simulation.fluid().steps() < 100000);
  double solid = 0, surface = 0;
  for (const auto& g : list) {
    solid += sphere_volume(g.radius);
    surface += 4 * std::numbers::pi * g.radius * g.radius;
  }
  result.phi = solid / total;
  result.diameter = 6 * solid / surface;
  result.drag = gradient * result.diameter * result.diameter / (18 * result.phi * nu * flux);
  result.cells = cells[0];
  result.steps = simulation.fluid().steps();
  return result;
}

}  // namespace suffuse::coupling
