// What gives a distribution its shape: the matrix A that stretches the ellipsoid to a sphere, and the three things that
// the mathematics asks of it. Plain GGX is Vec2 {alpha_x, alpha_y}: A = diag(alpha_x, alpha_y, 1). The ellipsoid NDF
// (Walter et al. 2015) has any A with |A| > 0.
//
// Neither a factor nor an orthogonal matrix on the left of A changes the distribution, so every A can be had with
// A n = n: Q A / |A n|, with Q turning A n to z. Then A n is the z axis of the hemisphere configuration, as in plain
// GGX, the cosine of Walter's lune angle is Vh.z, and everything between eq. 5 and eq. 6 of Heitz 2018 carries over.
// What is new is that Vh can be below the horizon for a view above it, and the other way round.
//
// Frames: Walter's disk is Heitz's turned, (x_a, y_a) = (t2, -t1). Here it is Heitz's everywhere.
#pragma once

#include <vndf/lanes/disk.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

template <class F>
struct Vec3 {
  F x, y, z;
};

template <class F>
VNDF_INLINE F dot(const Vec3<F>& a, const Vec3<F>& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

/// A = ((xx, xy, 0), (yx, yy, 0), (0, 0, 1)): GGX whose axes are turned about n.
template <class F>
struct Turned {
  F xx, xy, yx, yy;
  Vec2<F> det;  // two factors of |A| as large as the two alpha
};

/// A = ((xx, xy, 0), (yx, yy, 0), (zx, zy, 1)): any ellipsoid.
template <class F>
struct Tilted {
  Turned<F> turned;
  F zx, zy;
};

// Functions of a shape take Vec2 where nothing says which, so that {alpha_x, alpha_y} is a shape.

/// Whether (A v).z is v.z in a shape's formulas. Turned shapes go the way of tilted ones, so that they have their bits.
template <class Shape>
constexpr bool kUpright = false;
template <class F>
constexpr bool kUpright<Vec2<F>> = true;

/// A v, Heitz 2018, eq. 5.
template <class F>
VNDF_INLINE Vec3<F> stretch(const Vec3<F>& v, const Vec2<F>& alpha) {
  return {alpha.x * v.x, alpha.y * v.y, v.z};
}
template <class F>
VNDF_INLINE Vec3<F> stretch(const Vec3<F>& v, const Turned<F>& a) {
  return {a.xx * v.x + a.xy * v.y, a.yx * v.x + a.yy * v.y, v.z};
}
template <class F>
VNDF_INLINE Vec3<F> stretch(const Vec3<F>& v, const Tilted<F>& a) {
  Vec3<F> h = stretch(v, a.turned);
  return {h.x, h.y, (a.zx * v.x + a.zy * v.y) + v.z};
}

/// A^T v, eq. 6.
template <class F>
VNDF_INLINE Vec3<F> stretch_back(const Vec3<F>& v, const Vec2<F>& alpha) {
  return {alpha.x * v.x, alpha.y * v.y, v.z};
}
template <class F>
VNDF_INLINE Vec3<F> stretch_back(const Vec3<F>& v, const Turned<F>& a) {
  return {a.xx * v.x + a.yx * v.y, a.xy * v.x + a.yy * v.y, v.z};
}
template <class F>
VNDF_INLINE Vec3<F> stretch_back(const Vec3<F>& v, const Tilted<F>& a) {
  Vec3<F> p = stretch_back(v, a.turned);
  return {p.x + a.zx * v.z, p.y + a.zy * v.z, v.z};
}

/// Two factors of |A|.
template <class F>
VNDF_INLINE Vec2<F> factors_of_determinant(const Vec2<F>& alpha) {
  return alpha;
}
template <class F>
VNDF_INLINE Vec2<F> factors_of_determinant(const Turned<F>& a) {
  return a.det;
}
template <class F>
VNDF_INLINE Vec2<F> factors_of_determinant(const Tilted<F>& a) {
  return a.turned.det;
}

/// a A^-T v for |A| = a b.
template <class F>
struct Unstretched {
  Vec3<F> v;
  F a, a_over_b;
};

/// The roughness that densities are evaluated with: at least 2^-60, which keeps a mirror's finite.
template <class F>
VNDF_INLINE F evaluated_alpha(F alpha) {
  constexpr float kMirror = 0x1p-60f;
  F abs = op::abs(alpha);
  return op::select(abs < F(kMirror), F(kMirror), abs);
}

template <class F>
VNDF_INLINE Unstretched<F> unstretch(const Vec3<F>& v, const Vec2<F>& alpha) {
  F alpha_x = evaluated_alpha(alpha.x);
  F ratio = alpha_x / evaluated_alpha(alpha.y);
  return {{v.x, v.y * ratio, v.z * alpha_x}, alpha_x, ratio};
}
template <class F>
VNDF_INLINE Unstretched<F> unstretch(const Vec3<F>& v, const Turned<F>& a) {
  F inv = F(1.f) / a.det.y;
  return {{(a.yy * v.x - a.yx * v.y) * inv, (a.xx * v.y - a.xy * v.x) * inv, v.z * a.det.x}, a.det.x, a.det.x * inv};
}
template <class F>
VNDF_INLINE Unstretched<F> unstretch(const Vec3<F>& v, const Tilted<F>& a) {
  return unstretch<F>({v.x - a.zx * v.z, v.y - a.zy * v.z, v.z}, a.turned);
}

/// S Rz(theta_z), Walter et al. 2015, eq. 2-3 with theta_x = theta_y = 0.
template <class F>
VNDF_INLINE Turned<F> turned_shape(const Vec2<F>& alpha, F theta_z) {
  auto z = angle_of(theta_z);
  return {alpha.x * z.cos, F(0.f) - alpha.x * z.sin, alpha.y * z.sin, alpha.y * z.cos, alpha};
}

/// S Rx(theta_x) Ry(theta_y) Rz(theta_z), eq. 2-3.
///
/// With r1, r2, r3 the columns of R, a1 x a3 = S r1 x S r3 = -|S| S^-1 r2 and a2 x a3 = |S| S^-1 r1: what is left of a1
/// and a2 when their share of a3 is taken off, turned by a quarter about a3, without a difference. Q turns t = a3 /
/// |a3| to z by the shortest way, and by a half turn about x before where t is below the horizon. For theta = 0 the
/// result is A, exactly.
template <class F>
VNDF_INLINE Tilted<F> tilted_shape(const Vec2<F>& alpha, F theta_x, F theta_y, F theta_z) {
  auto x = angle_of(theta_x);
  auto y = angle_of(theta_y);
  auto z = angle_of(theta_z);
  F sc = x.sin * y.sin;
  F cs = x.cos * y.sin;
  Vec3<F> r1 = {y.cos * z.cos, x.cos * z.sin + sc * z.cos, x.sin * z.sin - cs * z.cos};
  Vec3<F> r2 = {F(0.f) - y.cos * z.sin, x.cos * z.cos - sc * z.sin, x.sin * z.cos + cs * z.sin};
  Vec3<F> r3 = {y.sin, F(0.f) - x.sin * y.cos, x.cos * y.cos};

  Vec3<F> a1 = stretch(r1, alpha);
  Vec3<F> a2 = stretch(r2, alpha);
  Vec3<F> a3 = stretch(r3, alpha);
  F inv = F(1.f) / op::sqrt(dot(a3, a3));
  F inv2 = inv * inv;
  // With y and z mirrored, a half turn about x, where that is needed.
  F t_y = a3.y * inv;
  auto below = a3.z < F(0.f);
  Vec3<F> t = {a3.x * inv, op::select(below, F(0.f) - t_y, t_y), op::abs(a3.z * inv)};
  F alpha_x = op::select(below, F(0.f) - alpha.x, alpha.x);

  F area = alpha_x * alpha.y;
  F s = F(1.f) / (F(1.f) + t.z);
  F lean1 = (area * r2.z) * s;
  F lean2 = (area * r1.z) * s;
  return {{(alpha_x * r2.y - t.y * lean1) * inv2,
           (t.y * lean2 - alpha_x * r1.y) * inv2,
           (t.x * lean1 - alpha.y * r2.x) * inv2,
           (alpha.y * r1.x - t.x * lean2) * inv2,
           {alpha.x * inv, alpha.y * inv2}},
          dot(a1, a3) * inv2,
          dot(a2, a3) * inv2};
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
