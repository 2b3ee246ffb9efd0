// The loop that runs of all fluids share: when it ends, and what it tells its steps.
#include <catch2/catch.hpp>
#include <utility>
#include <vector>

#include "suffuse/lbm/run_loop.h"

using namespace suffuse;
using namespace suffuse::lbm;

namespace {

/// A flow that approaches 1 m/s: what is left to it halves with every step.
class Halving final : public RunSteps {
 public:
  void advance(long step, bool cut_short) override {
    made.emplace_back(step, cut_short);
    left *= 0.5;
  }
  void check_due(long step) override { looked = step; }
  MeanMotion mean_motion() override { return {Vec3(0, 0, 1 - left), carried}; }
  std::string details() override { return ""; }
  int stop_requested() override { return looked == stop_at ? 7 : 0; }

  std::vector<std::pair<long, bool>> made;
  double left = 1;
  Vec3 carried = Vec3::Zero();
  long looked = 0, stop_at = -1;
};

RunEnd run(Halving& flow, const RunPlan& plan) {
  ProgressLine silent(false);
  return run_loop(flow, plan, silent);
}

}  // namespace

TEST_CASE("a run that nobody ends makes its steps, from the first after those that are made") {
  Halving flow;
  const RunEnd end = run(flow, {10, 14});
  CHECK(flow.made == std::vector<std::pair<long, bool>>{{11, false}, {12, false}, {13, false}, {14, false}});
  CHECK(flow.looked == 14);
  CHECK_FALSE(end.steady);
  CHECK(end.stop == 0);
}

TEST_CASE("a run ends once its flow is steady, or a step later where the end is to be told") {
  // Looks at steps 5, 10, 15: between the last two the flow changes by (2^-10 - 2^-15)/(1 - 2^-15) of itself.
  RunPlan plan{0, 100};
  plan.until_steady = 1e-3;
  plan.steady_every = 5;
  Halving flow;
  const RunEnd end = run(flow, plan);
  CHECK(end.steady);
  CHECK(flow.made.back() == std::pair(15L, false));
  CHECK(end.change == Approx((0x1p-10 - 0x1p-15) / (1 - 0x1p-15)).epsilon(1e-12));

  plan.ends_with_a_step = true;
  Halving told;
  CHECK(run(told, plan).steady);
  CHECK(told.made.back() == std::pair(16L, true));
  CHECK(told.made[14] == std::pair(15L, false));

  plan.last = 15;  // found at the last step: there is no other that could be told
  Halving late;
  CHECK_FALSE(run(late, plan).steady);
  CHECK(late.made.size() == 15);
}

TEST_CASE("what the flow carries has to be steady as well, ripples of a share of the flow aside") {
  Steadiness steadiness(0.01);
  CHECK_FALSE(steadiness.check({Vec3(1, 0, 0), Vec3(0, 0, 0.2)}));  // nothing to compare with
  CHECK_FALSE(steadiness.check({Vec3(1, 0, 0), Vec3(0, 0, 0.22)}));
  CHECK(steadiness.change() == 0);
  CHECK(steadiness.check({Vec3(1, 0, 0), Vec3(0, 0, 0.229)}));
  CHECK_FALSE(steadiness.check({Vec3(1.02, 0, 0), Vec3(0, 0, 0.229)}));
  CHECK(steadiness.change() == Approx(0.02 / 1.02));
}

TEST_CASE("somebody who wants to stop is heard after the step") {
  Halving flow;
  flow.stop_at = 3;
  const RunEnd end = run(flow, {0, 100});
  CHECK(end.stop == 7);
  CHECK(flow.made.size() == 3);
}
