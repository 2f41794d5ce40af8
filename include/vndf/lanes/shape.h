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
// out. A given pair of directions stays as it is, and the shape is a TurnedAlpha (shape_for_pairs.h).
//
// The products A v and Rz v are sums that can cancel, for views near the horizon of the leaning ellipsoid, or along the
// narrow axis of a turned one; small alpha magnifies what is lost then. Hence A and the angle are given in two parts,
// Triangle, where they meet the view that is sampled for, and so is A^-T. The way back, A^T Nh, and the lengths of A v,
// are as well conditioned as those of plain GGX and take floats, FloatTriangle: a shape and an angle are `narrowed` for
// them.
//
// Frames: Walter's disk is Heitz's turned, (x_a, y_a) = (t2, -t1). Here it is Heitz's everywhere.
#pragma once

#include <vndf/lanes/disk.h>
#include <vndf/lanes/rotation.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// A = ((xx, 0, 0), (yx, yy, 0), (zx, zy, 1)): any ellipsoid. |A| = xx yy.
template <class F, class Element>
struct TriangleOf {
  F xx;
  Element yx, yy, zx, zy;
  // Of the x axis that the triangle has for theta_z = 0. Azimuths count from it, so that theta_z turns the samples.
  Angle<F> azimuth;
};
/// For the view: in two parts.
template <class F>
using Triangle = TriangleOf<F, Split<F>>;
/// For the way back, and for lengths.
template <class F>
using FloatTriangle = TriangleOf<F, F>;

/// Roughness that one can divide by: at least 2^-60, without sign.
template <class F>
VNDF_INLINE F at_least_mirror(F alpha) {
  constexpr float kMirror = 0x1p-60f;
  F abs = op::abs(alpha);
  return op::select(abs < F(kMirror), F(kMirror), abs);
}

// Functions of a shape take Vec2 where nothing says which, so that {alpha_x, alpha_y} is a shape.

/// Whether (A v).z is v.z.
template <class Shape>
constexpr bool kUpright = true;
template <class F, class T>
constexpr bool kUpright<TriangleOf<F, T>> = false;
/// The diagonal of A, the product of which is |A|.
template <class F>
VNDF_INLINE Vec2<F> diagonal(const Vec2<F>& alpha) {
  return alpha;
}
template <class F>
VNDF_INLINE Vec2<F> diagonal(const FloatTriangle<F>& a) {
  return {a.xx, a.yy};
}
/// As floats.
template <class F>
VNDF_INLINE Vec2<F> narrowed(const Vec2<F>& alpha) {
  return alpha;
}
template <class F>
VNDF_INLINE FloatTriangle<F> narrowed(const Triangle<F>& a) {
  return {a.xx, narrowed(a.yx), narrowed(a.yy), narrowed(a.zx), narrowed(a.zy), a.azimuth};
}

/// Where azimuths begin.
template <class F>
VNDF_INLINE XAxis azimuth_of(const Vec2<F>&) {
  return {};
}
template <class F, class T>
VNDF_INLINE Angle<F> azimuth_of(const TriangleOf<F, T>& a) {
  return a.azimuth;
}

/// A v, Heitz 2018, eq. 5.
template <class F>
VNDF_INLINE Vec3<F> stretch(const Vec3<F>& v, const Vec2<F>& alpha) {
  return {alpha.x * v.x, alpha.y * v.y, v.z};
}
template <class F, class T>
VNDF_INLINE Vec3<F> stretch(const Vec3<F>& v, const TriangleOf<F, T>& a) {
  return {a.xx * v.x, sum_of_products(a.yx, v.x, a.yy, v.y), sum_of_products(a.zx, v.x, a.zy, v.y, v.z)};
}
/// A^T v, eq. 6.
template <class F>
VNDF_INLINE Vec3<F> stretch_back(const Vec3<F>& v, const Vec2<F>& alpha) {
  return stretch(v, alpha);
}
template <class F>
VNDF_INLINE Vec3<F> stretch_back(const Vec3<F>& v, const FloatTriangle<F>& a) {
  return {(a.xx * v.x + a.yx * v.y) + a.zx * v.z, a.yy * v.y + a.zy * v.z, v.z};
}
}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
