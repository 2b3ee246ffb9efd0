// The vectorised contact loop against the plain one, and the plain one against closed forms.

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "grains/contact_pass.h"

using namespace suffuse;
using namespace suffuse::grains;

namespace {

/// Grains at random, dense enough that many candidates touch, of two materials.
struct Heap {
  std::vector<Quad> position, velocity, spin, springs;
  std::vector<int> material, first, second, receiver;
  std::vector<PairCoefficients> coefficients;
  int owned;

  explicit Heap(int grains, unsigned seed = 7) : owned(grains - grains / 5) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    const double box = std::cbrt(grains * 3e-11);
    for (int i = 0; i < grains; ++i) {
      const double radius = 0.3e-3 * (1.2 + unit(random));
      position.push_back({box * unit(random), box * unit(random), box * unit(random), radius});
      velocity.push_back({unit(random), unit(random), unit(random), 1 / (1e4 * radius * radius * radius)});
      spin.push_back({1e3 * unit(random), 1e3 * unit(random), 1e3 * unit(random), radius});
      material.push_back(i % 2);
    }
    for (int i = 0; i < owned; ++i)
      for (int j = i + 1; j < grains; ++j) {
        first.push_back(i);
        second.push_back(j);
        receiver.push_back(j < owned ? j : grains);
        springs.push_back(
            {1e-6 * unit(random), 1e-6 * unit(random), 1e-6 * unit(random), random() % 3 == 0 ? 3. : 4.});
      }
  }

  std::size_t grains() const { return position.size(); }
  CandidatePairs candidates() const {
    return {first.size(), first.data(), second.data(), second.data(), receiver.data()};
  }
  GrainArrays arrays() const { return {position.data(), velocity.data(), spin.data(), material.data()}; }

  PassSettings settings(NormalLaw normal, TangentialLaw tangential, RollingLaw rolling, int materials) {
    coefficients.assign(4, {});
    for (int k = 0; k < 4; ++k) {
      auto& c = coefficients[static_cast<std::size_t>(k)];
      const double grow = materials > 1 ? 1 + 0.3 * (k % 3) : 1;
      const bool springs_given = normal == NormalLaw::hooke_stiffness;
      c.normal_stiffness = springs_given ? 2e3 * grow : 5e7 * grow;
      c.tangential_stiffness = springs_given ? 1e3 * grow : normal == NormalLaw::hooke ? 0.3 : 2e7 * grow;
      c.normal_damping = springs_given ? 200 * grow : 0.3;
      c.tangential_damping = springs_given ? 100 * grow : 0.2;
      c.friction = 0.4 * grow;
      c.rolling_friction = 0.1 * grow;
    }
    PassSettings settings;
    settings.law = {normal, tangential, rolling, false, false, false, 0.2, materials, coefficients.data()};
    settings.time_step = 1e-6;
    settings.pass_number = 5;
    return settings;
  }
};

struct Result {
  std::size_t touching = 0;
  std::vector<Quad> springs;
  std::vector<Load> loads;
  std::vector<double> virial, grain_virial;
  std::vector<ContactNote> notes;
};

template <class PassFunction>
Result result_of(const Heap& heap, const PassSettings& settings, PassFunction&& pass) {
  Result result;
  result.springs = heap.springs;
  result.loads.resize(heap.grains() + 1);
  result.virial.resize(6);
  result.grain_virial.resize(6 * heap.grains());
  PassOutput output;
  output.loads = result.loads.data();
  output.virial = result.virial.data();
  output.grain_virial = result.grain_virial.data();
  output.owned = heap.owned;
  output.listener = &result.notes;
  output.note = [](void* to, const ContactNote& note) {
    static_cast<std::vector<ContactNote>*>(to)->push_back(note);
  };
  result.touching = pass(heap.candidates(), heap.arrays(), settings, result.springs.data(), output);
  return result;
}

double rms(const std::vector<double>& values) {
  double sum = 0;
  for (double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}
/// Largest difference as a share of the rms of `expected`.
double difference(const std::vector<double>& found, const std::vector<double>& expected) {
  REQUIRE(found.size() == expected.size());
  double largest = 0;
  for (std::size_t k = 0; k < found.size(); ++k)
    largest = std::max(largest, std::abs(found[k] - expected[k]));
  const double size = rms(expected);
  return size > 0 ? largest / size : largest;
}
std::vector<double> values_of(const std::vector<Quad>& quads, bool with_w) {
  std::vector<double> values;
  for (const Quad& q : quads) {
    values.insert(values.end(), {q.x, q.y, q.z});
    if (with_w) values.push_back(q.w);
  }
  return values;
}
std::vector<double> forces_of(const std::vector<Load>& loads) {
  std::vector<double> values;
  for (const Load& l : loads) values.insert(values.end(), {l.force.x, l.force.y, l.force.z});
  return values;
}
std::vector<double> torques_of(const std::vector<Load>& loads) {
  std::vector<double> values;
  for (const Load& l : loads) values.insert(values.end(), {l.torque.x, l.torque.y, l.torque.z});
  return values;
}

}  // namespace

TEST_CASE("every law's vectorised loop gives the plain loop's loads, springs and virials to rounding") {
  Heap heap(160);
  const auto normal = GENERATE(NormalLaw::hertz, NormalLaw::hooke, NormalLaw::hooke_stiffness);
  const auto tangential = GENERATE(TangentialLaw::off, TangentialLaw::no_history, TangentialLaw::history);
  const auto rolling = GENERATE(RollingLaw::off, RollingLaw::cdt);
  const int materials = GENERATE(1, 2);
  const int variant = GENERATE(0, 1, 2, 3);
  PassSettings settings = heap.settings(normal, tangential, rolling, materials);
  settings.half_step_normal = variant % 2 == 1;
  settings.drop_lost_springs = variant < 2;
  settings.advance_springs = variant != 3;
  settings.law.limit_force = variant == 2;
  settings.law.torsion = variant == 1;
  settings.law.absolute_damping = variant == 3;

  const Result expected = result_of(heap, settings, reference_contact_pass);
  REQUIRE(expected.touching > 500);
  // Sums of some tens of contacts in the same order: some hundred roundings.
  const double bound = 1e-11;
  for (const InstructionSet set : available_instruction_sets()) {
    INFO(name_of(set));
    const Result found =
        result_of(heap, settings, [set](auto&&... arguments) { return contact_pass(set, arguments...); });
    CHECK(found.touching == expected.touching);
    CHECK(difference(forces_of(found.loads), forces_of(expected.loads)) < bound);
    CHECK(difference(torques_of(found.loads), torques_of(expected.loads)) < bound);
    CHECK(difference(values_of(found.springs, true), values_of(expected.springs, true)) < bound);
    CHECK(difference(found.virial, expected.virial) < bound);
    CHECK(difference(found.grain_virial, expected.grain_virial) < bound);
    REQUIRE(found.notes.size() == expected.notes.size());
    std::vector<double> note, expected_note;
    for (std::size_t k = 0; k < found.notes.size(); ++k) {
      CHECK(found.notes[k].pair == expected.notes[k].pair);
      for (int d = 0; d < 3; ++d) {
        note.insert(note.end(), {found.notes[k].force[d], 1e3 * found.notes[k].torque[d],
                                 1e3 * found.notes[k].torque_on_second[d]});
        expected_note.insert(expected_note.end(),
                             {expected.notes[k].force[d], 1e3 * expected.notes[k].torque[d],
                              1e3 * expected.notes[k].torque_on_second[d]});
      }
    }
    CHECK(difference(note, expected_note) < bound);
  }
}

TEST_CASE("contacts between owned grains leave total force zero") {
  Heap heap(120);
  heap.owned = 120;
  for (std::size_t k = 0; k < heap.first.size(); ++k) heap.receiver[k] = heap.second[k];
  const PassSettings settings = heap.settings(NormalLaw::hertz, TangentialLaw::history, RollingLaw::cdt, 2);
  const Result found = result_of(heap, settings, [](auto&&... arguments) {
    return contact_pass(available_instruction_sets().back(), arguments...);
  });
  Quad sum;
  for (const Load& load : found.loads) sum.x += load.force.x, sum.y += load.force.y, sum.z += load.force.z;
  const double size = rms(forces_of(found.loads)) * 120;
  CHECK(std::abs(sum.x) < 1e-13 * size);
  CHECK(std::abs(sum.y) < 1e-13 * size);
  CHECK(std::abs(sum.z) < 1e-13 * size);
}

TEST_CASE("two grains at rest press with 4/3 E* sqrt(r*) overlap^3/2, and slide at friction times that") {
  Heap heap(2);
  heap.owned = 2;
  const double r = 0.5e-3, overlap = 1e-6;
  heap.position = {{0, 0, 0, r}, {2 * r - overlap, 0, 0, r}};
  heap.velocity = {{0, 0, 0, 1e6}, {0, 0, 0, 1e6}};
  heap.spin = {{0, 0, 0, r}, {0, 0, 0, r}};
  heap.first = {0}, heap.second = {1}, heap.receiver = {1};
  heap.springs = {{0, 1e-5, 0, 4}};  // far beyond the limit
  const PassSettings settings = heap.settings(NormalLaw::hertz, TangentialLaw::history, RollingLaw::off, 1);
  const double force = 4. / 3 * 5e7 * std::sqrt(r / 2) * std::pow(overlap, 1.5);
  for (const InstructionSet set : available_instruction_sets()) {
    const Result found =
        result_of(heap, settings, [set](auto&&... arguments) { return contact_pass(set, arguments...); });
    REQUIRE(found.touching == 1);
    CHECK(found.loads[0].force.x == Approx(-force).epsilon(1e-9));
    CHECK(found.loads[1].force.x == Approx(force).epsilon(1e-9));
    CHECK(found.loads[0].force.y == Approx(-0.4 * force).epsilon(1e-9));
    // The normal points from the second grain to the first, -x: torque of (0, F_y) at -arm * n.
    CHECK(found.loads[0].torque.z == Approx((r - overlap / 2) * -0.4 * force).epsilon(1e-9));
    CHECK(found.loads[1].torque.z == Approx((r - overlap / 2) * -0.4 * force).epsilon(1e-9));
    const double stiffness = 8 * 2e7 * std::sqrt(r / 2 * overlap);
    CHECK(found.springs[0].y == Approx(0.4 * force / stiffness).epsilon(1e-9));
    CHECK(found.springs[0].w == 5);
  }
}

TEST_CASE(
    "a pair that did not touch in the pass before starts with a new spring, or keeps it where that is asked "
    "for") {
  Heap heap(2);
  heap.owned = 2;
  const double r = 0.5e-3;
  heap.position = {{0, 0, 0, r}, {2 * r - 1e-6, 0, 0, r}};
  heap.velocity = {{0, 0, 0, 1e6}, {0, 0, 0, 1e6}};
  heap.spin = {{0, 0, 0, r}, {0, 0, 0, r}};
  heap.first = {0}, heap.second = {1}, heap.receiver = {1};
  heap.springs = {{0, 1e-8, 0, 3}};  // touched two passes ago
  PassSettings settings = heap.settings(NormalLaw::hertz, TangentialLaw::history, RollingLaw::off, 1);
  for (const InstructionSet set : available_instruction_sets()) {
    const auto pass = [set](auto&&... arguments) { return contact_pass(set, arguments...); };
    settings.drop_lost_springs = true;
    CHECK(result_of(heap, settings, pass).springs[0].y == 0);
    settings.drop_lost_springs = false;
    CHECK(result_of(heap, settings, pass).springs[0].y == Approx(1e-8).epsilon(1e-12));
  }
}
