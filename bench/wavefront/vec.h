// Three floats, and the few things that the renderer does with them. Only + - * / and square roots: the same bits on
// every machine, as those of the library.
#pragma once

#include <algorithm>
#include <cmath>

namespace wavefront {

constexpr float kPi = 3.14159265f;

struct Vec2 {
  float x, y;
};
struct Vec3 {
  float x, y, z;
};
inline Vec3 operator+(Vec3 a, Vec3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3 operator-(Vec3 a, Vec3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3 operator*(Vec3 a, Vec3 b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline Vec3 operator*(float s, Vec3 a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline float dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(Vec3 a) {
  return std::sqrt(dot(a, a));
}
inline Vec3 normalize(Vec3 a) {
  return (1.f / length(a)) * a;
}
inline float largest(Vec3 a) {
  return std::max(a.x, std::max(a.y, a.z));
}
inline float luminance(Vec3 a) {
  return 0.2126f * a.x + 0.7152f * a.y + 0.0722f * a.z;
}
inline bool is_zero(Vec3 a) {
  return a.x == 0.f && a.y == 0.f && a.z == 0.f;
}
inline bool is_finite(Vec3 a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// Axes of a shading frame in the world.
struct Frame {
  Vec3 x, y, z;
};
/// z is the normal; x is the part of the tangent at right angles to it, or any such direction where there is none.
inline Frame frame_of(Vec3 normal, Vec3 tangent) {
  Vec3 x = tangent - dot(tangent, normal) * normal;
  float x2 = dot(x, x);
  if (!(x2 > 1e-10f)) {
    x = std::abs(normal.x) < 0.6f ? cross({1.f, 0.f, 0.f}, normal) : cross({0.f, 1.f, 0.f}, normal);
    x2 = dot(x, x);
  }
  x = (1.f / std::sqrt(x2)) * x;
  return {x, cross(normal, x), normal};
}
inline Vec3 to_local(const Frame& frame, Vec3 v) {
  return {dot(frame.x, v), dot(frame.y, v), dot(frame.z, v)};
}
inline Vec3 to_world(const Frame& frame, Vec3 v) {
  return (v.x * frame.x + v.y * frame.y) + v.z * frame.z;
}

}  // namespace wavefront
