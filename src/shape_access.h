// What is inside a Shape: for the code that computes it, and for kernels, which compute with it.
#pragma once

#include <cstring>

#include <vndf/ellipsoid.h>
#include <vndf/lanes/shape.h>

namespace vndf {

struct ShapeAccess {
  static VNDF_INLINE void set(Shape& shape, const lanes::Triangle<float>& a) {
    static_assert(sizeof a == sizeof shape);
    std::memcpy(shape.a_, &a, sizeof a);
  }
  static VNDF_INLINE lanes::Triangle<float> get(const Shape& shape) {
    lanes::Triangle<float> a;
    std::memcpy(&a, shape.a_, sizeof a);
    return a;
  }
};

}  // namespace vndf
