#include <catch2/catch.hpp>

#include "hand_packings.h"
#include "suffuse/micromechanics/constraint_ratio.h"
#include "suffuse/micromechanics/coordination.h"

using namespace suffuse;
using namespace suffuse::micromechanics;
using namespace suffuse::micromechanics::testing;

namespace {

/// A coarse grain (id 1, r = 1) that carries three fines (r = 0.1), two coarse neighbours in contact with it,
/// one chain fine–fine, one grain with one contact and two fines without any.
///
///   contacts: 1–2 (cc), 1–3 (cc), 1–4 (fc), 1–5 (fc), 4–6 (ff), 2–3 (cc)
///   counts:   grain 1: 4, 2: 2, 3: 2, 4: 2, 5: 1, 6: 1, 7: 0, 8: 0
Packing two_sizes() {
  Packing packing;
  for (int id = 1; id <= 8; ++id) packing.grains.push_back(grain(id, id <= 3 ? 1.0 : 0.1, Vec3::Zero()));
  packing.volume = 100;
  for (const auto& [i, j] :
       std::vector<std::pair<int, int>>{{0, 1}, {0, 2}, {0, 3}, {0, 4}, {3, 5}, {1, 2}}) {
    const double reach = packing.grains[static_cast<std::size_t>(i)].radius +
                         packing.grains[static_cast<std::size_t>(j)].radius;
    const Vec3 branch(reach, 0, 0);
    packing.contacts.push_back({i, j, branch, Vec3(1, 0, 0), 0.3});
  }
  return packing;
}

}  // namespace

TEST_CASE("simple cubic and face-centred cubic arrays have six and twelve contacts a grain") {
  const Coordination sc = coordination(coordination_sums(simple_cubic(3, 0.5, push(1)), {}), 27);
  CHECK(sc.mean == 6);
  CHECK(sc.geometric == 6);
  CHECK(sc.mechanical == 6);
  // Σ C_p V_p / V = Z (1 − n); the tolerance is rounding of the sum over grains.
  CHECK(sc.volume_weighted == Approx(6 * std::numbers::pi / 6).epsilon(1e-12));
  CHECK(sc.stable_share == 1);
  const Coordination fcc = coordination(coordination_sums(face_centred_cubic(2, 0.5, push(1)), {}), 1);
  CHECK(fcc.mean == 12);
}

TEST_CASE("a hand-made packing of two sizes gives every partial coordination number") {
  const CoordinationSums sums = coordination_sums(two_sizes(), {0.5});
  CHECK(sums.grains == 8);
  CHECK(sums.fines == 5);
  CHECK(sums.contacts == 6);
  CHECK(sums.coarse_coarse == 3);
  CHECK(sums.fine_coarse == 2);
  CHECK(sums.fine_fine == 1);
  CHECK(sums.unconnected == 2);
  CHECK(sums.single_contact == 2);
  CHECK(sums.unconnected_fines == 2);
  CHECK(sums.stable == 1);
  const Coordination z = coordination(sums, 100);
  CHECK(z.mean == Approx(12.0 / 8));
  CHECK(z.geometric == Approx(12.0 / 6));
  CHECK(z.mechanical == Approx(10.0 / 4));
  CHECK(z.coarse_coarse == Approx(6.0 / 3));
  CHECK(z.fine_coarse == Approx(2 * 3.0 / 5));
  CHECK(z.fine_fine == Approx(2.0 / 5));
  CHECK(z.fines_mean == Approx(4.0 / 5));
  CHECK(z.unconnected_fines_share == Approx(2.0 / 5));
  CHECK(z.stable_share == Approx(1.0 / 8));
  // (4+2+2) spheres of radius 1 and (2+1+1) of radius 0.1 in 100 m³
  CHECK(z.volume_weighted == Approx((8 + 4 * 1e-3) * 4.0 / 3 * std::numbers::pi / 100));
}

TEST_CASE("contact classes add up to all contacts whatever the split") {
  for (const double split : {0.0, 0.2, 0.5, 3.0}) {
    const CoordinationSums sums = coordination_sums(two_sizes(), {split});
    CHECK(sums.coarse_coarse + sums.fine_coarse + sums.fine_fine == sums.contacts);
  }
}

TEST_CASE("a grain as large as the split is coarse") {
  CHECK(coordination_sums(two_sizes(), {0.2}).fines == 0);
  CHECK(coordination_sums(two_sizes(), {0.2 * (1 + 1e-15) + 1e-15}).fines == 5);
}

TEST_CASE("coordination sums of two and three ranks add up to those of one") {
  for (const int ranks : {2, 3}) {
    CoordinationSums total;
    for (const Packing& part : shared_out(two_sizes(), ranks))
      add_sums(total, coordination_sums(part, {0.5}));
    CoordinationSums whole = coordination_sums(two_sizes(), {0.5});
    for (std::size_t i = 0; i < as_doubles(whole).size(); ++i)
      CHECK(as_doubles(total)[i] ==
            Approx(as_doubles(whole)[i]).epsilon(1e-14));  // rounding of the volume sum
  }
}

TEST_CASE("a grain between its own periodic images has two contacts and stands in one") {
  Packing packing;
  packing.grains.push_back(grain(1, 0.5, Vec3(0.5, 0.5, 0.5)));
  packing.volume = 1;
  add_image_contact(packing, {0, 0, Vec3(1, 0, 0), Vec3(1, 0, 0), 0.3}, {1, 0.5, Listing::whole});
  add_image_contact(packing, {0, 0, Vec3(-1, 0, 0), Vec3(-1, 0, 0), 0.3}, {1, 0.5, Listing::elsewhere});
  const CoordinationSums sums = coordination_sums(packing, {});
  CHECK(sums.contacts == 1);
  CHECK(contacts_per_grain(packing)[0] == 2);
  CHECK(coordination(sums, 1).mean == 2);
}

TEST_CASE("a sample without contacts or without grains has coordination zero") {
  Packing packing;
  CHECK(coordination(coordination_sums(packing, {1}), 0).mean == 0);
  packing.grains.push_back(grain(1, 1, Vec3::Zero()));
  const Coordination z = coordination(coordination_sums(packing, {1}), 10);
  for (const double value :
       {z.mean, z.mechanical, z.geometric, z.volume_weighted, z.coarse_coarse, z.fine_coarse})
    CHECK(value == 0);
}

TEST_CASE("a frictional simple cubic array has one and a half constraints a degree of freedom") {
  const Coordination z = coordination(coordination_sums(simple_cubic(3, 0.5, push(1)), {}), 27);
  CHECK(constraint_ratio(z, 0).mean == Approx(1.5));
  CHECK(constraint_ratio(z, 1).mean == Approx(0.5));
  CHECK(constraint_ratio(z, 0.25).geometric == Approx(6 * 2.5 / 12));
}

TEST_CASE("geometric and mechanical constraint ratios use the same share of sliding contacts") {
  const Coordination z = coordination(coordination_sums(two_sizes(), {0.5}), 100);
  const ConstraintRatio ratio = constraint_ratio(z, 0.1);
  CHECK(ratio.mean == Approx(1.5 * 2.8 / 12));
  CHECK(ratio.geometric == Approx(2.0 * 2.8 / 12));
  CHECK(ratio.mechanical == Approx(2.5 * 2.8 / 12));
}

TEST_CASE("the verdict follows the constraint ratio") {
  CHECK(hydromechanical_state(1.1) == HydromechanicalState::stable);
  CHECK(hydromechanical_state(1.001) == HydromechanicalState::transitional);
  CHECK(hydromechanical_state(0.9) == HydromechanicalState::fluid_like);
  CHECK(std::string(to_string(hydromechanical_state(0.2))) == "fluid-like");
}
