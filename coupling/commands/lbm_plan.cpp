#include "lbm_plan.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "manifest.h"
#include "styles/style_support.h"
#include "suffuse/common/count_text.h"
#include "suffuse/common/processor_time.h"
#include "suffuse/common/progress.h"
#include "suffuse/coupling/automatic_coefficient.h"
#include "suffuse/coupling/plane_sums.h"

namespace suffuse::coupling {

namespace {

/// Grain steps a second and core where this process has not run any yet (docs/performance_dry.md).
constexpr double kGrainStepsPerSecond = 4.5e6;

/// The grains, held: steps of the trial move nothing, and loads go nowhere.
class HeldGrains final : public ParticlePort {
 public:
  HeldGrains(ParticlePort& port, bool reads_loads) : port_(port), reads_loads_(reads_loads) {}
  void refresh() override {
    port_.refresh();
    const auto owned = static_cast<std::size_t>(port_.grains().owned);
    load_.resize(6 * owned);
    records_.resize(owned);
  }
  GrainArrays grains() const override { return port_.grains(); }
  void sum_over_copies(std::vector<GrainSums>&) override {}
  GrainMemory memory() override { return {load_.data(), records_.data()}; }
  bool reads_loads(int) override { return reads_loads_; }
  double time_step() const override { return port_.time_step(); }
  void advance(int) override {}

  /// The next step surveys the pores, as if the grains had moved far.
  void forget_the_survey() {
    for (GrainRecord& record : records_) record.surveyed = 0;
  }

 private:
  ParticlePort& port_;
  bool reads_loads_;
  std::vector<double> load_;
  std::vector<GrainRecord> records_;
};

struct Costs {
  double fluid = 0, mapping = 0, exchange = 0, samples = 0, grains = 0;  ///< s a fluid step
  double bytes = 0;                                                      ///< of all ranks
  double share = 1;  ///< of the trial's time in which this program had its processors
};

/// Seconds as they would be on processors of one's own: those by the clock, less what other programs took.
class Trial {
 public:
  Trial(CoupledSimulation& simulation, MPI_Comm communicator)
      : simulation_(simulation), communicator_(communicator) {}

  /// Mean of so many steps.
  Costs steps(int count) {
    simulation_.times() = {};
    const double share = share_during([&] {
      for (int n = 0; n < count; ++n) simulation_.step();
    });
    const CoupledTimes& times = simulation_.times();
    const double each = share / count;
    return {slowest(times.fluid * each),
            slowest(times.mapping * each),
            slowest(times.exchange * each),
            0,
            0,
            0,
            -slowest(-share)};
  }

  /// One look at all cells, as monitors and guards do.
  double look() {
    constexpr int looks = 3;
    double wall = 0;
    const MappedScene scene = simulation_.map();
    const double share = share_during([&] {
      const double start = MPI_Wtime();
      for (int n = 0; n < looks; ++n) (void)plane_sums(scene, 2);
      wall = MPI_Wtime() - start;
    });
    return slowest(share * wall / looks);
  }

 private:
  template <class Work>
  static double share_during(const Work& work) {
    const double start = MPI_Wtime(), busy = processor_seconds();
    work();
    const double wall = MPI_Wtime() - start;
    return wall > 0 ? std::min(1., (processor_seconds() - busy) / wall) : 1;
  }
  double slowest(double mine) const {
    MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_DOUBLE, MPI_MAX, communicator_);
    return mine;
  }

  CoupledSimulation& simulation_;
  MPI_Comm communicator_;
};

/// `looks`: how often a step all cells are looked at.
Costs measure(const CoupledSettings& settings, const lbm::Decomposition& parts, const Vec3& low,
              LiggghtsPort& port, bool grains_move, double looks) {
  constexpr int warm_up = 2, surveys = 5, fewest = 6, most = 40;
  constexpr double seconds = 0.4;  // that the trial may take where steps are short
  HeldGrains held(port, grains_move);
  CoupledSettings trial_settings = settings;
  if (grains_move)
    trial_settings.solids.remap_distance = -1;  // all are mapped in every step, as if they moved
  CoupledSimulation simulation(trial_settings, parts, low, held);
  Trial trial(simulation, parts.communicator());
  trial.steps(warm_up);
  const Costs first = trial.steps(1);
  const double step = std::max(1e-5, first.fluid + first.mapping + first.exchange);
  Costs costs = trial.steps(static_cast<int>(std::clamp(seconds / step, 1. * fewest, 1. * most)));
  if (grains_move && settings.solids.automatic_coefficient && !settings.averaged) {
    double with_survey = 0;
    for (int n = 0; n < surveys; ++n) {
      held.forget_the_survey();
      with_survey += trial.steps(1).mapping / surveys;
    }
    costs.mapping += std::max(0., with_survey - costs.mapping) / settings.solids.survey_every;
  }
  if (!grains_move) costs.mapping = costs.exchange = 0;
  costs.samples = looks * trial.look();
  costs.bytes = static_cast<double>(simulation.bytes());
  MPI_Allreduce(MPI_IN_PLACE, &costs.bytes, 1, MPI_DOUBLE, MPI_SUM, parts.communicator());
  return costs;
}

/// What so many steps of single grains take, s: at the speed of LIGGGHTS's last run, or on usual cores.
double grain_seconds(int ranks, const PastRun& past, double grain_steps) {
  const double speed = past.grain_steps > 0 ? past.grain_steps / past.seconds : kGrainStepsPerSecond * ranks;
  return grain_steps / speed;
}

bool is_calibrated(const CoupledSettings& settings) {
  const SolidSettings& solids = settings.solids;
  return !settings.averaged && solids.automatic_coefficient &&
         solids.cells.solid_operator == lbm::SolidOperator::force &&
         solids.cells.weighting == lbm::SolidWeighting::viscosity_independent;
}

/// Error of the permeability where the coefficient is calibrated; empty otherwise. `cells` a diameter of the
/// finest quarter of the surface: the fines of a graded bed make its pores.
std::string error_line(const CoupledSettings& settings, double cells) {
  if (!is_calibrated(settings)) return "";
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
  text += error_line(settings, fine / units.spacing());
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
  row("monitors and guards", costs.samples);
  row(grains_known ? "grains, as last run" : "grains, usual core", costs.grains);
  row("together", costs.fluid + costs.mapping + costs.exchange + costs.samples + costs.grains);
  constexpr double disturbed = 0.9;
  if (costs.share < disturbed)
    text += fmt::format(
        "lbm plan: note: other programs took {:.0f} % of the trial's time; the times are those without "
        "them\n",
        100 * (1 - costs.share));
  return text;
}

/// The same flow with other cells and the same relaxation time: cells grow with the third power of the
/// resolution, steps with the second, and the grains' own steps stay.
std::string prices_text(const Costs& costs, double steps, double cells) {
  const double water = (costs.fluid + costs.mapping + costs.exchange + costs.samples) * steps;
  const double grains = costs.grains * steps;
  std::string text = fmt::format("{:<22}{:>12}{:>12}\n", "cells a fine diameter", "in all", "error");
  for (const int other : {2, 3, 4, 5, 6, 8, 10})
    text += fmt::format("{:<22}{:>12}{:>10.1f} %\n", other,
                        duration_text(water * std::pow(other / cells, 5) + grains),
                        100 * expected_permeability_error(other));
  return text;
}

/// What the settings are expected to err by, source after source. The resolution's is that of the calibrated
/// coefficient; what contacts' softness changes is told by `dem_timestep`.
std::string errors_table(const CoupledSettings& settings, const DrivenScene& driven,
                         const lbm::Units& units) {
  const AccuracyScene& scene = driven.scene;
  const double spacing = units.spacing(), step = units.time_step();
  const lbm::CollisionOperator collision = settings.effects.comoving == Switch::on
                                               ? lbm::CollisionOperator::trt_comoving
                                               : settings.fluid.collision.collision_operator;
  AccuracyErrors errors = expected_errors(scene, spacing, step, collision);
  if (!is_calibrated(settings)) errors.resolution = 0;
  std::string text = fmt::format("{:<22}{:>12}\n", "error expected by", "about");
  const auto row = [&](const char* name, double error, const std::string& why) {
    text += fmt::format("{:<22}{:>10.2g} %  {}\n", name, 100 * error, why);
  };
  if (errors.resolution > 0)
    row("resolution", errors.resolution,
        fmt::format("{:.2g} cells per diameter of the finest quarter of the surface",
                    scene.fine_diameter / spacing));
  if (scene.velocity > 0)
    row("compressibility", errors.compressibility,
        fmt::format("Mach number {:.2g} at {:.3g} m/s, {}", expected_mach(scene, spacing, step),
                    scene.velocity, driven.velocity_from));
  if (scene.pressure_range > 0)
    row("density", errors.density, fmt::format("pressures differ by {:.3g} Pa", scene.pressure_range));
  if (scene.grain_speed > 0 && !settings.averaged)
    row("carried water", errors.motion,
        fmt::format("grains at {:.2g} viscosities a cell, {}", scene.grain_speed * spacing / scene.viscosity,
                    name_of(collision)));
  row("together", errors.together(), "of the permeability, or a steady speed");
  if (errors.coupling > 0)
    row("coupling", errors.coupling,
        fmt::format("while speeds change: half a step over the {:.2g} s in which the smallest grain follows",
                    scene.response_time));
  return text;
}

}  // namespace

void plan_run(LAMMPS_NS::LAMMPS* lmp, const CoupledSettings& settings, const lbm::Decomposition& parts,
              const Vec3& low, LiggghtsPort& port, const DrivenScene& driven, double time, double looks) {
  const lbm::Units units(settings.units);
  const LiggghtsPort::Summary grains = port.summary();
  const bool grains_move = grains.grains > 0 && port.anything_moves();
  Costs costs = measure(settings, parts, low, port, grains_move, looks);
  const PastRun past = port.past_run();
  if (grains_move)
    costs.grains = grain_seconds(parts.ranks(), past, settings.substeps * static_cast<double>(grains.grains));
  const double steps = std::max(1., std::round(units.time_to_lattice(time)));
  const double fine = driven.scene.fine_diameter;
  tell(lmp,
       scene_text(settings, units, parts.cells(), grains, fine, time, steps, costs.bytes) +
           cost_table(costs, steps, past.grain_steps > 0) +
           (grains.grains > 0 && !settings.averaged ? errors_table(settings, driven, units) : "") +
           (is_calibrated(settings) && fine > 0 ? prices_text(costs, steps, fine / units.spacing()) : ""));
}

}  // namespace suffuse::coupling
