// The shape of a general matrix, once for a batch or a material, in double: it is not on the way of any lane, and the
// same on every machine since it is + - * / sqrt as well.
#include <cmath>

#include "shape_access.h"

namespace vndf {
namespace {

struct D3 {
  double x, y, z;
};
double dot(const D3& a, const D3& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
D3 cross(const D3& a, const D3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace

ShapeError make_shape(const float (&a)[9], Shape& shape) noexcept {
  constexpr double kFlat = 0x1p-40, kSmallest = 0x1p-40, kLargest = 0x1p40;
  double largest = 0;
  for (float value : a) {
    if (!std::isfinite(value)) return ShapeError::not_finite;
    largest = std::fmax(largest, std::fabs(value));
  }
  if (!(largest > 0)) return ShapeError::not_positive;
  // Factors do not matter, and without this one products could leave the range of double.
  double scale = 1 / largest;
  D3 a1 = {a[0] * scale, a[3] * scale, a[6] * scale};
  D3 a2 = {a[1] * scale, a[4] * scale, a[7] * scale};
  D3 a3 = {a[2] * scale, a[5] * scale, a[8] * scale};
  D3 a13 = cross(a1, a3), a23 = cross(a2, a3);
  double determinant = dot(a1, a23);
  double lengths = std::sqrt(dot(a1, a1)) * std::sqrt(dot(a2, a2)) * std::sqrt(dot(a3, a3));
  if (!(determinant > kFlat * lengths)) return ShapeError::not_positive;

  // As in lanes::tilted_shape: t = a3 / |a3|, what a1 and a2 leave of it turned by a quarter about it, and t turned to
  // z.
  double inv = 1 / std::sqrt(dot(a3, a3));
  double sign = a3.z < 0 ? -1 : 1;
  D3 t = {a3.x * inv, a3.y * inv * sign, a3.z * inv * sign};
  a13 = {a13.x, a13.y * sign, a13.z * sign};
  a23 = {a23.x, a23.y * sign, a23.z * sign};
  double lean1 = a13.z / (1 + t.z), lean2 = a23.z / (1 + t.z);
  double inv2 = inv * inv;
  double xx = (t.y * lean1 - a13.y) * inv2, xy = (t.y * lean2 - a23.y) * inv2;
  double yx = (a13.x - t.x * lean1) * inv2, yy = (a23.x - t.x * lean2) * inv2;
  double root = std::sqrt(determinant * inv) * inv;  // of |A| / |A n|^3

  double along_1 = std::sqrt(xx * xx + yx * yx), along_2 = std::sqrt(xy * xy + yy * yy);
  double leaning = std::fmax(std::fabs(dot(a1, a3)), std::fabs(dot(a2, a3))) * inv2;
  const double sizes[] = {root, along_1, along_2};
  for (double value : sizes)
    if (!(value >= kSmallest && value <= kLargest)) return ShapeError::out_of_range;
  if (!(leaning <= kLargest)) return ShapeError::out_of_range;
  shape = ShapeAccess::make(float(xx), float(xy), float(yx), float(yy), float(root), float(root),
                            float(dot(a1, a3) * inv2), float(dot(a2, a3) * inv2));
  return ShapeError::none;
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
      return "the ellipsoid is too flat, too long or too skewed: reduced to A n = n, its matrix leaves 2^-40 to 2^40";
  }
  return "not an error of this library";
}

}  // namespace vndf
