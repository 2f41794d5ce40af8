// The vector of the tests and the benchmarks, in any arithmetic.
#pragma once

#include "reference/quad.h"

namespace vndf::reference {

template <class R>
struct Vec3 {
  R x, y, z;
};
template <class R>
Vec3<R> operator+(const Vec3<R>& a, const Vec3<R>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class R>
Vec3<R> operator-(const Vec3<R>& a, const Vec3<R>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class R>
Vec3<R> operator*(R s, const Vec3<R>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class R>
R dot(const Vec3<R>& a, const Vec3<R>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class R>
Vec3<R> cross(const Vec3<R>& a, const Vec3<R>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class R>
R length(const Vec3<R>& a) {
  return square_root(dot(a, a));
}
template <class R>
R distance(const Vec3<R>& a, const Vec3<R>& b) {
  return length(a - b);
}
template <class R>
Vec3<R> unit(const Vec3<R>& a) {
  return (1 / length(a)) * a;
}

}  // namespace vndf::reference
