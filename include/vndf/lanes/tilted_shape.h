// The triangle of an ellipsoid, from its roughness and angles or from any matrix.
#pragma once

#include <vndf/lanes/shape.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

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
VNDF_INLINE Triangle<F> triangle(const ColumnProducts<Wide<F>>& of) {
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
VNDF_INLINE Triangle<F> tilted_shape(const Vec2<F>& alpha, F theta_x, F theta_y, F theta_z) {
  using W = Wide<F>;
  auto x = angle_of<W>(theta_x), y = angle_of<W>(theta_y), z = angle_of<W>(theta_z);
  W alpha_x = op::widen(at_least_mirror(alpha.x)), alpha_y = op::widen(at_least_mirror(alpha.y)),
    determinant = alpha_x * alpha_y;
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

  // The x axis of a triangle is along c2. That of theta_z = 0 has these components along d2 and across, times 2^30 to
  // keep their squares.
  F along = op::narrow(dot(c2, d2) * products.inverse()) * F(0x1p30f);
  F across = F(0.f) - op::narrow(z.sin) * (shape.xx * F(0x1p30f));
  F length = op::sqrt(along * along + across * across);
  shape.azimuth = {along / length, across / length};
  return shape;
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
