// Permeability of held spheres in Stokes flow against the coefficient of the viscosity-independent weighting:
// arrays, random packings, equal and graded, at chosen resolutions. One CSV row a run.
//
//   coefficient_calibration --packing random:0.4:16:1 --diameter 5,8 --coefficient 2,4,8
//   coefficient_calibration --packing sc:0.45,fcc:0.6 --diameter 5,10,20 --coefficient auto --operator sc3
//
// Packings: sc:PHI, fcc:PHI, random:PHI:COUNT:SEED, spread:PHI:COUNT:SEED:SPREAD, appendix_c:PHI:SEED,
// gap:PHI:COARSE:SEED:RATIO:FINES_SHARE. A box is periodic and a whole number of cells; the diameter that
// fits it best is taken and printed. K is the drag on a sphere over 6 pi mu a U with the Sauter radius, U the
// superficial velocity: permeability/d^2 = 1/(18 phi K).
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "prescribed_grains.h"
#include "random_packing.h"
#include "suffuse/coupling/coupled_simulation.h"

namespace {

using namespace suffuse;
using namespace suffuse::coupling;

/// Spheres in a cube of edge 1.
struct Packing {
  std::string name;
  std::vector<Vec3> centres;
  std::vector<double> radii;
  bool array = false;
};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

Packing array_packing(const std::string& name, double phi, bool face_centred) {
  Packing packing;
  packing.name = name;
  packing.array = true;
  packing.centres = {Vec3(0, 0, 0)};
  if (face_centred)
    packing.centres.insert(packing.centres.end(), {Vec3(0, .5, .5), Vec3(.5, 0, .5), Vec3(.5, .5, 0)});
  const double volume = phi / static_cast<double>(packing.centres.size());
  packing.radii.assign(packing.centres.size(), std::cbrt(volume * 3 / (4 * std::numbers::pi)));
  return packing;
}

Packing make_packing(const std::string& text) {
  const std::vector<std::string> words = split(text, ':');
  const auto number = [&](std::size_t n) { return std::stod(words.at(n)); };
  const auto whole = [&](std::size_t n) { return std::stoi(words.at(n)); };
  const std::string& kind = words.at(0);
  if (kind == "sc" || kind == "fcc") return array_packing(text, number(1), kind == "fcc");
  Packing packing;
  packing.name = text;
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

struct Run {
  lbm::SolidOperator solid_operator = lbm::SolidOperator::force;
  lbm::SolidWeighting weighting = lbm::SolidWeighting::viscosity_independent;
  lbm::CollisionOperator collision = lbm::CollisionOperator::trt;
  FractionMethod fraction = FractionMethod::exact;
  double relaxation_time = 1;
  double coefficient = 0;  ///< 0: automatic
  double offset = 0.3;     ///< cells
  double water = 0;        ///< empty layer above and below, in box lengths: flow along x
  bool single = false;
  std::optional<CoefficientLaw> law;
};

struct Result {
  double phi, diameter, drag, crowding;
  int cells;
  long steps;
};

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

Result measure(const Packing& packing, double diameter, const Run& run) {
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
  settings.pressure_gradient = Vec3(gradient, 0, 0);
  PrescribedGrains grains(list, Vec3(cells[0], cells[1], cells[2]), {true, true, true}, 1.);
  Result result;
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
    flux = simulation.fluid().momentum()[0] / total - 0.5 * gradient;
    settled = std::abs(flux - before) < 2e-6 * std::abs(flux) ? settled + 1 : 0;
  } while (settled < 2 && simulation.fluid().steps() < 100000);
  double solid = 0, surface = 0;
  for (const auto& g : list) {
    solid += sphere_volume(g.radius);
    surface += 4 * std::numbers::pi * g.radius * g.radius;
  }
  result.phi = solid / total;
  result.diameter = 6 * solid / surface;
  result.drag =
      gradient * result.diameter * result.diameter / (18 * result.phi * nu * flux);
  result.cells = cells[0];
  result.steps = simulation.fluid().steps();
  return result;
}

template <class T>
std::vector<T> listed(const std::string& text, T (*read)(const std::string&)) {
  std::vector<T> values;
  for (const std::string& word : split(text, ',')) values.push_back(read(word));
  return values;
}

double read_number(const std::string& word) {
  return word == "auto" ? 0. : std::stod(word);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Drag of held spheres against the coefficient of the solid weighting");
  std::string packings = "sc:0.45", diameters = "5", coefficients = "auto", taus = "1", offsets = "0.3",
              solid_operator = "force", weighting = "viscosity_independent", fraction = "exact",
              collision = "trt", law;
  Run run;
  bool header = true;
  app.add_option("--packing", packings, "comma-separated, see the top of this program's source");
  app.add_option("--diameter", diameters, "Sauter, in cells");
  app.add_option("--coefficient", coefficients, "numbers or auto");
  app.add_option("--relaxation-time", taus);
  app.add_option("--offset", offsets, "of the packing from the lattice, cells");
  app.add_option("--operator", solid_operator, "force, sc1, sc2, sc3");
  app.add_option("--weighting", weighting, "fraction, noble_torczynski, viscosity_independent");
  app.add_option("--fraction", fraction, "exact, linear, subcells");
  app.add_option("--collision", collision, "trt, bgk");
  app.add_option("--law", law, "constant,single,crowded,dense of the automatic coefficient");
  app.add_option("--water", run.water, "empty layers above and below along z, in box lengths");
  app.add_flag("--single", run.single, "single precision");
  app.add_flag("--header,!--no-header", header, "first row with names");
  CLI11_PARSE(app, argc, argv);
  MPI_Init(&argc, &argv);
  for (const auto o : {lbm::SolidOperator::sc1, lbm::SolidOperator::sc2, lbm::SolidOperator::sc3})
    if (solid_operator == lbm::name_of(o)) run.solid_operator = o;
  for (const auto w : {lbm::SolidWeighting::fraction, lbm::SolidWeighting::noble_torczynski})
    if (weighting == lbm::name_of(w)) run.weighting = w;
  if (fraction == "linear") run.fraction = FractionMethod::linear;
  if (fraction == "subcells") run.fraction = FractionMethod::subcells;
  if (!law.empty()) {
    const std::vector<double> terms = listed(law, read_number);
    run.law = CoefficientLaw{terms.at(0), terms.at(1), terms.at(2), terms.at(3)};
  }
  if (collision == "bgk") run.collision = lbm::CollisionOperator::bgk;
  if (header)
    std::printf("packing,phi,diameter_cells,box_cells,relaxation_time,operator,weighting,fraction,offset,"
                "coefficient,crowding,drag_K,steps\n");
  for (const std::string& name : split(packings, ',')) {
    const Packing packing = make_packing(name);
    for (const double diameter : listed(diameters, read_number))
      for (const double tau : listed(taus, read_number))
        for (const double offset : listed(offsets, read_number))
          for (const double k : listed(coefficients, read_number)) {
            run.relaxation_time = tau;
            run.offset = offset;
            run.coefficient = k;
            const Result r = measure(packing, diameter, run);
            std::printf("%s,%.5f,%.4f,%d,%g,%s,%s,%s,%g,%s,%.4f,%.5f,%ld\n", name.c_str(), r.phi, r.diameter,
                        r.cells, tau, solid_operator.c_str(), weighting.c_str(), fraction.c_str(), offset,
                        k > 0 ? std::to_string(k).c_str() : "auto", r.crowding, r.drag, r.steps);
            std::fflush(stdout);
          }
  }
  MPI_Finalize();
  return 0;
}
