#include <catch2/catch.hpp>
#include <cmath>

#include "suffuse/micromechanics/seepage.h"

using namespace suffuse::micromechanics;

TEST_CASE("Terzaghi's gradient of quartz at a porosity of 0.4 is 0.99") {
  CHECK(critical_gradient(0.4, 2650) == Approx(0.99));
  CHECK(critical_gradient_of_fines(0.4, 2650, 0.25) == Approx(0.2475));
  CHECK(critical_gradient_of_fines(0.4, 2650, 1.8) == Approx(0.99));  // the whole soil lifts first
}

TEST_CASE(
    "Li and Fannin's envelope by the stress on a layer is the printed one by the mean stress in it, and "
    "heave under a surcharge for alpha = 1") {
  const SeepageFluid water;
  const double unit_weight = water.density * water.gravity, thickness = 0.2, top = 5e3;
  for (const double alpha : {0.1, 0.5, 1.0}) {
    const double gradient = critical_gradient_by_top_stress(0.35, 2650, alpha, {top, thickness});
    const double buoyant = critical_gradient(0.35, 2650) * unit_weight;
    const double mean = top + (buoyant - gradient * unit_weight) * thickness / 2;  // at the onset
    CHECK(alpha / (1 - alpha / 2) * (mean / thickness + buoyant / 2) / unit_weight == Approx(gradient));
  }
  CHECK(critical_gradient_by_top_stress(0.35, 2650, 1, {top, thickness}) * unit_weight * thickness ==
        Approx(top + critical_gradient(0.35, 2650) * unit_weight * thickness));
}

TEST_CASE("conductivities of the thesis's chapter 6 grading at a porosity of 0.376") {
  // d10 = 0.2948 mm, Sauter's size 0.34756 mm, by hand with ν = 1e-6 m²/s and g = 9.81 m/s².
  CHECK(conductivity_hazen(0.2948e-3) == Approx(8.6907e-4).epsilon(1e-4));
  CHECK(conductivity_carman_kozeny(0.347556e-3, 0.376) == Approx(8.9875e-4).epsilon(1e-4));
  // Chapuis: e = 0.60256; [0.2948² × 0.21878/1.60256]^0.7825 = 0.0311; × 2.4622 cm/s
  const double e = 0.376 / 0.624;
  CHECK(conductivity_chapuis(0.2948e-3, 0.376) ==
        Approx(0.024622 * std::exp(0.7825 * std::log(0.2948 * 0.2948 * e * e * e / (1 + e)))));
}

TEST_CASE("Ergun's velocity: viscous at small gradients, and a root of the equation at any") {
  const double d = 0.347e-3, n = 0.376;
  const double viscous = conductivity_carman_kozeny(d, n) * 180 / 150;
  CHECK(velocity_ergun(1e-6, d, n) == Approx(1e-6 * viscous));
  for (const double gradient : {0.5, 1.0, 50.0}) {
    const double u = velocity_ergun(gradient, d, n);
    CHECK(150 * 1e-6 * u * std::pow((1 - n) / d, 2) / std::pow(n, 3) +
              1.75 * u * u * (1 - n) / (d * std::pow(n, 3)) ==
          Approx(9.81 * gradient));
    CHECK(gradient_ergun(u, d, n) == Approx(gradient));
    CHECK(gradient_ergun(-u, d, n) == Approx(-gradient));
  }
  CHECK(velocity_ergun(-1, d, n) == -velocity_ergun(1, d, n));
  // At Terzaghi's gradient, the least velocity of fluidisation: 1.0972e-3 m/s for d50 = 0.3467 mm.
  CHECK(velocity_ergun(critical_gradient(n, 2650), 0.3467e-3, n) == Approx(1.0972e-3).epsilon(1e-4));
}

TEST_CASE(
    "Wen and Yu's least velocity of fluidisation: Re 0.00061 Ar for fine grains, by hand for coarse ones") {
  // Fine: √(a² + x) − a = x/2a.
  const double fine = 1e-5, archimedes = 1e-15 * 1.65 * 9.81 / 1e-12;
  CHECK(minimum_fluidisation_wen_yu(fine, 2650) ==
        Approx(0.0408 * archimedes / 67.4 * 1e-6 / fine).epsilon(1e-6));
  // 2 mm quartz in water: Ar = 129,492, Re = √(1135.69 + 5283.27) − 33.7 = 46.42.
  CHECK(minimum_fluidisation_wen_yu(2e-3, 2650) == Approx(46.42e-6 / 2e-3).epsilon(1e-3));
}
