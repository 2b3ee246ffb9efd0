#include "lbm_plan.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>

#include "../liggghts/fine_diameter.h"
#include "comm.h"
#include "lammps.h"
#include "manifest.h"
#include "styles/style_support.h"
#include "suffuse/common/count_text.h"
#include "suffuse/common/progress.h"
#include "suffuse/coupling/automatic_coefficient.h"
#include "timer.h"
#include "update.h"

namespace suffuse::coupling {

namespace {

/// Grain steps a second and core where this process has not run any yet (docs/performance_dry.md).
constexpr double kGrainStepsPerSecond = 4.5e6;

/// The grains, held: steps of the trial move nothing, and loads go nowhere.
class HeldGrains final : public ParticlePort {
 public:
  HeldGrains(ParticlePort& port, bool reads_loads) : port_(port), reads_loads_(reads_loads) {}
  GrainArrays grains() override {
    const GrainArrays arrays = port_.grains();
    load_.resize(6 * static_cast<std::size_t>(arrays.owned));
    records_.resize(static_cast<std::size_t>(arrays.owned));
    return arrays;
  }
  void sum_over_copies(std::vector<double>&, std::vector<double>&) override {}
  GrainMemory memory() override { return {load_.data(), records_.data()}; }
  bool reads_loads(int) override { return reads_loads_; }
  double time_step() const override { return port_.time_step(); }
  void advance(int) override {}

 private:
  ParticlePort& port_;
  bool reads_loads_;
  std::vector<double> load_;
  std::vector<GrainRecord> records_;
};

double slowest(double mine, MPI_Comm communicator) {
  MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_DOUBLE, MPI_MAX, communicator);
  return mine;
}

struct Costs {
  double fluid = 0, mapping = 0, exchange = 0, grains = 0;  ///< s a fluid step
  double bytes = 0;                                         ///< of all ranks
};

Costs measure(const CoupledSettings& settings, const lbm::Decomposition& parts, const Vec3& low,
              LiggghtsPort& port, bool grains_move) {
  const MPI_Comm communicator = parts.communicator();
  HeldGrains held(port, grains_move);
  CoupledSettings trial = settings;
  trial.solids.remap_distance = -1;  // every grain is mapped in every step, as if it moved
  CoupledSimulation simulation(trial, parts, low, held);
  constexpr int warm_up = 2, steps = 6;
  for (int n = 0; n < warm_up; ++n) simulation.step();
  simulation.times() = {};
  for (int n = 0; n < steps; ++n) simulation.step();
  Costs costs;
  costs.fluid = slowest(simulation.times().fluid, communicator) / steps;
  if (grains_move) {
    costs.mapping = slowest(simulation.times().mapping, communicator) / steps;
    costs.exchange = slowest(simulation.times().exchange, communicator) / steps;
  }
  costs.bytes = static_cast<double>(simulation.bytes());
  MPI_Allreduce(MPI_IN_PLACE, &costs.bytes, 1, MPI_DOUBLE, MPI_SUM, communicator);
  return costs;
}

/// What so many steps of single grains take, s: at the speed of LIGGGHTS's last run, or on usual cores.
double grain_seconds(LAMMPS_NS::LAMMPS* lmp, const PastRun& past, double grain_steps) {
  const double speed =
      past.grain_steps > 0 ? past.grain_steps / past.seconds : kGrainStepsPerSecond * lmp->comm->nprocs;
  return grain_steps / speed;
}

/// Error of the permeability where the coefficient is calibrated; empty otherwise. `cells` a diameter of the
/// finest quarter of the surface: the fines of a graded bed make its pores.
std::string error_line(const SolidSettings& solids, double cells) {
  const bool calibrated = solids.automatic_coefficient &&
                          solids.cells.solid_operator == lbm::SolidOperator::force &&
                          solids.cells.weighting == lbm::SolidWeighting::viscosity_independent;
  if (!calibrated) return "";
  return fmt::format(
      "lbm plan: expected error of the permeability: about {:.0f} % (worst packing tried: {:.0f} %), by the "
      "{:.2g} cells per diameter of the finest quarter of the grains' surface\n",
      100 * expected_permeability_error(cells), 100 * largest_permeability_error(cells), cells);
}

std::string scene_text(const CoupledSettings& settings, const lbm::Units& units, const lbm::Index3& cells,
                       const LiggghtsPort::Summary& grains, double fine, double time, double steps,
                       double bytes) {
  std::string text = fmt::format(
      "lbm plan: {:g} s are {:.0f} steps of {} x {} x {} cells, {} each; {:.3g} GB for the fluid\n", time,
      steps, cells[0], cells[1], cells[2], count_text(settings.substeps, "DEM step"), bytes * 1e-9);
  text += "lbm plan: " + units.summary() + "\n";
  for (const std::string& note : units.warnings())
    text += "lbm plan: note: " + note + " (docs/reference/lbm.md#fluid-lattice)\n";
  if (grains.grains == 0) return text;
  text += fmt::format("lbm plan: {}, {}\n", count_text(grains.grains, "grain"),
                      sizes_text(grains, units.spacing()));
  if (settings.averaged) return text;
  text += error_line(settings.solids, fine / units.spacing());
  const std::string note = resolution_note(grains, units.spacing());
  return note.empty() ? text : text + "lbm plan: note: " + note + "\n";
}

std::string cost_table(const Costs& costs, double steps, bool grains_known) {
  std::string text = fmt::format("{:<22}{:>12}{:>12}\n", "cost of", "ms a step", "in all");
  const auto row = [&](const char* name, double seconds) {
    text += fmt::format("{:<22}{:>12.3f}{:>12}\n", name, 1e3 * seconds, duration_text(seconds * steps));
  };
  row("fluid", costs.fluid);
  row("solid mapping", costs.mapping);
  row("forces on grains", costs.exchange);
  row(grains_known ? "grains, as last run" : "grains, usual core", costs.grains);
  row("together", costs.fluid + costs.mapping + costs.exchange + costs.grains);
  return text;
}

}  // namespace

void plan_run(LAMMPS_NS::LAMMPS* lmp, const CoupledSettings& settings, const lbm::Decomposition& parts,
              const Vec3& low, LiggghtsPort& port, double time) {
  const lbm::Units units(settings.units);
  const LiggghtsPort::Summary grains = port.summary();
  const bool grains_move = grains.grains > 0 && port.anything_moves();
  Costs costs = measure(settings, parts, low, port, grains_move);
  const PastRun past = port.past_run();
  if (grains_move)
    costs.grains = grain_seconds(lmp, past, settings.substeps * static_cast<double>(grains.grains));
  const double steps = std::max(1., std::round(units.time_to_lattice(time)));
  const double fine = grains.grains > 0 ? fine_diameter(port, grains) : 0;
  tell(lmp, scene_text(settings, units, parts.cells(), grains, fine, time, steps, costs.bytes) +
                cost_table(costs, steps, past.grain_steps > 0));
}

}  // namespace suffuse::coupling
