// The numbers of a Shape, for those who compute them.
#pragma once

#include <vndf/ellipsoid.h>

namespace vndf {

struct ShapeAccess {
  /// ((xx, xy, 0), (yx, yy, 0), (zx, zy, 1)), and two factors of its determinant. In the order of lanes::Tilted.
  static inline __attribute__((always_inline)) Shape make(float xx, float xy, float yx, float yy, float det_x,
                                                          float det_y, float zx, float zy) {
    Shape shape;
    shape.xx_ = xx;
    shape.xy_ = xy;
    shape.yx_ = yx;
    shape.yy_ = yy;
    shape.det_x_ = det_x;
    shape.det_y_ = det_y;
    shape.zx_ = zx;
    shape.zy_ = zy;
    return shape;
  }
};

}  // namespace vndf
