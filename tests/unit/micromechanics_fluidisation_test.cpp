#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "suffuse/common/error.h"
#include "suffuse/micromechanics/fluidisation.h"

using namespace suffuse::micromechanics;

namespace {

constexpr double kConductivity = 8e-4, kHeight = 4e-3;

/// A bed of three layers whose conductivities differ, and which is lifted where the mean gradient is 1: the
/// stress at the middle of layer k is the weight above less the gradients above.
FlowState bed_at(double mean, double risen) {
  FlowState state;
  state.velocity = kConductivity * std::min(mean, 1.0);
  state.gradient = {0.8 * std::min(mean, 1.0), 1.1 * std::min(mean, 1.0), 1.1 * std::min(mean, 1.0)};
  double above = 0;
  for (const double gradient : state.gradient) {
    state.stress.push_back(9.81 * (above + (1 - gradient) / 2));
    above += 1 - gradient;
  }
  state.centre = kHeight * (0.5 + 1e-3 * std::min(mean, 1.0) + risen);
  return state;
}

std::vector<FlowState> ramp(std::size_t samples, double noise = 0) {
  std::mt19937 dice(7);
  std::normal_distribution<double> error(0, 1);
  std::vector<FlowState> states;
  for (std::size_t k = 0; k < samples; ++k) {
    const double mean = 1.2 * static_cast<double>(k) / static_cast<double>(samples - 1);
    states.push_back(bed_at(mean, 20 * std::pow(std::max(mean - 1, 0.0), 3)));
    FlowState& state = states.back();
    state.velocity *= 1 + noise * error(dice);
    state.centre += 1e-2 * noise * kHeight * error(dice);
    for (double& gradient : state.gradient) gradient += 0.1 * noise * error(dice);
    for (double& stress : state.stress) stress *= 1 + noise * error(dice);
  }
  return states;
}

}  // namespace

TEST_CASE("a line and a parabola through their own points are found again") {
  const std::vector<double> x{0.1, 0.4, 0.5, 0.9}, y{1.2, 1.8, 2.0, 2.8};
  const auto line = fit_line(x, y);
  REQUIRE(line);
  CHECK(line->slope == Approx(2));
  CHECK(line->intercept == Approx(1));
  CHECK(line->root() == Approx(-0.5));
  CHECK(line->scatter < 1e-12);
  CHECK_FALSE(fit_line(std::vector<double>{1, 1}, std::vector<double>{0, 1}));
  std::vector<double> bent;
  for (const double at : x) bent.push_back(3 - at + 4 * at * at);
  const auto parabola = fit_parabola(x, bent);
  REQUIRE(parabola);
  CHECK(parabola->at(2) == Approx(17));
  CHECK_FALSE(fit_parabola(std::vector<double>{1, 1, 2}, std::vector<double>{0, 1, 2}));
}

TEST_CASE("the standard error of a slope is that of the textbook") {
  // y = x with ±1 at the ends: slope 1 + Σx e/Σx², residuals by hand.
  const std::vector<double> x{-1, 0, 1}, y{-1, 3, 1};
  const auto line = fit_line(x, y);
  CHECK(line->slope == Approx(1));
  // Residuals −1, 2, −1: variance 6/(3 − 2), Σ(x − x̄)² = 2.
  CHECK(line->slope_error == Approx(std::sqrt(6.0 / 2.0)));
  // The line is 1 at x = 0, the mean, with variance 6/3; its root is -1: sqrt(2 + 1 * 3)/1.
  CHECK(line->root() == Approx(-1));
  CHECK(line->root_error() == Approx(std::sqrt(5.0)));
}

TEST_CASE("what lifts a layer is the mean gradient above its middle") {
  const std::vector<double> layers{0.2, 0.6, 1.0};
  CHECK(bed_gradient(layers) == Approx(0.6));
  CHECK(lifting_gradient(layers, 0) == Approx(0.2));
  CHECK(lifting_gradient(layers, 1) == Approx((0.2 + 0.3) / 1.5));
  CHECK(lifting_gradient(layers, 2) == Approx((0.2 + 0.6 + 0.5) / 2.5));
}

TEST_CASE("a ramp gives back its conductivity, critical gradient and onset") {
  const std::vector<FlowState> states = ramp(401);
  const Fluidisation found = measure_fluidisation(states, 1, kHeight);
  CHECK(found.flow.slope == Approx(kConductivity));
  REQUIRE(found.layers.size() == 3);
  for (const LayerFluidisation& layer : found.layers) {
    REQUIRE(layer.by_lifting);
    CHECK(*layer.by_lifting == Approx(1));  // whatever the conductivities
  }
  REQUIRE(found.vanishes());
  CHECK(*found.vanishes() == Approx(1));
  // Over its own gradient layer 2's stress (1.5 − 1.35 i)/1.5, i the mean, 1.1 i its own.
  CHECK(*found.layers[1].local == Approx(1.1 * 1.5 / 1.35));
  CHECK(found.layers[1].stress->slope == Approx(-1.35 / 1.5 / 1.1));
  REQUIRE(found.onset);
  // The bed is lifted at 1; the band is left with the first sample above 1 + (5e-4/20)^(1/3) = 1.029, whose
  // own gradient stays at 1.
  CHECK(found.onset->gradient == Approx(1));
  CHECK(found.onset->risen == Approx(1));
  CHECK(1.2 * static_cast<double>(found.onset->state) / 400 == Approx(1.0292).margin(0.003));  // one sample
}

TEST_CASE("noise of one per cent moves the critical gradient by less than one") {
  const Fluidisation found = measure_fluidisation(ramp(401, 0.01), 1, kHeight);
  // 200 samples of 1 % over a range of 0.6: standard error of k 0.01 × 0.5/(0.17 √200) = 0.2 %; three of it.
  CHECK(found.flow.slope == Approx(kConductivity).epsilon(0.006));
  REQUIRE(found.vanishes());
  CHECK(*found.vanishes() == Approx(1).epsilon(0.01));
  REQUIRE(found.onset);
  CHECK(found.onset->gradient == Approx(1).epsilon(0.01));
}

TEST_CASE("without motion there is no onset, and a run that stops early is refused") {
  std::vector<FlowState> states = ramp(401);
  states.resize(300);
  CHECK_FALSE(measure_fluidisation(states, 1, kHeight).onset);
  states.resize(100);  // up to 0.3: a tenth of the critical gradient in the window
  CHECK_THROWS_AS(measure_fluidisation(states, 1, kHeight), suffuse::UserError);
  states.resize(2);
  CHECK_THROWS_AS(measure_fluidisation(states, 1, kHeight), suffuse::UserError);
}

TEST_CASE("a stress that does not follow its line has no gradient at which it vanishes") {
  // Walls carry half of what the water lifts, up to 0.8 of the critical gradient, and let go after it.
  std::vector<FlowState> states = ramp(401);
  for (std::size_t k = 0; k < states.size(); ++k) {
    const double mean = 1.2 * static_cast<double>(k) / 400;
    states[k].stress[2] = 9.81 * 2.5 * (mean < 0.8 ? 1 - mean / 2 : std::max(0., 0.6 - 2 * (mean - 0.8)));
  }
  const Fluidisation walls = measure_fluidisation(states, 1, kHeight);
  REQUIRE(walls.stress);
  CHECK(walls.stress->root() > 1.8);
  CHECK_FALSE(walls.vanishes());
  CHECK_FALSE(walls.layers[2].by_lifting);
  CHECK(walls.layers[1].by_lifting);
  // A ramp that ends at 0.55, far below where its line leads, says nothing of it; one that ends at 0.9 does.
  states = ramp(401);
  states.resize(184);
  CHECK_FALSE(measure_fluidisation(states, 1, kHeight).vanishes());
  states = ramp(401);
  states.resize(301);
  CHECK(measure_fluidisation(states, 1, kHeight).vanishes());
}

TEST_CASE("a passing rise is no onset") {
  std::vector<FlowState> states = ramp(401);
  states.resize(330);
  states[250].centre += 0.02 * kHeight;
  // The bump at 0.75 is in the window and widens the band, but the bed is at rest afterwards.
  CHECK_FALSE(measure_fluidisation(states, 1, kHeight).onset);
}

TEST_CASE("holds are found, and give the mean of their last half and the centre of their end") {
  const std::vector<double> driving{0, 0.1, 0.2, 0.2, 0.2, 0.2, 0.3, 0.4, 0.4, 0.4};
  const std::vector<Hold> holds = holds_of(driving);
  REQUIRE(holds.size() == 2);
  CHECK(holds[0] == Hold{2, 5});
  CHECK(holds[1] == Hold{7, 9});
  std::vector<FlowState> samples;
  for (std::size_t k = 0; k < driving.size(); ++k)
    samples.push_back(
        {static_cast<double>(k), static_cast<double>(k * k), static_cast<double>(k), {driving[k]}, {}});
  const std::vector<FlowState> states = held_states(samples, holds);
  REQUIRE(states.size() == 2);
  CHECK(states[0].velocity == Approx((16 + 25) / 2.0));
  CHECK(states[0].centre == 5);
  CHECK(states[0].gradient[0] == Approx(0.2));
  CHECK(states[1].velocity == Approx((64 + 81) / 2.0));
}

TEST_CASE("where a quantity falls below a level, single samples left out") {
  const std::vector<double> gradient{0, 1, 2, 3, 4, 5}, values{1.4, 0.9, 1.3, 1.1, 0.9, 0.8};
  CHECK(*gradient_at_fall(gradient, values, 1) == Approx(0.8));
  CHECK(*gradient_at_fall(gradient, values, 1, 2) == Approx(3.5));
  CHECK_FALSE(gradient_at_fall(gradient, values, 0.5));
  CHECK_FALSE(gradient_at_fall(gradient, values, 2));
}

TEST_CASE("lifting: the packed line meets the weight, whatever the hump before the bed floats") {
  std::vector<double> velocity, drop;
  for (int k = 0; k <= 200; ++k) {
    const double v = 1e-5 * k;
    velocity.push_back(v);
    drop.push_back(v < 1.1e-3 ? v / 1e-3 : 0.98);  // packed until 1.1 of the weight, then 0.98
  }
  const Lifting lifting = measure_lifting(velocity, drop);
  CHECK(lifting.velocity == Approx(1e-3));
  CHECK(lifting.largest == Approx(1.09));
  CHECK(lifting.floating == Approx(0.98));
  CHECK_THROWS_AS(measure_lifting(std::span(velocity).first(10), std::span(drop).first(10)),
                  suffuse::UserError);
  std::reverse(velocity.begin(), velocity.end());
  CHECK_THROWS_AS(measure_lifting(velocity, drop), suffuse::UserError);
}
