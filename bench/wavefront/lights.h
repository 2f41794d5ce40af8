// The scene's light, for next event estimation: which light, where on it, and the density that it is found with.
#pragma once

#include "environment.h"

namespace wavefront {

/// `u.x` and `u.y` choose the point, `disk` is the point of the unit disk that they map to, `select` chooses the light.
LightSample sample_light(const Scene& scene, Vec3 from, Vec2 u, Vec2 disk, float select);

/// The density that sample_light has for the direction in which a ray from `from` met `position` of a primitive.
float light_pdf(const Scene& scene, Primitive primitive, Vec3 from, Vec3 position, Vec3 normal);
/// Radiance of a ray that met nothing, times the weight of multiple importance sampling.
Vec3 escaped_light(const Scene& scene, Vec3 direction, float bsdf_pdf, bool mis);

/// Veach's power heuristic. Densities are at most 2^60, so squares are finite.
inline float mis_weight(float pdf, float other) {
  return pdf * pdf / (pdf * pdf + other * other);
}

}  // namespace wavefront
