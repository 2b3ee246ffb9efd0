// When fines began to move and to leave, of records whose answer is known.

#include <catch2/catch.hpp>
#include <vector>

#include "suffuse/micromechanics/suffusion.h"

using namespace suffuse::micromechanics;

namespace {

/// Twenty states, gradient 0.1 a state; the lower of two layers loses 1.2 % of its fines a state from
/// state 6 on, and a tenth of a per cent of all fines leaves a state from state 8 on.
std::vector<SuffusionState> washed_out() {
  std::vector<SuffusionState> states;
  for (int n = 0; n < 20; ++n) {
    const double moved = n > 5 ? 0.012 * (n - 5) : 0, left = n > 7 ? 0.001 * (n - 7) : 0;
    states.push_back({0.1 * n, left, {0.2, 0.2 * (1 - moved)}, {0.1 * n, 0.1 * n}});
  }
  return states;
}

}  // namespace

TEST_CASE("fines begin to move where a layer's content is off by more than a twentieth", "[suffusion]") {
  std::vector<SuffusionState> states = washed_out();
  const SuffusionOnset lost = suffusion_onset(states, {});
  REQUIRE(lost.inside);
  CHECK(*lost.inside == Approx(1.0));  // state 10: 6 % of the layer's
  // A layer that gains fines has changed as well.
  for (SuffusionState& state : states) state.fines_share[1] = 0.4 - state.fines_share[1];
  CHECK(*suffusion_onset(states, {}).inside == Approx(1.0));
  // One that never had any tells nothing.
  for (SuffusionState& state : states) state.fines_share = {0, 0.3};
  CHECK_FALSE(suffusion_onset(states, {}).inside);
}

TEST_CASE("gradients at which shares of the fines have left", "[suffusion]") {
  const std::vector<double> shares{0.002, 0.01, 0.05};
  const SuffusionOnset onset = suffusion_onset(washed_out(), shares);
  REQUIRE(onset.eroded.size() == 3);
  CHECK(*onset.eroded[0] == Approx(0.9));
  CHECK(*onset.eroded[1] == Approx(1.7));
  CHECK_FALSE(onset.eroded[2]);
  // Of a gradient that swings the largest so far counts, not that of the moment.
  std::vector<SuffusionState> states = washed_out();
  states[17].gradient = 0.2;
  CHECK(*suffusion_onset(states, shares).eroded[1] == Approx(1.6));
}

TEST_CASE("water that flows down tells the same gradients as water that flows up", "[suffusion]") {
  const std::vector<double> shares{0.002, 0.01, 0.05};
  std::vector<SuffusionState> down = washed_out();
  for (SuffusionState& state : down) {
    state.gradient = -state.gradient;
    for (double& gradient : state.layer_gradient) gradient = -gradient;
  }
  const SuffusionOnset onset = suffusion_onset(down, shares), up = suffusion_onset(washed_out(), shares);
  CHECK(*onset.inside == *up.inside);
  CHECK(*onset.eroded[0] == Approx(0.9));
  CHECK(*onset.eroded[1] == *up.eroded[1]);
  CHECK_FALSE(onset.eroded[2]);
  // Of one that turns the larger magnitude counts.
  down[3].gradient = 1.5;
  CHECK(*suffusion_onset(down, shares).inside == Approx(1.5));
}

TEST_CASE("a layer that clogs is steeper than the mean", "[suffusion]") {
  std::vector<SuffusionState> states = washed_out();
  CHECK(suffusion_onset(states, {}).steepest_layer == Approx(1));
  states[15].layer_gradient = {1, 3};
  CHECK(suffusion_onset(states, {}).steepest_layer == Approx(1.5));
  // While the flow sets in, within the first tenth, gradients are of no steady flow.
  states[1].layer_gradient = {0.1, 0.9};
  CHECK(suffusion_onset(states, {}).steepest_layer == Approx(1.5));
  // Where a gradient that swings passes zero, a layer's over the mean is no measure.
  states[16].layer_gradient = {-0.01, 0.03};
  CHECK(suffusion_onset(states, {}).steepest_layer == Approx(1.5));
  // Water that flows down has negative gradients.
  for (SuffusionState& state : states) state.layer_gradient = {-1, -3};
  CHECK(suffusion_onset(states, {}).steepest_layer == Approx(1.5));
  CHECK(suffusion_onset({}, {}).steepest_layer == 0);
}
