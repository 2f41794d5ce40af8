// All light, for next event estimation: the sky, triangles and spheres; sampled, and the density of that.
#pragma once

#include "scene.h"

namespace wavefront {

struct LightSample {
  Vec3 wi{0.f};
  float distance = 0.f;  // infinite for the sky
  Vec3 radiance{0.f};
  float pdf = 0.f;  // over solid angle; 0: no light
};
void list_lights(Scene& scene);
/// `u` chooses the point, `disk` is the point of the unit disk that it maps to, `select` chooses the light.
LightSample sample_light(const Scene& scene, Vec3 from, Vec2 u, Vec2 disk, float select);

/// The density that sample_light has for the direction in which a ray from `from` met `position` of a primitive.
float light_pdf(const Scene& scene, Primitive primitive, Vec3 from, Vec3 position);
/// What a ray that meets nothing finds, and the density that sample_light has for it.
LightSample sky_at(const Scene& scene, Vec3 direction);

/// Veach's power heuristic. Densities are at most 2^60, so squares are finite.
inline float mis_weight(float pdf, float other) {
  return pdf * pdf / (pdf * pdf + other * other);
}

}  // namespace wavefront
