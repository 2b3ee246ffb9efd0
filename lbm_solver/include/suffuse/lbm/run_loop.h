#pragma once

#include <optional>
#include <string>

#include "suffuse/common/linear_algebra.h"
#include "suffuse/common/progress.h"

namespace suffuse::lbm {

/// Mean velocities over a whole box, in one unit.
struct MeanMotion {
  Vec3 flow = Vec3::Zero();     ///< of the fluid
  Vec3 carried = Vec3::Zero();  ///< of what it carries; zero without
};

/// Has a flow become steady? It has when its mean, and that of what it carries, have changed by less than a
/// share of themselves since the last look. Ripples of a share of the flow count for what is carried too: at
/// rest grains tremble. The first look never finds a steady flow.
class Steadiness {
 public:
  explicit Steadiness(double share) : share_(share) {}

  bool check(const MeanMotion& now);
  /// Of the flow between the last two looks, as a share of itself; 0 before, and where nothing flows.
  double change() const { return change_; }

 private:
  double share_, change_ = 0;
  std::optional<MeanMotion> last_;
};

/// "steady after 0.5 s", or "not yet steady after 0.5 s".
std::string steadiness_text(bool steady, double seconds);

/// What progress lines say: the fluid's time as text, millions of updates of `cells` cells a second, health.
std::string progress_details(const std::string& time, double cells, double steps, double seconds,
                             const std::string& health);

/// What one kind of run does at the steps of a loop. Every call is collective.
class RunSteps {
 public:
  virtual ~RunSteps() = default;

  /// Makes the fluid's step number `step`. `cut_short`: no other follows although the run was to be longer.
  virtual void advance(long step, bool cut_short) = 0;
  /// Everything that is due after it: guards, then what is written.
  virtual void check_due(long step) = 0;
  virtual MeanMotion mean_motion() = 0;
  /// For progress lines.
  virtual std::string details() = 0;
  /// 0, or why the run shall end now.
  virtual int stop_requested() { return 0; }
};

struct RunPlan {
  long first = 0, last = 0;                 ///< steps that are made before the run, and when it has ended
  long tell_every = 1;                      ///< steps after which RunSteps::details are new
  std::optional<double> until_steady = {};  ///< share of Steadiness
  long steady_every = 1;                    ///< steps between its looks
  bool ends_with_a_step = false;  ///< once steady, one step more, that is told to be the last (`cut_short`)
};

struct RunEnd {
  bool steady = false;
  int stop = 0;       ///< what RunSteps::stop_requested said
  double change = 0;  ///< Steadiness::change of the last look
};

/// The loop of every run: a step, what is due after it, a progress line; until the last step, or the flow is
/// steady, or somebody wants to stop.
RunEnd run_loop(RunSteps& steps, const RunPlan& plan, ProgressLine& progress);

}  // namespace suffuse::lbm
