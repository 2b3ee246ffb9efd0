#pragma once

/// Eight numbers at a time, or sixteen of two rows, with every instruction set: for work on pieces of eight
/// cells, whose results must not depend on how wide a register is.

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace suffuse::simd::SUFFUSE_KERNEL_NAMESPACE {

inline constexpr int kLanes = 8;
typedef float Floats __attribute__((vector_size(32)));
typedef float TwoRows __attribute__((vector_size(64)));
typedef double Doubles __attribute__((vector_size(64)));
typedef float UnalignedFloats __attribute__((vector_size(32), aligned(4), may_alias));
typedef double UnalignedDoubles __attribute__((vector_size(64), aligned(8), may_alias));
inline constexpr Floats kLaneNumbers{0, 1, 2, 3, 4, 5, 6, 7};

[[gnu::always_inline]] inline Floats load(const float* from) {
  return *reinterpret_cast<const UnalignedFloats*>(from);
}
[[gnu::always_inline]] inline void store(float* to, const Floats& value) {
  *reinterpret_cast<UnalignedFloats*>(to) = value;
}
[[gnu::always_inline]] inline Doubles widened(const Floats& v) {
#ifdef __AVX512F__
  return _mm512_maskz_cvtps_pd(static_cast<__mmask8>(-1), v);
#else
  return __builtin_convertvector(v, Doubles);
#endif
}
[[gnu::always_inline]] inline Floats square_root(Floats v) {
#ifdef __AVX__
  return _mm256_sqrt_ps(v);
#else
  for (int lane = 0; lane < kLanes; ++lane) v[lane] = __builtin_sqrtf(v[lane]);
  return v;
#endif
}
[[gnu::always_inline]] inline Floats lesser(const Floats& a, const Floats& b) {
#ifdef __AVX__
  return _mm256_min_ps(a, b);  // as below, in one instruction
#else
  return a < b ? a : b;
#endif
}
[[gnu::always_inline]] inline Floats greater(const Floats& a, const Floats& b) {
#ifdef __AVX__
  return _mm256_max_ps(a, b);
#else
  return a > b ? a : b;
#endif
}
/// Is any lane not zero?
[[gnu::always_inline]] inline bool any(const Floats& v) {
#ifdef __AVX__
  return _mm256_movemask_ps(_mm256_cmp_ps(v, Floats{}, _CMP_NEQ_UQ)) != 0;
#else
  bool found = false;
  for (int lane = 0; lane < kLanes; ++lane) found |= v[lane] != 0;
  return found;
#endif
}

[[gnu::always_inline]] inline Floats row_of(const TwoRows& v, int row) {
  return row == 0 ? __builtin_shufflevector(v, v, 0, 1, 2, 3, 4, 5, 6, 7)
                  : __builtin_shufflevector(v, v, 8, 9, 10, 11, 12, 13, 14, 15);
}
[[gnu::always_inline]] inline TwoRows two_rows(const Floats& a, const Floats& b) {
  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
#ifdef __AVX512F__
// The masked forms with all lanes on: the plain ones make GCC 12 warn about its own header.
inline constexpr __mmask16 kAllLanes = 0xffff;
[[gnu::always_inline]] inline TwoRows square_root(const TwoRows& v) {
  return _mm512_maskz_sqrt_ps(kAllLanes, v);
}
[[gnu::always_inline]] inline TwoRows lesser(const TwoRows& a, const TwoRows& b) {
  return _mm512_maskz_min_ps(kAllLanes, a, b);
}
[[gnu::always_inline]] inline TwoRows greater(const TwoRows& a, const TwoRows& b) {
  return _mm512_maskz_max_ps(kAllLanes, a, b);
}
[[gnu::always_inline]] inline bool any(const TwoRows& v) {
  return _mm512_cmp_ps_mask(v, TwoRows{}, _CMP_NEQ_UQ) != 0;
}
#else
[[gnu::always_inline]] inline TwoRows square_root(const TwoRows& v) {
  return two_rows(square_root(row_of(v, 0)), square_root(row_of(v, 1)));
}
[[gnu::always_inline]] inline TwoRows lesser(const TwoRows& a, const TwoRows& b) {
  return two_rows(lesser(row_of(a, 0), row_of(b, 0)), lesser(row_of(a, 1), row_of(b, 1)));
}
[[gnu::always_inline]] inline TwoRows greater(const TwoRows& a, const TwoRows& b) {
  return two_rows(greater(row_of(a, 0), row_of(b, 0)), greater(row_of(a, 1), row_of(b, 1)));
}
[[gnu::always_inline]] inline bool any(const TwoRows& v) {
  return any(row_of(v, 0)) || any(row_of(v, 1));
}
#endif
template <class V>
[[gnu::always_inline]] inline V magnitude(const V& v) {
  return greater(v, -v);
}

}  // namespace suffuse::simd::SUFFUSE_KERNEL_NAMESPACE
