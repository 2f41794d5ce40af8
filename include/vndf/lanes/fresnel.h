// Indices of refraction, and Fresnel's equations.
//
// eta is the index on the other side of the surface over the one on the view's. c = wo.wm, and g = eta cos of the angle
// of refraction: g^2 = eta^2 - 1 + c^2.
#pragma once

#include <vndf/lanes/many.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// eta, the index on the other side over the one on the view's, and eta - 1 with the digits that 1 / eta loses; and the
/// index that was given, the one below the surface over the one above.
template <class F>
struct Index {
  F eta, minus_1, given;
};
/// Views from below see the inverse.
template <class F>
VNDF_INLINE Index<F> index_seen(Mask<F> from_below, F given) {
  F inv = F(1.f) / given;
  F minus_1 = given - F(1.f);
  return {op::select(from_below, inv, given), op::select(from_below, F(0.f) - minus_1 * inv, minus_1), given};
}
template <class F>
VNDF_INLINE F squared_minus_1(const Index<F>& index) {
  return index.minus_1 * (index.eta + F(1.f));
}

/// Where eta differs from 1 by less, the surface is index-matched: light passes straight on, as a delta.
constexpr float kIndexMatched = 0x1p-16f;
template <class F>
VNDF_INLINE Mask<F> index_matched(const Index<F>& index) {
  return op::abs(index.minus_1) < F(kIndexMatched);
}
/// 0, negative numbers, infinity and NaN are not possible.
template <class F>
VNDF_INLINE Mask<F> possible(const Index<F>& index) {
  return (index.eta > F(0x1p-20f)) & (index.eta < F(0x1p20f));
}

/// Small eta, whose squares and inverses magnify what is rounded beside them.
template <class F>
VNDF_INLINE Mask<F> is_small(const Index<F>& index) {
  return index.eta < F(0.5f);
}

/// c, kept from 0, and g: 0 where reflection is total.
template <class F>
struct Cosines {
  F c, g;
};

template <class F>
VNDF_INLINE F root_of_positive(F a) {
  return op::sqrt(op::select(a > F(0.f), a, F(0.f)));
}
template <class F>
VNDF_INLINE Cosines<F> cosines(F cos, const Index<F>& index) {
  F c = cos + F(0x1p-62f);
  return {c, root_of_positive(squared_minus_1(index) + c * c)};
}

/// Fresnel's equations for unpolarised light.
template <class F>
struct Fresnel {
  F reflected, transmitted;  // shares; their sum is 1 but for rounding
  F bend;                    // c - g: wm's share in eta wi = (c - g) wm - wo
};

/// Walter et al. 2007, eq. 22. Every difference is taken of eta alone, so eta near 1 costs no digits, and neither does
/// the small one of the two shares: c - g = (1 - eta^2) / (c + g), and eta^2 c - g = (eta^2 - 1) b / (eta^2 c + g),
/// where b = (eta^2 + 1) c^2 - 1 = (eta^2 + 1) g^2 - eta^4 vanishes at Brewster's angle alone. The former loses digits
/// where eta is small, the latter where it is large.
template <class F>
VNDF_INLINE Fresnel<F> fresnel(const Cosines<F>& cos, const Index<F>& index) {
  const auto& [c, g] = cos;
  F eta2 = index.eta * index.eta;
  F more = squared_minus_1(index);
  auto denser = more > F(0.f);
  F brewster = (eta2 + F(1.f)) * op::select(denser, c * c, g * g) - op::select(denser, F(1.f), eta2 * eta2);
  auto passes = g > F(0.f);  // no total reflection
  F s = F(1.f) / (c + g);
  F p = F(1.f) / (eta2 * c + g);
  F s2 = s * s;
  F p2 = p * p;
  F rs = more * s2;
  F rp = (more * p2) * brewster;
  F cg = c * g;
  return {op::select(passes, (rs * rs + rp * rp) * F(0.5f), F(1.f)),
          op::select(passes, (cg + cg) * (s2 + eta2 * p2), F(0.f)), F(0.f) - more * s};
}

/// Fresnel's reflectance of a conductor for unpolarised light. `cos` = wo.wm in [0, 1]; `eta` and `k` are the real and
/// the imaginary part of its index over that of the medium above, eta > 0 and k >= 0.
///
/// With (a + i b)^2 = (eta + i k)^2 - s^2, s^2 = 1 - cos^2, eq. of Born and Wolf, Principles of Optics, 14.2:
/// Rs = ((a - c)^2 + b^2) / ((a + c)^2 + b^2), Rp = Rs ((a c - s^2)^2 + b^2 c^2) / ((a c + s^2)^2 + b^2 c^2). Of a^2
/// and b^2, which are (|..| +- t) / 2, the smaller is from their product, (eta k)^2. Relative error at most 40 x 2^-24
/// for eta from 0.05 to 10 and k from 0.1 to 15 (tests/fresnel_test.cpp).
template <class F>
VNDF_INLINE F conductor_reflectance(F cos, F eta, F k) {
  F c2 = cos * cos;
  F s2 = (F(1.f) - cos) * (F(1.f) + cos);
  F t = (eta - k) * (eta + k) - s2;
  F ab = eta * k;
  F larger = (op::sqrt(t * t + (ab * ab) * F(4.f)) + op::abs(t)) * F(0.5f);
  F smaller = op::select(larger > F(0.f), (ab * ab) / larger, F(0.f));
  auto positive = t > F(0.f);
  F a = op::sqrt(op::select(positive, larger, smaller));
  F b2 = op::select(positive, smaller, larger);
  F minus = a - cos, plus = a + cos;
  F ac = a * cos, b2c2 = b2 * c2;
  F p_minus = ac - s2, p_plus = ac + s2;
  F rs = (minus * minus + b2) / (plus * plus + b2);
  F rp = (p_minus * p_minus + b2c2) / (p_plus * p_plus + b2c2);
  return (rs * (F(1.f) + rp)) * F(0.5f);
}

/// Schlick's approximation, from the reflectance at normal incidence. `cos` = wo.wm in [0, 1].
template <class F>
VNDF_INLINE F schlick_reflectance(F cos, F r0) {
  F m = F(1.f) - cos;
  F m2 = m * m;
  return r0 + ((m2 * m2) * m) * (F(1.f) - r0);
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
