// Rays against the scene. Embree says which primitive a ray meets; where, is computed here from the ray and the
// primitive alone, so that of Embree's arithmetic, which differs between its instruction sets, nothing but the choice
// is kept.
#pragma once

#include "scene.h"

namespace wavefront {

/// `device` is Embree's configuration.
void build_tree(Scene& scene, const std::string& device);
Primitive intersect(const Scene& scene, Vec3 origin, Vec3 direction);
bool occluded(const Scene& scene, Vec3 origin, Vec3 direction, float distance);

struct Surface {
  Vec3 position, normal;         // the geometric one, to the outside
  Vec3 shading_normal, tangent;  // tangent: along u, of any length
  Vec2 uv;
};
Surface surface_at(const Scene& scene, Primitive primitive, Vec3 origin, Vec3 direction);

}  // namespace wavefront
