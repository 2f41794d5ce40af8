#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <numeric>

#include <tbb/task_arena.h>

#include "scene.h"

namespace wavefront {
namespace {

#if RTC_VERSION_MAJOR < 4  // which has a default for them
struct Context : RTCIntersectContext {
  Context() { rtcInitIntersectContext(this); }
};
void rtcIntersect1(RTCScene tree, RTCRayHit* hit) {
  Context context;
  ::rtcIntersect1(tree, &context, hit);
}
void rtcOccluded1(RTCScene tree, RTCRay* ray) {
  Context context;
  ::rtcOccluded1(tree, &context, ray);
}
#endif

RTCRay ray_of(Vec3 o, Vec3 d, float distance) {
  return {o.x, o.y, o.z, 0.f, d.x, d.y, d.z, 0.f, distance, ~0u, 0, 0};
}

Surface hit_at(const Triangle& triangle, Vec3 origin, Vec3 direction) {
  // Moeller and Trumbore 1997. Barycentric coordinates are clamped: Embree's may have been inside where these are not.
  const Corner *a = &triangle.corners[0], *b = a + 1, *c = a + 2;
  Vec3 ab = triangle.edge(1), ac = triangle.edge(2), p = direction.cross(ac), way = origin - a->position;
  float determinant = ab.dot(p), inv = determinant != 0.f ? 1.f / determinant : 0.f;
  float v = std::max(0.f, std::min(way.dot(p) * inv, 1.f));
  float w = std::max(0.f, std::min(direction.dot(way.cross(ab)) * inv, 1.f - v));
  auto mixed = [&](auto at) { return at(*a) + v * (at(*b) - at(*a)) + w * (at(*c) - at(*a)); };
  Vec3 normal = normalize(ab.cross(ac)), smooth = mixed([](const Corner&corner) { return corner.normal; });
  smooth = smooth.dot(smooth) > 1e-20f ? normalize(smooth) : normal;
  if (smooth.dot(normal) < 0.f) normal = -normal;  // the normals say which side is outside, not the winding
  Vec2 uv1 = b->uv - a->uv, uv2 = c->uv - a->uv;
  Vec3 along_u = std::copysign(1.f, uv1.cross(uv2)) * (uv2.y * ab - uv1.y * ac);
  Vec2 uv = mixed([](const Corner& corner) { return corner.uv; });
  return {a->position + v * ab + w * ac, normal, smooth, along_u, uv};
}

Surface hit_at(const Sphere& sphere, Vec3 origin, Vec3 direction) {
  // The nearest root in front of the ray, from the point of the ray that is nearest to the middle.
  Vec3 way = sphere.center - origin;
  float along = way.dot(direction);
  Vec3 off = along * direction - way;
  float half = std::sqrt(std::max(0.f, sphere.radius * sphere.radius - off.dot(off)));
  float inside = way.dot(way) - sphere.radius * sphere.radius;
  Vec3 normal = normalize(off + (inside < 0.f || along - half < 0.f ? half : -half) * direction);
  return {sphere.center + sphere.radius * normal, normal, normal, {normal.z, 0.f, -normal.x}, Vec2(0.f)};
}

}  // namespace

void build_tree(Scene& scene, const std::string& configuration) {
  std::shared_ptr<RTCDeviceTy> device(rtcNewDevice(configuration.c_str()), rtcReleaseDevice);
  if (!device) fail(configuration, "Embree does not accept this configuration");
  scene.tree.reset(rtcNewScene(device.get()), [device](RTCScene tree) { rtcReleaseScene(tree); });
  rtcSetSceneFlags(scene.tree.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene.tree.get(), RTC_BUILD_QUALITY_HIGH);
  RTCGeometry triangles = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  std::size_t corners = 3 * scene.triangles.size();
  auto* indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, scene.triangles.size()));
  std::iota(indices, indices + corners, 0u);
  auto* positions =
      static_cast<Vec3*>(rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, corners));
  for (const Triangle& t : scene.triangles)
    for (const Corner& corner : t.corners) *positions++ = corner.position;
  RTCGeometry spheres = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_SPHERE_POINT);
  auto* balls = static_cast<Imath::V4f*>(
      rtcSetNewGeometryBuffer(spheres, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, scene.spheres.size()));
  for (const auto& [center, radius, material] : scene.spheres) *balls++ = {center.x, center.y, center.z, radius};
  for (RTCGeometry geometry : {triangles, spheres}) {  // they get the numbers 0 and 1
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.tree.get(), geometry);
    rtcReleaseGeometry(geometry);
  }
  // By one thread: the tree, and with it which of two triangles a ray through their edge meets, must not depend on how
  // many there are.
  tbb::task_arena(1).execute([&] { rtcCommitScene(scene.tree.get()); });
  RTCBounds box;
  rtcGetSceneBounds(scene.tree.get(), &box);
  scene.epsilon =
      0x1p-17f * Vec3(box.upper_x - box.lower_x, box.upper_y - box.lower_y, box.upper_z - box.lower_z).length();
}

Primitive intersect(const Scene& scene, Vec3 origin, Vec3 direction) {
  RTCRayHit hit{ray_of(origin, direction, kInfinity), {}};
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene.tree.get(), &hit);
  if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return kNothing;
  return hit.hit.primID + (hit.hit.geomID == 1 ? static_cast<Primitive>(scene.triangles.size()) : 0u);
}

bool occluded(const Scene& scene, Vec3 origin, Vec3 direction, float distance) {
  RTCRay ray = ray_of(origin, direction, distance);
  rtcOccluded1(scene.tree.get(), &ray);
  return ray.tfar < 0.f;
}

Surface surface_at(const Scene& scene, Primitive primitive, Vec3 origin, Vec3 direction) {
  return scene.of_shape(primitive, [&](const auto& shape) { return hit_at(shape, origin, direction); });
}

}  // namespace wavefront
