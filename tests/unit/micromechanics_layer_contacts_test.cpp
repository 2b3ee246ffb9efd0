#include <catch2/catch.hpp>

#include "suffuse/micromechanics/layer_contacts.h"

using namespace suffuse::micromechanics;

namespace {

/// Five grains of 1 mm on each other from 0 to 5 mm, the last one of double the size; forces in N downwards.
Packing stack() {
  Packing packing;
  for (int k = 0; k < 5; ++k)
    packing.grains.push_back({k + 1, k == 4 ? 1e-3 : 0.5e-3, suffuse::Vec3(0, 0, 0.5e-3 + 1e-3 * k)});
  for (int k = 0; k < 4; ++k) {
    Contact contact;
    contact.first = k;
    contact.second = k + 1;
    contact.branch = suffuse::Vec3(0, 0, -1e-3);
    contact.force = suffuse::Vec3(k == 0 ? 0.3 * (4 - k) : 0, 0, -(4.0 - k));
    contact.friction = 0.3;
    packing.contacts.push_back(contact);
  }
  return packing;
}

const HeightLayers kLayers{2, 0, 5e-3, 2};  // layer 0 above 2.5 mm

}  // namespace

TEST_CASE("layers are numbered from the top and end at their bounds") {
  CHECK(kLayers.of(4.9e-3) == 0);
  CHECK(kLayers.of(0.1e-3) == 1);
  CHECK_FALSE(kLayers.of(5.1e-3));
  CHECK_FALSE(kLayers.of(-1e-6));
}

TEST_CASE("networks of layers: contacts by their middle, grains by their centre, by hand") {
  // Grains at 0.5, 1.5 | 2.5 (on the boundary: layer 1), 3.5, 4.5 mm; contacts at 1, 2 | 3, 4 mm.
  const std::vector<LayerNetwork> found = layer_networks(stack(), kLayers, {}, {});
  REQUIRE(found.size() == 3);
  CHECK(found[0].contacts == 2);
  CHECK(found[1].contacts == 2);
  CHECK(found[2].grains == 5);
  CHECK(found[2].coordination == Approx(8.0 / 5));
  CHECK(found[0].mean_normal_force == Approx(1.5));
  CHECK(found[1].mean_normal_force == Approx(3.5));
  CHECK(found[1].sliding_share == Approx(0.5));
  CHECK(found[2].sliding_share == Approx(0.25));
  CHECK(found[2].constraint_ratio == Approx(1.6 * (3 - 0.5) / 12));
  CHECK(found[2].strong_share == Approx(0.5));  // 4 and 3 N against a mean of 2.5
  CHECK(layer_networks(stack(), kLayers, {}, {1.5, 3.5, 0.5})[2].strong_share == Approx(1));
  CHECK(found[2].strong_stress_share == Approx(0.7));  // of 10 N that are carried over 1 mm each, 4 and 3
  CHECK(layer_networks(stack(), kLayers, {}, {1.5, 3.5, 0.5})[0].strong_stress_share == Approx(2.0 / 3));
}

TEST_CASE("contacts lost by layers: gross by where they were, net by how many there are") {
  const Packing before = stack();
  const LayerReference reference(before, kLayers);
  Packing after = before;
  after.contacts.erase(after.contacts.begin() + 3);  // that at 4 mm
  std::vector<BrokenContacts> broken = reference.broken(after);
  CHECK(broken[0].gross == Approx(0.5));
  CHECK(broken[0].net == Approx(0.5));
  CHECK(broken[1].gross == 0);
  CHECK(broken[2].net == Approx(0.25));
  // Carried down whole: no contact is lost, but the upper layer has fewer.
  Packing sunk = before;
  for (Grain& grain : sunk.grains) grain.position[2] -= 1.0e-3;
  broken = reference.broken(sunk);
  CHECK(broken[2].gross == 0);
  CHECK(broken[0].net == Approx(0.5));
  CHECK(broken[1].net == Approx(0));  // two have left below, hold: one came, one left
}

TEST_CASE("distributions add up to one, and the sizes are those of the grains") {
  const Packing packing = stack();
  CHECK(own_size_at(packing, 0.3) == Approx(1e-3));  // four of 1 mm hold 4/12 of the mass
  CHECK(own_size_at(packing, 0.5) == Approx(2e-3));
  const ContactCounts all = coordination_distribution(packing, kLayers, std::nullopt, 0);
  CHECK(all[1] == Approx(0.4));
  CHECK(all[2] == Approx(0.6));
  CHECK(coordination_distribution(packing, kLayers, std::nullopt, own_size_at(packing, 0.5))[1] == Approx(1));
  CHECK(median_of(all) == 2);
  CHECK(mean_coordination(packing, kLayers, std::nullopt, 0) == Approx(1.6));
  CHECK(mean_coordination(packing, kLayers, 0, 2e-3) == Approx(1));
  const ForceShares forces = normal_force_distribution(packing, kLayers, std::nullopt, 2);
  CHECK(forces[2] == Approx(0.25));  // 1 N of a mean of 2
  CHECK(forces[8] == Approx(0.25));  // 4 N
  CHECK(normal_force_distribution(packing, kLayers, 1, 0.5)[24] ==
        Approx(1));  // six and eight times the mean
  CHECK(normal_force_distribution(packing, kLayers, 1, 0)[24] == 0);
  const SlippingShares slipping = slipping_distribution(packing, kLayers, std::nullopt, {});
  CHECK(slipping[0] == Approx(0.75));
  CHECK(slipping[10] == Approx(0.25));
}
