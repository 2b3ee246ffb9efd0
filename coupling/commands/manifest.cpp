#include "manifest.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>

#include "suffuse/common/count_text.h"
#include "suffuse/common/progress.h"

namespace suffuse::coupling {

std::string sizes_text(const LiggghtsPort::Summary& grains, double spacing) {
  return fmt::format("{:.3g} to {:.3g} cells per diameter, Sauter mean {:.3g}",
                     2 * grains.smallest_radius / spacing, 2 * grains.largest_radius / spacing,
                     grains.sauter_diameter / spacing);
}

std::string resolution_note(const LiggghtsPort::Summary& grains, double spacing) {
  // A single grain of fewer cells has a drag that changes by per cents with its place among them.
  constexpr double least = 3.5;
  const double smallest = 2 * grains.smallest_radius / spacing;
  if (grains.grains == 0 || smallest >= least) return "";
  return fmt::format(
      "the smallest grains have {:.2g} cells per diameter; below {:g} their drag is rough "
      "(docs/decisions/solid-operator.md), and a spacing of {:.2g} m resolves them",
      smallest, least, 2 * grains.smallest_radius / least);
}

namespace {

std::string faces_text(const lbm::FaceConditions& faces) {
  std::string text;
  for (int f = 0; f < lbm::kFaces; ++f)
    text += fmt::format("{}{} {}", f == 0 ? "" : ", ", lbm::name_of(static_cast<lbm::Face>(f)),
                        lbm::name_of(faces[static_cast<std::size_t>(f)].kind));
  return text;
}

std::string solids_text(const SolidSettings& solids) {
  std::string text = fmt::format("operator {}, weighting {}", lbm::name_of(solids.cells.solid_operator),
                                 lbm::name_of(solids.cells.weighting));
  if (solids.cells.weighting == lbm::SolidWeighting::viscosity_independent)
    text += solids.automatic_coefficient ? ", coefficient calibrated"
                                         : fmt::format(", coefficient {:g}", solids.cells.coefficient);
  switch (solids.fraction) {
    case FractionMethod::exact:
      return text + ", fraction exact";
    case FractionMethod::linear:
      return text + ", fraction linear";
    case FractionMethod::subcells:
      return text + fmt::format(", fraction {0} x {0} x {0} sub-cells", solids.subcells);
  }
  return text;
}

std::string grains_text(const LiggghtsPort::Summary& grains, double spacing) {
  if (grains.grains == 0) return "none: the fluid flows alone";
  return fmt::format("{}, {}", grains.grains, sizes_text(grains, spacing));
}

std::string grains_text_in_cells(const LiggghtsPort::Summary& grains, double spacing) {
  if (grains.grains == 0) return "none: the water flows alone";
  return fmt::format("{}, cells of {:.3g} to {:.3g} diameters, {:.3g} Sauter mean", grains.grains,
                     0.5 * spacing / grains.largest_radius, 0.5 * spacing / grains.smallest_radius,
                     spacing / grains.sauter_diameter);
}

/// Axis across which two different pressures, or a pressure and a velocity, are given; none: -1.
int driven_axis(const lbm::FaceConditions& faces) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const std::size_t side : {2 * axis, 2 * axis + 1})
      if (faces[side].kind == lbm::FaceKind::pressure) return static_cast<int>(axis);
  return -1;
}

/// Thinner than this there is no bed.
constexpr double kBedPacking = 0.3;

std::string bed_text(const CoupledSimulation& simulation, const LiggghtsPort::Summary& grains) {
  const int axis = driven_axis(simulation.fluid().settings().faces);
  if (grains.packing < kBedPacking || axis < 0) return "";
  const double time = pressure_diffusion_time(grains.extent[axis], 1 - grains.packing, grains.sauter_diameter,
                                              simulation.units());
  return fmt::format(
      "bed         {:.4g} m, porosity {:.3g}: pressure spreads through it in about {:.2g} s; change boundary "
      "values over several times that",
      grains.extent[axis], 1 - grains.packing, time);
}

std::string collision_note(const CoupledSimulation& simulation, const LiggghtsPort::Summary& grains) {
  const lbm::CollisionFacts& facts =
      lbm::facts_of(simulation.fluid().settings().collision.collision_operator);
  const double tau = simulation.units().relaxation_time();
  if (grains.grains == 0 || tau >= facts.least_stirred_relaxation_time) return "";
  return fmt::format(
      "{} gains energy where grains stir the water at a relaxation time below {:g}, here "
      "{:.4g}; "
      "take `lbm collision trt` with `lbm effect turbulence on`",
      facts.word, facts.least_stirred_relaxation_time, tau);
}

}  // namespace

std::vector<std::string> manifest(const CoupledSimulation& simulation, const LiggghtsPort::Summary& grains,
                                  const std::vector<EffectState>& effects,
                                  const std::vector<std::string>& walls) {
  const lbm::Fluid& fluid = simulation.fluid();
  const lbm::Units& units = simulation.units();
  const lbm::Index3& cells = fluid.decomposition().cells();
  const lbm::CollisionSettings& collision = fluid.settings().collision;
  const WaterMethod* method = simulation.method();
  std::vector<std::string> lines;
  if (method != nullptr)
    lines.push_back(fmt::format("water       {} x {} x {} cells on {}, {}", cells[0], cells[1], cells[2],
                                count_text(fluid.decomposition().ranks(), "rank"), method->summary()));
  else
    lines.push_back(
        fmt::format("lattice     {} x {} x {} cells on {}, {}, {} kernels, {}{}", cells[0], cells[1],
                    cells[2], count_text(fluid.decomposition().ranks(), "rank"),
                    name_of(collision.collision_operator), name_of(fluid.instruction_set()),
                    fluid.settings().precision == lbm::Precision::double_precision ? "double" : "float",
                    collision.incompressible ? ", incompressible" : ""));
  lines.push_back("            " + units.summary());
  lines.push_back("faces       " + faces_text(fluid.settings().faces));
  lines.insert(lines.end(), walls.begin(), walls.end());
  lines.push_back("grains      " + (method == nullptr ? grains_text(grains, units.spacing())
                                                      : grains_text_in_cells(grains, units.spacing())));
  if (const std::string bed = bed_text(simulation, grains); method == nullptr && !bed.empty())
    lines.push_back(bed);
  if (grains.grains > 0 && method == nullptr)
    lines.push_back("solids      " + solids_text(simulation.settings().solids));
  lines.push_back(fmt::format("coupling    {} of {:.4g} s a fluid step{}",
                              count_text(simulation.substeps(), "DEM step"),
                              units.time_step() / simulation.substeps(),
                              simulation.settings().average_force ? ", mean force of two steps" : ""));
  for (const EffectState& effect : effects)
    lines.push_back(fmt::format("{:<12}{:<4}{}", effect.name, effect.on ? "on" : "off", effect.text()));
  if (const std::string note = resolution_note(grains, units.spacing()); method == nullptr && !note.empty())
    lines.push_back("note: " + note + " (docs/performance_coupled.md#what-accuracy-costs)");
  if (const std::string note = collision_note(simulation, grains); method == nullptr && !note.empty())
    lines.push_back("note: " + note + " (docs/reference/lbm.md#collision)");
  for (const std::string& warning : units.warnings())
    lines.push_back("note: " + warning + " (docs/reference/lbm.md#fluid-lattice)");
  return lines;
}

std::string time_table(CoupledSimulation& simulation, long steps, long rested, double grain_steps,
                       double wall) {
  const MPI_Comm communicator = simulation.fluid().decomposition().communicator();
  const bool averaged = simulation.method() != nullptr;
  const double updates = static_cast<double>(steps - rested);
  double bare = 1e300;
  for (int n = 0; n < 3 && !averaged && updates > 0; ++n) {
    MPI_Barrier(communicator);
    const double start = MPI_Wtime();
    simulation.fluid().bare_update();
    double mine = MPI_Wtime() - start;
    MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_DOUBLE, MPI_MAX, communicator);
    bare = std::min(bare, mine);
  }
  const CoupledTimes& times = simulation.times();
  double parts[] = {times.fluid, times.mapping, times.exchange, times.grains, times.output};
  MPI_Allreduce(MPI_IN_PLACE, parts, 5, MPI_DOUBLE, MPI_MAX, communicator);
  const char* names[] = {"fluid", "solid mapping", "forces on grains", "grains (LIGGGHTS)",
                         "monitors and output"};
  const double count = static_cast<double>(std::max(1L, steps));
  std::string text = fmt::format("{:<22}{:>10}{:>12}{:>8}\n", "time in", "s", "ms a step", "share");
  double rest = wall;
  const auto row = [&](const char* name, double seconds) {
    text += fmt::format("{:<22}{:>10.2f}{:>12.3f}{:>7.1f}%\n", name, seconds, 1e3 * seconds / count,
                        100 * seconds / wall);
  };
  for (int i = 0; i < 5; ++i) {
    row(names[i], parts[i]);
    rest -= parts[i];
  }
  row("rest", std::max(0., rest));
  const lbm::Index3& cells = simulation.fluid().decomposition().cells();
  const double all_cells = static_cast<double>(lbm::CellBox{{0, 0, 0}, cells}.volume());
  if (averaged)
    text += fmt::format("{} in {}: water {:.2f} times the time of the grains", count_text(steps, "step"),
                        duration_text(wall), (parts[0] + parts[2]) / std::max(parts[3], 1e-9));
  else if (updates == 0)
    text += fmt::format("{} in {}: water at rest", count_text(steps, "step"), duration_text(wall));
  else
    text += fmt::format("{} in {}: fluid {:.1f} MLUPS, {:.0f} % of the memory's speed (measured now)",
                        count_text(steps, "step"), duration_text(wall),
                        all_cells * updates / std::max(parts[0], 1e-9) * 1e-6,
                        100 * bare * updates / std::max(parts[0], 1e-9));
  if (grain_steps > 0)
    text +=
        fmt::format("; grains {:.2f} M grain steps a second", grain_steps / std::max(parts[3], 1e-9) * 1e-6);
  return text;
}

}  // namespace suffuse::coupling
