#include "lights.h"

#include <limits>

namespace wavefront {
namespace {

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
  float texel = e.columns[y].chance(x) * e.rows.chance(y), size = 2.f / static_cast<float>(e.size);
  float angle = size * size * sum(wi) * sum(wi) * sum(wi);
  return {wi, std::numeric_limits<float>::infinity(), e.texels[y * e.size + x], chance_of_sky(scene) * texel / angle};
}

/// Solid angle over area.
float angle_over_area(const Triangle& triangle, Vec3 way) {
  float d2 = way.dot(way);
  return std::abs(way.dot(normalize(triangle.area()))) / (d2 * std::sqrt(d2));
}
LightSample sample_triangle(const Triangle& triangle, Vec3 from, Vec2 u) {
  float s = std::sqrt(u.x);
  Vec3 way = triangle.corners[0].position + (s * (1.f - u.y)) * triangle.edge(1) + (s * u.y) * triangle.edge(2) - from;
  float distance = way.length();
  return {(1.f / distance) * way, distance};
}

/// 1 - cos of the cone that a sphere fills, without cancellation.
float one_minus_cos(const Sphere& sphere, Vec3 from) {
  Vec3 way = sphere.center - from;
  float sin2 = std::min(1.f, sphere.radius * sphere.radius / way.dot(way));
  return sin2 / (1.f + std::sqrt(1.f - sin2));
}
/// Evenly over that cone.
LightSample sample_sphere(const Sphere& sphere, Vec3 from, Vec2 disk) {
  Vec3 way = sphere.center - from;
  float cone = one_minus_cos(sphere, from), z = 1.f - disk.dot(disk) * cone, s = std::sqrt(cone * (1.f + z));
  Vec3 wi = frame_of(normalize(way), Vec3(0.f)).to_world({disk.x * s, disk.y * s, z});
  float along = way.dot(wi), off2 = way.dot(way) - along * along;
  return {wi, along - std::sqrt(std::max(0.f, sphere.radius * sphere.radius - off2))};
}

}  // namespace

Choice::Choice(const std::vector<double>& weights) {
  double sum = 0., all = 0.;
  for (double weight : weights) all += weight;
  for (double weight : weights) sums_.push_back(static_cast<float>((sum += weight) / all));
}
std::size_t Choice::choose(float& u) const {
  auto i = static_cast<std::size_t>(std::upper_bound(sums_.begin(), sums_.end() - 1, u) - sums_.begin());
  u = std::max(0.f, std::min((u - (i > 0 ? sums_[i - 1] : 0.f)) / chance(i), 0.9999f));
  return i;
}

Environment make_environment(int size, const std::function<Vec3(Vec3)>& radiance) {
  Environment e;
  e.size = size;
  std::vector<double> of_rows, weights(static_cast<std::size_t>(size));
  for (int y = 0; y < size; ++y) {
    double row = 0.;
    for (int x = 0; x < size; ++x) {
      Vec3 d = direction_at(e, x + 0.5f, y + 0.5f);
      e.texels.push_back(radiance(d));
      // Dark texels keep a little: sampling must reach whatever has light.
      row += weights[x] = (luminance(e.texels.back()) + 1e-6) * sum(d) * sum(d) * sum(d);
    }
    e.columns.emplace_back(weights);
    of_rows.push_back(row);
  }
  e.rows = Choice(of_rows);
  return e;
}

Environment environment_of_latlong(const Texture& map) {
  // Coordinates are rounded to 1/4096 of a texel: the last bits of a machine's arc functions do not show.
  auto rounded = [](double a) { return static_cast<float>(std::floor(a * 4096 + 0.5) / 4096); };
  return make_environment(std::max(64, std::min(2048, map.height)), [&](Vec3 d) {
    double u = 0.5 + std::atan2(double(d.x), double(-d.z)) / (2 * 3.14159265358979);
    double v = std::acos(std::max(-1.0, std::min(1.0, double(d.y)))) / 3.14159265358979;
    float y = std::max(0.5f, std::min(rounded(v * map.height), map.height - 0.5f));
    return map.look_up({rounded(u * map.width) / map.width, 1.f - y / map.height});
  });
}

void list_lights(Scene& s) {
  s.lights.clear();
  std::vector<double> weights;
  double all = 0.;
  for (Primitive p = 0; p < s.triangles.size() + s.spheres.size(); ++p) {
    float light = luminance(s.material_of(p).emission);
    if (!(light > 0.f)) continue;
    bool flat = p < s.triangles.size();
    float r = flat ? 0.f : s.spheres[p - s.triangles.size()].radius;
    s.lights.push_back(p);
    weights.push_back(light * (flat ? s.triangles[p].area().length() : kPi * r * r));
    all += weights.back();
  }
  s.choice = Choice(weights);
  s.light = static_cast<float>(all);
}

LightSample sample_light(const Scene& scene, Vec3 from, Vec2 u, Vec2 disk, float select) {
  float of_sky = chance_of_sky(scene);
  if (select < of_sky) {
    const Environment& e = scene.environment;
    std::size_t y = e.rows.choose(u.y), x = e.columns[y].choose(u.x);
    return sky(scene, x, y, direction_at(e, x + u.x, y + u.y));
  }
  if (scene.lights.empty()) return {};
  float v = (select - of_sky) / (1.f - of_sky);
  Primitive primitive = scene.lights[scene.choice.choose(v)];
  std::size_t triangles = scene.triangles.size();
  LightSample light = primitive < triangles ? sample_triangle(scene.triangles[primitive], from, u)
                                            : sample_sphere(scene.spheres[primitive - triangles], from, disk);
  light.pdf = light_pdf(scene, primitive, from, from + light.distance * light.wi);
  light.radiance = scene.material_of(primitive).emission;
  return light;
}

float light_pdf(const Scene& scene, Primitive primitive, Vec3 from, Vec3 position) {
  // A primitive is chosen by its light, which is luminance times area, and within it all of the area alike.
  float density = (1.f - chance_of_sky(scene)) * luminance(scene.material_of(primitive).emission) / scene.light;
  std::size_t triangles = scene.triangles.size();
  if (primitive < triangles) {
    float angle = angle_over_area(scene.triangles[primitive], position - from);
    return std::min(0x1p60f, density / (angle + 1e-20f));
  }
  // Of spheres, all of the angle alike.
  const Sphere& sphere = scene.spheres[primitive - triangles];
  float cone = one_minus_cos(sphere, from);
  return cone < 1.f ? density * kPi * sphere.radius * sphere.radius / (2.f * kPi * cone) : 0.f;
}

LightSample sky_at(const Scene& scene, Vec3 d) {
  const Environment& e = scene.environment;
  if (e.size == 0) return {};
  Vec2 p = folded({d.x / sum(d), d.y / sum(d)}, d.z);
  auto index = [&](float a) { return std::max(0, std::min(static_cast<int>((0.5f * a + 0.5f) * e.size), e.size - 1)); };
  return sky(scene, index(p.x), index(p.y), d);
}

}  // namespace wavefront
