#pragma once

/// A few numbers side by side in one vector register, for whatever instruction set this file is compiled for.
///
/// GCC's vector extension gives + - * / and comparison; this adds unaligned access and a square
/// root. The namespace is named after the instruction set, so that no function compiled for a wide one can
/// be taken by the linker for another's; for the same reason no standard library template is used in these
/// files.

#if defined(__AVX512F__) || defined(__AVX2__)
#include <immintrin.h>
#endif

#ifndef SUFFUSE_KERNEL_NAMESPACE
#error \
    "compile through suffuse_vector_kernels (cmake/SuffuseVectorKernels.cmake), which names the instruction set"
#endif

namespace suffuse::simd::SUFFUSE_KERNEL_NAMESPACE {

#if defined(__AVX512F__)
inline constexpr int kPackBytes = 64;
#elif defined(__AVX2__)
inline constexpr int kPackBytes = 32;
#else
inline constexpr int kPackBytes = 16;
#endif

template <class T>
struct PackTypes {
  typedef T Pack __attribute__((vector_size(kPackBytes)));
  typedef T Unaligned __attribute__((vector_size(kPackBytes), aligned(sizeof(T)), may_alias));
};

template <class T>
using Pack = typename PackTypes<T>::Pack;

template <class T>
inline constexpr int kPackWidth = kPackBytes / static_cast<int>(sizeof(T));

template <class T>
[[gnu::always_inline]] inline Pack<T> load(const T* from) {
  return *reinterpret_cast<const typename PackTypes<T>::Unaligned*>(from);
}

/// As many floats as a pack of T has lanes, as T.
template <class T>
[[gnu::always_inline]] inline Pack<T> load_floats(const float* from) {
  if constexpr (sizeof(T) == sizeof(float)) {
    return load<T>(reinterpret_cast<const T*>(from));
  } else {
#if defined(__AVX512F__)
    return _mm512_maskz_cvtps_pd(static_cast<__mmask8>(-1), _mm256_loadu_ps(from));
#elif defined(__AVX2__)
    return _mm256_cvtps_pd(_mm_loadu_ps(from));
#else
    Pack<T> values{};
    for (int lane = 0; lane < kPackWidth<T>; ++lane) values[lane] = static_cast<T>(from[lane]);
    return values;
#endif
  }
}

template <class T>
[[gnu::always_inline]] inline void store(T* to, const Pack<T>& value) {
  *reinterpret_cast<typename PackTypes<T>::Unaligned*>(to) = value;
}

/// The first `lanes` lanes only.
template <class T>
[[gnu::always_inline]] inline void store_lanes(T* to, const Pack<T>& value, int lanes) {
#if defined(__AVX512F__)
  const unsigned mask = (1u << lanes) - 1;
  if constexpr (sizeof(T) == sizeof(double))
    _mm512_mask_storeu_pd(to, static_cast<__mmask8>(mask), value);
  else
    _mm512_mask_storeu_ps(to, static_cast<__mmask16>(mask), value);
#elif defined(__AVX2__)
  if constexpr (sizeof(T) == sizeof(double)) {
    const __m256i lane = _mm256_setr_epi64x(0, 1, 2, 3);
    _mm256_maskstore_pd(to, _mm256_cmpgt_epi64(_mm256_set1_epi64x(lanes), lane), value);
  } else {
    const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    _mm256_maskstore_ps(to, _mm256_cmpgt_epi32(_mm256_set1_epi32(lanes), lane), value);
  }
#else
  for (int lane = 0; lane < lanes; ++lane) to[lane] = value[lane];
#endif
}

template <class T>
[[gnu::always_inline]] inline Pack<T> broadcast(T value) {
  return Pack<T>{} + value;
}

#if defined(__AVX512F__)
// The masked form with all lanes on: the plain one makes GCC 12 warn about its own header.
[[gnu::always_inline]] inline bool any_positive(const Pack<double>& v) {
  return _mm512_cmp_pd_mask(v, Pack<double>{}, _CMP_GT_OQ) != 0;
}
[[gnu::always_inline]] inline bool any_positive(const Pack<float>& v) {
  return _mm512_cmp_ps_mask(v, Pack<float>{}, _CMP_GT_OQ) != 0;
}
[[gnu::always_inline]] inline Pack<double> square_root(const Pack<double>& v) {
  return _mm512_maskz_sqrt_pd(static_cast<__mmask8>(-1), v);
}
[[gnu::always_inline]] inline Pack<float> square_root(const Pack<float>& v) {
  return _mm512_maskz_sqrt_ps(static_cast<__mmask16>(-1), v);
}
#elif defined(__AVX2__)
[[gnu::always_inline]] inline bool any_positive(const Pack<double>& v) {
  return _mm256_movemask_pd(_mm256_cmp_pd(v, Pack<double>{}, _CMP_GT_OQ)) != 0;
}
[[gnu::always_inline]] inline bool any_positive(const Pack<float>& v) {
  return _mm256_movemask_ps(_mm256_cmp_ps(v, Pack<float>{}, _CMP_GT_OQ)) != 0;
}
[[gnu::always_inline]] inline Pack<double> square_root(const Pack<double>& v) {
  return _mm256_sqrt_pd(v);
}
[[gnu::always_inline]] inline Pack<float> square_root(const Pack<float>& v) {
  return _mm256_sqrt_ps(v);
}
#else
template <class V>
[[gnu::always_inline]] inline bool any_positive(const V& v) {
  bool any = false;
  for (unsigned lane = 0; lane < sizeof(V) / sizeof(v[0]); ++lane) any |= v[lane] > 0;
  return any;
}
[[gnu::always_inline]] inline Pack<double> square_root(Pack<double> v) {
  for (int lane = 0; lane < kPackWidth<double>; ++lane) v[lane] = __builtin_sqrt(v[lane]);
  return v;
}
[[gnu::always_inline]] inline Pack<float> square_root(Pack<float> v) {
  for (int lane = 0; lane < kPackWidth<float>; ++lane) v[lane] = __builtin_sqrtf(v[lane]);
  return v;
}
#endif

}  // namespace suffuse::simd::SUFFUSE_KERNEL_NAMESPACE
