#include <catch2/catch.hpp>

#include "commands/trial_costs.h"

using namespace suffuse::coupling;

TEST_CASE("Few grains on several ranks take what their messages take, many what their contacts take") {
  const double one = grain_seconds(1, {}, 1000, 100), two = grain_seconds(2, {}, 1000, 100);
  CHECK(one == Approx(1000 * 100 / 4.5e6));
  CHECK(two - one / 2 == Approx(1000 * 8e-6));
  CHECK(two > 0.8 * one);
  CHECK(grain_seconds(2, {}, 1000, 1e5) == Approx(grain_seconds(1, {}, 1000, 1e5) / 2).epsilon(0.001));
}

TEST_CASE("Grains that have run already take as long as they took") {
  const PastRun past{2e6, 4};  // 2e6 grain steps in 4 s, on however many ranks
  for (const int ranks : {1, 2, 8}) CHECK(grain_seconds(ranks, past, 1000, 500) == Approx(1));
}
