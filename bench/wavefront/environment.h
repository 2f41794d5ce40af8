// Light from far away: looked up, sampled, and the density that sampling has.
#pragma once

#include "scene.h"

namespace wavefront {

struct LightSample {
  Vec3 wi;
  float distance;  // infinite for the sky
  Vec3 radiance;
  float pdf;  // over solid angle; 0: no light
};

/// Plain octahedral map, [0, 1]^2 to unit directions and back. `stretch` is the solid angle of a piece of the square
/// over its area in [-1, 1]^2: 1 / |p|^3, with p the point on the octahedron.
Vec3 octahedral_direction(Vec2 square, float& stretch);
Vec2 octahedral_square(Vec3 direction, float& stretch);

/// Fills the cumulative weights of the texels.
void prepare(Environment& environment);
Environment environment_of_latlong(const Texture& map);

/// Radiance from a direction, and the density of sample_sky.
struct Sky {
  Vec3 radiance;
  float pdf;
};
Sky sky_at(const Environment& environment, Vec3 direction);
LightSample sample_sky(const Environment& environment, Vec2 u);

/// A direction in the cone about z, evenly over its solid angle.
inline Vec3 in_cone(Vec2 disk, float one_minus_cos) {
  float r2 = disk.x * disk.x + disk.y * disk.y;
  float z = 1.f - r2 * one_minus_cos;
  float s = std::sqrt(one_minus_cos * (1.f + z));
  return {disk.x * s, disk.y * s, z};
}

template <class Radiance>
Environment make_environment(int size, Radiance radiance) {
  Environment environment;
  environment.size = size;
  environment.texels.resize(static_cast<std::size_t>(size) * size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      float stretch;
      environment.texels[static_cast<std::size_t>(y) * size + x].radiance =
          radiance(octahedral_direction({(x + 0.5f) / size, (y + 0.5f) / size}, stretch));
    }
  prepare(environment);
  return environment;
}

}  // namespace wavefront
