// Floats in two parts, for sums of products that may cancel: the products of the first parts are exact, and what is
// left is so small that its rounding does not matter.
#pragma once

#include <vndf/lanes/many.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// high + low, with 12 significant bits in `high`.
template <class F>
struct Split {
  F high, low;
};

template <class F>
VNDF_INLINE F first_bits(F a) {
  return op::from_bits(op::bits(a) & Int<F>(std::int32_t(0xfffff000u)));
}

/// a, exactly.
template <class F>
VNDF_INLINE Split<F> split(F a) {
  F high = first_bits(a);
  return {high, a - high};
}
/// a, which has more digits than a float, to 36 bits.
template <class F>
VNDF_INLINE Split<F> split(const Wide<F>& a) {
  F high = first_bits(op::narrow(a));
  return {high, op::narrow(a - op::widen(high))};
}

/// As a float.
template <class F>
VNDF_INLINE F narrowed(const Split<F>& a) {
  return a.high + a.low;
}

/// a / b, to 33 bits.
template <class F>
VNDF_INLINE Split<F> quotient(const Split<F>& a, const Split<F>& b) {
  F divisor = narrowed(b);
  F high = first_bits(narrowed(a) / divisor);
  return {high, ((a.high - high * b.high) + (a.low - high * b.low)) / divisor};
}

/// a - b c, to 32 bits of the larger term.
template <class F>
VNDF_INLINE Split<F> difference(const Split<F>& a, const Split<F>& b, const Split<F>& c) {
  F product = b.high * c.high;
  F large = a.high - product;
  F a_in_large = large + product;
  F error = (a.high - a_in_large) - (product - (a_in_large - large));
  F rest = error + (a.low - (b.high * c.low + b.low * narrowed(c)));
  F high = first_bits(large);
  return {high, (large - high) + rest};
}

/// a x + b y.
template <class F>
VNDF_INLINE F sum_of_products(F a, F x, F b, F y) {
  return a * x + b * y;
}
/// The same, but for the rounding of the result to 2^-32 of the larger product: where the first sum is rounded, it is
/// not small.
template <class F>
VNDF_INLINE F sum_of_products(const Split<F>& a, F x, const Split<F>& b, F y) {
  auto p = split(x), q = split(y);
  return (a.high * p.high + b.high * q.high) + ((a.high * p.low + a.low * x) + (b.high * q.low + b.low * y));
}

/// a x + b y + z.
template <class F>
VNDF_INLINE F sum_of_products(F a, F x, F b, F y, F z) {
  return (a * x + b * y) + z;
}
/// The rounding of the first sum stays, half an eps where a and b are at most 1: it is as much as that of z.
template <class F>
VNDF_INLINE F sum_of_products(const Split<F>& a, F x, const Split<F>& b, F y, F z) {
  auto p = split(x), q = split(y);
  return ((a.high * p.high + b.high * q.high) + z) + ((a.high * p.low + a.low * x) + (b.high * q.low + b.low * y));
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
