// Imath's vectors, and the few things that a renderer does with them besides. Only + - * / and square roots: the same
// bits on every machine, as those of the library.
#pragma once

#include <ImathVec.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace wavefront {

using Vec2 = Imath::V2f;
using Vec3 = Imath::V3f;
constexpr float kPi = 3.14159265f, kInfinity = std::numeric_limits<float>::infinity();
constexpr double kTurn = 6.283185307179586;

/// A multiple of a power of two: the last bits of sines and the like differ between machines.
inline float rounded(double a, double unit = 0x1p-16) {
  return static_cast<float>(std::floor(a / unit + 0.5) * unit);
}
inline Vec3 rounded(const Imath::V3d& a) {
  return {rounded(a.x), rounded(a.y), rounded(a.z)};
}

inline Vec3 normalize(Vec3 a) {
  return (1.f / a.length()) * a;
}
inline float largest(Vec3 a) {
  return std::max(a.x, std::max(a.y, a.z));
}
inline float luminance(Vec3 a) {
  return 0.2126f * a.x + 0.7152f * a.y + 0.0722f * a.z;
}

/// Axes of a shading frame in the world.
struct Frame {
  Vec3 x, y, z;

  Vec3 to_local(Vec3 v) const { return {x.dot(v), y.dot(v), z.dot(v)}; }
  Vec3 to_world(Vec3 v) const { return (v.x * x + v.y * y) + v.z * z; }
};
/// z is the normal; x is the part of the tangent at right angles to it, or any such direction where there is none.
inline Frame frame_of(Vec3 normal, Vec3 tangent) {
  Vec3 x = tangent - tangent.dot(normal) * normal;
  if (!(x.dot(x) > 1e-10f * tangent.dot(tangent)))
    x = std::abs(normal.x) < 0.6f ? Vec3(1.f, 0.f, 0.f).cross(normal) : Vec3(0.f, 1.f, 0.f).cross(normal);
  x = (1.f / std::sqrt(x.dot(x))) * x;
  return {x, normal.cross(x), normal};
}

}  // namespace wavefront
