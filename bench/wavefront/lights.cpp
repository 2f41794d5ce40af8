#include <numeric>

#include "scene.h"

namespace wavefront {
namespace {

Weights weights_of(const std::vector<double>& given) {
  Weights weights{std::accumulate(given.begin(), given.end(), 0.), {}};
  double sum = 0.;
  for (double weight : given) weights.sums.push_back(static_cast<float>((sum += weight) / weights.total));
  return weights;
}
float chance(const Weights& weights, std::size_t i) {
  return weights.sums[i] - (i > 0 ? weights.sums[i - 1] : 0.f);
}
/// u in [0, 1) becomes its place within what is chosen, so that strata stay whole.
std::size_t choose(const Weights& weights, float& u) {
  const auto& sums = weights.sums;
  auto i = static_cast<std::size_t>(std::upper_bound(sums.begin(), sums.end() - 1, u) - sums.begin());
  u = std::max(0.f, std::min((u - (i > 0 ? sums[i - 1] : 0.f)) / chance(weights, i), 0.9999f));
  return i;
}

/// Of unit d: the point p of the octahedron is d over this, and a piece of the map is |p|^3 of its solid angle.
float sum(Vec3 d) {
  return std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
}
/// The octahedron's map on [-1, 1]^2 has its lower half in the corners, inside out.
Vec2 folded(Vec2 p, float z) {
  if (z >= 0.f) return p;
  return {std::copysign(1.f - std::abs(p.y), p.x), std::copysign(1.f - std::abs(p.x), p.y)};
}
/// Of column x and row y, counted in texels.
Vec3 direction_at(const Environment& e, float x, float y) {
  Vec2 map{2.f * (x / e.size) - 1.f, 2.f * (y / e.size) - 1.f};
  float z = 1.f - std::abs(map.x) - std::abs(map.y);
  Vec2 p = folded(map, z);
  return normalize({p.x, p.y, z});
}

/// The sky and what is in the scene have the same chance, where there are both.
float chance_of_sky(const Scene& scene) {
  return scene.environment.size == 0 ? 0.f : scene.lights.empty() ? 1.f : 0.5f;
}

/// Light of a texel from a direction in it.
LightSample sky(const Scene& scene, std::size_t x, std::size_t y, Vec3 wi) {
  const Environment& e = scene.environment;
  float texel = chance(e.columns[y], x) * chance(e.rows, y), size = 2.f / static_cast<float>(e.size);
  float angle = size * size * sum(wi) * sum(wi) * sum(wi);
  return {wi, kInfinity, e.texels[y * e.size + x], chance_of_sky(scene) * texel / angle};
}

// Triangles are sampled by their area, spheres by the solid angle of the cone that they fill.

float area(const Triangle& triangle) {
  return 0.5f * triangle.cross().length();
}
float angle_over_area(const Triangle& triangle, Vec3 from, Vec3 position) {
  Vec3 way = position - from;
  float d2 = way.dot(way);
  return std::abs(way.dot(normalize(triangle.cross()))) / (d2 * std::sqrt(d2));
}
LightSample sample(const Triangle& triangle, Vec3 from, Vec2 u, Vec2) {
  float s = std::sqrt(u.x);
  Vec3 way = triangle.corners[0].position + (s * (1.f - u.y)) * triangle.edge(1) + (s * u.y) * triangle.edge(2) - from;
  float distance = way.length();
  return {(1.f / distance) * way, distance};
}

/// Of the disk that is seen from far away.
float area(const Sphere& sphere) {
  return kPi * sphere.radius * sphere.radius;
}
/// 1 - cos of the cone, without cancellation.
float one_minus_cos(const Sphere& sphere, Vec3 from) {
  Vec3 way = sphere.center - from;
  float sin2 = std::min(1.f, sphere.radius * sphere.radius / way.dot(way));
  return sin2 / (1.f + std::sqrt(1.f - sin2));
}
float angle_over_area(const Sphere& sphere, Vec3 from, Vec3) {
  float cone = one_minus_cos(sphere, from);
  return cone < 1.f ? 2.f * kPi * cone / area(sphere) : kInfinity;  // none from within
}
LightSample sample(const Sphere& sphere, Vec3 from, Vec2, Vec2 disk) {
  Vec3 way = sphere.center - from;
  float cone = one_minus_cos(sphere, from), z = 1.f - disk.dot(disk) * cone, s = std::sqrt(cone * (1.f + z));
  Vec3 wi = frame_of(normalize(way), Vec3(0.f)).to_world({disk.x * s, disk.y * s, z});
  float along = way.dot(wi), off2 = way.dot(way) - along * along;
  return {wi, along - std::sqrt(std::max(0.f, sphere.radius * sphere.radius - off2))};
}

/// The density that sample_light has for the direction of a position on a primitive.
float light_pdf(const Scene& scene, Primitive primitive, Vec3 from, Vec3 position) {
  // A primitive is chosen by its light, which is luminance times area.
  float light = luminance(scene.material_of(primitive).emission) / static_cast<float>(scene.light.total);
  float angle = scene.of_shape(primitive, [&](const auto& shape) { return angle_over_area(shape, from, position); });
  return std::min(0x1p60f, (1.f - chance_of_sky(scene)) * light / (angle + 1e-20f));
}

}  // namespace

Environment make_environment(int size, const std::function<Vec3(Vec3)>& radiance) {
  Environment e;
  e.size = size;
  std::vector<double> of_rows, weights(static_cast<std::size_t>(size));
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      Vec3 d = direction_at(e, x + 0.5f, y + 0.5f);
      e.texels.push_back(radiance(d));
      // Dark texels keep a little: sampling must reach whatever has light.
      weights[x] = (luminance(e.texels.back()) + 1e-6) * sum(d) * sum(d) * sum(d);
    }
    e.columns.push_back(weights_of(weights));
    of_rows.push_back(e.columns.back().total);
  }
  e.rows = weights_of(of_rows);
  return e;
}

Environment environment_of_latlong(const Texture& map) {
  return make_environment(std::clamp(map.height, 64, 2048), [&](Vec3 d) {
    double u = 0.5 + std::atan2(double(d.x), double(-d.z)) / kTurn;
    double v = std::acos(std::clamp(double(d.y), -1.0, 1.0)) / (0.5 * kTurn);
    float x = rounded(u * map.width, 0x1p-12), y = rounded(v * map.height, 0x1p-12);
    return map.look_up({x / map.width, 1.f - std::clamp(y, 0.5f, map.height - 0.5f) / map.height});
  });
}

void list_lights(Scene& scene) {
  scene.lights.clear();
  std::vector<double> weights;
  for (Primitive p = 0; p < scene.triangles.size() + scene.spheres.size(); ++p) {
    float light = luminance(scene.material_of(p).emission);
    if (!(light > 0.f)) continue;
    scene.lights.push_back(p);
    weights.push_back(light * scene.of_shape(p, [](const auto& shape) { return area(shape); }));
  }
  scene.light = weights_of(weights);
}

LightSample sample_light(const Scene& scene, Vec3 from, Vec2 u, Vec2 disk, float select) {
  float of_sky = chance_of_sky(scene);
  if (select < of_sky) {
    const Environment& e = scene.environment;
    std::size_t y = choose(e.rows, u.y), x = choose(e.columns[y], u.x);
    return sky(scene, x, y, direction_at(e, x + u.x, y + u.y));
  }
  if (scene.lights.empty()) return {};
  float v = (select - of_sky) / (1.f - of_sky);
  Primitive primitive = scene.lights[choose(scene.light, v)];
  LightSample light = scene.of_shape(primitive, [&](const auto& shape) { return sample(shape, from, u, disk); });
  light.pdf = light_pdf(scene, primitive, from, from + light.distance * light.wi);
  light.radiance = scene.material_of(primitive).emission;
  return light;
}

LightSample light_met(const Scene& scene, Primitive primitive, Vec3 from, Vec3 d) {
  if (primitive != kNothing) {
    Vec3 position = surface_at(scene, primitive, from, d).position;
    return {d, 0.f, scene.material_of(primitive).emission, light_pdf(scene, primitive, from, position)};
  }
  const Environment& e = scene.environment;
  if (e.size == 0) return {};
  Vec2 p = folded({d.x / sum(d), d.y / sum(d)}, d.z);
  auto index = [&](float a) { return std::clamp(static_cast<int>((0.5f * a + 0.5f) * e.size), 0, e.size - 1); };
  return sky(scene, index(p.x), index(p.y), d);
}

}  // namespace wavefront
