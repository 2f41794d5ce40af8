// What gives a distribution its shape: the matrix A that stretches the ellipsoid to a sphere, and what the mathematics
// asks of it: A v, A^T v, A^-T v, |A|, and where azimuths begin. Plain GGX is Vec2 {alpha_x, alpha_y}: A =
// diag(alpha_x, alpha_y, 1). The ellipsoid NDF (Walter et al. 2015) has any A with |A| > 0.
//
// Neither a factor nor an orthogonal matrix on the left of A changes the distribution, so every A can be had as a lower
// triangle with A n = n: Q A / |A n|. Then A n is the z axis of the hemisphere configuration, as in plain GGX, the
// cosine of Walter's lune angle is Vh.z, and everything between eq. 5 and eq. 6 of Heitz 2018 carries over. What is new
// is that Vh can be below the horizon for a view above it, and the other way round.
//
// theta_z turns the frame of the directions about n. Sampling turns the view on the way in and the result on the way
// out; for a given pair of directions the shape is Turned, and they stay as they are.
//
// The products A v and Rz v are sums that can cancel, for views near the horizon of the leaning ellipsoid, or along the
// narrow axis of a turned one; small alpha magnifies what is lost then. Hence A and the angle are given in two parts,
// T = Split<F>, where they meet the view that is sampled for, and so is A^-T. The way back, A^T Nh, and the lengths of
// A v, are as well conditioned as those of plain GGX and take floats, T = F: a shape and an angle are `narrowed` for
// them. So are they for the cap, the sum of which loses more.
//
// Frames: Walter's disk is Heitz's turned, (x_a, y_a) = (t2, -t1). Here it is Heitz's everywhere.
#pragma once

#include <vndf/lanes/disk.h>
#include <vndf/lanes/rotation.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// A = ((xx, 0, 0), (yx, yy, 0), (zx, zy, 1)): any ellipsoid. |A| = xx yy.
template <class F, class T = Split<F>>
struct Tilted {
  F xx;
  T yx, yy, zx, zy;
  // Of the x axis that the triangle has for theta_z = 0. Azimuths count from there, so that theta_z turns the samples.
  Angle<F> azimuth;
};

/// A = diag(alpha_x, alpha_y, 1) Rz: GGX whose axes are turned about n. Theta is SmallAngle<F>, or Angle<F> in a shape
/// that is narrowed.
template <class F, class Theta = SmallAngle<F>>
struct Turned {
  Theta theta_z;
  Vec2<F> alpha;
};
/// Odd quarter turns exchange the two alpha, which is another quarter turn on the left of A.
template <class F>
VNDF_INLINE Turned<F> turned_shape(const Vec2<F>& alpha, const Rotation<F>& theta_z) {
  auto odd = theta_z.turns.odd;
  return {theta_z.small, {op::select(odd, alpha.y, alpha.x), op::select(odd, alpha.x, alpha.y)}};
}

/// The diagonal of A, the product of which is |A|.
template <class F>
VNDF_INLINE Vec2<F> diagonal(const Vec2<F>& alpha) {
  return alpha;
}
template <class F>
VNDF_INLINE Vec2<F> diagonal(const Tilted<F, F>& a) {
  return {a.xx, a.yy};
}

/// The roughness that densities are evaluated with: at least 2^-60, which keeps a mirror's finite.
template <class F>
VNDF_INLINE F evaluated_alpha(F alpha) {
  constexpr float kMirror = 0x1p-60f;
  F abs = op::abs(alpha);
  return op::select(abs < F(kMirror), F(kMirror), abs);
}

/// The diagonal that densities are evaluated with: |A| = a b.
template <class F>
struct EvaluatedDiagonal {
  F a, a_over_b;
};
template <class F>
VNDF_INLINE EvaluatedDiagonal<F> evaluated_diagonal(const Vec2<F>& diagonal) {
  F a = evaluated_alpha(diagonal.x);
  return {a, a / evaluated_alpha(diagonal.y)};
}

/// The shape for given pairs of directions: narrowed, and A^-T up to the diagonal of A, which is
/// ((1, -xy, -xz), (0, 1, -yz), (0, 0, 1)).
template <class F>
struct TiltedForPairs {
  Tilted<F, F> narrowed;
  Split<F> xy, xz, yz;
  EvaluatedDiagonal<F> diagonal;
};

// Functions of a shape take Vec2 where nothing says which, so that {alpha_x, alpha_y} is a shape.

/// Whether (A v).z is v.z.
template <class Shape>
constexpr bool kUpright = true;
template <class F, class T>
constexpr bool kUpright<Tilted<F, T>> = false;
template <class F>
constexpr bool kUpright<TiltedForPairs<F>> = false;

template <class F>
VNDF_INLINE Vec2<F> narrowed(const Vec2<F>& alpha) {
  return alpha;
}
template <class F>
VNDF_INLINE Tilted<F, F> narrowed(const Tilted<F>& a) {
  return {a.xx, narrowed(a.yx), narrowed(a.yy), narrowed(a.zx), narrowed(a.zy), a.azimuth};
}
template <class F>
VNDF_INLINE const Tilted<F, F>& narrowed(const TiltedForPairs<F>& a) {
  return a.narrowed;
}
template <class F>
VNDF_INLINE TiltedForPairs<F> for_pairs(const Tilted<F>& a) {
  auto xy = quotient(a.yx, a.yy);
  auto floats = narrowed(a);
  return {floats, xy, difference(a.zx, xy, a.zy), a.zy, evaluated_diagonal(diagonal(floats))};
}
template <class F>
VNDF_INLINE Turned<F, Angle<F>> narrowed(const Turned<F>& a) {
  return {narrowed(a.theta_z), a.alpha};
}

/// Where azimuths begin.
template <class F>
VNDF_INLINE XAxis azimuth_of(const Vec2<F>&) {
  return {};
}
template <class F, class T>
VNDF_INLINE Angle<F> azimuth_of(const Tilted<F, T>& a) {
  return a.azimuth;
}

/// A v, Heitz 2018, eq. 5.
template <class F>
VNDF_INLINE Vec3<F> stretch(const Vec3<F>& v, const Vec2<F>& alpha) {
  return {alpha.x * v.x, alpha.y * v.y, v.z};
}
template <class F, class T>
VNDF_INLINE Vec3<F> stretch(const Vec3<F>& v, const Tilted<F, T>& a) {
  return {a.xx * v.x, sum_of_products(a.yx, v.x, a.yy, v.y), sum_of_products(a.zx, v.x, a.zy, v.y, v.z)};
}
template <class F, class Theta>
VNDF_INLINE Vec3<F> stretch(const Vec3<F>& v, const Turned<F, Theta>& a) {
  return stretch(turn(v, a.theta_z), a.alpha);
}

/// A^T v, eq. 6.
template <class F>
VNDF_INLINE Vec3<F> stretch_back(const Vec3<F>& v, const Vec2<F>& alpha) {
  return stretch(v, alpha);
}
template <class F>
VNDF_INLINE Vec3<F> stretch_back(const Vec3<F>& v, const Tilted<F, F>& a) {
  return {(a.xx * v.x + a.yx * v.y) + a.zx * v.z, a.yy * v.y + a.zy * v.z, v.z};
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
VNDF_INLINE Unstretched<F> unstretch(const Vec3<F>& v, const TiltedForPairs<F>& a) {
  auto y = split(v.y), z = split(v.z);
  F vx = ((v.x - a.xy.high * y.high) - a.xz.high * z.high) -
         ((a.xy.high * y.low + a.xy.low * v.y) + (a.xz.high * z.low + a.xz.low * v.z));
  F vy = (v.y - a.yz.high * z.high) - (a.yz.high * z.low + a.yz.low * v.z);
  return unstretch(Vec3<F>{vx, vy, v.z}, a.diagonal);
}
template <class F>
VNDF_INLINE Unstretched<F> unstretch(const Vec3<F>& v, const Turned<F>& a) {
  return unstretch(turn(v, a.theta_z), a.alpha);
}

/// Products of the columns a1, a2, a3 = A n of A, with c1 = a1 x a3 and c2 = a2 x a3.
template <class W>
struct ColumnProducts {
  W determinant, a1_a3, a2_a3, a3_a3, c1_c2, c2_length;

  VNDF_INLINE W inverse() const { return W(1) / (a3_a3 * c2_length); }
};

/// The triangle of A: quotients of these, which neither a factor nor an orthogonal matrix changes.
///
/// An element that is alone in its row, beside zeros, is the float that it is in plain GGX: all of it is the low part,
/// whose products are rounded as those of floats are.
template <class F>
VNDF_INLINE Tilted<F> triangle(const ColumnProducts<Wide<F>>& of) {
  auto inv = of.inverse();
  auto inv_a3_a3 = of.c2_length * inv;
  auto yx = split<F>(of.c1_c2 * inv);
  auto yy = of.c2_length * inv_a3_a3;
  auto parts = split<F>(yy);
  auto alone = narrowed(yx) == F(0.f);
  return {op::narrow(of.determinant * inv) * op::sqrt(op::narrow(of.a3_a3)),
          yx,
          {op::select(alone, F(0.f), parts.high), op::select(alone, op::narrow(yy), parts.low)},
          split<F>(of.a1_a3 * inv_a3_a3),
          split<F>(of.a2_a3 * inv_a3_a3),
          {F(1.f), F(0.f)}};
}

/// S Rx(theta_x) Ry(theta_y) Rz(theta_z), eq. 2-3. For theta_z = 0, c1 = -|S| S^-1 r2 and c2 = |S| S^-1 r1 with the
/// columns r of Rx Ry, and most of the sums collapse; theta_z turns a1 and a2, and c1 and c2 with them.
template <class F>
VNDF_INLINE Tilted<F> tilted_shape(const Vec2<F>& alpha, F theta_x, F theta_y, F theta_z) {
  using W = Wide<F>;
  auto x = angle_of<W>(theta_x), y = angle_of<W>(theta_y), z = angle_of<W>(theta_z);
  W alpha_x = op::widen(alpha.x), alpha_y = op::widen(alpha.y), determinant = alpha_x * alpha_y;
  W ax_xcos = alpha_x * x.cos, ay_xsin = alpha_y * x.sin, ax_ysin = alpha_x * y.sin;
  W without_y = ay_xsin * ay_xsin + x.cos * x.cos;  // a3_a3 for theta_y = 0
  W a1_a3 = (y.sin * y.cos) * (alpha_x * alpha_x - without_y);
  W a2_a3 = ((x.sin * x.cos) * y.cos) * (W(1) - alpha_y * alpha_y);
  Vec3<W> c1 = {W(0), W(0) - ax_xcos, W(0) - alpha_x * ay_xsin};
  Vec3<W> c2 = {alpha_y * y.cos, ax_ysin * x.sin, W(0) - (ax_ysin * alpha_y) * x.cos};

  auto turned_1 = [&](W a1, W a2) { return a1 * z.cos + a2 * z.sin; };
  auto turned_2 = [&](W a1, W a2) { return a2 * z.cos - a1 * z.sin; };
  Vec3<W> d1 = {turned_1(c1.x, c2.x), turned_1(c1.y, c2.y), turned_1(c1.z, c2.z)};
  Vec3<W> d2 = {turned_2(c1.x, c2.x), turned_2(c1.y, c2.y), turned_2(c1.z, c2.z)};
  ColumnProducts<W> products = {
      determinant, turned_1(a1_a3, a2_a3), turned_2(a1_a3, a2_a3), ax_ysin * ax_ysin + (y.cos * y.cos) * without_y,
      dot(d1, d2), op::sqrt(dot(d2, d2))};
  auto shape = triangle<F>(products);

  // The x axis of a triangle is along c2. That of theta_z = 0 has these components along d2 and across, times 2^40 to
  // keep their squares.
  F along = op::narrow(dot(c2, d2) * products.inverse()) * F(0x1p40f);
  F across = F(0.f) - op::narrow(z.sin) * (shape.xx * F(0x1p40f));
  F length = op::sqrt(along * along + across * across);
  shape.azimuth = {along / length, across / length};
  return shape;
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
