// The scene that is made by code: an engine-turned metal disc under an evening sky, with arcs of spheres over roughness
// and anisotropy, a knot, rough glass, and a panel of light.
#include <ImathVec.h>

#include "environment.h"

namespace wavefront {
namespace {

constexpr double kTurn = 6.283185307179586;

/// Rounded to 2^-16: the last bits of sines differ between machines.
float rounded(double a) {
  return static_cast<float>(std::floor(a * 65536 + 0.5) / 65536);
}
Vec3 rounded(const Imath::V3d& p) {
  return {rounded(p.x), rounded(p.y), rounded(p.z)};
}

int add(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  return static_cast<int>(scene.materials.size()) - 1;
}
void add(Scene& scene, Sphere sphere, int material) {
  scene.spheres.push_back(sphere);
  scene.materials_of_spheres.push_back(material);
}
void add(Scene& scene, const Corner& a, const Corner& b, const Corner& c, int material) {
  scene.triangles.push_back({{a, b, c}});
  scene.materials_of_triangles.push_back(material);
}
void add_quad(Scene& scene, Vec3 corner, Vec3 u, Vec3 v, int material) {
  Vec3 n = normalize(cross(u, v));
  Corner a{corner, n, {0.f, 0.f}}, b{corner + u, n, {1.f, 0.f}}, c{corner + u + v, n, {1.f, 1.f}},
      d{corner + v, n, {0.f, 1.f}};
  add(scene, a, b, c, material);
  add(scene, a, c, d, material);
}

struct Metal {
  Vec3 n, k;  // at about 630, 532 and 465 nm, rounded
};
constexpr Metal kGold{{0.19f, 0.54f, 1.33f}, {3.0f, 2.23f, 1.87f}}, kSilver{{0.16f, 0.14f, 0.13f}, {4.0f, 3.3f, 2.4f}},
    kCopper{{0.21f, 0.95f, 1.2f}, {3.6f, 2.6f, 2.4f}}, kSteel{{2.9f, 2.6f, 2.3f}, {3.3f, 3.1f, 2.9f}};

Material conductor(Metal metal, float alpha_x, float alpha_y) {
  Material m;
  m.kind = Kind::conductor;
  m.n = metal.n, m.k = metal.k;
  m.alpha_x = alpha_x, m.alpha_y = alpha_y;
  return m;
}

/// A surface over a grid of u and v that closes on itself, with normals by differences.
template <class Point>
void add_closed_surface(Scene& scene, int us, int vs, int material, Point point) {
  auto corner = [&](int i, int j) {
    double u = double(i) / us, v = double(j) / vs, h = 1e-4;
    Imath::V3d along_u = point(u + h, v) - point(u - h, v), along_v = point(u, v + h) - point(u, v - h);
    return Corner{
        rounded(point(u, v)), normalize(rounded((along_v % along_u).normalized())), {rounded(8 * u), rounded(v)}};
  };
  for (int i = 0; i < us; ++i)
    for (int j = 0; j < vs; ++j) {
      Corner a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), d = corner(i, j + 1);
      add(scene, a, b, c, material);
      add(scene, a, c, d, material);
    }
}

/// A trefoil knot that stands upright: a tube of radius `tube` about (sin t + 2 sin 2t, cos t - 2 cos 2t, -sin 3t).
void add_knot(Scene& scene, Imath::V3d middle, double size, double tube, int material) {
  using Imath::V3d;
  auto line = [](double t) {
    return V3d(std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t), -std::sin(3 * t));
  };
  add_closed_surface(scene, 400, 48, material, [&](double u, double v) {
    double t = kTurn * u, h = 1e-3;
    V3d p = line(t), ahead = (line(t + h) - line(t - h)).normalized();
    V3d side = (ahead % V3d(p.x, p.y, 0.3)).normalized(), up = side % ahead;
    V3d round = std::cos(kTurn * v) * side + std::sin(kTurn * v) * up;
    return middle + size * (p + tube * round);
  });
}

/// Rings of overlapping swirls, as engine turning leaves them: the angle of the brush, in turns, seen from above.
Texture engine_turned(int size, double rings) {
  Texture t;
  t.width = t.height = size;
  t.texels.assign(static_cast<std::size_t>(size) * size, {});
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      double px = 2.0 * (x + 0.5) / size - 1, py = 1 - 2.0 * (y + 0.5) / size;
      double r = std::sqrt(px * px + py * py), ring = std::floor(r * rings);
      // Of the swirls of this ring and the one within, the one that was cut last.
      double angle = 0;
      for (double on = ring + 1; on >= ring - 1 && on >= 0; --on) {
        double middle = (on + 0.5) / rings, count = std::floor(kTurn * (on + 0.5) / 0.8) + 1;
        double at = std::floor(std::atan2(py, px) / kTurn * count + 0.5 + 0.35) / count * kTurn;
        double dx = px - middle * std::cos(at), dy = py - middle * std::sin(at);
        if (dx * dx + dy * dy > 0.64 / (rings * rings)) continue;
        angle = std::atan2(dy, dx) / kTurn + 0.25;
        break;
      }
      float a = rounded(-angle);  // theta_z turns alpha_x towards -y
      t.texels[static_cast<std::size_t>(y) * size + x] = {a, a, a};
    }
  return t;
}

/// Late afternoon: warm about the sun and along the horizon, blue above, dim earth below.
Environment evening() {
  Vec3 sun = normalize({-0.60f, 0.36f, -0.58f});
  // Behind haze: 12 degrees in radius.
  const float sun_cos = 1.f - 0x1.8p-6f;
  const Vec3 sun_radiance = 1.f / (2.f * kPi * (1.f - sun_cos)) * Vec3{3.0f, 1.9f, 1.0f};
  return make_environment(256, [&](Vec3 d) {
    float up = std::max(0.f, d.y), c = std::max(0.f, dot(d, sun));
    float c2 = c * c, c8 = c2 * c2 * c2 * c2, c64 = c8 * c8 * c8 * c8 * c8 * c8 * c8 * c8;
    float haze = 1.f / (1.f + 7.f * up), low = haze * haze;
    Vec3 sky = (1.f - haze) * Vec3{0.06f, 0.15f, 0.42f} + haze * Vec3{0.22f, 0.30f, 0.42f} +
               (0.6f * low) * ((0.15f + 0.85f * c2) * Vec3{1.0f, 0.52f, 0.22f});
    sky = sky + (0.5f * c8) * Vec3{1.0f, 0.62f, 0.30f} + (1.6f * c64) * Vec3{1.0f, 0.75f, 0.45f};
    if (dot(d, sun) >= sun_cos) sky = sky + sun_radiance;
    if (d.y >= 0.f) return sky;
    return Vec3{0.16f, 0.13f, 0.11f} + std::max(0.f, 1.f + 12.f * d.y) * (sky - Vec3{0.16f, 0.13f, 0.11f});
  });
}

}  // namespace

Scene default_scene() {
  Scene scene;
  scene.environment = evening();

  // The floor, and the disc on it.
  Material stone;  // polished
  stone.kind = Kind::plastic;
  stone.color = {0.035f, 0.042f, 0.055f};
  stone.alpha_x = stone.alpha_y = 0.18f;
  add_quad(scene, {-40.f, 0.f, 40.f}, {80.f, 0.f, 0.f}, {0.f, 0.f, -80.f}, add(scene, stone));
  scene.textures.push_back(engine_turned(1024, 11));
  Material turned = conductor(kSteel, 0.12f, 0.34f);
  turned.kind = Kind::brushed;
  turned.angle_map = 0;
  Material rim = conductor(kGold, 0.12f, 0.12f);
  int disc = add(scene, turned), edge = add(scene, rim);
  const double radius = 5.2, height = 0.15;
  constexpr int kSides = 256;
  for (int i = 0; i < kSides; ++i) {
    auto on_rim = [&](int at, double y, bool top) {
      double c = std::cos(kTurn * at / kSides), s = std::sin(kTurn * at / kSides);
      return Corner{rounded({radius * c, y, -radius * s}),
                    top ? Vec3{0.f, 1.f, 0.f} : normalize(rounded({c, 0, -s})),
                    {rounded(0.5 + 0.5 * c), rounded(0.5 + 0.5 * s)}};
    };
    Corner middle{rounded({0, height, 0}), {0.f, 1.f, 0.f}, {0.5f, 0.5f}};
    add(scene, middle, on_rim(i, height, true), on_rim(i + 1, height, true), disc);
    Corner a = on_rim(i, 0, false), b = on_rim(i + 1, 0, false), c = on_rim(i + 1, height, false),
           d = on_rim(i, height, false);
    add(scene, a, b, c, edge);
    add(scene, a, c, d, edge);
  }

  // Arcs of spheres: roughness grows from left to right, anisotropy from the front arc to the one behind.
  const Metal metals[] = {kCopper, kSilver, kGold};
  for (int arc = 0; arc < 3; ++arc)
    for (int i = 0; i < 7 + 2 * arc; ++i) {
      double share = (i + 0.5) / (7 + 2 * arc), angle = kTurn * (0.5 - 0.5 * share);
      double away = 2.75 + 0.85 * arc, r = 0.30;
      float alpha = rounded(0.08 + 0.5 * share * share), aspect = 1.f + 2.f * static_cast<float>(arc);
      int material =
          add(scene, conductor(metals[arc], std::min(1.f, alpha * std::sqrt(aspect)), alpha / std::sqrt(aspect)));
      add(scene, {rounded({away * std::cos(angle), height + r, -away * std::sin(angle)}), rounded(r)}, material);
    }

  add_knot(scene, {0, height + 1.22, -0.5}, 0.37, 0.66, add(scene, conductor(kGold, 0.16f, 0.16f)));

  Material glass;
  glass.kind = Kind::dielectric;
  glass.alpha_x = glass.alpha_y = 0.10f;
  glass.color = {0.93f, 0.98f, 0.96f};
  add(scene, {rounded({-2.15, height + 0.72, 1.35}), rounded(0.72)}, add(scene, glass));
  glass.alpha_x = glass.alpha_y = 0.22f;
  glass.color = {0.98f, 0.80f, 0.55f};
  add(scene, {rounded({-0.55, height + 0.42, 2.35}), rounded(0.42)}, add(scene, glass));

  Material lacquer;
  lacquer.kind = Kind::plastic;
  lacquer.color = {0.42f, 0.03f, 0.035f};
  lacquer.alpha_x = lacquer.alpha_y = 0.08f;
  add(scene, {rounded({2.05, height + 0.70, 1.45}), rounded(0.70)}, add(scene, lacquer));
  Material shingles = conductor(kSteel, 0.12f, 0.30f);
  shingles.kind = Kind::leaning;
  shingles.theta_x = 0.35f, shingles.theta_y = -0.25f, shingles.theta_z = 0.6f;
  add(scene, {rounded({0.75, height + 0.45, 2.4}), rounded(0.45)}, add(scene, shingles));

  Material panel;
  panel.color = {0.f, 0.f, 0.f};
  panel.emission = {3.2f, 3.4f, 3.7f};
  add_quad(scene, {3.2f, 4.8f, 6.f}, {4.f, 0.9f, -4.8f}, {-1.8f, 3.3f, 0.9f}, add(scene, panel));

  scene.camera.from = {0.f, 5.0f, 11.0f};
  scene.camera.at = {0.f, 0.62f, 0.15f};
  scene.camera.fov = 37.f;
  return scene;
}

}  // namespace wavefront
