// The scene that is made by code: an engine-turned metal disc under an evening sky, with arcs of spheres over roughness
// and anisotropy, a knot, rough glass, and a panel of light.
#include "scene.h"

namespace wavefront {
namespace {

using Imath::V3d;
constexpr double kHeight = 0.15;  // of the disc that things stand on

struct Index {
  Vec3 n, k;  // at about 630, 532 and 465 nm, rounded
};
const Index kGold{{0.19f, 0.54f, 1.33f}, {3.0f, 2.23f, 1.87f}}, kSilver{{0.16f, 0.14f, 0.13f}, {4.0f, 3.3f, 2.4f}},
    kCopper{{0.21f, 0.95f, 1.2f}, {3.6f, 2.6f, 2.4f}}, kSteel{{2.9f, 2.6f, 2.3f}, {3.3f, 3.1f, 2.9f}};

Material metal(const Index& index, float alpha_x, float alpha_y) {
  return {Kind::conductor, Vec3(0.f), alpha_x, alpha_y, index.n, index.k};
}

/// On the disc.
void add_sphere(Scene& scene, double x, double z, double radius, const Material& material) {
  V3d center(x, kHeight + radius, z);
  scene.spheres.push_back({rounded(center), rounded(radius), static_cast<int>(scene.materials.size())});
  scene.materials.push_back(material);
}
/// A surface of `us` by `vs` quadrangles, of the corners that corner(i, j) answers.
template <class At>
void add_surface(Scene& scene, int us, int vs, const Material& material, At corner) {
  const int number = static_cast<int>(scene.materials.size());
  scene.materials.push_back(material);
  for (int i = 0; i < us; ++i)
    for (int j = 0; j < vs; ++j) {
      Corner a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), d = corner(i, j + 1);
      for (const Triangle& t : {Triangle{{a, b, c}, number}, Triangle{{a, c, d}, number}})
        if (t.cross() != Vec3(0.f)) scene.triangles.push_back(t);
    }
}
void add_rectangle(Scene& scene, Vec3 corner, Vec3 u, Vec3 v, const Material& material) {
  Vec3 n = normalize(u.cross(v));
  add_surface(scene, 1, 1, material, [&](float i, float j) { return Corner{corner + i * u + j * v, n, {i, j}}; });
}

/// A round plate on the ground: its top has the one material, its rim the other.
void add_disc(Scene& scene, double radius, const Material& top, const Material& rim) {
  auto at = [&](int i, double r, double y, bool outward) {
    double c = std::cos(kTurn * i / 256), s = std::sin(kTurn * i / 256);
    Vec3 n = outward ? normalize(rounded({c, 0, -s})) : Vec3(0.f, 1.f, 0.f);
    return Corner{
        rounded({r * radius * c, y, -r * radius * s}), n, {rounded(0.5 + 0.5 * r * c), rounded(0.5 + 0.5 * r * s)}};
  };
  add_surface(scene, 256, 1, top, [&](int i, int j) { return at(i, j, kHeight, false); });
  add_surface(scene, 256, 1, rim, [&](int i, int j) { return at(i, 1, kHeight * j, true); });
}

/// A trefoil knot that stands upright: a tube of radius `tube` about (sin t + 2 sin 2t, cos t - 2 cos 2t, -sin 3t).
void add_knot(Scene& scene, V3d middle, double size, double tube, const Material& material) {
  auto line = [](double t) {
    return V3d(std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t), -std::sin(3 * t));
  };
  add_surface(scene, 400, 48, material, [&](int i, int j) {
    double u = i / 400.0, v = j / 48.0, t = kTurn * u, h = 1e-3;
    V3d p = line(t), ahead = (line(t + h) - line(t - h)).normalized();
    V3d side = (ahead % V3d(p.x, p.y, 0.3)).normalized(), up = side % ahead;
    V3d out = std::cos(kTurn * v) * side + std::sin(kTurn * v) * up;
    return Corner{rounded(middle + size * (p + tube * out)), normalize(rounded(out)), {rounded(8 * u), rounded(v)}};
  });
}

/// Rings of overlapping swirls, as engine turning leaves them: the angle of the brush, in turns, seen from above.
Texture engine_turned(int size, double rings) {
  Texture t{size, size, {}};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      double px = 2.0 * (x + 0.5) / size - 1, py = 1 - 2.0 * (y + 0.5) / size;
      double ring = std::floor(std::sqrt(px * px + py * py) * rings), angle = 0;
      // Of the swirls of this ring and the one within, the one that was cut last.
      for (double on = ring + 1; on >= ring - 1 && on >= 0; --on) {
        double middle = (on + 0.5) / rings, count = std::floor(kTurn * (on + 0.5) / 0.8) + 1;
        double at = std::floor(std::atan2(py, px) / kTurn * count + 0.5 + 0.35) / count * kTurn;
        double dx = px - middle * std::cos(at), dy = py - middle * std::sin(at);
        if (dx * dx + dy * dy > 0.64 / (rings * rings)) continue;
        angle = std::atan2(dy, dx) / kTurn + 0.25;
        break;
      }
      t.texels.push_back(Vec3(rounded(-angle)));  // theta_z turns alpha_x towards -y
    }
  return t;
}

}  // namespace

/// Late afternoon: warm about the sun and along the horizon, blue above, dim earth below.
Environment evening() {
  const Vec3 sun = normalize({-0.60f, 0.36f, -0.58f}), earth(0.16f, 0.13f, 0.11f);
  const float sun_cos = 1.f - 0x1.8p-6f;  // behind haze: 12 degrees in radius
  const Vec3 sun_radiance = 1.f / (2.f * kPi * (1.f - sun_cos)) * Vec3(3.0f, 1.9f, 1.0f);
  return make_environment(256, [=](Vec3 d) {
    float up = std::max(0.f, d.y), c = std::max(0.f, d.dot(sun));
    float c2 = c * c, c8 = c2 * c2 * c2 * c2, c64 = c8 * c8 * c8 * c8 * c8 * c8 * c8 * c8;
    float haze = 1.f / (1.f + 7.f * up), low = haze * haze;
    Vec3 sky = (1.f - haze) * Vec3(0.06f, 0.15f, 0.42f) + haze * Vec3(0.22f, 0.30f, 0.42f) +
               (0.6f * low) * ((0.15f + 0.85f * c2) * Vec3(1.0f, 0.52f, 0.22f));
    sky += (0.5f * c8) * Vec3(1.0f, 0.62f, 0.30f) + (1.6f * c64) * Vec3(1.0f, 0.75f, 0.45f);
    if (d.dot(sun) >= sun_cos) sky += sun_radiance;
    return d.y >= 0.f ? sky : earth + std::max(0.f, 1.f + 12.f * d.y) * (sky - earth);
  });
}

Scene default_scene() {
  Scene scene;
  scene.environment = evening();
  scene.camera = {{0.f, 5.0f, 11.0f}, {0.f, 0.62f, 0.15f}, 37.f};

  const Material stone{Kind::plastic, {0.035f, 0.042f, 0.055f}, 0.18f, 0.18f};  // polished
  add_rectangle(scene, {-40.f, 0.f, 40.f}, {80.f, 0.f, 0.f}, {0.f, 0.f, -80.f}, stone);
  Material panel;
  panel.emission = {3.2f, 3.4f, 3.7f};
  add_rectangle(scene, {3.2f, 4.8f, 6.f}, {4.f, 0.9f, -4.8f}, {-1.8f, 3.3f, 0.9f}, panel);

  Material turned = metal(kSteel, 0.12f, 0.34f);
  turned.kind = Kind::brushed, turned.angle_map = std::make_shared<Texture>(engine_turned(1024, 11));
  add_disc(scene, 5.2, turned, metal(kGold, 0.12f, 0.12f));

  // Arcs of spheres: roughness grows from left to right, anisotropy from the front arc to the one behind.
  const Index metals[] = {kCopper, kSilver, kGold};
  for (int arc = 0; arc < 3; ++arc)
    for (int i = 0; i < 7 + 2 * arc; ++i) {
      double share = (i + 0.5) / (7 + 2 * arc), angle = kTurn * (0.5 - 0.5 * share), away = 2.75 + 0.85 * arc, r = 0.30;
      float alpha = rounded(0.08 + 0.5 * share * share), root = std::sqrt(1.f + 2.f * static_cast<float>(arc));
      add_sphere(scene, away * std::cos(angle), -away * std::sin(angle), r,
                 metal(metals[arc], std::min(1.f, alpha * root), alpha / root));
    }
  add_knot(scene, {0, kHeight + 1.22, -0.5}, 0.37, 0.66, metal(kGold, 0.16f, 0.16f));

  Material shingles = metal(kSteel, 0.12f, 0.30f);
  shingles.kind = Kind::leaning;
  shingles.theta_x = 0.35f, shingles.theta_y = -0.25f, shingles.theta_z = 0.6f;
  add_sphere(scene, -2.15, 1.35, 0.72, {Kind::dielectric, {0.93f, 0.98f, 0.96f}, 0.10f, 0.10f});
  add_sphere(scene, -0.55, 2.35, 0.42, {Kind::dielectric, {0.98f, 0.80f, 0.55f}, 0.22f, 0.22f});
  add_sphere(scene, 2.05, 1.45, 0.70, {Kind::plastic, {0.42f, 0.03f, 0.035f}, 0.08f, 0.08f});
  add_sphere(scene, 0.75, 2.4, 0.45, shingles);
  return scene;
}

}  // namespace wavefront
