#pragma once

/// Four doubles at a time with every instruction set: for records of four values, and tables of four of them.

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace suffuse::simd::SUFFUSE_KERNEL_NAMESPACE {

typedef double Four __attribute__((vector_size(32)));
typedef long FourFlags __attribute__((vector_size(32)));

[[gnu::always_inline]] inline void store(double* to, Four value) {
  *reinterpret_cast<Four*>(to) = value;
}
[[gnu::always_inline]] inline Four lanes(const double* from) {
  return *reinterpret_cast<const Four*>(from);
}
/// The same anywhere in memory, whatever the type of the values there.
typedef double UnalignedFour __attribute__((vector_size(32), aligned(8), may_alias));
[[gnu::always_inline]] inline Four unaligned(const double* from) {
  return *reinterpret_cast<const UnalignedFour*>(from);
}
[[gnu::always_inline]] inline void store_unaligned(double* to, Four value) {
  *reinterpret_cast<UnalignedFour*>(to) = value;
}
/// One bit for each lane that is not zero, the first lane's the lowest.
[[gnu::always_inline]] inline int bits_of(FourFlags flags) {
#ifdef __AVX__
  return _mm256_movemask_pd(reinterpret_cast<__m256d>(flags));
#else
  int bits = 0;
  for (int lane = 0; lane < 4; ++lane) bits |= (flags[lane] != 0 ? 1 : 0) << lane;
  return bits;
#endif
}
/// Rows become columns.
[[gnu::always_inline]] inline void transpose(Four& a, Four& b, Four& c, Four& d) {
  const Four p = __builtin_shufflevector(a, b, 0, 4, 2, 6), q = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Four r = __builtin_shufflevector(c, d, 0, 4, 2, 6), s = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(p, r, 0, 1, 4, 5), b = __builtin_shufflevector(q, s, 0, 1, 4, 5);
  c = __builtin_shufflevector(p, r, 2, 3, 6, 7), d = __builtin_shufflevector(q, s, 2, 3, 6, 7);
}

}  // namespace suffuse::simd::SUFFUSE_KERNEL_NAMESPACE
