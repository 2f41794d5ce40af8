// Pairs and directions of lanes.
#pragma once

#include <vndf/lanes/many.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

template <class F>
struct Vec2 {
  F x, y;
};

template <class F>
struct Vec3 {
  F x, y, z;
};

template <class F>
VNDF_INLINE F dot(const Vec3<F>& a, const Vec3<F>& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
template <class F>
VNDF_INLINE Vec3<F> cross(const Vec3<F>& a, const Vec3<F>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
