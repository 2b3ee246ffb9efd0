// What the ways to compute the water cost and how far they err: drag of packings, force on each grain, core
// seconds. Rows of CSV on stdout; docs/results/price_of_methods.md reads them.
#include <fmt/format.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>

#include "drag_of_packings.h"
#include "suffuse/common/processor_time.h"
#include "suffuse/coupling/plane_sums.h"

using namespace suffuse;
using namespace suffuse::coupling;

namespace {

constexpr double kEdge = 2e-3, kViscosity = 1e-6, kDensity = 1000, kGradient = 1;  // m, m^2/s, kg/m^3, Pa/m

struct Result {
  double drag = 0, seconds = 0;
  std::vector<double> forces;  ///< along the gradient, over their sum
};

struct Case {
  Packing packing;
  double phi = 0, diameter = 0;  ///< Sauter, box lengths
};

double drag_from(const Case& c, double speed) {
  const double d = c.diameter * kEdge;
  return kGradient * d * d / (18 * c.phi * kDensity * kViscosity * speed);
}

std::vector<double> shares(std::vector<double> forces) {
  double sum = 0;
  for (const double f : forces) sum += f;
  for (double& f : forces) f /= sum;
  return forces;
}

/// Held grains in a periodic box, driven until the flow changes by less than 1e-5 in `interval` steps.
Result run(const Case& c, CoupledSettings settings, int cells, int interval) {
  settings.units.density = kDensity;
  settings.units.viscosity = kViscosity;
  settings.units.spacing = kEdge / cells;
  settings.pressure_gradient = Vec3(kGradient, 0, 0);
  settings.substeps = 1;
  std::vector<PrescribedGrains::Grain> list;
  for (std::size_t n = 0; n < c.packing.radii.size(); ++n) {
    PrescribedGrains::Grain g;
    g.position = kEdge * c.packing.centres[n];
    g.radius = kEdge * c.packing.radii[n];
    list.push_back(g);
  }
  const double start = processor_seconds();
  PrescribedGrains grains(list, kEdge * Vec3::Ones(), {true, true, true},
                          lbm::Units(settings.units).time_step());
  CoupledSimulation simulation(settings, lbm::Decomposition::balanced(MPI_COMM_WORLD, {cells, cells, cells}),
                               Vec3::Zero(), grains);
  simulation.map();
  double speed = 0, before = 1;
  constexpr double steady = 1e-5;
  for (int n = 0; n < 400 && std::abs(speed - before) > steady * std::abs(speed); ++n) {
    for (int k = 0; k < interval; ++k) simulation.step(k >= interval - simulation.loads_span());
    before = speed;
    speed = plane_sums(simulation.map(), 0).superficial_velocity()[0];
  }
  simulation.refresh_loads();
  Result result;
  for (std::size_t n = 0; n < list.size(); ++n) result.forces.push_back(grains.force_on(n)[0]);
  result.forces = shares(result.forces);
  result.seconds = processor_seconds() - start;
  result.drag = drag_from(c, speed);
  return result;
}

Result resolved(const Case& c, double diameter, bool single) {
  CoupledSettings settings;
  settings.units.relaxation_time = 1;
  if (single) settings.fluid.precision = lbm::Precision::float_precision;
  return run(c, settings, std::max(4, static_cast<int>(std::lround(diameter / c.diameter))), 50);
}

Result averaged(const Case& c, DragLaw law, int cells) {
  CoupledSettings settings;
  settings.units.time_step = 1e-3;
  settings.units.only_cells_and_steps = true;
  settings.averaged = AveragedSettings{law, true};
  return run(c, settings, cells, 5);
}

/// A closure by itself: all grains see the mean solid fraction.
Result formula(const Case& c, DragLaw law) {
  Result result;
  const double start = processor_seconds();
  for (const double r : c.packing.radii) {
    const double y = 2 * r / c.diameter;
    // Drag with the pressure gradient's share, by the grain's volume.
    const double drag = 2 * r * graded_drag_factor(law, c.phi, 0, y);
    result.forces.push_back(drag);
  }
  result.forces = shares(result.forces);
  for (std::size_t n = 0; n < result.forces.size(); ++n) {
    const double r = c.packing.radii[n];
    result.forces[n] = (1 - c.phi) * result.forces[n] + 4 * std::numbers::pi / 3 * r * r * r;
  }
  result.drag = drag_factor(law, c.phi, 0) / (1 - c.phi);
  result.seconds = processor_seconds() - start;
  return result;
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

void print(const std::string& packing, const std::string& method, const Result& r, double reference,
           const Result& finest) {
  std::vector<double> ratios;
  double square = 0;
  for (std::size_t n = 0; n < r.forces.size(); ++n) {
    ratios.push_back(r.forces[n] / finest.forces[n]);
    square += std::pow(ratios.back() - 1, 2) / static_cast<double>(r.forces.size());
  }
  std::printf("%s,%s,%.4f,%.2f,%.2f,%.3f,%.3f,%.3f,%.5f\n", packing.c_str(), method.c_str(), r.drag,
              100 * (reference / r.drag - 1), 100 * std::sqrt(square), quantile(ratios, 0.1),
              quantile(ratios, 0.5), quantile(ratios, 0.9), r.seconds);
  std::fflush(stdout);
}

double reference_of(const std::string& file, const std::string& packing) {
  std::ifstream rows(file);
  for (std::string row; std::getline(rows, row);)
    if (row.starts_with(packing + ",")) return std::stod(row.substr(packing.size() + 1));
  throw std::runtime_error("no " + packing + " in " + file);
}

/// What a program of others needs to compute the same (benchmarks/pore_network.py): a row a grain.
void write_grains(std::ofstream& file, const std::string& name, const Case& c, double reference,
                  const Result& finest) {
  for (std::size_t n = 0; n < c.packing.radii.size(); ++n) {
    const Vec3& at = c.packing.centres[n];
    file << fmt::format("{},{:.6g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", name, reference, at[0], at[1],
                        at[2], c.packing.radii[n], finest.forces[n]);
  }
}

void compare(const std::string& name, const std::string& references, double finest_diameter,
             std::ofstream& grains) {
  Case c;
  c.packing = make_packing(name);
  c.phi = volume_of(c.packing.radii);
  c.diameter = sauter_diameter(c.packing.radii);
  const double reference = reference_of(references, name);
  const Result finest = resolved(c, finest_diameter, false);
  write_grains(grains, name, c, reference, finest);
  for (const DragLawEntry& law : drag_laws())
    print(name, "formula_" + law.word, formula(c, law.law), reference, finest);
  for (const int cells : {1, 2})
    if (1 / (cells * c.diameter) >= 1.5)
      print(name, "averaged_beetstra_" + std::to_string(cells) + "_cells",
            averaged(c, DragLaw::beetstra, cells), reference, finest);
  for (const int diameter : {2, 3, 4, 5, 8, 10})
    for (const bool single : {false, true})
      print(name, "resolved_" + std::to_string(diameter) + (single ? "_float" : "_double"),
            resolved(c, diameter, single), reference, finest);
  print(name, "resolved_" + std::to_string(static_cast<int>(finest_diameter)) + "_double", finest, reference,
        finest);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Errors of drag, of the force on each grain, and core seconds of every way to compute the water");
  std::vector<std::string> packings{"random:0.58:64:21", "appendix_c:0.6:11"};
  std::string references = "tests/data/packing_drags.csv", grains;
  double finest = 14;
  app.add_option("--packings", packings, "names of packing_drags.csv")->delimiter(' ');
  app.add_option("--references", references, "converged drags");
  app.add_option("--grains", grains, "file to write: the packings' grains and the forces on them");
  app.add_option("--finest", finest, "cells a diameter of the run that gives the forces to compare with");
  CLI11_PARSE(app, argc, argv);
  MPI_Init(&argc, &argv);
  std::printf(
      "packing,method,drag_K,k_error_percent,force_error_rms_percent,force_ratio_10,force_ratio_50,"
      "force_ratio_90,core_seconds\n");
  std::ofstream file(grains.empty() ? "/dev/null" : grains);
  if (!file) throw std::runtime_error("cannot write " + grains);
  file << "packing,drag_K,x,y,z,radius,force_share\n";  // box lengths
  for (const std::string& name : packings) compare(name, references, finest, file);
  MPI_Finalize();
  return 0;
}
