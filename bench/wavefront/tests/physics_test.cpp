// Whether the renderer is right: against quadrature, and against itself by other ways of sampling.
#include <gtest/gtest.h>

#include "render.h"

namespace {

using namespace wavefront;

constexpr int kSize = 64;

/// A sky of `radiance` alone.
Environment uniform_sky(Vec3 radiance) {
  return make_environment(8, [=](Vec3) { return radiance; });
}

int add_material(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  return static_cast<int>(scene.materials.size()) - 1;
}
void finish(Scene& scene) {
  list_lights(scene);
  build_tree(scene, "");
}
/// The plane y = 0, 40 wide, lit and seen from above.
void add_plane(Scene& scene, const Material& material) {
  int number = add_material(scene, material);
  Vec3 up{0.f, 1.f, 0.f};
  Corner a{{-20.f, 0.f, 20.f}, up, {0, 0}}, b{{20.f, 0.f, 20.f}, up, {1, 0}}, c{{20.f, 0.f, -20.f}, up, {1, 1}},
      d{{-20.f, 0.f, -20.f}, up, {0, 1}};
  scene.triangles.insert(scene.triangles.end(), {Triangle{{a, b, c}, number}, Triangle{{a, c, d}, number}});
}
void add_sphere(Scene& scene, Vec3 center, float radius, const Material& material) {
  scene.spheres.push_back({center, radius, add_material(scene, material)});
}
/// A camera far away that sees the origin of the plane under `cos`, and little else: all its views are nearly one.
void look(Scene& scene, float cos) {
  float sin = std::sqrt(1.f - cos * cos);
  scene.camera.from = 10.f * Vec3{sin, cos, 0.f};
  scene.camera.at = {0.f, 0.f, 0.f};
  scene.camera.fov = 0.02f;
}
Material white_metal(float alpha_x, float alpha_y) {
  Material m;
  m.kind = Kind::conductor;
  m.n = {0.f, 0.f, 0.f}, m.k = {1.f, 1.f, 1.f};  // reflects everything
  m.alpha_x = alpha_x, m.alpha_y = alpha_y;
  return m;
}

Task task_of(int samples) {
  Task task;
  task.size = {kSize, kSize};
  task.crop = {{0, 0}, {kSize, kSize}};
  task.last_sample = samples;
  return task;
}
std::vector<Vec3> picture(const Scene& scene, const Task& task) {
  return render(scene, task, [](double) { return true; }).pixels;
}

/// Mean of the red channel, and the standard error of that, from the pixels: they have independent random numbers.
struct Estimate {
  double mean, error;
};
Estimate estimate(const std::vector<Vec3>& pixels) {
  double sum = 0, squares = 0, count = static_cast<double>(pixels.size());
  for (const Vec3& p : pixels) sum += p.x;
  double mean = sum / count;
  for (const Vec3& p : pixels) squares += (p.x - mean) * (p.x - mean);
  return {mean, std::sqrt(squares / (count - 1) / count)};
}

/// Smith's Lambda of GGX for a direction, Heitz 2014, eq. 72.
double lambda(double x, double y, double z, double alpha_x, double alpha_y) {
  return 0.5 * (std::sqrt(1 + (alpha_x * alpha_x * x * x + alpha_y * alpha_y * y * y) / (z * z)) - 1);
}
/// Albedo of single scattering: the integral of f cos over normals, by the textbook's D and G2.
double albedo(double cos_o, double alpha_x, double alpha_y) {
  double ox = std::sqrt(1 - cos_o * cos_o), sum = 0;
  double lambda_o = lambda(ox, 0, cos_o, alpha_x, alpha_y);
  constexpr int kPhis = 512, kThetas = 2048;
  for (int i = 0; i < kThetas; ++i)
    for (int j = 0; j < kPhis; ++j) {
      // Normals by their own distribution, which has 1 / (1 + t^2) even for t the tangent of the stretched one. It has
      // a long tail: s^2 in place of it.
      double s = (i + 0.5) / kThetas, phi = 2 * 3.141592653589793 * (j + 0.5) / kPhis, t = std::sqrt(1 - s * s) / s;
      double x = alpha_x * t * std::cos(phi), y = alpha_y * t * std::sin(phi), inv = 1 / std::sqrt(1 + x * x + y * y);
      double c = (ox * x + cos_o) * inv;  // wo.wm
      double ix = 2 * c * x * inv - ox, iy = 2 * c * y * inv, iz = 2 * c * inv - cos_o;
      if (c <= 0 || iz <= 0) continue;
      double g2 = 1 / (1 + lambda_o + lambda(ix, iy, iz, alpha_x, alpha_y));
      sum += 2 * s * g2 * c / (cos_o * inv);  // f cos / pdf of NDF sampling
    }
  return sum / (static_cast<double>(kThetas) * kPhis);
}

TEST(Furnace, MetalShowsItsAlbedo) {
  for (float alpha : {0.1f, 0.4f, 1.0f})
    for (float cos : {0.15f, 0.5f, 0.98f})
      for (bool mis : {true, false}) {
        Scene scene;
        add_plane(scene, white_metal(alpha, 0.5f * alpha));
        scene.environment = uniform_sky({1.f, 1.f, 1.f});
        look(scene, cos);
        finish(scene);
        Task task = task_of(64);
        task.mis = mis;
        Estimate seen = estimate(picture(scene, task));
        EXPECT_NEAR(seen.mean, albedo(cos, alpha, 0.5f * alpha), 3 * seen.error + 2e-4)
            << "alpha " << alpha << ", cos " << cos << ", mis " << mis;
      }
}

TEST(Furnace, GlassOfNoIndexVanishes) {
  Scene scene;
  Material glass;
  glass.kind = Kind::dielectric;
  glass.alpha_x = glass.alpha_y = 0.5f;
  glass.eta = 1.f;
  glass.color = {1.f, 1.f, 1.f};
  add_sphere(scene, {0.f, 0.f, 0.f}, 1.f, glass);
  scene.environment = make_environment(64, [](Vec3 d) { return Vec3{0.5f + 0.5f * d.x, 0.25f, 1.f}; });
  scene.camera.from = {0.f, 0.f, 3.f};
  scene.camera.fov = 30.f;
  finish(scene);
  auto with = picture(scene, task_of(4));
  scene.camera.from = {0.f, 0.f, 3.f};
  Scene empty = scene;
  empty.spheres[0].center = {1000.f, 0.f, 0.f};
  finish(empty);
  auto without = picture(empty, task_of(4));
  for (std::size_t i = 0; i < with.size(); ++i) ASSERT_NEAR(with[i].x, without[i].x, 0.02f) << i;  // a texel of the sky
  EXPECT_NEAR(estimate(with).mean, estimate(without).mean, 1e-4);
}

TEST(Furnace, GlassKeepsEnergy) {
  Scene scene;
  Material glass;
  glass.kind = Kind::dielectric;
  glass.alpha_x = glass.alpha_y = 0.05f;
  glass.color = {1.f, 1.f, 1.f};
  add_sphere(scene, {0.f, 0.f, 0.f}, 1.f, glass);
  scene.environment = uniform_sky({1.f, 1.f, 1.f});
  scene.camera.from = {0.f, 0.f, 3.f};
  scene.camera.fov = 15.f;
  finish(scene);
  Estimate seen = estimate(picture(scene, task_of(64)));
  EXPECT_LT(seen.mean, 1.0 + 3 * seen.error);
  EXPECT_GT(seen.mean, 0.97);  // what is lost is multiple scattering, little at this roughness
}

TEST(Furnace, GlassCondensesRadiance) {
  Scene scene;
  Material glass, light;
  glass.kind = Kind::dielectric;
  glass.alpha_x = glass.alpha_y = 0.05f;
  glass.color = {1.f, 1.f, 1.f};
  light.emission = {1.f, 1.f, 1.f};
  add_sphere(scene, {0.f, 0.f, 0.f}, 1.f, glass);
  add_sphere(scene, {0.f, 0.f, 0.f}, 0.9f, light);
  look(scene, 1.f);
  finish(scene);
  // Seen along the normal: what Fresnel lets out, less by the square of the index.
  double exact = 0.96 / (1.5 * 1.5);
  for (bool mis : {true, false}) {
    Task task = task_of(64);
    task.mis = mis;
    Estimate seen = estimate(picture(scene, task));
    EXPECT_NEAR(seen.mean, exact, 3 * seen.error + 1e-3) << "mis " << mis;
  }
}

/// All there is, turned upside down, looks the same: sheets have two sides, and a brush's strokes lie where they lie.
TEST(TwoSided, FromBelowAsFromAbove) {
  for (Kind kind : {Kind::diffuse, Kind::plastic, Kind::conductor, Kind::brushed})
    for (Sampler sampler : {Sampler::vndf, Sampler::bounded, Sampler::ndf}) {
      double means[2];
      Task task = task_of(64);
      task.sampling.sampler = sampler;
      for (float up : {1.f, -1.f}) {
        Material sheet = white_metal(0.6f, 0.1f), light;
        sheet.kind = kind;
        sheet.theta_z = 0.6f;
        light.emission = {2.f, 2.f, 2.f};
        Scene scene;
        add_plane(scene, sheet);
        add_sphere(scene, {1.f, up * 3.f, 2.f}, 1.f, light);
        look(scene, 0.7f);
        scene.camera.from.y *= up;
        finish(scene);
        means[up < 0.f] = estimate(picture(scene, task)).mean;
      }
      EXPECT_GT(means[0], 0.01);
      EXPECT_NEAR(means[0], means[1], 0.03 * means[0]) << "kind " << int(kind) << ", sampler " << int(sampler);
    }
}

TEST(Direct, SphereLightOnAPlane) {
  Scene scene;
  Material white, light;
  white.color = {1.f, 1.f, 1.f};
  light.emission = {2.f, 2.f, 2.f};
  add_plane(scene, white);
  const double radius = 0.5, height = 2.0, away = 1.5;
  add_sphere(scene, {-1.5f, 2.f, 0.f}, 0.5f, light);
  look(scene, 0.9f);
  finish(scene);
  // Of a sphere that is above the horizon as a whole, the irradiance is pi L sin^2 cos.
  double d2 = height * height + away * away;
  double exact = 2.0 * (radius * radius / d2) * (height / std::sqrt(d2));
  for (bool mis : {true, false}) {
    Task task = task_of(mis ? 16 : 256);
    task.mis = mis;
    Estimate seen = estimate(picture(scene, task));
    EXPECT_NEAR(seen.mean, exact, 3 * seen.error + 1e-5) << "mis " << mis;
  }
}

/// Several materials in a box of light: all ways of sampling converge to one picture.
Scene meeting() {
  Scene scene;
  Material plastic, light;
  plastic.kind = Kind::plastic;
  plastic.color = {0.6f, 0.3f, 0.2f};
  plastic.alpha_x = plastic.alpha_y = 0.3f;
  add_plane(scene, plastic);
  Material metal = white_metal(0.5f, 0.2f);
  metal.n = {0.2f, 0.5f, 1.3f}, metal.k = {3.f, 2.2f, 1.9f};
  add_sphere(scene, {-1.2f, 1.f, 0.f}, 0.8f, metal);
  metal.kind = Kind::brushed;
  metal.theta_z = 0.7f;
  add_sphere(scene, {1.2f, 1.f, 0.f}, 0.8f, metal);
  metal.kind = Kind::leaning;
  metal.theta_x = 0.3f;
  add_sphere(scene, {0.f, 1.f, -1.5f}, 0.8f, metal);
  Material glass;
  glass.kind = Kind::dielectric;
  glass.alpha_x = glass.alpha_y = 0.4f;
  add_sphere(scene, {0.f, 0.6f, 1.2f}, 0.5f, glass);
  light.emission = {3.f, 3.f, 3.f};
  add_sphere(scene, {2.f, 4.f, 2.f}, 1.f, light);
  scene.environment = make_environment(32, [](Vec3 d) { return Vec3{0.3f + 0.7f * d.y * d.y, 0.5f, 0.8f}; });
  scene.camera.from = {0.f, 3.f, 6.f};
  scene.camera.at = {0.f, 0.7f, 0.f};
  finish(scene);
  return scene;
}
/// Means of 8 x 8 blocks.
std::vector<double> block_means(const std::vector<Vec3>& pixels) {
  std::vector<double> means(64);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) means[y / 8 * 8 + x / 8] += luminance(pixels[y * kSize + x]) / 64;
  return means;
}

TEST(Converges, EveryWayOfSamplingToOnePicture) {
  Scene scene = meeting();
  constexpr int kRuns = 6;
  struct Way {
    const char* name;
    Sampling sampling;
    bool mis;
  };
  using vndf::Warp;
  const Way ways[] = {{"concentric", {Sampler::vndf, Warp::concentric}, true},
                      {"polar", {Sampler::vndf, Warp::polar}, true},
                      {"cap", {Sampler::vndf, Warp::spherical_cap}, true},
                      {"bounded", {Sampler::bounded, Warp::spherical_cap}, true},
                      {"bounded polar", {Sampler::bounded, Warp::polar}, true},
                      {"ndf", {Sampler::ndf, Warp::concentric}, true},
                      {"without mis", {Sampler::vndf, Warp::concentric}, false},
                      {"ndf without mis", {Sampler::ndf, Warp::polar}, false}};
  std::vector<double> first_mean, first_variance;
  for (const Way& way : ways) {
    std::vector<double> mean(64), variance(64);
    std::vector<std::vector<double>> runs;
    for (int run = 0; run < kRuns; ++run) {
      Task task = task_of(way.mis ? 32 : 128);
      task.sampling = way.sampling;
      task.mis = way.mis;
      task.seed = static_cast<std::uint32_t>(1000 * (&way - ways) + run);
      runs.push_back(block_means(picture(scene, task)));
      for (int i = 0; i < 64; ++i) mean[i] += runs.back()[i] / kRuns;
    }
    for (const auto& run : runs)
      for (int i = 0; i < 64; ++i) variance[i] += (run[i] - mean[i]) * (run[i] - mean[i]) / (kRuns * (kRuns - 1));
    if (first_mean.empty()) {
      first_mean = mean, first_variance = variance;
      continue;
    }
    // 64 blocks of Welch's t with about 10 degrees of freedom: its square has mean 10/8 and deviation 2.3.
    double sum = 0;
    for (int i = 0; i < 64; ++i) {
      double d = mean[i] - first_mean[i];
      sum += d * d / (variance[i] + first_variance[i] + 1e-12);
    }
    EXPECT_LT(sum / 64, 1.25 + 4 * 2.3 / 8) << way.name;
  }
}

TEST(Queues, SamplesAndCropsDoNotChangePixels) {
  Scene scene = meeting();
  Task task = task_of(8);
  auto whole = picture(scene, task);
  task.crop = {{13, 7}, {50, 41}};
  auto part = picture(scene, task);
  for (int y = 7; y < 41; ++y)
    for (int x = 13; x < 50; ++x) {
      const Vec3 &a = whole[y * kSize + x], &b = part[(y - 7) * 37 + x - 13];
      ASSERT_TRUE(a.x == b.x && a.y == b.y && a.z == b.z) << x << " " << y;
    }
}

}  // namespace
