#include <catch2/catch.hpp>
#include <numbers>

#include "hand_packings.h"
#include "suffuse/micromechanics/broken_contacts.h"
#include "suffuse/micromechanics/fabric.h"
#include "suffuse/micromechanics/force_distribution.h"
#include "suffuse/micromechanics/slipping.h"
#include "suffuse/micromechanics/strong_contacts.h"

using namespace suffuse;
using namespace suffuse::micromechanics;
using namespace suffuse::micromechanics::testing;

namespace {

/// A contact along z with given normal and tangential force.
Contact contact_with(double normal, double tangential, double friction) {
  return {0, 1, Vec3(0, 0, 2), Vec3(tangential, 0, normal), friction};
}

Packing two_grains(std::vector<Contact> contacts) {
  Packing packing;
  packing.grains = {grain(1, 1, Vec3(0, 0, 2)), grain(2, 1, Vec3::Zero())};
  packing.contacts = std::move(contacts);
  packing.volume = 10;
  return packing;
}

}  // namespace

TEST_CASE("the slipping index is the tangential force over its Coulomb limit") {
  CHECK(slipping_index(contact_with(10, 1.5, 0.3)) == Approx(0.5));
  CHECK(mobilised_friction(contact_with(10, 1.5, 0.3)) == Approx(0.15));
  CHECK(slipping_index(contact_with(10, 3, 0.3)) == Approx(1));
  CHECK(slipping_index(contact_with(10, 0, 0.3)) == 0);
  CHECK(slipping_index(contact_with(0, 0, 0.3)) == 0);
}

TEST_CASE("sliding has a tolerance for rounding, which the appendix's rule has not") {
  const SlidingRule tolerant;
  const SlidingRule exact = SlidingRule::appendix();
  const Contact nearly = contact_with(10, 3 * (1 - 1e-9), 0.3);
  CHECK(is_sliding(nearly, tolerant));
  CHECK_FALSE(is_sliding(nearly, exact));
  const Contact stuck = contact_with(10, 3 * (1 - 1e-5), 0.3);
  CHECK_FALSE(is_sliding(stuck, tolerant));
  const Contact capped = contact_with(10, 3.001, 0.3);
  CHECK(is_sliding(capped, exact));
}

TEST_CASE("damping above the limit does not make a contact slide where its spring is known") {
  const Contact damped = contact_with(10, 8.85, 0.3);  // 2.95 times the limit
  CHECK(slipping_index(damped) == 1);
  CHECK(is_sliding(damped, {}));
  CHECK(is_above_limit(damped, 1e-6));
  CHECK(contacts_above_limit(two_grains({damped, contact_with(10, 3, 0.3)}), 1e-6) == 1);
  Contact known = damped;
  known.friction_limit = 3;
  known.spring_force = 1.2;
  CHECK_FALSE(is_sliding(known, {}));
  CHECK_FALSE(is_above_limit(known, 1e-6));
  known.spring_force = 3 * (1 - 1e-9);
  CHECK(is_sliding(known, {}));
}

TEST_CASE("the limit of the contact law counts where cohesion pulls the normal force below it") {
  Contact held = contact_with(10, 2, 0.3);  // 10 N in all: 14 N of the spring less 4 N of cohesion
  held.friction_limit = 0.3 * 14;
  held.spring_force = 1.9;
  CHECK(slipping_index(held) == Approx(2 / 4.2));
  CHECK(mobilised_friction(held) == Approx(2. / 14));
  CHECK_FALSE(is_sliding(held, {}));
}

TEST_CASE("a contact in tension is no strong one and has a negative normal force") {
  const Contact tensile = contact_with(-10, 0.5, 0.3);
  const Packing packing = two_grains({tensile, contact_with(4, 0, 0.3), contact_with(8, 0, 0.3)});
  CHECK(normal_force(tensile) == Approx(-10));
  const double mean = mean_normal_force(normal_force_sums(packing));
  CHECK(mean == Approx(2. / 3));
  const StrongContacts strong = strong_contacts(strong_sums(packing, 5), 2);
  CHECK(strong.share == Approx(1. / 3));
  // Two compressive contacts and one of tension: (4 + 8 − 10) × branch; the strong one carries 8 of 2.
  CHECK(strong.mean_stress_share == Approx(4));
  const ForceDistribution forces = force_distribution(packing, {});
  CHECK(forces.tensile_share == Approx(1. / 3));
}

TEST_CASE("a frictionless contact slides, except by the appendix's 0/0") {
  const Contact smooth = contact_with(10, 0, 0);
  CHECK(slipping_index(smooth) == 1);
  CHECK(is_sliding(smooth, {}));
  CHECK_FALSE(is_sliding(smooth, SlidingRule::appendix()));
}

TEST_CASE("the share of sliding contacts counts each contact once") {
  Packing packing = two_grains({contact_with(10, 3, 0.3), contact_with(10, 1.5, 0.3),
                                contact_with(10, 0, 0.3), contact_with(10, 0, 0.3)});
  add_image_contact(packing, contact_with(10, 3, 0.3), {3, 0.5, Listing::elsewhere});
  const Sliding result = sliding(sliding_sums(packing, {}));
  CHECK(result.share == Approx(0.25));
  CHECK(result.mean_slipping_index == Approx(1.5 / 4));
  CHECK(result.mean_mobilised_friction == Approx(0.45 / 4));
  CHECK(sliding(sliding_sums(two_grains({}), {})).share == 0);
}

TEST_CASE("cubic arrays have an isotropic fabric tensor") {
  for (const Packing& packing : {simple_cubic(3, 1, push(1)), face_centred_cubic(2, 1, push(1))}) {
    const Mat3 fabric = fabric_tensor(fabric_sums(packing));
    CHECK((fabric - Mat3::Identity() / 3).norm() < 1e-12);  // rounding
    CHECK(deviatoric_fabric(fabric) < 1e-12);
  }
  CHECK(fabric_tensor(fabric_sums(two_grains({}))).norm() == 0);
}

TEST_CASE("parallel normals give a deviatoric fabric of one") {
  const FabricSums sums = fabric_sums(two_grains({contact_with(1, 0, 0.3)}));
  CHECK(deviatoric_fabric(fabric_tensor(sums)) == Approx(1));
  // Its projections: none in xy, ±90° in xz and yz.
  for (const double count : sums.planes[0].counts) CHECK(count == 0);
  for (const std::size_t plane : {1u, 2u}) {
    CHECK(sums.planes[plane].counts[9] == 1);
    CHECK(sums.planes[plane].counts[27] == 1);
  }
}

TEST_CASE("the orientation histogram does not depend on which grain is listed first") {
  Packing packing = face_centred_cubic(2, 1, push(1));
  const FabricSums before = fabric_sums(packing);
  for (Contact& contact : packing.contacts) {
    contact.branch = -contact.branch;
    contact.force = -contact.force;
  }
  const FabricSums after = fabric_sums(packing);
  for (std::size_t plane = 0; plane < 3; ++plane)
    CHECK(before.planes[plane].counts == after.planes[plane].counts);
  double total = 0;
  for (const double count : before.planes[0].counts) total += count;
  CHECK(total == 2 * before.contacts);
}

TEST_CASE("the rose fit recovers the anisotropy and direction of a known distribution") {
  const double a = 0.4, direction = 0.3;
  OrientationHistogram histogram;
  for (int bin = 0; bin < kOrientationBins; ++bin)
    histogram.counts[static_cast<std::size_t>(bin)] =
        1e4 * (1 + a * std::cos(2 * (bin_centre(bin) - direction)));
  const RoseFit fit = fit_rose(histogram);
  CHECK(fit.anisotropy == Approx(a).epsilon(1e-12));  // the model is in the fit's span: rounding only
  CHECK(fit.direction == Approx(direction).epsilon(1e-12));
  const auto density = orientation_density(histogram);
  double integral = 0;
  for (std::size_t bin = 0; bin < density.size(); ++bin) {
    integral += density[bin] * 2 * std::numbers::pi / kOrientationBins;
    CHECK(density[bin] == Approx(fit.density(bin_centre(static_cast<int>(bin)))).epsilon(1e-12));
  }
  CHECK(integral == Approx(1));
}

TEST_CASE("the rose fit of an isotropic or empty histogram has no anisotropy") {
  OrientationHistogram histogram;
  CHECK(fit_rose(histogram).anisotropy == 0);
  histogram.counts.fill(7);
  CHECK(fit_rose(histogram).anisotropy < 1e-12);
  // Perpendicular preference: cos 2θ_A = −1, where the appendix's atan would turn the rose by 90°.
  for (int bin = 0; bin < kOrientationBins; ++bin)
    histogram.counts[static_cast<std::size_t>(bin)] = 1 - 0.5 * std::cos(2 * bin_centre(bin));
  CHECK(fit_rose(histogram).anisotropy == Approx(0.5));
  CHECK(std::abs(fit_rose(histogram).direction) == Approx(std::numbers::pi / 2));
}

TEST_CASE("strong contacts are those at or above the threshold, and carry their share of the stress") {
  const Packing packing =
      two_grains({contact_with(1, 0, 0.3), contact_with(2, 0, 0.3), contact_with(3, 0, 0.3)});
  const double mean = mean_normal_force(normal_force_sums(packing));
  CHECK(mean == Approx(2));
  const StrongContacts strong = strong_contacts(strong_sums(packing, mean), 2);
  CHECK(strong.share == Approx(2.0 / 3));
  CHECK(strong.mean_stress_share == Approx(5.0 / 6));
  CHECK(strong.deviator_share.value() == Approx(5.0 / 6));
  // Along three axes alike but for half a per cent: a deviator by chance.
  const auto along = [](double x, double y, double z) {
    return two_grains({{0, 1, Vec3(1, 0, 0), Vec3(x, 0, 0), 0.3},
                       {0, 1, Vec3(0, 1, 0), Vec3(0, y, 0), 0.3},
                       {0, 1, Vec3(0, 0, 1), Vec3(0, 0, z), 0.3}});
  };
  CHECK_FALSE(strong_contacts(strong_sums(along(1, 1, 1.005), 1.001), 2).deviator_share);
  CHECK(strong_contacts(strong_sums(along(1, 1, 1.02), 1.001), 2).deviator_share);
  CHECK(strong_contacts(strong_sums(packing, 100), 2).share == 0);
  CHECK(strong_contacts(strong_sums(two_grains({}), 0), 2).share == 0);
}

TEST_CASE("all contacts of a regular array are strong") {
  // Equal forces: their mean is met up to rounding of the sum, hence the slightly lower threshold.
  const Packing packing = simple_cubic(3, 1, push(0.1));
  const double mean = mean_normal_force(normal_force_sums(packing));
  CHECK(strong_contacts(strong_sums(packing, mean * (1 - 1e-12)), 2).share == 1);
}

TEST_CASE("broken contacts are told apart from contacts formed meanwhile") {
  const std::vector<GrainPair> reference{{1, 2}, {1, 3}, {2, 3}, {4, 5}};
  const std::vector<GrainPair> current{{1, 3}, {2, 4}, {4, 5}};
  const BrokenContacts broken = broken_contacts(broken_sums(reference, current));
  CHECK(broken.net == Approx(0.25));
  CHECK(broken.gross == Approx(0.5));
  CHECK(broken.formed == Approx(0.25));
  CHECK(broken.net == Approx(broken.gross - broken.formed));
  CHECK(broken_contacts(broken_sums({}, current)).gross == 0);
}

TEST_CASE("contact pairs are the same list on any number of ranks") {
  const Packing packing = face_centred_cubic(2, 1, push(1));
  const std::vector<GrainPair> whole = contact_pairs(packing);
  CHECK(whole.size() == packing.contacts.size());
  std::vector<GrainPair> gathered;
  for (const Packing& part : shared_out(packing, 3))
    for (const GrainPair& pair : contact_pairs(part)) gathered.push_back(pair);
  std::sort(gathered.begin(), gathered.end());
  CHECK(gathered == whole);
}
