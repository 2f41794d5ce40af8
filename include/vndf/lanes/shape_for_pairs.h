// The shape for given pairs of directions: the densities ask for A^-T.
#pragma once

#include <vndf/lanes/shape.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// The diagonal that densities are evaluated with: |A| = a b.
template <class F>
struct EvaluatedDiagonal {
  F a, a_over_b;
};
template <class F>
VNDF_INLINE EvaluatedDiagonal<F> evaluated_diagonal(const Vec2<F>& diagonal) {
  F a = at_least_mirror(diagonal.x);
  return {a, a / at_least_mirror(diagonal.y)};
}

/// The shape for given pairs of directions: narrowed, and A^-T up to the diagonal of A, which is
/// ((1, -xy, -xz), (0, 1, -yz), (0, 0, 1)).
template <class F>
struct TriangleForPairs {
  FloatTriangle<F> narrowed;
  Split<F> xy, xz, yz;
  EvaluatedDiagonal<F> diagonal;
};
template <class F>
constexpr bool kUpright<TriangleForPairs<F>> = false;

template <class F>
VNDF_INLINE const FloatTriangle<F>& narrowed(const TriangleForPairs<F>& a) {
  return a.narrowed;
}
template <class F>
VNDF_INLINE TriangleForPairs<F> for_pairs(const Triangle<F>& a) {
  auto xy = quotient(a.yx, a.yy);
  auto floats = narrowed(a);
  return {floats, xy, difference(a.zx, xy, a.zy), a.zy, evaluated_diagonal(diagonal(floats))};
}

/// A = diag(alpha_x, alpha_y, 1) Rz: GGX whose axes are turned about n.
template <class F, class Theta>
struct TurnedAlphaOf {
  Theta theta_z;
  Vec2<F> alpha;
};
template <class F>
using TurnedAlpha = TurnedAlphaOf<F, Versed<F>>;
template <class F>
using FloatTurnedAlpha = TurnedAlphaOf<F, Angle<F>>;
/// Odd quarter turns exchange the two alpha, which is another quarter turn on the left of A.
template <class F>
VNDF_INLINE TurnedAlpha<F> turned_shape(const Vec2<F>& alpha, const Rotation<F>& theta_z) {
  auto odd = theta_z.turns.odd;
  return {versed(theta_z.small), {op::select(odd, alpha.y, alpha.x), op::select(odd, alpha.x, alpha.y)}};
}

template <class F>
VNDF_INLINE FloatTurnedAlpha<F> narrowed(const TurnedAlpha<F>& a) {
  return {narrowed(a.theta_z), a.alpha};
}
template <class F, class Theta>
VNDF_INLINE Vec3<F> stretch(const Vec3<F>& v, const TurnedAlphaOf<F, Theta>& a) {
  return stretch(turn(v, a.theta_z), a.alpha);
}

/// a A^-T v for |A| = a b.
template <class F>
struct Unstretched {
  Vec3<F> v;
  F a, a_over_b;
};

template <class F>
VNDF_INLINE Unstretched<F> unstretch(const Vec3<F>& v, const EvaluatedDiagonal<F>& d) {
  return {{v.x, v.y * d.a_over_b, v.z * d.a}, d.a, d.a_over_b};
}
template <class F>
VNDF_INLINE Unstretched<F> unstretch(const Vec3<F>& v, const Vec2<F>& alpha) {
  return unstretch(v, evaluated_diagonal(alpha));
}
/// The solution of a triangle, up to its diagonal, which is that of plain GGX. What may cancel are again products with
/// exact large parts.
template <class F>
VNDF_INLINE Unstretched<F> unstretch(const Vec3<F>& v, const TriangleForPairs<F>& a) {
  auto y = split(v.y), z = split(v.z);
  F vx = ((v.x - a.xy.high * y.high) - a.xz.high * z.high) -
         ((a.xy.high * y.low + a.xy.low * v.y) + (a.xz.high * z.low + a.xz.low * v.z));
  F vy = (v.y - a.yz.high * z.high) - (a.yz.high * z.low + a.yz.low * v.z);
  return unstretch(Vec3<F>{vx, vy, v.z}, a.diagonal);
}
template <class F>
VNDF_INLINE Unstretched<F> unstretch(const Vec3<F>& v, const TurnedAlpha<F>& a) {
  return unstretch(turn(v, a.theta_z), a.alpha);
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
