#include "trial_costs.h"

#include <mpi.h>

#include <algorithm>
#include <vector>

#include "suffuse/common/processor_time.h"
#include "suffuse/coupling/plane_sums.h"

namespace suffuse::coupling {

namespace {

/// Grain steps a second and core where this process has not run any yet (docs/performance_dry.md), and what
/// ranks that share the grains take in a step for their messages, however few the grains (two ranks of one
/// machine), s.
constexpr double kGrainStepsPerSecond = 4.5e6, kMessagesOfAStep = 8e-6;

/// The grains, held: steps of the trial move nothing, and loads go nowhere.
class HeldGrains final : public ParticlePort {
 public:
  HeldGrains(ParticlePort& port, bool reads_loads, double time_step)
      : port_(port), reads_loads_(reads_loads), time_step_(time_step) {}
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
  double time_step() const override { return time_step_; }
  void advance(int) override {}

  /// The next step surveys the pores, as if the grains had moved far.
  void forget_the_survey() {
    for (GrainRecord& record : records_) record.surveyed = 0;
  }

 private:
  ParticlePort& port_;
  bool reads_loads_;
  double time_step_;
  std::vector<double> load_;
  std::vector<GrainRecord> records_;
};

/// Seconds as they would be on processors of one's own: those by the clock, less what other programs took.
class Trial {
 public:
  Trial(CoupledSimulation& simulation, MPI_Comm communicator)
      : simulation_(simulation), communicator_(communicator) {}

  /// Mean of so many steps.
  TrialCosts steps(int count) {
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

  /// One sweep of all cells, as monitors and guards do.
  double sweep() {
    constexpr int sweeps = 3;
    double wall = 0;
    const MappedScene scene = simulation_.map();
    const double share = share_during([&] {
      const double start = MPI_Wtime();
      for (int n = 0; n < sweeps; ++n) (void)plane_sums(scene, 2);
      wall = MPI_Wtime() - start;
    });
    return slowest(share * wall / sweeps);
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

}  // namespace

TrialCosts trial_costs(const CoupledSettings& settings, const lbm::Decomposition& parts, const Vec3& low,
                       LiggghtsPort& port, double dem_step, double sweeps) {
  const bool grains_move = port.summary().grains > 0 && port.anything_moves();
  constexpr int warm_up = 2, surveys = 5, fewest = 6, most = 40;
  constexpr double seconds = 0.4;  // that the trial may take where steps are short
  HeldGrains held(port, grains_move, dem_step);
  CoupledSettings trial_settings = settings;
  if (grains_move)
    trial_settings.solids.remap_distance = -1;  // all are mapped in every step, as if they moved
  CoupledSimulation simulation(trial_settings, parts, low, held);
  Trial trial(simulation, parts.communicator());
  trial.steps(warm_up);
  const TrialCosts first = trial.steps(1);
  const double step = std::max(1e-5, first.fluid + first.mapping + first.exchange);
  TrialCosts costs = trial.steps(static_cast<int>(std::clamp(seconds / step, 1. * fewest, 1. * most)));
  if (grains_move && settings.solids.automatic_coefficient && !settings.averaged) {
    double with_survey = 0;
    for (int n = 0; n < surveys; ++n) {
      held.forget_the_survey();
      with_survey += trial.steps(1).mapping / surveys;
    }
    costs.mapping += std::max(0., with_survey - costs.mapping) / settings.solids.survey_every;
  }
  if (!grains_move) costs.mapping = costs.exchange = 0;
  costs.samples = sweeps * trial.sweep();
  costs.bytes = static_cast<double>(simulation.bytes());
  MPI_Allreduce(MPI_IN_PLACE, &costs.bytes, 1, MPI_DOUBLE, MPI_SUM, parts.communicator());
  return costs;
}

double grain_seconds(int ranks, const PastRun& past, double steps, double grains) {
  if (past.grain_steps > 0) return steps * grains * past.seconds / past.grain_steps;
  return steps * (grains / (kGrainStepsPerSecond * ranks) + (ranks > 1 ? kMessagesOfAStep : 0));
}

}  // namespace suffuse::coupling
