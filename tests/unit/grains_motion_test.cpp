// Loops over grains around the contact pass: each instruction set against plain loops, for every number of
// grains from none to two groups and more, and nothing beside the grains touched.

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "grains/grain_motion.h"

using namespace suffuse;
using namespace suffuse::grains;

namespace {

constexpr std::size_t kMost = 11, kBeside = 5;
constexpr double kUntouched = 1234.5;

/// Values of `count` grains, and beyond them some that must stay.
struct Values : std::vector<double> {
  Values(std::size_t count, std::mt19937& random, double low, double high) {
    std::uniform_real_distribution<double> of(low, high);
    for (std::size_t k = 0; k < count; ++k) push_back(of(random));
    resize(count + kBeside, kUntouched);
  }
  bool rest_untouched() const {
    return std::all_of(end() - kBeside, end(), [](double value) { return value == kUntouched; });
  }
};

struct Grains {
  std::mt19937 random{11};
  std::size_t count;
  Values position, velocity, spin, force, torque, mass, radius, mobility;

  explicit Grains(std::size_t grains)
      : count(grains),
        position(3 * grains, random, -1, 1),
        velocity(3 * grains, random, -1, 1),
        spin(3 * grains, random, -1e3, 1e3),
        force(3 * grains, random, -1e-3, 1e-3),
        torque(3 * grains, random, -1e-7, 1e-7),
        mass(grains, random, 1e-8, 1e-6),
        radius(grains, random, 1e-4, 1e-3),
        mobility(grains, random, 0, 1) {}

  MovingGrains arrays() {
    return {position.data(), velocity.data(), spin.data(),  force.data(),
            torque.data(),   mass.data(),     radius.data()};
  }
};

const auto kRounding = [](double expected) { return Approx(expected).epsilon(1e-14).margin(1e-16); };

}  // namespace

TEST_CASE("a half step and a step of velocity Verlet of every number of grains", "[grains]") {
  for (const InstructionSet set : available_instruction_sets()) {
    for (std::size_t count = 0; count <= kMost; ++count) {
      for (const double step : {0., 1e-6}) {
        INFO(name_of(set) << ", " << count << " grains, step " << step);
        const double half = 5e-7, inertia = count % 2 == 0 ? 0.4 : 0.5;
        Grains before(count), after(count);
        advance_grains(set, after.arrays(), count, {half, step, inertia});
        for (std::size_t k = 0; k < 3 * count; ++k) {
          const std::size_t i = k / 3;
          const double v = before.velocity[k] + half / before.mass[i] * before.force[k];
          CHECK(after.velocity[k] == kRounding(v));
          CHECK(after.position[k] == kRounding(before.position[k] + step * v));
          const double moment = inertia * before.mass[i] * before.radius[i] * before.radius[i];
          CHECK(after.spin[k] == kRounding(before.spin[k] + half / moment * before.torque[k]));
        }
        CHECK(after.force == before.force);
        CHECK((after.position.rest_untouched() && after.velocity.rest_untouched() &&
               after.spin.rest_untouched()));
      }
    }
  }
}

TEST_CASE("a grain moves alike wherever it stands among the others", "[grains]") {
  for (const InstructionSet set : available_instruction_sets()) {
    Grains all(kMost);
    advance_grains(set, all.arrays(), kMost, {5e-7, 1e-6, 0.4});
    for (std::size_t first = 1; first < kMost; ++first) {
      INFO(name_of(set) << ", without the first " << first);
      Grains part(kMost);
      advance_grains(
          set,
          {&part.position[3 * first], &part.velocity[3 * first], &part.spin[3 * first],
           &part.force[3 * first], &part.torque[3 * first], &part.mass[first], &part.radius[first]},
          kMost - first, {5e-7, 1e-6, 0.4});
      for (std::size_t k = 3 * first; k < 3 * kMost; ++k) {
        CHECK(part.position[k] == all.position[k]);
        CHECK(part.velocity[k] == all.velocity[k]);
        CHECK(part.spin[k] == all.spin[k]);
      }
    }
  }
}

TEST_CASE("the motion of every number of grains is gathered", "[grains]") {
  for (const InstructionSet set : available_instruction_sets()) {
    for (std::size_t count = 0; count <= kMost; ++count) {
      INFO(name_of(set) << ", " << count << " grains");
      Grains grains(count);
      const Quad beside{kUntouched, kUntouched, kUntouched, kUntouched};
      std::vector<Quad> position(count + 1, beside), velocity(count + 1, beside), spin(count + 1, beside);
      gather_motion(set, grains.arrays(), grains.mobility.data(), count, position.data(), velocity.data(),
                    spin.data());
      for (std::size_t i = 0; i < count; ++i) {
        const auto is = [i](const Quad& record, const Values& vector, double fourth) {
          return record.x == vector[3 * i] && record.y == vector[3 * i + 1] &&
                 record.z == vector[3 * i + 2] && record.w == fourth;
        };
        CHECK(is(position[i], grains.position, grains.radius[i]));
        CHECK(is(velocity[i], grains.velocity, grains.mobility[i] / grains.mass[i]));
        CHECK(is(spin[i], grains.spin, grains.radius[i]));
      }
      CHECK((position[count].x == kUntouched && velocity[count].x == kUntouched &&
             spin[count].w == kUntouched));
    }
  }
}

TEST_CASE("loads are handed out once", "[grains]") {
  for (const InstructionSet set : available_instruction_sets()) {
    for (std::size_t count = 0; count <= kMost; ++count) {
      INFO(name_of(set) << ", " << count << " grains");
      Grains before(count), after(count);
      std::vector<Load> loads(count + 1);
      for (std::size_t i = 0; i <= count; ++i) {
        const double n = static_cast<double>(i);
        loads[i] = {{1e-3 * n, 2e-3, -n, 7}, {1e-8, -2e-8 * n, 3e-8, 7}};
      }
      const std::vector<Load> given = loads;
      for (int again = 0; again < 2; ++again)
        hand_out_loads(set, loads.data(), count, after.force.data(), after.torque.data());
      for (std::size_t i = 0; i < count; ++i) {
        CHECK(after.force[3 * i] == before.force[3 * i] + given[i].force.x);
        CHECK(after.force[3 * i + 1] == before.force[3 * i + 1] + given[i].force.y);
        CHECK(after.force[3 * i + 2] == before.force[3 * i + 2] + given[i].force.z);
        CHECK(after.torque[3 * i] == before.torque[3 * i] + given[i].torque.x);
        CHECK(after.torque[3 * i + 1] == before.torque[3 * i + 1] + given[i].torque.y);
        CHECK(after.torque[3 * i + 2] == before.torque[3 * i + 2] + given[i].torque.z);
      }
      CHECK(loads[count].force.x == given[count].force.x);
      CHECK((after.force.rest_untouched() && after.torque.rest_untouched()));
    }
  }
}
