#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "../liggghts/scene.h"
#include "effect_report.h"
#include "lbm_request.h"
#include "run_effects.h"
#include "run_guards.h"
#include "run_output.h"
#include "styles/scene_checks.h"
#include "suffuse/coupling/coupled_simulation.h"
#include "suffuse/lbm/run_loop.h"

namespace suffuse::coupling {

struct RunRequest {
  double time = 0;  ///< s
  /// End early once the fluid's superficial velocity and the grains' mean motion have changed by less than
  /// this share of themselves over `window`.
  std::optional<double> steady;
  double window = 0;               ///< s
  std::vector<std::string> walls;  ///< lines of the manifest about them
};

/// One `lbm run`: manifest, steps with what is due at each, table of times.
class LbmRun final : private lbm::RunSteps {
 public:
  /// Fluid steps between looks of the guards, which cost as much as two or three steps: within 1 % of the
  /// time.
  static constexpr long kCheckEvery = 250;

  LbmRun(const Scene& scene, const LbmRequest& settings, RunOutput& output, RunEffects& effects);

  /// Collective. A UserError if the flow becomes unstable; Interrupted once a SIGTERM or SIGINT has ended it:
  /// the fluid step is finished then, and the state saved where restart files were asked for.
  /// `took_up_state`: files go on with what an earlier run left in them.
  void run(const RunRequest& request, bool took_up_state);

 private:
  void begin(const RunRequest& request, bool took_up_state);
  void advance(long step, bool cut_short) override;
  void check_due(long step) override;
  lbm::MeanMotion mean_motion() override;
  std::string details() override;
  int stop_requested() override;
  std::string interruption_text(int signal);
  void set_values();
  void say(const std::string& line) const;
  void refuse_overlaps(const LiggghtsPort::Summary& grains) const;
  void check(long step);
  void follow_effects();
  void report_effects(double wall);
  GuardReading reading(const lbm::FluidExtremes& fluid) const;
  std::string with_last_state(const std::string& reason) const;
  std::string table(double wall);
  /// The steps of this run whose water was at rest, without a lattice.
  long rested_steps() const { return scene_.simulation.rested_steps() - rested_; }
  void conclude(const RunRequest& request, const lbm::RunEnd& end, ProgressLine& progress);
  std::optional<std::string> drag_note() const;
  std::optional<std::string> weight_note() const;

  Scene scene_;
  const LbmRequest& settings_;
  RunOutput& output_;
  RunEffects& effects_;
  EffectReport report_;
  bool follow_variables_ = false;
  long rested_ = 0;            ///< the water's steps of rest before the run
  long first_ = 0, last_ = 0;  ///< fluid steps that the run begins after and ends with
  std::int64_t grains_ = 0;
  double start_ = 0;
  lbm::FluidExtremes extremes_;
  RunGuards guards_;
  GrainCensus census_;
  bool near_limit_ = false;   ///< the Mach number, at the last look
  double fastest_grain_ = 0;  ///< m/s, of the steps that were looked at
};

}  // namespace suffuse::coupling
