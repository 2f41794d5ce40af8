// The three warps from random numbers to visible normals, stage by stage.
#pragma once

#include <vndf/lanes/spherical_cap.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

template <class F, class Shape = Vec2<F>>
VNDF_INLINE Vec3<F> sample_normal_on_chord(Vec3<F> wo, const Shape& shape, const Chord<F>& t) {
  auto view = map_to_hemisphere(wo, shape);
  return map_from_hemisphere(reproject(view, t, squish(view, t)), shape);
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
  return map_from_hemisphere(sample_cap(wo, shape, u), shape);
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
