// Sine and cosine of 2 pi u.
#pragma once

#include <vndf/lanes/simd.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// A direction in the plane.
template <class F>
struct Angle {
  F cos, sin;
};

/// (-cos, sin)(2 pi a) for a in [0, 1/2], the sine with its sign bit clear.
///
/// m = a (1/2 - a) vanishes exactly where the sine does and a - 1/4 where the cosine does, and (a - 1/4)^2 = 1/16 - m:
/// each is its zero times a polynomial in m whose coefficients are all positive. That keeps the relative accuracy
/// everywhere, without quadrants.
template <class F>
VNDF_INLINE Angle<F> minus_cos_and_sin(F a) {
  F m = a * (F(0.5f) - a);
  F m2 = m * m;
  // Minimax in relative error with the coefficients rounded to float one after the other: 6.1e-9 and 1.2e-9. 4 pi is
  // added in two parts, since its rounding alone would be half an ulp. Estrin's order halves the chain of dependent
  // operations, which is what bounds the kernels.
  F cos = (F(0x1p+2f) + m * F(0x1.fffff2p+4f)) +
          m2 * ((F(0x1.10b308p+6f) + m * F(0x1.0a9dd8p+6f)) + m2 * F(0x1.3d489ep+5f));
  F sin = F(12.5f) + ((F(0x1.0fdaa6p-4f) + m * F(0x1.921fb0p+5f)) +
                      m2 * ((F(0x1.1d90fcp+6f) + m * F(0x1.a2fc90p+5f)) + m2 * F(0x1.8bd6d8p+4f)));
  return {(a - F(0.25f)) * cos, m * sin};
}

/// (cos, sin)(2 pi u) for u in [0, 1]: a half turn on, with a = |1/2 - u|, which is exact for every multiple of 2^-25.
template <class F>
VNDF_INLINE Angle<F> sincos2pi(F u) {
  F h = F(0.5f) - u;
  auto turned = minus_cos_and_sin(op::abs(h));
  return {turned.cos, op::with_sign_of(turned.sin, h)};
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
