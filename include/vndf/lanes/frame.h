// Local shading frames: the axes that directions of the library are in, as world vectors.
#pragma once

#include <vndf/lanes/vec.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// Orthonormal vectors of the world: x and y along alpha_x and alpha_y, z the normal.
template <class F>
struct Frame {
  Vec3<F> x, y, z;
};

/// A world direction in the frame: its products with the axes.
template <class F>
VNDF_INLINE Vec3<F> to_local(const Vec3<F>& v, const Frame<F>& frame) {
  return {dot(v, frame.x), dot(v, frame.y), dot(v, frame.z)};
}

/// A direction of the frame in the world.
template <class F>
VNDF_INLINE Vec3<F> to_world(const Vec3<F>& v, const Frame<F>& frame) {
  const auto& [x, y, z] = frame;
  return {(x.x * v.x + y.x * v.y) + z.x * v.z, (x.y * v.x + y.y * v.y) + z.y * v.z,
          (x.z * v.x + y.z * v.y) + z.z * v.z};
}

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
