#include "contacts/rose_command.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "contacts/read_options.h"
#include "contacts/rose_table.h"
#include "files/figure_script.h"
#include "files/number_parser.h"
#include "files/output_options.h"
#include "files/record_table.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/directional_distribution.h"
#include "suffuse/micromechanics/spherical_distribution.h"

namespace suffuse::analysis {
namespace {

using namespace micromechanics;

constexpr const char* kRose = "rose";
constexpr double kDegree = std::numbers::pi / 180;

struct RoseOptions {
  OutputOptions outputs;
  ReadOptions read;
  std::string plane = "xz", step = "last", output, fits, sphere, figure, sphere_figure;
  int bins = kOrientationBins, order = 4, cells = 500;
};

Plane plane_of(const std::string& text) {
  if (text == "xy") return Plane::xy;
  if (text == "xz") return Plane::xz;
  if (text == "yz") return Plane::yz;
  throw_user_error({kRose, "--plane", text, "be xy, xz or yz", ""});
}

/// Sums over the snapshots that were asked for.
struct Sums {
  PlaneDistribution plane;
  SphericalDistribution sphere;
  Mat3 normals = Mat3::Zero(), forces = Mat3::Zero();
  std::int64_t snapshots = 0, step = 0;
  double contacts = 0;

  void add(const Packing& packing, const RoseOptions& options, const SphericalGrid& grid) {
    const FabricSums fabric = fabric_sums(packing);
    const PlaneDistribution in_plane = plane_distribution(packing, plane_of(options.plane), options.bins);
    const SphericalDistribution over_sphere = spherical_distribution(packing, grid);
    if (snapshots++ == 0) {
      plane = in_plane;
      sphere = over_sphere;
    } else {
      plane.add(in_plane);
      sphere.add(over_sphere);
    }
    normals += fabric.normals.matrix();
    forces += normal_force_moment(packing);
    contacts += fabric.contacts;
  }
};

void write_fits(const std::string& path, const std::vector<Rose>& roses, int bins) {
  SafeFile file(path, kRose);
  file.write("distribution,order,amplitude,amplitude_without_bins,direction_rad\n");
  for (const Rose& rose : roses)
    for (const Harmonic& h : rose.fit.harmonics)
      file.write(fmt::format("{},{},{},{},{}\n", rose.name, h.order, h.amplitude,
                             h.amplitude / bin_attenuation(h.order, bins), h.direction));
  file.commit();
}

void write_sphere(const std::string& path, const Sums& sums, const SphericalGrid& grid) {
  SafeFile file(path, kRose);
  file.write(
      "cos_polar_low,cos_polar_high,azimuth_low_rad,azimuth_high_rad,solid_angle_sr,contacts,"
      "contact_density_per_sr,contact_fit_per_sr,normal_force_density_per_sr,normal_force_fit_per_sr\n");
  const std::vector<double> contacts = spherical_density(sums.sphere.contacts, grid),
                            forces = spherical_density(sums.sphere.normal, grid);
  const Mat3 fabric = sums.normals / sums.normals.trace();
  const Mat3 force_fabric = sums.forces.trace() > 0 ? Mat3(sums.forces / sums.forces.trace()) : fabric;
  for (int k = 0; k < grid.size(); ++k) {
    const SphericalGrid::Cell& cell = grid.cell(k);
    const auto at = static_cast<std::size_t>(k);
    file.write(fmt::format("{},{},{},{},{},{},{},{},{},{}\n", cell.z_low, cell.z_high, cell.azimuth_low,
                           cell.azimuth_high, grid.solid_angle(), sums.sphere.contacts[at], contacts[at],
                           second_order_density(fabric, cell.centre()), forces[at],
                           second_order_density(force_fabric, cell.centre())));
  }
  file.commit();
}

void print_fits(const Sums& sums, const RoseOptions& options, const std::vector<Rose>& roses) {
  fmt::print("{}; plane {}, {} bins; angles from {} towards {}\n",
             sums.snapshots == 1
                 ? fmt::format("step {}, {:.0f} contacts", sums.step, sums.contacts)
                 : fmt::format("{} snapshots, {:.0f} contacts", sums.snapshots, sums.contacts),
             options.plane, options.bins, options.plane[0], options.plane[1]);
  fmt::print("{:<24}", "distribution");
  for (int k = 2; k <= options.order; k += 2)
    fmt::print("{:>10} {:>12}", fmt::format("a{}", k), fmt::format("theta{} (deg)", k));
  fmt::print("\n");
  for (const Rose& rose : roses) {
    fmt::print("{:<24}", rose.name);
    for (const Harmonic& h : rose.fit.harmonics)
      fmt::print("{:>10.4f} {:>12.2f}", h.amplitude, h.direction / kDegree);
    fmt::print("\n");
  }
  fmt::print("tangential: f_t/f_0 = -{:.4f} sin 2(theta - {:.2f} deg) by its second order\n",
             roses.back().fit.harmonics.front().amplitude,
             tangential_direction(roses.back().fit.harmonics.front()) / kDegree);
  if (sums.normals.trace() > 0)
    fmt::print("over the sphere: deviatoric fabric {:.4f}; of force-weighted normals {:.4f}\n",
               deviatoric_fabric(sums.normals / sums.normals.trace()),
               sums.forces.trace() > 0 ? deviatoric_fabric(sums.forces / sums.forces.trace()) : 0.);
}

/// Reads up to what --step asks for and sums it up.
Sums gathered(RoseOptions& options, const SphericalGrid& grid) {
  const bool all = options.step == "all", last = options.step == "last", first = options.step == "first";
  std::int64_t wanted = 0;
  if (!all && !last && !first && !parse_integer(options.step, wanted))
    throw_user_error({kRose, "--step", options.step, "be first, last, all or the number of a step", ""});
  const std::unique_ptr<SnapshotSeries> series = options.read.open();
  Sums sums;
  Snapshot snapshot;
  bool found = false;
  while (series->next(snapshot)) {
    found = all || last || first || snapshot.step == wanted;
    sums.step = snapshot.step;
    if (all || (found && !last)) sums.add(snapshot.packing, options, grid);
    if (found && !all && !last) break;
  }
  if (last) sums.add(snapshot.packing, options, grid);
  if (!found)
    throw_user_error({kRose, "--step", options.step, "be a step of the files",
                      "the last one is " + std::to_string(sums.step)});
  if (sums.contacts == 0)
    throw UserError(fmt::format("rose: step {} has no contacts; take a later one (--step)", sums.step));
  return sums;
}

void check(const RoseOptions& options) {
  plane_of(options.plane);
  if (options.bins < 8 || options.bins % 2 != 0 || options.bins > 3600)
    throw_user_error({kRose, "--bins", std::to_string(options.bins), "be even, 8 to 3600",
                      "opposite directions share their contacts"});
  if (options.order < 2 || options.order % 2 != 0 || options.order >= options.bins / 2)
    throw_user_error(
        {kRose, "--order", std::to_string(options.order), "be even, from 2 to below half of the bins", ""});
  if (options.cells < 6 || options.cells > 1'000'000)
    throw_user_error({kRose, "--cells", std::to_string(options.cells), "be 6 to 1000000", ""});
  if (!options.figure.empty() && options.output.empty())
    throw_user_error(
        {kRose, "--figure", options.figure, "have a CSV file to be drawn from", "add --output FILE.csv"});
  if (!options.sphere_figure.empty() && options.sphere.empty())
    throw_user_error({kRose, "--sphere-figure", options.sphere_figure, "have a CSV file to be drawn from",
                      "add --sphere FILE.csv"});
}

void run(RoseOptions& options) {
  check(options);
  options.outputs.require_new(kRose, options.read.files);
  const SphericalGrid grid(options.cells);
  const Sums sums = gathered(options, grid);
  const std::vector<Rose> roses = roses_of(sums.plane, options.order);
  if (!options.output.empty()) write_rose(options.output, sums.plane, roses, kRose);
  if (!options.fits.empty()) write_fits(options.fits, roses, options.bins);
  if (!options.sphere.empty()) write_sphere(options.sphere, sums, grid);
  print_fits(sums, options, roses);
  std::fflush(stdout);
  if (!options.figure.empty())
    make_figure("rose.py", {options.output, "--plane", options.plane, "--output", options.figure}, kRose);
  if (!options.sphere_figure.empty())
    make_figure("rose.py", {"--sphere", options.sphere, "--output", options.sphere_figure}, kRose);
}

}  // namespace

void add_rose(CLI::App& app) {
  auto options = std::make_shared<RoseOptions>();
  CLI::App* command = app.add_subcommand(
      kRose, "Orientation of contacts and forces: rose diagram, Fourier fits, spherical histogram");
  options->read.add_to(*command);
  command->add_option("--plane", options->plane, "xy, xz or yz; angles run from the first axis to the second")
      ->capture_default_str();
  command->add_option("--step", options->step, "first, last, all (summed up), or the number of a step")
      ->capture_default_str();
  command->add_option("--bins", options->bins, "bins over 2 pi, even")->capture_default_str();
  command->add_option("--order", options->order, "highest harmonic of the fits, even; the thesis's is 2")
      ->capture_default_str();
  options->outputs.add(*command, "--output", options->output,
                       "CSV file of the rose and its fits, a row a bin");
  options->outputs.add(*command, "--fits", options->fits, "CSV file of the amplitudes and directions");
  options->outputs.add(*command, "--sphere", options->sphere,
                       "CSV file of the spherical histogram, a row a cell of equal area");
  command->add_option("--cells", options->cells, "about how many cells the sphere has")
      ->capture_default_str();
  options->outputs.add(*command, "--figure", options->figure, "figure of the rose (.png, .svg, .pdf)");
  options->outputs.add(*command, "--sphere-figure", options->sphere_figure,
                       "figure of the spherical histogram");
  command->callback([options] { run(*options); });
}

}  // namespace suffuse::analysis
