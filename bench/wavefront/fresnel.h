// Fresnel's factor for what reflects: conductors, and the coat of plastic.
#pragma once

#include "vec.h"

namespace wavefront {

/// Unpolarised light on a conductor of index n + i k, exactly: Born and Wolf, 14.2.
inline float conductor_fresnel(float cos, float n, float k) {
  float c2 = cos * cos, s2 = 1.f - c2, n2 = n * n, k2 = k * k;
  float difference = n2 - k2 - s2;
  float root = std::sqrt(difference * difference + 4.f * n2 * k2);  // a^2 + b^2
  float twice_a_cos = 2.f * cos * std::sqrt(std::max(0.f, 0.5f * (root + difference)));
  float rs = (root + c2 - twice_a_cos) / (root + c2 + twice_a_cos);
  float far = c2 * root + s2 * s2, near = twice_a_cos * s2;
  return 0.5f * rs * (1.f + (far - near) / (far + near));
}
inline Vec3 conductor_fresnel(float cos, Vec3 n, Vec3 k) {
  return {conductor_fresnel(cos, n.x, k.x), conductor_fresnel(cos, n.y, k.y), conductor_fresnel(cos, n.z, k.z)};
}

/// From outside, eta > 1.
inline float dielectric_fresnel(float cos, float eta) {
  float g = std::sqrt(std::max(0.f, eta * eta - 1.f + cos * cos));
  float rs = (cos - g) / (cos + g), rp = (eta * eta * cos - g) / (eta * eta * cos + g);
  return 0.5f * (rs * rs + rp * rp);
}

}  // namespace wavefront
