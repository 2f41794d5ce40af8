// Shapes that are worked out once for a batch or a material: with the lanes' mathematics, and with + - * / sqrt of
// double. Both have the same bits on every machine.
#include <cmath>

#include <vndf/lanes/tilted_shape.h>

#include "dispatch/dispatch.h"
#include "shape_access.h"

namespace vndf {

Shape shape_of(const Ellipsoid& constants) noexcept {
  Shape shape;
  ShapeAccess::set(
      shape, lanes::tilted_shape<float>({constants.alpha.x.value, constants.alpha.y.value}, constants.theta_x.value,
                                        constants.theta_y.value, constants.theta_z.value));
  return shape;
}

VNDF_NOINLINE static ShapeError make(const float (&a)[9], Shape& shape) noexcept {
  constexpr double kFlat = 0x1p-40, kSmallest = 0x1p-26, kLargest = 0x1p26;
  double largest = 0;
  for (float value : a) {
    if (!std::isfinite(value)) return ShapeError::not_finite;
    largest = std::fmax(largest, std::fabs(value));
  }
  if (!(largest > 0)) return ShapeError::not_positive;
  // A factor of A changes nothing. Without this one, products could leave the range of double.
  double scale = 1 / largest;
  using D3 = lanes::Vec3<double>;
  D3 a1 = {a[0] * scale, a[3] * scale, a[6] * scale};
  D3 a2 = {a[1] * scale, a[4] * scale, a[7] * scale};
  D3 a3 = {a[2] * scale, a[5] * scale, a[8] * scale};
  D3 c1 = cross(a1, a3), c2 = cross(a2, a3);
  double determinant = dot(a1, c2);
  double sizes = std::sqrt(dot(a1, a1)) * std::sqrt(dot(a2, a2)) * std::sqrt(dot(a3, a3));
  if (!(determinant > kFlat * sizes)) return ShapeError::not_positive;

  auto reduced =
      lanes::triangle<float>({determinant, dot(a1, a3), dot(a2, a3), dot(a3, a3), dot(c1, c2), std::sqrt(dot(c2, c2))});
  auto n = lanes::narrowed(reduced);
  for (float value : {n.xx, n.yy})
    if (!(value >= kSmallest && value <= kLargest)) return ShapeError::out_of_range;
  for (float value : {n.yx, n.zx, n.zy})
    if (!(std::fabs(value) <= kLargest)) return ShapeError::out_of_range;
  ShapeAccess::set(shape, reduced);
  return ShapeError::none;
}

ShapeError make_shape(const float (&a)[9], Shape& shape) noexcept {
  FloatMode exact;
  return make(a, shape);
}

const char* message(ShapeError error) noexcept {
  switch (error) {
    case ShapeError::none:
      return "no error";
    case ShapeError::not_finite:
      return "the matrix has elements that are not finite";
    case ShapeError::not_positive:
      return "the determinant of the matrix is not positive, or vanishes beside the lengths of its columns";
    case ShapeError::out_of_range:
      return "the ellipsoid is too flat, too long or too skewed: reduced to A n = n, its matrix leaves 2^-26 to 2^26";
  }
  return "not an error of this library";
}

}  // namespace vndf
