// Visible normals: the paper from end to end.
#pragma once

#include <vndf/lanes/warps.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// A visible normal of wo, as the warp maps u. `theta_z` turns it back from a turned frame.
///
/// Source: Heitz 2018; Dupuy and Benyoub 2023.
template <class Warp, class F, class Shape = Vec2<F>, class Theta = XAxis>
VNDF_INLINE Vec3<F> sample_normal(const Vec3<F>& wo, const Shape& shape, Vec2<F> u, const Theta& theta_z = {}) {
  Vec3<F> h = stretch(wo, shape);  // 3.2, eq. 5
  if constexpr (Warp::kOnDisk) {
    auto t = chord(Warp::disk_point(u));                       // 4.2, eq. 9-10
    auto view = map_to_hemisphere(h, azimuth_of(shape));       // 3.2
    auto nh = reproject(view, t).nh;                           // 4.2-4.3, eq. 11-13
    return map_from_hemisphere(nh, narrowed(shape), theta_z);  // 3.4, eq. 6
  } else {
    auto view = cap_view(h, azimuth_of(shape));
    auto nh = on_cap(view, Warp::cap_point(u)).nh;
    return map_from_hemisphere(nh, narrowed(shape), theta_z);
  }
}

/// The same for plain GGX whose axes theta_z turns about n.
template <class Warp, class F>
VNDF_INLINE Vec3<F> sample_normal_turned(const Vec3<F>& wo, Vec2<F> alpha, F theta_z, Vec2<F> u) {
  auto rotation = rotation_of(theta_z);
  return sample_normal<Warp>(turn(wo, rotation), alpha, u, angle_of<F>(rotation));
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
