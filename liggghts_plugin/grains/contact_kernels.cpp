// Compiled once for each instruction set: which candidates touch, their data into batches, laws, and back.

#include "grains/contact_kernels.h"

#include "grains/contact_batch.h"
#include "suffuse/simd/four_doubles.h"

namespace suffuse::grains::SUFFUSE_KERNEL_NAMESPACE {

using namespace simd::SUFFUSE_KERNEL_NAMESPACE;

namespace {

using simd::SUFFUSE_KERNEL_NAMESPACE::store;

constexpr int kBlock = 512;  // candidates that are searched at a time

[[gnu::always_inline]] inline Four load(const Quad& from) {
  return *reinterpret_cast<const Four*>(&from);
}
[[gnu::always_inline]] inline void store(Quad& to, Four value) {
  *reinterpret_cast<Four*>(&to) = value;
}
/// First minus second, but for the last lane, which is their sum: (branch, sum of radii), (velocity, sum of
/// 1/m).
[[gnu::always_inline]] inline Four relative(const Quad& first, const Quad& second) {
  constexpr Four signs{1, 1, 1, -1};
  return load(first) - signs * load(second);
}

/// Of four candidates, by a bit for each that touches: how many do, and which, first of all.
struct Touching {
  int lanes[4], count;
};
constexpr Touching kTouching[16] = {
    {{0, 0, 0, 0}, 0}, {{0, 0, 0, 0}, 1}, {{1, 0, 0, 0}, 1}, {{0, 1, 0, 0}, 2},
    {{2, 0, 0, 0}, 1}, {{0, 2, 0, 0}, 2}, {{1, 2, 0, 0}, 2}, {{0, 1, 2, 0}, 3},
    {{3, 0, 0, 0}, 1}, {{0, 3, 0, 0}, 2}, {{1, 3, 0, 0}, 2}, {{0, 1, 3, 0}, 3},
    {{2, 3, 0, 0}, 2}, {{0, 2, 3, 0}, 3}, {{1, 2, 3, 0}, 3}, {{0, 1, 2, 3}, 4}};

/// The places within a block of candidates that touch; returns how many. There is room for four beyond them.
int touching_in(const CandidatePairs& pairs, const Quad* position, std::size_t start, int count,
                int* places) {
  int found = 0, k = 0;
  const int* first = pairs.first + start;
  const int* second = pairs.second + start;
  for (; k + 4 <= count; k += 4) {
    Four x = relative(position[first[k]], position[second[k]]);
    Four y = relative(position[first[k + 1]], position[second[k + 1]]);
    Four z = relative(position[first[k + 2]], position[second[k + 2]]);
    Four r = relative(position[first[k + 3]], position[second[k + 3]]);
    transpose(x, y, z, r);
    const FourFlags touch = x * x + y * y + z * z < r * r;
    const Touching& those = kTouching[bits_of(touch)];
    for (int n = 0; n < 4; ++n) places[found + n] = k + those.lanes[n];
    found += those.count;
  }
  for (; k < count; ++k) {
    const Four d = relative(position[first[k]], position[second[k]]);
    places[found] = k, found += d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < d[3] * d[3];
  }
  return found;
}

class Pass {
 public:
  Pass(const GrainArrays& grains, const PassSettings& settings, Quad* springs, const PassOutput& output)
      : grains_(grains), settings_(settings), springs_(springs), output_(output) {
    if (settings.law.materials == 1)
      for (int c = 0; c < kLanes; ++c) take_material(c, settings.law.coefficients[0]);
    choose_forces();
  }

  std::size_t run(const CandidatePairs& pairs) {
    std::size_t touching = 0;
    int places[kBlock + 4], filled = 0;
    for (std::size_t start = 0; start < pairs.count; start += kBlock) {
      const std::size_t left = pairs.count - start;
      const int count = left < kBlock ? static_cast<int>(left) : kBlock;
      const int found = touching_in(pairs, grains_.position, start, count, places);
      touching += static_cast<std::size_t>(found);
      for (int f = 0; f < found; ++f) {
        const std::size_t k = start + static_cast<std::size_t>(places[f]);
        batch_.first[filled] = pairs.first[k], batch_.second[filled] = pairs.second[k];
        batch_.motion[filled] = pairs.motion[k], batch_.receiver[filled] = pairs.receiver[k];
        batch_.pair[filled] = static_cast<std::uint32_t>(k);
        if (++filled == kLanes) {
          evaluate(kLanes);
          filled = 0;
        }
      }
    }
    if (filled > 0) evaluate(filled);
    return touching;
  }

 private:
  using Forces = void (*)(ContactBatch&, const PassSettings&);

  template <class Normal, TangentialLaw tangential, RollingLaw rolling>
  Forces with_normal_at() const {
    return settings_.half_step_normal && tangential != TangentialLaw::off
               ? &forces_of<Normal, tangential, rolling, tangential != TangentialLaw::off>
               : &forces_of<Normal, tangential, rolling, false>;
  }
  template <class Normal, TangentialLaw tangential>
  Forces with_rolling() const {
    return settings_.law.rolling == RollingLaw::cdt ? with_normal_at<Normal, tangential, RollingLaw::cdt>()
                                                    : with_normal_at<Normal, tangential, RollingLaw::off>();
  }
  template <class Normal>
  Forces with_tangential() const {
    switch (settings_.law.tangential) {
      case TangentialLaw::off:
        return with_rolling<Normal, TangentialLaw::off>();
      case TangentialLaw::no_history:
        return with_rolling<Normal, TangentialLaw::no_history>();
      default:
        return with_rolling<Normal, TangentialLaw::history>();
    }
  }
  void choose_forces() {
    switch (settings_.law.normal) {
      case NormalLaw::hertz:
        forces_ = with_tangential<HertzLaw>();
        break;
      case NormalLaw::hooke:
        forces_ = with_tangential<HookeLaw>();
        break;
      case NormalLaw::hooke_stiffness:
        forces_ = with_tangential<HookeStiffnessLaw>();
    }
  }

  void take_material(int lane, const PairCoefficients& pair) {
    batch_.normal_stiffness[lane] = pair.normal_stiffness;
    batch_.tangential_stiffness[lane] = pair.tangential_stiffness;
    batch_.normal_damping[lane] = pair.normal_damping;
    batch_.tangential_damping[lane] = pair.tangential_damping;
    batch_.friction[lane] = pair.friction;
    batch_.rolling_friction[lane] = pair.rolling_friction;
  }

  /// Lanes beyond the batch's contacts repeat the first one, so that their arithmetic is harmless.
  void evaluate(int contacts) {
    for (int c = contacts; c < kLanes; ++c) {
      batch_.first[c] = batch_.first[0], batch_.second[c] = batch_.second[0],
      batch_.motion[c] = batch_.motion[0];
      batch_.pair[c] = batch_.pair[0];
    }
    gather();
    if (settings_.law.normal == NormalLaw::hooke) linear_stiffness();
    forces_(batch_, settings_);
    scatter(contacts);
  }

  void gather() {
    ContactBatch& b = batch_;
    for (int c = 0; c < kLanes; c += 4) {
      const int *i = b.first + c, *j = b.second + c, *m = b.motion + c;
      Four x = relative(grains_.position[i[0]], grains_.position[j[0]]);
      Four y = relative(grains_.position[i[1]], grains_.position[j[1]]);
      Four z = relative(grains_.position[i[2]], grains_.position[j[2]]);
      Four w = relative(grains_.position[i[3]], grains_.position[j[3]]);
      keep(x, y, z, w, b.branch, b.radii, c);
      x = relative(grains_.velocity[i[0]], grains_.velocity[m[0]]);
      y = relative(grains_.velocity[i[1]], grains_.velocity[m[1]]);
      z = relative(grains_.velocity[i[2]], grains_.velocity[m[2]]);
      w = relative(grains_.velocity[i[3]], grains_.velocity[m[3]]);
      keep(x, y, z, w, b.velocity, b.inverse_mass, c);
      keep(load(grains_.spin[i[0]]), load(grains_.spin[i[1]]), load(grains_.spin[i[2]]),
           load(grains_.spin[i[3]]), b.spin_first, b.radius_first, c);
      keep(load(grains_.spin[m[0]]), load(grains_.spin[m[1]]), load(grains_.spin[m[2]]),
           load(grains_.spin[m[3]]), b.spin_second, b.radius_second, c);
      if (settings_.law.tangential == TangentialLaw::history) gather_springs(c);
    }
    if (settings_.law.materials > 1)
      for (int c = 0; c < kLanes; ++c)
        take_material(c, settings_.law.coefficients[grains_.material[b.first[c]] * settings_.law.materials +
                                                    grains_.material[b.motion[c]]]);
  }

  [[gnu::always_inline]] static void keep(Four x, Four y, Four z, Four w, double (&vector)[3][kLanes],
                                          double (&fourth)[kLanes], int c) {
    transpose(x, y, z, w);
    store(vector[0] + c, x), store(vector[1] + c, y), store(vector[2] + c, z), store(fourth + c, w);
  }

  void gather_springs(int c) {
    const std::uint32_t* s = batch_.pair + c;
    Four x = load(springs_[s[0]]), y = load(springs_[s[1]]), z = load(springs_[s[2]]),
         w = load(springs_[s[3]]);
    transpose(x, y, z, w);
    if (settings_.drop_lost_springs) {
      const double before = settings_.pass_number - 1;
      const FourFlags held = w >= Four{before, before, before, before};
      x = held ? x : Four{}, y = held ? y : Four{}, z = held ? z : Four{};
    }
    store(batch_.spring[0] + c, x), store(batch_.spring[1] + c, y), store(batch_.spring[2] + c, z);
  }

  /// k_n = 16/15 sqrt(r*) E* (15 m* V^2 / (16 sqrt(r*) E*))^(1/5)
  void linear_stiffness() {
    const double V = settings_.law.characteristic_velocity;
    for (int c = 0; c < kLanes; ++c) {
      const double root = __builtin_sqrt(batch_.radius_first[c] * batch_.radius_second[c] / batch_.radii[c]) *
                          batch_.normal_stiffness[c];
      batch_.linear_stiffness[c] =
          16. / 15 * root * __builtin_pow(15 * V * V / (16 * root * batch_.inverse_mass[c]), 0.2);
    }
  }

  void scatter(int contacts) {
    if (output_.loads != nullptr) add_loads(contacts);
    if (settings_.law.tangential == TangentialLaw::history && settings_.advance_springs)
      keep_springs(contacts);
    if (output_.virial != nullptr || output_.grain_virial != nullptr) add_virial(contacts);
    if (output_.note != nullptr) tell_notes(contacts);
  }

  void add_loads(int contacts) {
    const bool rolls = settings_.law.rolling == RollingLaw::cdt;
    for (int c = 0; c < contacts; c += 4) {
      Four force[4] = {lanes(batch_.force[0] + c), lanes(batch_.force[1] + c), lanes(batch_.force[2] + c),
                       Four{}};
      transpose(force[0], force[1], force[2], force[3]);
      Four moment[4] = {lanes(batch_.moment[0] + c), lanes(batch_.moment[1] + c), lanes(batch_.moment[2] + c),
                        Four{}};
      transpose(moment[0], moment[1], moment[2], moment[3]);
      Four roll[4]{};
      if (rolls) {
        roll[0] = lanes(batch_.rolling[0] + c), roll[1] = lanes(batch_.rolling[1] + c);
        roll[2] = lanes(batch_.rolling[2] + c);
        transpose(roll[0], roll[1], roll[2], roll[3]);
      }
      const int here = contacts - c < 4 ? contacts - c : 4;
      for (int lane = 0; lane < here; ++lane) {
        Load& on_first = output_.loads[batch_.first[c + lane]];
        const double arm = batch_.arm_first[c + lane], other_arm = batch_.arm_second[c + lane];
        store(on_first.force, load(on_first.force) + force[lane]);
        Four torque = load(on_first.torque) - arm * moment[lane];
        if (rolls) torque -= roll[lane];
        store(on_first.torque, torque);
        Load& on_second = output_.loads[batch_.receiver[c + lane]];
        store(on_second.force, load(on_second.force) - force[lane]);
        torque = load(on_second.torque) - other_arm * moment[lane];
        if (rolls) torque += roll[lane];
        store(on_second.torque, torque);
      }
    }
  }

  void keep_springs(int contacts) {
    for (int c = 0; c < contacts; c += 4) {
      const double number = settings_.pass_number;
      Four spring[4] = {lanes(batch_.spring[0] + c), lanes(batch_.spring[1] + c), lanes(batch_.spring[2] + c),
                        Four{number, number, number, number}};
      transpose(spring[0], spring[1], spring[2], spring[3]);
      const int here = contacts - c < 4 ? contacts - c : 4;
      for (int lane = 0; lane < here; ++lane) store(springs_[batch_.pair[c + lane]], spring[lane]);
    }
  }

  void add_virial(int contacts) {
    for (int c = 0; c < contacts; ++c) {
      const double* d[3] = {batch_.branch[0] + c, batch_.branch[1] + c, batch_.branch[2] + c};
      const double* f[3] = {batch_.force[0] + c, batch_.force[1] + c, batch_.force[2] + c};
      const double half[6] = {0.5 * *d[0] * *f[0], 0.5 * *d[1] * *f[1], 0.5 * *d[2] * *f[2],
                              0.5 * *d[0] * *f[1], 0.5 * *d[0] * *f[2], 0.5 * *d[1] * *f[2]};
      const bool both = batch_.receiver[c] < output_.owned;
      if (output_.virial != nullptr)
        for (int k = 0; k < 6; ++k) output_.virial[k] += both ? 2 * half[k] : half[k];
      if (output_.grain_virial == nullptr) continue;
      for (int k = 0; k < 6; ++k) output_.grain_virial[6 * batch_.first[c] + k] += half[k];
      if (!both) continue;
      for (int k = 0; k < 6; ++k) output_.grain_virial[6 * batch_.receiver[c] + k] += half[k];
    }
  }

  void tell_notes(int contacts) {
    const bool rolls = settings_.law.rolling == RollingLaw::cdt;
    for (int c = 0; c < contacts; ++c) {
      ContactNote note;
      note.pair = batch_.pair[c];
      for (int d = 0; d < 3; ++d) {
        note.force[d] = batch_.force[d][c];
        const double roll = rolls ? batch_.rolling[d][c] : 0;
        note.torque[d] = -batch_.arm_first[c] * batch_.moment[d][c] - roll;
        note.torque_on_second[d] = -batch_.arm_second[c] * batch_.moment[d][c] + roll;
      }
      output_.note(output_.listener, note);
    }
  }

  GrainArrays grains_;
  PassSettings settings_;
  Quad* springs_;
  PassOutput output_;
  Forces forces_ = nullptr;
  ContactBatch batch_;
};

}  // namespace

std::size_t contact_pass(const CandidatePairs& candidates, const GrainArrays& grains,
                         const PassSettings& settings, Quad* springs, const PassOutput& output) {
  return Pass(grains, settings, springs, output).run(candidates);
}

}  // namespace suffuse::grains::SUFFUSE_KERNEL_NAMESPACE
