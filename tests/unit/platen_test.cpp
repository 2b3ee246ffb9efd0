#include "laws/platen.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "grains/contact_pass.h"
#include "suffuse/micromechanics/hertz_contact.h"

using namespace suffuse;
using namespace suffuse::platen;

namespace {

constexpr double kYoungs = 5e7, kPoisson = 0.3, kRestitution = 0.7, kRadius = 2e-4;
const double kMass = 2650 * 4. / 3 * std::numbers::pi * std::pow(kRadius, 3);

Material material(double restitution = kRestitution) {
  return {effective_modulus(kYoungs, kPoisson, 2 * kYoungs, 0.2), damping_factor(restitution)};
}

/// The same contact by the pair's law, with a grain a billion times as large in the platen's place.
double force_of_pair(double overlap, double approach) {
  const double large = 1e9 * kRadius;
  const Material own = material();
  const grains::PairCoefficients pair{own.effective_modulus, 0, own.damping, 0, 0, 0};
  // The large grain is the origin's: its centre costs no digits of the overlap if the small one's place is
  // exact.
  const grains::Quad position[] = {{0, 0, large + kRadius - overlap, kRadius}, {0, 0, 0, large}};
  const grains::Quad velocity[] = {{0, 0, -approach, 1 / kMass}, {0, 0, 0, 1e-30}};
  const grains::Quad spin[] = {{0, 0, 0, kRadius}, {0, 0, 0, large}};
  const int first = 0, second = 1;
  grains::Quad springs[1];
  grains::Load loads[2];
  grains::PassSettings settings;
  settings.law.tangential = grains::TangentialLaw::off;
  settings.law.coefficients = &pair;
  grains::PassOutput output;
  output.loads = loads;
  output.owned = 2;
  grains::reference_contact_pass({1, &first, &second, &second, &second}, {position, velocity, spin, nullptr},
                                 settings, springs, output);
  return loads[0].force.z;
}

}  // namespace

TEST_CASE("a grain and a platen touch by the law of a pair whose second grain is flat and immovable") {
  // 1e-3: at 1e9 radii a double has the overlap to four digits.
  for (const double approach : {0., 0.02, -0.003})
    CHECK(reaction(material(), kRadius, kMass, 2e-6, approach).force ==
          Approx(force_of_pair(2e-6, approach)).epsilon(1e-3));
  const Reaction rest = reaction(material(), kRadius, kMass, 2e-6, 0);
  const micromechanics::HertzPair pair{material().effective_modulus, kRadius};
  CHECK(rest.force == Approx(micromechanics::hertz_force(pair, 2e-6)));
  CHECK(rest.stiffness == Approx(1.5 * rest.force / 2e-6));  // Hertz: dF/dδ = 3F/(2δ)
}

TEST_CASE("a grain leaves a platen with the coefficient of restitution, and is never held back") {
  for (const double restitution : {1., 0.7, 0.4}) {
    double speed = 0.1, depth = 0;  // towards the platen, m/s; m
    const double step = 1e-8;
    do {
      const Reaction now = reaction(material(restitution), kRadius, kMass, std::max(depth, 1e-15), speed);
      CHECK(now.force >= 0);
      speed -= step * now.force / kMass;
      depth += step * speed;
    } while (depth > 0);
    // Without the attraction at the end, with which the law's damping gives e, a grain keeps a little more:
    // up to 0.075.
    CHECK(-speed / 0.1 > restitution - 1e-3);
    CHECK(-speed / 0.1 < restitution + (restitution < 1 ? 0.08 : 1e-3));
  }
}

TEST_CASE("a platen comes to rest where its contacts carry the load, at no more than its speed") {
  const Drive drive{3e-4, 1e-7, 0.5, 0.01};
  for (const double outward : {1., -1.}) {
    Motion platen{outward * (kRadius + 5e-6), 0};  // the grain's centre is the origin, held there
    double fastest = 0;
    for (int step = 0; step < 40000; ++step) {
      const double overlap = kRadius - outward * platen.position;
      const Reaction now =
          overlap > 0 ? reaction(material(), kRadius, kMass, overlap, -platen.velocity) : Reaction{};
      CHECK(stiffness_of_step(drive, now, 1e-7) < 1);
      advance(platen, drive, now, outward, 1e-7);
      fastest = std::max(fastest, std::abs(platen.velocity));
    }
    const micromechanics::HertzPair pair{material().effective_modulus, kRadius};
    const double overlap = kRadius - outward * platen.position;
    CHECK(micromechanics::hertz_force(pair, overlap) == Approx(drive.load));
    CHECK(fastest <= drive.most_speed);
    CHECK(fastest > 0.9 * drive.most_speed);
  }
}

TEST_CASE("grains are counted in the class of their diameter, a bound belonging to the class above it") {
  SizeTally tally({1e-4, 2e-4});
  CHECK(tally.classes() == 3);
  CHECK(tally.class_of(0.5e-4) == 0);
  CHECK(tally.class_of(1e-4) == 1);
  CHECK(tally.class_of(3e-4) == 2);
  tally.row(0) = {4, 1e-9};
  tally.row(2) = {1, 5e-9};
  CHECK(tally.total().grains == 5);
  CHECK(tally.total().mass == Approx(6e-9));
  CHECK(SizeTally().class_of(1) == 0);
}
