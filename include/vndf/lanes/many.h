// Several vectors as one. A lane function is a chain of dependent operations, several roots and divisions deep, of
// which a core alone can keep only a few in flight. Over Many<batch, 4> the same function is four chains side by side.
#pragma once

#include <vndf/lanes/simd.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

template <class T, int K>
struct Many {
  T v[K];

  Many() = default;
  template <class S, class = std::enable_if_t<std::is_arithmetic_v<S>>>
  VNDF_INLINE explicit Many(S all) {
    for (int k = 0; k < K; ++k) v[k] = T(all);
  }
  static VNDF_INLINE Many load_unaligned(const float* p) {
    Many result;
    for (int k = 0; k < K; ++k) result.v[k] = op::load<T>(p + std::size_t(k) * kWidth<T>);
    return result;
  }
};

template <class T, int K>
struct LaneTypes<Many<T, K>> {
  using Int = Many<lanes::Int<T>, K>;
  using Mask = Many<lanes::Mask<T>, K>;
  using Wide = Many<lanes::Wide<T>, K>;
};

/// f of each vector.
template <int K, class Function, class... T>
VNDF_INLINE auto each(Function f, const Many<T, K>&... a) {
  Many<decltype(f(a.v[0]...)), K> result;
  for (int k = 0; k < K; ++k) result.v[k] = f(a.v[k]...);
  return result;
}

template <class T, int K>
VNDF_INLINE Many<T, K> operator+(const Many<T, K>& a, const Many<T, K>& b) {
  return each([](const T& x, const T& y) { return T(x + y); }, a, b);
}
template <class T, int K>
VNDF_INLINE Many<T, K> operator-(const Many<T, K>& a, const Many<T, K>& b) {
  return each([](const T& x, const T& y) { return T(x - y); }, a, b);
}
template <class T, int K>
VNDF_INLINE Many<T, K> operator*(const Many<T, K>& a, const Many<T, K>& b) {
  return each([](const T& x, const T& y) { return T(x * y); }, a, b);
}
template <class T, int K>
VNDF_INLINE Many<T, K> operator/(const Many<T, K>& a, const Many<T, K>& b) {
  return each([](const T& x, const T& y) { return T(x / y); }, a, b);
}
template <class T, int K>
VNDF_INLINE Many<T, K> operator&(const Many<T, K>& a, const Many<T, K>& b) {
  return each([](const T& x, const T& y) { return T(x & y); }, a, b);
}
template <class T, int K>
VNDF_INLINE Many<T, K> operator|(const Many<T, K>& a, const Many<T, K>& b) {
  return each([](const T& x, const T& y) { return T(x | y); }, a, b);
}
template <class T, int K>
VNDF_INLINE Many<T, K> operator^(const Many<T, K>& a, const Many<T, K>& b) {
  return each([](const T& x, const T& y) { return T(x ^ y); }, a, b);
}
template <class T, int K>
VNDF_INLINE auto operator!(const Many<T, K>& a) {
  return each([](const T& x) { return !x; }, a);
}
template <class T, int K>
VNDF_INLINE auto operator<(const Many<T, K>& a, const Many<T, K>& b) {
  return each([](const T& x, const T& y) { return x < y; }, a, b);
}
template <class T, int K>
VNDF_INLINE auto operator>(const Many<T, K>& a, const Many<T, K>& b) {
  return each([](const T& x, const T& y) { return x > y; }, a, b);
}
template <class T, int K>
VNDF_INLINE auto operator<=(const Many<T, K>& a, const Many<T, K>& b) {
  return each([](const T& x, const T& y) { return x <= y; }, a, b);
}
template <class T, int K>
VNDF_INLINE auto operator>=(const Many<T, K>& a, const Many<T, K>& b) {
  return each([](const T& x, const T& y) { return x >= y; }, a, b);
}
template <class T, int K>
VNDF_INLINE auto operator==(const Many<T, K>& a, const Many<T, K>& b) {
  return each([](const T& x, const T& y) { return x == y; }, a, b);
}

namespace op {

template <class M, class T, int K>
VNDF_INLINE Many<T, K> select(const Many<M, K>& mask, const Many<T, K>& yes, const Many<T, K>& no) {
  return each([](const M& m, const T& y, const T& n) { return select(m, y, n); }, mask, yes, no);
}
template <class M, int K>
VNDF_INLINE bool any(const Many<M, K>& mask) {
  bool result = false;
  for (const M& m : mask.v) result |= any(m);
  return result;
}
template <class T, int K>
VNDF_INLINE Many<T, K> sqrt(const Many<T, K>& a) {
  return each([](const T& x) { return sqrt(x); }, a);
}
template <class T, int K>
VNDF_INLINE auto bits(const Many<T, K>& a) {
  return each([](const T& x) { return bits(x); }, a);
}
template <class T, int K>
VNDF_INLINE auto from_bits(const Many<T, K>& a) {
  return each([](const T& x) { return from_bits(x); }, a);
}
template <class T, int K>
VNDF_INLINE Many<T, K> min(const Many<T, K>& a, const Many<T, K>& b) {
  return each([](const T& x, const T& y) { return min(x, y); }, a, b);
}
template <class T, int K>
VNDF_INLINE Many<T, K> max(const Many<T, K>& a, const Many<T, K>& b) {
  return each([](const T& x, const T& y) { return max(x, y); }, a, b);
}
template <class T, int K>
VNDF_INLINE Many<T, K> minus(const Many<T, K>& a, const Many<T, K>& b) {
  return each([](const T& x, const T& y) { return minus(x, y); }, a, b);
}
template <int bits, class T, int K>
VNDF_INLINE Many<T, K> shift_left(const Many<T, K>& a) {
  return each([](const T& x) { return shift_left<bits>(x); }, a);
}
template <int bits, class T, int K>
VNDF_INLINE Many<T, K> shift_right(const Many<T, K>& a) {
  return each([](const T& x) { return shift_right<bits>(x); }, a);
}
template <class T, int K>
VNDF_INLINE Many<T, K> abs(const Many<T, K>& a) {
  return each([](const T& x) { return abs(x); }, a);
}
template <class T, int K>
VNDF_INLINE Many<T, K> with_sign_of(const Many<T, K>& magnitude, const Many<T, K>& sign) {
  return each([](const T& m, const T& s) { return with_sign_of(m, s); }, magnitude, sign);
}
template <class T, int K>
VNDF_INLINE auto widen(const Many<T, K>& a) {
  return each([](const T& x) { return widen(x); }, a);
}
template <class T, int K>
VNDF_INLINE auto narrow(const Many<T, K>& a) {
  return each([](const T& x) { return narrow(x); }, a);
}

template <class T, int K>
VNDF_INLINE void store(const Many<T, K>& a, float* p) {
  for (int k = 0; k < K; ++k) store(a.v[k], p + std::size_t(k) * kWidth<T>);
}
template <class T, int K>
VNDF_INLINE void stream(const Many<T, K>& a, float* p) {
  for (int k = 0; k < K; ++k) stream(a.v[k], p + std::size_t(k) * kWidth<T>);
}

}  // namespace op
}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
