// The three warps from random numbers to visible normals, stage by stage.
#pragma once

#include <vndf/lanes/spherical_cap.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

template <class F, class Shape = Vec2<F>>
VNDF_INLINE Vec3<F> sample_normal_on_chord(Vec3<F> wo, const Shape& shape, const Chord<F>& t) {
  auto view = map_to_hemisphere(stretch(wo, shape), azimuth_of(shape));
  return map_from_hemisphere(reproject(view, t, squish(view, t)), narrowed(shape));
}

template <class F, class Shape = Vec2<F>>
VNDF_INLINE Vec3<F> sample_normal_polar(Vec3<F> wo, const Shape& shape, Vec2<F> u) {
  return sample_normal_on_chord(wo, shape, chord(polar_map(u)));
}

template <class F, class Shape = Vec2<F>>
VNDF_INLINE Vec3<F> sample_normal_concentric(Vec3<F> wo, const Shape& shape, Vec2<F> u) {
  return sample_normal_on_chord(wo, shape, chord(concentric_map(u)));
}

template <class F, class Shape = Vec2<F>>
VNDF_INLINE Vec3<F> sample_normal_cap(Vec3<F> wo, const Shape& shape, Vec2<F> u) {
  // The sum of two vectors that comes loses more than a product with floats.
  auto a = narrowed(shape);
  return map_from_hemisphere(on_visible_cap(visible_cap_of(stretch(wo, a)), plus(sincos2pi(u.x), azimuth_of(a)), u.y),
                             a);
}

/// Plain GGX whose axes theta_z turns about n: sample(wo) is one of the above for alpha and u. T is Split<F> for the
/// disk, F for the cap.
template <class T, class F, class Sample>
VNDF_INLINE Vec3<F> sample_in_turned_frame(const Vec3<F>& wo, F theta_z, Sample sample) {
  auto rotation = rotation_of<T>(reduce_angle(theta_z));
  return turn_back(sample(turn_as<T>(wo, rotation)), angle_of<F>(rotation));
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
