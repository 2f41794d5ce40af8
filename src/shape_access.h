// What is inside a Shape, for those who compute it and those who compute with it.
#pragma once

#include <cstring>

#include <vndf/ellipsoid.h>
#include <vndf/lanes/shape.h>

namespace vndf {

struct ShapeAccess {
  static VNDF_INLINE void set(Shape& shape, const lanes::Tilted<float>& a, const lanes::Angle<float>& azimuth) {
    static_assert(sizeof a + sizeof azimuth == sizeof shape);
    std::memcpy(shape.a_, &a, sizeof a);
    std::memcpy(shape.azimuth_, &azimuth, sizeof azimuth);
  }
  static VNDF_INLINE void get(const Shape& shape, lanes::Tilted<float>& a, lanes::Angle<float>& azimuth) {
    std::memcpy(&a, shape.a_, sizeof a);
    std::memcpy(&azimuth, shape.azimuth_, sizeof azimuth);
  }
};

/// Of an ellipsoid of five constants.
Shape shape_of(const Ellipsoid& constants) noexcept;

}  // namespace vndf
