// The only file that knows xsimd: the handful of operations the lane mathematics is written in, for float and for
// xsimd::batch<float, Arch>, xsimd 8.1 to 14.
//
// The arithmetic contract: + - * / sqrt, comparisons, selection and bit operations on IEEE binary32, rounded to
// nearest. All of them are exactly rounded, so a batch lane and a float give the same bits on every instruction set.
// There is no fused multiply-add, no approximate reciprocal and no call into a mathematics library, and there must not
// be.
#pragma once

#ifdef __FAST_MATH__
#error "vndf promises identical bits on every instruction set: compile without -ffast-math"
#endif

#include <cstdint>
#include <cstring>
#include <xsimd/xsimd.hpp>

// Inline functions compiled for one instruction set must never be the copy that the linker keeps for another, so
// everything here lives in an inline namespace named after the build it belongs to. The library names its own; a
// program that includes these headers is told apart by the widest set it is compiled for.
#ifndef VNDF_LANES_BUILD
#if defined(__AVX512F__)
#define VNDF_LANES_BUILD user_avx512
#elif defined(__AVX2__)
#define VNDF_LANES_BUILD user_avx2
#elif defined(__SSE4_2__)
#define VNDF_LANES_BUILD user_sse42
#else
#define VNDF_LANES_BUILD user_baseline
#endif
#endif

#define VNDF_INLINE inline __attribute__((always_inline))

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

template <class F>
struct LaneTypes;
template <>
struct LaneTypes<float> {
  using Int = std::int32_t;
  using Mask = bool;
};
template <class Arch>
struct LaneTypes<xsimd::batch<float, Arch>> {
  using Int = xsimd::batch<std::int32_t, Arch>;
  using Mask = xsimd::batch_bool<float, Arch>;
};
template <class F>
using Int = typename LaneTypes<F>::Int;
template <class F>
using Mask = typename LaneTypes<F>::Mask;

template <class F>
constexpr std::size_t kWidth = sizeof(F) / sizeof(float);

// Called with their namespace, so that xsimd's functions of the same names are never meant.
namespace op {

template <class Arch>
using Batch = xsimd::batch<float, Arch>;
template <class Arch>
using IntBatch = xsimd::batch<std::int32_t, Arch>;

VNDF_INLINE float select(bool mask, float yes, float no) {
  return mask ? yes : no;
}
template <class Arch>
VNDF_INLINE Batch<Arch> select(xsimd::batch_bool<float, Arch> mask, Batch<Arch> yes, Batch<Arch> no) {
  return xsimd::select(mask, yes, no);
}

VNDF_INLINE float sqrt(float a) {
  return __builtin_sqrtf(a);
}
template <class Arch>
VNDF_INLINE Batch<Arch> sqrt(Batch<Arch> a) {
  return xsimd::sqrt(a);
}

VNDF_INLINE std::int32_t bits(float a) {
  std::int32_t b;
  std::memcpy(&b, &a, sizeof b);
  return b;
}
VNDF_INLINE float from_bits(std::int32_t a) {
  float b;
  std::memcpy(&b, &a, sizeof b);
  return b;
}
template <class Arch>
VNDF_INLINE IntBatch<Arch> bits(Batch<Arch> a) {
#if XSIMD_VERSION_MAJOR >= 11
  return xsimd::bitwise_cast<std::int32_t>(a);
#else
  return xsimd::bitwise_cast<IntBatch<Arch>>(a);
#endif
}
template <class Arch>
VNDF_INLINE Batch<Arch> from_bits(IntBatch<Arch> a) {
#if XSIMD_VERSION_MAJOR >= 11
  return xsimd::bitwise_cast<float>(a);
#else
  return xsimd::bitwise_cast<Batch<Arch>>(a);
#endif
}

VNDF_INLINE std::int32_t min(std::int32_t a, std::int32_t b) {
  return a < b ? a : b;
}
VNDF_INLINE std::int32_t max(std::int32_t a, std::int32_t b) {
  return a > b ? a : b;
}
template <class Arch>
VNDF_INLINE IntBatch<Arch> min(IntBatch<Arch> a, IntBatch<Arch> b) {
  return xsimd::min(a, b);
}
template <class Arch>
VNDF_INLINE IntBatch<Arch> max(IntBatch<Arch> a, IntBatch<Arch> b) {
  return xsimd::max(a, b);
}

/// |a|, by clearing the sign bit.
template <class F>
VNDF_INLINE F abs(F a) {
  return from_bits(bits(a) & Int<F>(0x7fffffff));
}

/// |magnitude| with the sign bit of `sign`; `magnitude` must not carry one.
template <class F>
VNDF_INLINE F with_sign_of(F magnitude, F sign) {
  return from_bits(bits(magnitude) | (bits(sign) & Int<F>(INT32_MIN)));
}

template <class F>
VNDF_INLINE F load(const float* p) {
  if constexpr (kWidth<F> == 1)
    return *p;
  else
    return F::load_unaligned(p);
}
VNDF_INLINE void store(float a, float* p) {
  *p = a;
}
template <class Arch>
VNDF_INLINE void store(Batch<Arch> a, float* p) {
  a.store_unaligned(p);
}

/// Stores past the caches; p is aligned to the vector. Visible to other threads only after finish_streaming().
template <class F>
VNDF_INLINE void stream(F a, float* p) {
#if defined(__AVX512F__)
  if constexpr (kWidth<F> == 16) return _mm512_stream_ps(p, a);
#endif
#if defined(__AVX__)
  if constexpr (kWidth<F> == 8) return _mm256_stream_ps(p, a);
#endif
#if defined(__SSE2__)
  if constexpr (kWidth<F> == 4) return _mm_stream_ps(p, a);
#endif
  store(a, p);
}
VNDF_INLINE void finish_streaming() {
#if defined(__SSE2__)
  _mm_sfence();
#endif
}

/// Brings what p points to into the caches; any address will do.
VNDF_INLINE void prefetch(const float* p) {
  __builtin_prefetch(p, 0, 3);
}

}  // namespace op
}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
