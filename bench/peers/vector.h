// Three components and the operations that the papers' listings use, over any floating type.
#pragma once

#include <cmath>
#include <cstddef>

namespace peers {
namespace {

template <class T>
constexpr T kPi = T(3.14159265358979323846264338327950288L);

template <class T>
struct Vec3 {
  T x, y, z;
};
template <class T>
Vec3<T> operator+(Vec3<T> a, Vec3<T> b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
Vec3<T> operator*(T s, Vec3<T> a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
T dot(Vec3<T> a, Vec3<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
Vec3<T> cross(Vec3<T> a, Vec3<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
Vec3<T> normalize(Vec3<T> a) {
  return (T(1) / std::sqrt(dot(a, a))) * a;
}

/// z of the stretched view as the float peer has it. Where a published routine jumps from one parameterisation to
/// another, its oracle has to jump at the same inputs: a sample on the other side is a valid one, not a rounding error.
template <class T>
float float_stretched_z(Vec3<T> wo, T alpha_x, T alpha_y) {
  return normalize(Vec3<float>{float(alpha_x) * float(wo.x), float(alpha_y) * float(wo.y), float(wo.z)}).z;
}

/// Runs one sampling routine, normal(wo, alpha_x, alpha_y, u1, u2), over columns. T = float makes the peer and
/// T = long double its oracle.
template <class T, Vec3<T> normal(Vec3<T>, T, T, T, T)>
void sample_columns(std::size_t count, const float* const in[7], T* const out[3]) {
  for (std::size_t i = 0; i < count; ++i) {
    Vec3<T> wm = normal({T(in[0][i]), T(in[1][i]), T(in[2][i])}, T(in[3][i]), T(in[4][i]), T(in[5][i]), T(in[6][i]));
    out[0][i] = wm.x;
    out[1][i] = wm.y;
    out[2][i] = wm.z;
  }
}

}  // namespace
}  // namespace peers
