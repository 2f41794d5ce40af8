// Dupuy and Benyoub 2023: visible hemisphere normals as half vectors of the view and a uniform point of a spherical
// cap. Eto and Tokuyoshi 2023: a smaller cap, for reflection.
#pragma once

#include <vndf/lanes/hemisphere.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// The view in the hemisphere configuration, A V.
template <class F>
struct CapView {
  F x, y, abs_z;  // A V, the last without its sign
  F r2;           // x^2 + y^2
  F length;       // |A V|
  F sum;          // |A V| + |(A V).z|
};

/// h = A V, times `scale`, a power of two or 1.
template <class F>
VNDF_INLINE CapView<F> map_to_cap(const Vec3<F>& h, F scale) {
  F x = h.x * scale;
  F y = h.y * scale;
  F abs_z = op::abs(h.z * scale);
  F r2 = x * x + y * y;
  F length = op::sqrt(r2 + abs_z * abs_z);
  return {x, y, abs_z, r2, length, length + abs_z};
}

/// The power of two that takes the largest component of A V to [1, 2).
template <class F>
VNDF_INLINE F cap_scale(const Vec3<F>& h) {
  Int<F> larger = op::max(op::max(op::bits(op::abs(h.x)), op::bits(op::abs(h.y))), op::bits(op::abs(h.z)));
  return op::from_bits(Int<F>(0x7f000000) - (op::max(larger, Int<F>(0x00800000)) & Int<F>(0x7f800000)));
}

/// The cap c.z >= -k Vh.z, by the height and the radius of its rim, both times |A V|.
template <class F>
struct Cap {
  F height;   // 1 + k Vh.z
  F radius2;  // 1 - (k Vh.z)^2
};

/// k = 1: the directions that all visible normals reflect the view to (Dupuy and Benyoub 2023). For h.z >= 0.
template <class F>
VNDF_INLINE Cap<F> visible_cap(const CapView<F>& view) {
  return {view.sum, view.r2};
}
/// For any h.z: below the horizon 1 + Vh.z is the small one.
template <class F>
VNDF_INLINE Cap<F> visible_cap(const CapView<F>& view, F h_z) {
  return {op::select(h_z < F(0.f), view.r2 / view.sum, view.sum), view.r2};
}

/// The bound of Eto and Tokuyoshi 2023, eq. 5, with alpha the smaller of the two and at most 1 (their eq. 6; Tokuyoshi
/// and Eto 2024): no direction above the horizon is reflected from a c below -k Vh.z. For wo.z >= 0.
///
/// 1 - k = alpha^2 (s^2 + z^2) / (s^2 + alpha^2 z^2), without a difference.
template <class F>
struct Bound {
  F k, one_minus_k;
};

template <class F>
VNDF_INLINE Bound<F> reflection_bound(Vec3<F> wo, Vec2<F> alpha) {
  Int<F> smaller = op::min(op::bits(op::abs(alpha.x)), op::bits(op::abs(alpha.y)));
  F a = op::from_bits(op::min(smaller, Int<F>(0x3f800000)));
  F s = F(1.f) + op::sqrt(wo.x * wo.x + wo.y * wo.y);
  F s2 = s * s;
  F z2 = wo.z * wo.z;
  F a2 = a * a;
  F inv = F(1.f) / (s2 + a2 * z2);
  return {(((F(1.f) - a) * (F(1.f) + a)) * s2) * inv, (a2 * (s2 + z2)) * inv};
}

template <class F>
VNDF_INLINE Cap<F> bounded_cap(const CapView<F>& view, const Bound<F>& bound) {
  F z2 = view.abs_z * view.abs_z;
  return {view.length + bound.k * view.abs_z, view.r2 + (bound.one_minus_k * (F(1.f) + bound.k)) * z2};
}

/// A cap, and the view that its points are added to, less the third component: the height of a point over the rim
/// makes up for it.
template <class F>
struct CapAtView {
  F x, y;
  Cap<F> cap;
};

/// From h = A V of any length.
template <class F>
VNDF_INLINE CapAtView<F> visible_cap_of(const Vec3<F>& h) {
  auto view = map_to_cap(h, cap_scale(h));
  return {view.x, view.y, visible_cap(view, h.z)};
}

/// A uniform point c of the cap plus the view: Nh = c + Vh up to a positive factor. `r2` and phi are a point of the
/// unit disk that Lambert's map lays on the cap, e = 1 - r2.
///
/// With z the height of c over the rim, 1 - c.z^2 = r2 (1 - (k Vh.z)^2 + (1 + k Vh.z) z): no difference is taken. What
/// stays is the sum c + Vh where c is nearly -Vh. The third component is that of c over the rim, (1 - k) Vh.z short.
template <class F>
VNDF_INLINE Vec3<F> on_cap(const CapAtView<F>& view, F r2, F e, const Angle<F>& phi) {
  F z = e * view.cap.height;
  F radius = op::sqrt(r2 * (view.cap.radius2 + view.cap.height * z));
  return {radius * phi.cos + view.x, radius * phi.sin + view.y, z};
}

/// Dupuy and Benyoub 2023, Listing 3, with u1 = phi / 2 pi for the azimuth and u2 for the height of c.
template <class F>
VNDF_INLINE Vec3<F> on_visible_cap(const CapAtView<F>& view, const Angle<F>& phi, F u2) {
  return on_cap(view, u2, F(1.f) - u2, phi);
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
