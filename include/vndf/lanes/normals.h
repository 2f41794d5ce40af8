// The three warps from random numbers to visible normals, stage by stage.
#pragma once

#include <vndf/lanes/spherical_cap.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

template <class F, class Shape = Vec2<F>, class Theta = XAxis>
VNDF_INLINE Vec3<F> sample_normal_on_chord(const Vec3<F>& wo, const Shape& shape, const Chord<F>& t,
                                           const Theta& theta_z = {}) {
  auto view = map_to_hemisphere(stretch(wo, shape), azimuth_of(shape));
  return map_from_hemisphere(reproject(view, t).nh, narrowed(shape), theta_z);
}

template <class F, class Shape = Vec2<F>, class Theta = XAxis>
VNDF_INLINE Vec3<F> sample_normal_polar(const Vec3<F>& wo, const Shape& shape, Vec2<F> u, const Theta& theta_z = {}) {
  return sample_normal_on_chord(wo, shape, chord(polar_map(u)), theta_z);
}

template <class F, class Shape = Vec2<F>, class Theta = XAxis>
VNDF_INLINE Vec3<F> sample_normal_concentric(const Vec3<F>& wo, const Shape& shape, Vec2<F> u,
                                             const Theta& theta_z = {}) {
  return sample_normal_on_chord(wo, shape, chord(concentric_map(u)), theta_z);
}

template <class F, class Shape = Vec2<F>, class Theta = XAxis>
VNDF_INLINE Vec3<F> sample_normal_cap(const Vec3<F>& wo, const Shape& shape, Vec2<F> u, const Theta& theta_z = {}) {
  auto view = cap_view(stretch(wo, shape), azimuth_of(shape));
  return map_from_hemisphere(on_cap(view, cap_map(u)).nh, narrowed(shape), theta_z);
}

/// Plain GGX whose axes theta_z turns about n: sample(wo, theta_z) is one of the above for alpha and u.
template <class F, class Sample>
VNDF_INLINE Vec3<F> sample_in_turned_frame(const Vec3<F>& wo, F theta_z, Sample sample) {
  auto rotation = rotation_of(theta_z);
  return sample(turn(wo, rotation), angle_of<F>(rotation));
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
