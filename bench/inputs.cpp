#include "inputs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>
#include <stdexcept>
#include <vector>

#include "reference/random.h"
#include "reference/vec.h"

namespace bench {
namespace {

using Vec3 = vndf::reference::Vec3<double>;
using vndf::reference::Random;

struct Sphere {
  Vec3 center;
  double radius;
};

struct Hit {
  double distance = INFINITY;
  Vec3 normal, tangent;
  double s, t;           // texture coordinates
  double brushed = 1.0;  // alpha_y / alpha_x
};

constexpr int kFieldSide = 8;

/// Spheres of several sizes on a jittered grid, resting on the ground z = 0.
std::vector<Sphere> make_field() {
  Random random(1);
  std::vector<Sphere> field;
  for (int row = 0; row < kFieldSide; ++row)
    for (int column = 0; column < kFieldSide; ++column) {
      double radius = 0.25 + 0.45 * random.unit();
      double x = 2.0 * (column - 0.5 * (kFieldSide - 1)) + 0.6 * (random.unit() - 0.5);
      double y = 2.0 * row + 0.6 * (random.unit() - 0.5);
      field.push_back({{x, y, radius}, radius});
    }
  return field;
}

/// The nearest hit of origin + distance * direction; an infinite distance for the sky.
Hit intersect(const std::vector<Sphere>& field, Vec3 origin, Vec3 direction) {
  Hit hit;
  if (direction.z < 0) {
    hit.distance = -origin.z / direction.z;
    Vec3 p = origin + hit.distance * direction;
    hit.normal = {0, 0, 1};
    hit.tangent = {1, 0, 0};
    hit.s = p.x;
    hit.t = p.y;
    bool tile = (static_cast<long long>(std::floor(p.x)) + static_cast<long long>(std::floor(p.y))) & 1;
    hit.brushed = tile ? 0.2 : 1.0;
  }
  for (std::size_t i = 0; i < field.size(); ++i) {
    const Sphere& sphere = field[i];
    Vec3 to_center = sphere.center - origin;
    double along = dot(to_center, direction);
    Vec3 off = to_center - along * direction;
    double half_chord2 = sphere.radius * sphere.radius - dot(off, off);
    if (half_chord2 < 0) continue;
    double distance = along - std::sqrt(half_chord2);
    if (distance <= 0 || distance >= hit.distance) continue;
    Vec3 n = (1 / sphere.radius) * (origin + distance * direction - sphere.center);
    double parallel = std::sqrt(n.x * n.x + n.y * n.y);
    hit.distance = distance;
    hit.normal = n;
    hit.tangent = parallel > 0 ? Vec3{-n.y / parallel, n.x / parallel, 0} : Vec3{1, 0, 0};
    hit.s = 2 * std::atan2(n.y, n.x);
    hit.t = 4 * n.z;
    hit.brushed = i % 3 == 0 ? 8.0 : 1.0;
  }
  return hit;
}

/// Sums of sines, folded into [0.001, 1] on a logarithmic scale, as an artist's roughness map covers it.
double roughness_texture(double s, double t) {
  double pattern = std::sin(1.7 * s + std::sin(2.3 * t)) + std::sin(2.9 * t - 0.8 * s) + 0.5 * std::sin(7.1 * s * t);
  return std::pow(0.001, 0.5 - pattern / 5.0);
}

constexpr double kPi = 3.141592653589793;

/// A direction uniform over the upper hemisphere.
void fill_direction(float* const columns[3], std::size_t i, Random& random) {
  double z = random.unit();
  double phi = 2 * kPi * random.unit();
  double radius = std::sqrt(1 - z * z);
  columns[0][i] = static_cast<float>(radius * std::cos(phi));
  columns[1][i] = static_cast<float>(radius * std::sin(phi));
  columns[2][i] = static_cast<float>(z);
}

/// All but the views and alpha: random numbers, angles in [-pi, pi], directions of light.
void fill_rest(const Batch& batch, std::uint64_t seed) {
  Random random(seed), besides(seed + 100);
  for (std::size_t i = 0; i < batch.count; ++i) {
    for (int c : {5, 6}) batch.in[c][i] = random.unit();
    batch.in[7][i] = besides.unit();
    for (int c : {8, 9, 10}) batch.in[c][i] = static_cast<float>(kPi * (2 * besides.unit() - 1));
    fill_direction(&batch.in[11], i, besides);
    batch.in[14][i] = std::copysign(batch.in[13][i], batch.in[8][i]);
  }
}

}  // namespace

Batch make_columns(std::size_t count, Offset offset) {
  constexpr std::size_t kLine = 16;  // floats in 64 bytes
  constexpr std::size_t kColumns = kInputs + kOutputs;
  std::size_t stride = (count + kLine - 1) / kLine * kLine + 5 * kLine;
  std::size_t floats = stride * kColumns;
  auto* base = static_cast<float*>(::operator new[](floats * sizeof(float), std::align_val_t(64)));
  std::fill(base, base + floats, 0.f);  // touches every page before anything is timed
  Batch batch;
  batch.count = count;
  batch.arena = {base, [](float* p) { ::operator delete[](p, std::align_val_t(64)); }};
  for (std::size_t c = 0; c < kColumns; ++c) {
    float* column = base + c * stride + (offset == Offset::unaligned ? 2 * c + 1 : 0);
    (c < kInputs ? batch.in[c] : batch.out[c - kInputs]) = column;
  }
  return batch;
}

void fill_camera(const Batch& batch) {
  const std::vector<Sphere> field = make_field();
  const Vec3 eye{0.7, -3.0, 1.7};
  const Vec3 forward = unit(Vec3{0, 6, -0.8} - eye);
  const Vec3 right = unit(cross(forward, {0, 0, 1}));
  const Vec3 up = cross(right, forward);
  constexpr double kHalfWidth = 0.7;      // tangent of half the field of view
  constexpr double kSkyFraction = 0.303;  // of the picture, so that one frame just about fills the batch
  const auto side =
      static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(batch.count) / (1 - kSkyFraction))));

  // Should one frame fall short, the next one begins; the camera moves on a little between frames.
  std::size_t i = 0;
  for (int frame = 0; i < batch.count; ++frame)
    for (std::size_t row = 0; row < side && i < batch.count; ++row)
      for (std::size_t column = 0; column < side && i < batch.count; ++column) {
        double x = kHalfWidth * (2 * (static_cast<double>(column) + 0.5) / static_cast<double>(side) - 1);
        double y = kHalfWidth * (1 - 2 * (static_cast<double>(row) + 0.5) / static_cast<double>(side));
        Vec3 direction = unit(forward + x * right + y * up);
        Hit hit = intersect(field, eye + (0.01 * frame) * right, direction);
        if (!std::isfinite(hit.distance)) continue;
        Vec3 wo = -1. * direction;
        double alpha_x = roughness_texture(hit.s, hit.t);
        double alpha_y = std::clamp(alpha_x * hit.brushed, 0.001, 1.0);
        batch.in[0][i] = static_cast<float>(dot(wo, hit.tangent));
        batch.in[1][i] = static_cast<float>(dot(wo, cross(hit.normal, hit.tangent)));
        batch.in[2][i] = static_cast<float>(dot(wo, hit.normal));
        batch.in[3][i] = static_cast<float>(alpha_x);
        batch.in[4][i] = static_cast<float>(alpha_y);
        ++i;
      }
  fill_rest(batch, 2);
}

void fill_uniform(const Batch& batch) {
  Random random(3);
  for (std::size_t i = 0; i < batch.count; ++i) {
    fill_direction(&batch.in[0], i, random);
    batch.in[3][i] = static_cast<float>(std::pow(0.01, random.unit()));
    batch.in[4][i] = static_cast<float>(std::pow(0.01, random.unit()));
  }
  fill_rest(batch, 4);
}

Batch make_batch(const std::string& input, std::size_t count) {
  Batch batch = make_columns(count, input == "camera_unaligned" ? Offset::unaligned : Offset::aligned);
  if (input == "camera" || input == "camera_unaligned")
    fill_camera(batch);
  else if (input == "uniform")
    fill_uniform(batch);
  else
    throw std::invalid_argument("no such input: " + input);
  return batch;
}

}  // namespace bench
