#include "suffuse/lbm/run_loop.h"

#include <fmt/format.h>

#include <algorithm>

namespace suffuse::lbm {

bool Steadiness::check(const MeanMotion& now) {
  bool steady = false;
  if (last_) {
    const double speed = now.flow.norm(), change = (now.flow - last_->flow).norm();
    change_ = speed > 0 ? change / speed : 0;
    // Water that has not been set in motion yet is not steady.
    const bool flows = speed > 0 || now.carried.norm() > 0;
    steady = flows && change <= share_ * speed &&
             (now.carried - last_->carried).norm() <= share_ * std::max(speed, now.carried.norm());
  }
  last_ = now;
  return steady;
}

std::string steadiness_text(bool steady, double seconds) {
  return fmt::format("{} after {:.5g} s", steady ? "steady" : "not yet steady", seconds);
}

std::string progress_details(const std::string& time, double cells, double steps, double seconds,
                             const std::string& health) {
  return fmt::format("{}  {:.1f} MLUPS  {}", time, cells * steps / std::max(1e-9, seconds) * 1e-6, health);
}

RunEnd run_loop(RunSteps& steps, const RunPlan& plan, ProgressLine& progress) {
  std::optional<Steadiness> steadiness;
  if (plan.until_steady) steadiness.emplace(*plan.until_steady);
  RunEnd end;
  bool found_steady = false;
  for (long step = plan.first + 1; step <= plan.last && !end.steady && end.stop == 0; ++step) {
    steps.advance(step, found_steady);
    steps.check_due(step);
    end.steady = found_steady;
    const bool due = steadiness && (step - plan.first) % plan.steady_every == 0;
    found_steady = due && steadiness->check(steps.mean_motion());
    if (!plan.ends_with_a_step) end.steady = found_steady;
    if ((step - plan.first) % plan.tell_every == 0 || step == plan.last)
      progress.update(static_cast<double>(step - plan.first) / static_cast<double>(plan.last - plan.first),
                      [&steps] { return steps.details(); });
    end.stop = steps.stop_requested();
  }
  if (steadiness) end.change = steadiness->change();
  return end;
}

}  // namespace suffuse::lbm
