#include "intersect.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <limits>

namespace wavefront {
namespace {

RTCRay ray_of(Vec3 origin, Vec3 direction, float distance) {
  RTCRay ray{};
  ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
  ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
  ray.tfar = distance;
  ray.mask = ~0u;
  return ray;
}

Surface triangle_at(const Triangle& triangle, Vec3 tangent, Vec3 origin, Vec3 direction) {
  // Moeller and Trumbore 1997. Barycentric coordinates are clamped: Embree's may have been inside where these are not.
  const Corner *a = &triangle.corners[0], *b = a + 1, *c = a + 2;
  Vec3 ab = b->position - a->position, ac = c->position - a->position;
  Vec3 p = cross(direction, ac), way = origin - a->position;
  float determinant = dot(ab, p);
  float inv = determinant != 0.f ? 1.f / determinant : 0.f;
  float v = std::max(0.f, std::min(dot(way, p) * inv, 1.f));
  float w = std::max(0.f, std::min(dot(direction, cross(way, ab)) * inv, 1.f - v));
  Vec3 normal = normalize(cross(ab, ac));
  Vec3 smooth = a->normal + v * (b->normal - a->normal) + w * (c->normal - a->normal);
  float smooth2 = dot(smooth, smooth);
  smooth = smooth2 > 1e-20f ? (1.f / std::sqrt(smooth2)) * smooth : normal;
  if (dot(smooth, normal) < 0.f) normal = -1.f * normal;  // the normals say which side is outside, not the winding
  return {a->position + v * ab + w * ac,
          normal,
          smooth,
          tangent,
          {a->uv.x + v * (b->uv.x - a->uv.x) + w * (c->uv.x - a->uv.x),
           a->uv.y + v * (b->uv.y - a->uv.y) + w * (c->uv.y - a->uv.y)}};
}

Surface sphere_at(const Sphere& sphere, Vec3 origin, Vec3 direction) {
  // The nearest root in front of the ray, from the point of the ray that is nearest to the middle.
  Vec3 way = sphere.center - origin;
  float along = dot(way, direction);
  Vec3 off = along * direction - way;
  float half = std::sqrt(std::max(0.f, sphere.radius * sphere.radius - dot(off, off)));
  float inside = dot(way, way) - sphere.radius * sphere.radius;
  Vec3 normal = normalize(off + (inside < 0.f || along - half < 0.f ? half : -half) * direction);
  // Without an arc function, uv is the place on the octahedron.
  float inv = 1.f / (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z));
  return {sphere.center + sphere.radius * normal,
          normal,
          normal,
          {normal.z, 0.f, -normal.x},
          {0.5f + 0.5f * normal.x * inv, 0.5f + 0.5f * normal.y * inv}};
}

}  // namespace

Primitive intersect(const Scene& scene, Vec3 origin, Vec3 direction) {
  RTCRayHit hit{};
  hit.ray = ray_of(origin, direction, std::numeric_limits<float>::infinity());
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(scene.tree.get(), &hit, nullptr);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene.tree.get(), &context, &hit);
#endif
  if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return kNothing;
  return hit.hit.primID + (hit.hit.geomID == 1 ? static_cast<Primitive>(scene.triangles.size()) : 0u);
}

bool occluded(const Scene& scene, Vec3 origin, Vec3 direction, float distance) {
  RTCRay ray = ray_of(origin, direction, distance);
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded1(scene.tree.get(), &ray, nullptr);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene.tree.get(), &context, &ray);
#endif
  return ray.tfar < 0.f;
}

Surface surface_at(const Scene& scene, Primitive primitive, Vec3 origin, Vec3 direction) {
  std::size_t triangles = scene.triangles.size();
  return primitive < triangles ? triangle_at(scene.triangles[primitive], scene.tangents[primitive], origin, direction)
                               : sphere_at(scene.spheres[primitive - triangles], origin, direction);
}

}  // namespace wavefront
