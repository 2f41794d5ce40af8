#include "lights.h"

namespace wavefront {
namespace {

/// The sky and what is in the scene have the same chance, where there are both.
float share_of_sky(const Scene& scene) {
  return scene.environment.size == 0 ? 0.f : scene.lights.empty() ? 1.f : 0.5f;
}

float area_to_angle(Vec3 from, Vec3 position, Vec3 normal, float area) {
  Vec3 way = position - from;
  float d2 = dot(way, way);
  return std::min(0x1p60f, d2 * std::sqrt(d2) / (std::abs(dot(way, normal)) * area + 1e-20f));
}
/// 1 - cos of the cone that a sphere fills, without cancellation.
float one_minus_cos(const Sphere& sphere, Vec3 from) {
  Vec3 way = sphere.center - from;
  float sin2 = std::min(1.f, sphere.radius * sphere.radius / dot(way, way));
  return sin2 / (1.f + std::sqrt(1.f - sin2));
}

LightSample sample_triangle(const Triangle& triangle, Vec3 from, Vec2 u) {
  const Corner* c = triangle.corners;
  float s = std::sqrt(u.x);
  Vec3 p = (1.f - s) * c[0].position + (s * (1.f - u.y)) * c[1].position + (s * u.y) * c[2].position;
  Vec3 twice = cross(c[1].position - c[0].position, c[2].position - c[0].position);
  float size = length(twice);
  Vec3 way = p - from;
  float distance = length(way);
  return {(1.f / distance) * way, distance, {}, area_to_angle(from, p, (1.f / size) * twice, 0.5f * size)};
}
LightSample sample_sphere(const Sphere& sphere, Vec3 from, Vec2 disk) {
  Vec3 way = sphere.center - from;
  float d = length(way), cone = one_minus_cos(sphere, from);
  Vec3 wi = to_world(frame_of((1.f / d) * way, {0.f, 0.f, 0.f}), in_cone(disk, cone));
  float along = dot(way, wi);
  float off2 = dot(way, way) - along * along;
  float distance = along - std::sqrt(std::max(0.f, sphere.radius * sphere.radius - off2));
  return {wi, distance, {}, d > sphere.radius ? 1.f / (2.f * kPi * cone) : 0.f};
}

}  // namespace

LightSample sample_light(const Scene& scene, Vec3 from, Vec2 u, Vec2 disk, float select) {
  float sky = share_of_sky(scene);
  LightSample light{};
  if (select < sky) {
    light = sample_sky(scene.environment, u);
    light.pdf *= sky;
  } else if (!scene.lights.empty()) {
    float v = (select - sky) / (1.f - sky);
    auto found = std::upper_bound(scene.light_sums.begin(), scene.light_sums.end() - 1, v);
    Primitive primitive = scene.lights[static_cast<std::size_t>(found - scene.light_sums.begin())];
    std::size_t triangles = scene.triangles.size();
    light = primitive < triangles ? sample_triangle(scene.triangles[primitive], from, u)
                                  : sample_sphere(scene.spheres[primitive - triangles], from, disk);
    light.pdf *= (1.f - sky) * scene.light_share[primitive];
    light.radiance = scene.materials[scene.material_of(primitive)].emission;
  }
  return light;
}

float light_pdf(const Scene& scene, Primitive primitive, Vec3 from, Vec3 position, Vec3 normal) {
  float share = (1.f - share_of_sky(scene)) * scene.light_share[primitive];
  std::size_t triangles = scene.triangles.size();
  if (primitive >= triangles) {
    float cone = one_minus_cos(scene.spheres[primitive - triangles], from);
    return cone < 1.f ? share / (2.f * kPi * cone) : 0.f;
  }
  const Corner* c = scene.triangles[primitive].corners;
  float area = 0.5f * length(cross(c[1].position - c[0].position, c[2].position - c[0].position));
  return share * area_to_angle(from, position, normal, area);
}

Vec3 escaped_light(const Scene& scene, Vec3 direction, float bsdf_pdf, bool mis) {
  Sky sky = sky_at(scene.environment, direction);
  return (mis ? mis_weight(bsdf_pdf, share_of_sky(scene) * sky.pdf) : 1.f) * sky.radiance;
}

}  // namespace wavefront
