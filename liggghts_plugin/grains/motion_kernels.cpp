// Compiled once for each instruction set: the loops over grains around the contact pass, four grains at a
// time.

#include "grains/motion_kernels.h"

#include "suffuse/simd/four_doubles.h"

namespace suffuse::grains::SUFFUSE_KERNEL_NAMESPACE {

using namespace simd::SUFFUSE_KERNEL_NAMESPACE;

namespace {

constexpr std::size_t kGroup = 4;

/// Vectors of four grains as they lie in memory: (x0 y0 z0 x1) (y1 z1 x2 y2) (z2 x3 y3 z3).
struct Vectors {
  Four a, b, c;
};

[[gnu::always_inline]] inline Vectors vectors(const double* from) {
  return {unaligned(from), unaligned(from + 4), unaligned(from + 8)};
}
[[gnu::always_inline]] inline void store_vectors(double* to, const Vectors& value) {
  store_unaligned(to, value.a), store_unaligned(to + 4, value.b), store_unaligned(to + 8, value.c);
}
/// to += factor of each grain times its vector
[[gnu::always_inline]] inline void add_scaled(Vectors& to, Four factor, const Vectors& what) {
  to.a += __builtin_shufflevector(factor, factor, 0, 0, 0, 1) * what.a;
  to.b += __builtin_shufflevector(factor, factor, 1, 1, 2, 2) * what.b;
  to.c += __builtin_shufflevector(factor, factor, 2, 3, 3, 3) * what.c;
}

[[gnu::always_inline]] inline void advance_four(const MovingGrains& grains, const MotionStep& step,
                                                std::size_t i) {
  const Four mass = unaligned(grains.mass + i), radius = unaligned(grains.radius + i);
  Vectors velocity = vectors(grains.velocity + 3 * i), spin = vectors(grains.spin + 3 * i);
  add_scaled(velocity, step.half_step / mass, vectors(grains.force + 3 * i));
  store_vectors(grains.velocity + 3 * i, velocity);
  if (step.step != 0) {
    Vectors position = vectors(grains.position + 3 * i);
    add_scaled(position, Four{step.step, step.step, step.step, step.step}, velocity);
    store_vectors(grains.position + 3 * i, position);
  }
  add_scaled(spin, step.half_step / step.inertia / (radius * radius * mass), vectors(grains.torque + 3 * i));
  store_vectors(grains.spin + 3 * i, spin);
}

/// Vectors of four grains and one value of each as records of four.
[[gnu::always_inline]] inline void store_records(Quad* to, const Vectors& vector, Four fourth) {
  const Four second = __builtin_shufflevector(vector.a, vector.b, 3, 4, 5, 5),
             third = __builtin_shufflevector(vector.b, vector.c, 2, 3, 4, 4);
  store(&to[0].x, __builtin_shufflevector(vector.a, fourth, 0, 1, 2, 4));
  store(&to[1].x, __builtin_shufflevector(second, fourth, 0, 1, 2, 5));
  store(&to[2].x, __builtin_shufflevector(third, fourth, 0, 1, 2, 6));
  store(&to[3].x, __builtin_shufflevector(vector.c, fourth, 1, 2, 3, 7));
}

[[gnu::always_inline]] inline void gather_four(const MovingGrains& grains, const double* mobility,
                                               std::size_t i, Quad* position, Quad* velocity, Quad* spin) {
  const Four radius = unaligned(grains.radius + i);
  store_records(position + i, vectors(grains.position + 3 * i), radius);
  store_records(velocity + i, vectors(grains.velocity + 3 * i),
                unaligned(mobility + i) / unaligned(grains.mass + i));
  store_records(spin + i, vectors(grains.spin + 3 * i), radius);
}

/// Adds the first three values of four records to four vectors.
[[gnu::always_inline]] inline void add_records(double* to, Four first, Four second, Four third, Four fourth) {
  Vectors sum = vectors(to);
  sum.a += __builtin_shufflevector(first, second, 0, 1, 2, 4);
  sum.b += __builtin_shufflevector(second, third, 1, 2, 4, 5);
  sum.c += __builtin_shufflevector(third, fourth, 2, 4, 5, 6);
  store_vectors(to, sum);
}

[[gnu::always_inline]] inline void hand_out_four(Load* loads, double* force, double* torque) {
  add_records(force, lanes(&loads[0].force.x), lanes(&loads[1].force.x), lanes(&loads[2].force.x),
              lanes(&loads[3].force.x));
  add_records(torque, lanes(&loads[0].torque.x), lanes(&loads[1].torque.x), lanes(&loads[2].torque.x),
              lanes(&loads[3].torque.x));
  for (std::size_t k = 0; k < kGroup; ++k) {
    store(&loads[k].force.x, Four{});
    store(&loads[k].torque.x, Four{});
  }
}

/// The last grains, fewer than four, take the same instructions, in copies beside grains of no interest.
struct Last {
  double position[12], velocity[12], spin[12], force[12], torque[12], mass[4], radius[4];

  MovingGrains grains() { return {position, velocity, spin, force, torque, mass, radius}; }
};

void copy(double* to, const double* from, std::size_t values) {
  for (std::size_t k = 0; k < values; ++k) to[k] = from[k];
}

}  // namespace

void advance_grains(const MovingGrains& grains, std::size_t count, const MotionStep& step) {
  const std::size_t whole = count / kGroup * kGroup, left = count - whole;
  for (std::size_t i = 0; i < whole; i += kGroup) advance_four(grains, step, i);
  if (left == 0) return;
  Last last{};
  for (std::size_t k = 0; k < kGroup; ++k) last.mass[k] = last.radius[k] = 1;
  copy(last.position, grains.position + 3 * whole, 3 * left);
  copy(last.velocity, grains.velocity + 3 * whole, 3 * left);
  copy(last.spin, grains.spin + 3 * whole, 3 * left);
  copy(last.force, grains.force + 3 * whole, 3 * left);
  copy(last.torque, grains.torque + 3 * whole, 3 * left);
  copy(last.mass, grains.mass + whole, left);
  copy(last.radius, grains.radius + whole, left);
  advance_four(last.grains(), step, 0);
  copy(grains.position + 3 * whole, last.position, 3 * left);
  copy(grains.velocity + 3 * whole, last.velocity, 3 * left);
  copy(grains.spin + 3 * whole, last.spin, 3 * left);
}

void gather_motion(const MovingGrains& grains, const double* mobility, std::size_t count, Quad* position,
                   Quad* velocity, Quad* spin) {
  const std::size_t whole = count / kGroup * kGroup;
  for (std::size_t i = 0; i < whole; i += kGroup) gather_four(grains, mobility, i, position, velocity, spin);
  for (std::size_t i = whole; i < count; ++i) {
    const double *x = grains.position + 3 * i, *v = grains.velocity + 3 * i, *w = grains.spin + 3 * i;
    position[i] = {x[0], x[1], x[2], grains.radius[i]};
    velocity[i] = {v[0], v[1], v[2], mobility[i] / grains.mass[i]};
    spin[i] = {w[0], w[1], w[2], grains.radius[i]};
  }
}

void hand_out_loads(Load* loads, std::size_t count, double* force, double* torque) {
  const std::size_t whole = count / kGroup * kGroup;
  for (std::size_t i = 0; i < whole; i += kGroup) hand_out_four(loads + i, force + 3 * i, torque + 3 * i);
  for (std::size_t i = whole; i < count; ++i) {
    const Quad &f = loads[i].force, &t = loads[i].torque;
    force[3 * i] += f.x, force[3 * i + 1] += f.y, force[3 * i + 2] += f.z;
    torque[3 * i] += t.x, torque[3 * i + 1] += t.y, torque[3 * i + 2] += t.z;
    loads[i] = {};
  }
}

}  // namespace suffuse::grains::SUFFUSE_KERNEL_NAMESPACE
