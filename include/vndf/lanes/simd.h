// The only file that knows xsimd: the handful of operations the lane mathematics is written in, for float and for
// xsimd::batch<float, Arch>, xsimd 8.1 to 14.
//
// The arithmetic contract: + - * / sqrt, comparisons, selection and bit operations on IEEE binary32, rounded to
// nearest, and where a sum of products may cancel, + - * / sqrt on binary64 and the conversions. All of them are
// exactly rounded, so a batch lane and a float give the same bits on every instruction set. There is no fused
// multiply-add, no approximate reciprocal and no call into a mathematics library, and there must not be.
#pragma once

// What can be seen of the flags that change bits. Clang shows less than GCC, and neither shows -ffp-contract: the
// target vndf::lanes brings flags that take all of them back.
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__)
#error "vndf promises identical bits on every instruction set: link vndf::lanes, or compile without -ffast-math"
#endif

#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0 && __FLT_EVAL_METHOD__ != 16
#error "vndf promises identical bits everywhere: compile for arithmetic in float, on x86 with -mfpmath=sse"
#endif

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <xsimd/xsimd.hpp>

#include <vndf/lanes/compiler.h>

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

#if defined(__aarch64__)
/// xsimd's quotient of floats is Newton's steps on NEON, up to one unit off. The processor's own is exact. For every
/// batch of NEON that a file divides after this header, and inlined, so that no linker keeps xsimd's instead.
namespace xsimd {
template <>
VNDF_INLINE batch<float, neon64>& batch<float, neon64>::operator/=(const batch& divisor) noexcept {
  return *this = vdivq_f32(*this, divisor);
}
#if defined(XSIMD_WITH_I8MM_NEON64) && XSIMD_WITH_I8MM_NEON64
template <>
VNDF_INLINE batch<float, i8mm<neon64>>& batch<float, i8mm<neon64>>::operator/=(const batch& divisor) noexcept {
  return *this = vdivq_f32(*this, divisor);
}
#endif
}  // namespace xsimd
#endif

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

static_assert(0.1 != static_cast<double>(0.1f), "vndf needs constants in double: without -fsingle-precision-constant");

/// As many doubles as a batch has floats.
template <class Arch>
struct Doubles {
  xsimd::batch<double, Arch> low, high;

  Doubles() = default;
  VNDF_INLINE explicit Doubles(double value) : low(value), high(value) {}
  VNDF_INLINE Doubles(xsimd::batch<double, Arch> low_, xsimd::batch<double, Arch> high_) : low(low_), high(high_) {}

  friend VNDF_INLINE Doubles operator+(const Doubles& a, const Doubles& b) { return {a.low + b.low, a.high + b.high}; }
  friend VNDF_INLINE Doubles operator-(const Doubles& a, const Doubles& b) { return {a.low - b.low, a.high - b.high}; }
  friend VNDF_INLINE Doubles operator*(const Doubles& a, const Doubles& b) { return {a.low * b.low, a.high * b.high}; }
  friend VNDF_INLINE Doubles operator/(const Doubles& a, const Doubles& b) { return {a.low / b.low, a.high / b.high}; }
};

template <class F>
struct LaneTypes;
template <>
struct LaneTypes<float> {
  using Int = std::int32_t;
  using Mask = bool;
  using Wide = double;
};
template <class Arch>
struct LaneTypes<xsimd::batch<float, Arch>> {
  using Int = xsimd::batch<std::int32_t, Arch>;
  using Mask = xsimd::batch_bool<float, Arch>;
  using Wide = Doubles<Arch>;
};
template <class F>
using Int = typename LaneTypes<F>::Int;
template <class F>
using Mask = typename LaneTypes<F>::Mask;
/// double, lane for lane.
template <class F>
using Wide = typename LaneTypes<F>::Wide;

template <class F>
constexpr std::size_t kWidth = sizeof(F) / sizeof(float);

// Called with their namespace, so that xsimd's functions of the same names are never meant.
namespace op {

template <class Arch>
using Batch = xsimd::batch<float, Arch>;
template <class Arch>
using IntBatch = xsimd::batch<std::int32_t, Arch>;
#if defined(__aarch64__)
template <class Arch>
constexpr bool kNeon = std::is_base_of_v<xsimd::neon64, Arch>;
#endif

VNDF_INLINE float select(bool mask, float yes, float no) {
  return mask ? yes : no;
}
template <class Arch>
VNDF_INLINE Batch<Arch> select(xsimd::batch_bool<float, Arch> mask, Batch<Arch> yes, Batch<Arch> no) {
  return xsimd::select(mask, yes, no);
}

VNDF_INLINE bool any(bool mask) {
  return mask;
}
template <class Arch>
VNDF_INLINE bool any(xsimd::batch_bool<float, Arch> mask) {
  return xsimd::any(mask);
}

VNDF_INLINE float sqrt(float a) {
  return VNDF_SQRTF(a);
}
template <class Arch>
VNDF_INLINE Batch<Arch> sqrt(Batch<Arch> a) {
#if defined(__aarch64__)
  if constexpr (kNeon<Arch>) return vsqrtq_f32(a);  // as for the quotient
#endif
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

// Of unsigned integers: signed, a difference or a shift into the sign bit is undefined.
VNDF_INLINE std::int32_t minus(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}
template <class Arch>
VNDF_INLINE IntBatch<Arch> minus(IntBatch<Arch> a, IntBatch<Arch> b) {
  return a - b;
}
template <int bits>
VNDF_INLINE std::int32_t shift_left(std::int32_t a) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) << bits);
}
template <int bits, class Arch>
VNDF_INLINE IntBatch<Arch> shift_left(IntBatch<Arch> a) {
  return a << bits;
}
/// Of signed integers: the sign stays.
template <int bits>
VNDF_INLINE std::int32_t shift_right(std::int32_t a) {
  return a >> bits;
}
template <int bits, class Arch>
VNDF_INLINE IntBatch<Arch> shift_right(IntBatch<Arch> a) {
  return a >> bits;
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

VNDF_INLINE double sqrt(double a) {
  return VNDF_SQRT(a);
}
template <class Arch>
VNDF_INLINE Doubles<Arch> sqrt(const Doubles<Arch>& a) {
  return {xsimd::sqrt(a.low), xsimd::sqrt(a.high)};
}

/// Exact.
VNDF_INLINE double widen(float a) {
  return static_cast<double>(a);
}
/// Rounded to nearest.
VNDF_INLINE float narrow(double a) {
  return static_cast<float>(a);
}
template <class Arch>
VNDF_INLINE Doubles<Arch> widen(Batch<Arch> a) {
#if defined(__AVX512F__)
  if constexpr (kWidth<Batch<Arch>> == 16) {
    __m512d halves = _mm512_castps_pd(a);
    return {_mm512_cvtps_pd(_mm512_castps512_ps256(a)),
            _mm512_cvtps_pd(_mm256_castpd_ps(_mm512_extractf64x4_pd(halves, 1)))};
  }
#endif
#if defined(__AVX__)
  if constexpr (kWidth<Batch<Arch>> == 8)
    return {_mm256_cvtps_pd(_mm256_castps256_ps128(a)), _mm256_cvtps_pd(_mm256_extractf128_ps(a, 1))};
#endif
#if defined(__SSE2__)
  if constexpr (kWidth<Batch<Arch>> == 4) return {_mm_cvtps_pd(a), _mm_cvtps_pd(_mm_movehl_ps(a, a))};
#endif
#if defined(__aarch64__)
  if constexpr (kNeon<Arch>) return {vcvt_f64_f32(vget_low_f32(a)), vcvt_high_f64_f32(a)};
#endif
  constexpr std::size_t kLanes = kWidth<Batch<Arch>>;
  alignas(64) float from[kLanes];
  alignas(64) double to[kLanes];
  a.store_aligned(from);
  for (std::size_t i = 0; i < kLanes; ++i) to[i] = static_cast<double>(from[i]);
  using D = xsimd::batch<double, Arch>;
  return {D::load_aligned(to), D::load_aligned(to + kLanes / 2)};
}
template <class Arch>
VNDF_INLINE Batch<Arch> narrow(const Doubles<Arch>& a) {
#if defined(__AVX512F__)
  if constexpr (kWidth<Batch<Arch>> == 16)
    return _mm512_castpd_ps(_mm512_insertf64x4(_mm512_castps_pd(_mm512_castps256_ps512(_mm512_cvtpd_ps(a.low))),
                                               _mm256_castps_pd(_mm512_cvtpd_ps(a.high)), 1));
#endif
#if defined(__AVX__)
  if constexpr (kWidth<Batch<Arch>> == 8)
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm256_cvtpd_ps(a.low)), _mm256_cvtpd_ps(a.high), 1);
#endif
#if defined(__SSE2__)
  if constexpr (kWidth<Batch<Arch>> == 4) return _mm_movelh_ps(_mm_cvtpd_ps(a.low), _mm_cvtpd_ps(a.high));
#endif
#if defined(__aarch64__)
  if constexpr (kNeon<Arch>) return vcvt_high_f32_f64(vcvt_f32_f64(a.low), a.high);
#endif
  constexpr std::size_t kLanes = kWidth<Batch<Arch>>;
  alignas(64) double from[kLanes];
  alignas(64) float to[kLanes];
  a.low.store_aligned(from);
  a.high.store_aligned(from + kLanes / 2);
  for (std::size_t i = 0; i < kLanes; ++i) to[i] = static_cast<float>(from[i]);
  return Batch<Arch>::load_aligned(to);
}

template <class F>
VNDF_INLINE F load(const float* p) {
  if constexpr (std::is_floating_point_v<F>)
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

/// The first n floats at p, at least one and at most a vector, and for the other lanes the first of them: what is
/// beyond is not touched.
template <class F>
VNDF_INLINE F load_first(const float* p, std::size_t n) {
  if constexpr (kWidth<F> == 1) return load<F>(p);
#if defined(__AVX512F__)
  if constexpr (kWidth<F> == 16)
    return _mm512_mask_loadu_ps(_mm512_set1_ps(*p), static_cast<__mmask16>((1u << n) - 1), p);
#endif
#if defined(__AVX2__)
  if constexpr (kWidth<F> == 8) {
    __m256i wanted =
        _mm256_cmpgt_epi32(_mm256_set1_epi32(static_cast<int>(n)), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    return _mm256_blendv_ps(_mm256_set1_ps(*p), _mm256_maskload_ps(p, wanted), _mm256_castsi256_ps(wanted));
  }
#endif
#if defined(__SSE4_1__)
  if constexpr (kWidth<F> == 4) {
    if (n == 4) return load<F>(p);
    __m128 all = _mm_set1_ps(*p);
    if (n > 1) all = _mm_insert_ps(all, _mm_load_ss(p + 1), 0x10);
    if (n > 2) all = _mm_insert_ps(all, _mm_load_ss(p + 2), 0x20);
    return all;
  }
#endif
  alignas(64) float all[kWidth<F>];
  for (std::size_t i = 0; i < kWidth<F>; ++i) all[i] = p[i < n ? i : 0];
  return load<F>(all);
}
template <class F>
VNDF_INLINE void store_first(F a, float* p, std::size_t n) {
  if (n == kWidth<F>) return store(a, p);
#if defined(__AVX512F__)
  if constexpr (kWidth<F> == 16) return _mm512_mask_storeu_ps(p, static_cast<__mmask16>((1u << n) - 1), a);
#endif
#if defined(__AVX2__)
  if constexpr (kWidth<F> == 8)
    return _mm256_maskstore_ps(
        p, _mm256_cmpgt_epi32(_mm256_set1_epi32(static_cast<int>(n)), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7)), a);
#endif
  alignas(64) float all[kWidth<F>];
  store(a, all);
  for (std::size_t i = 0; i < n; ++i) p[i] = all[i];
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
  VNDF_PREFETCH(p);
}

}  // namespace op
}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
