#include "environment.h"

#include <limits>

namespace wavefront {
namespace {

float sign(float a) {
  return a < 0.f ? -1.f : 1.f;
}

std::size_t first_above(const float* sums, std::size_t count, float u) {
  return std::min(static_cast<std::size_t>(std::upper_bound(sums, sums + count, u) - sums), count - 1);
}

/// Turns a corner of the square, where the lower half of the octahedron lies, inside out: it is its own inverse.
Vec2 folded(Vec2 p) {
  return {(1.f - std::abs(p.y)) * sign(p.x), (1.f - std::abs(p.x)) * sign(p.y)};
}

}  // namespace

Vec3 octahedral_direction(Vec2 square, float& stretch) {
  Vec2 p{2.f * square.x - 1.f, 2.f * square.y - 1.f};
  float z = 1.f - std::abs(p.x) - std::abs(p.y);
  if (z < 0.f) p = folded(p);
  float inv = 1.f / std::sqrt(p.x * p.x + p.y * p.y + z * z);
  stretch = inv * inv * inv;
  return {p.x * inv, p.y * inv, z * inv};
}

Vec2 octahedral_square(Vec3 d, float& stretch) {
  float inv = 1.f / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
  Vec2 p{d.x * inv, d.y * inv};
  stretch = 1.f / (inv * inv * inv);  // |p| = inv for unit d
  if (d.z < 0.f) p = folded(p);
  return {0.5f * p.x + 0.5f, 0.5f * p.y + 0.5f};
}

void prepare(Environment& e) {
  std::size_t size = static_cast<std::size_t>(e.size);
  e.rows.resize(size);
  e.columns.resize(size * size);
  double all = 0;
  std::vector<double> sums(size), of_row(size);
  for (std::size_t y = 0; y < size; ++y) {
    double sum = 0;
    for (std::size_t x = 0; x < size; ++x) {
      float stretch;
      octahedral_direction({(x + 0.5f) / size, (y + 0.5f) / size}, stretch);
      // Dark texels keep a little: sampling must reach whatever has light.
      sum += (luminance(e.texels[y * size + x].radiance) + 1e-6) * stretch;
      sums[x] = sum;
    }
    for (std::size_t x = 0; x < size; ++x) e.columns[y * size + x] = static_cast<float>(sums[x] / sum);
    of_row[y] = all += sum;
  }
  for (std::size_t y = 0; y < size; ++y) e.rows[y] = static_cast<float>(of_row[y] / all);
  // The density that sampling has: of the rounded sums.
  for (std::size_t y = 0; y < size; ++y)
    for (std::size_t x = 0; x < size; ++x) {
      const float* row = &e.columns[y * size];
      float in_row = row[x] - (x > 0 ? row[x - 1] : 0.f), of_row = e.rows[y] - (y > 0 ? e.rows[y - 1] : 0.f);
      e.texels[y * size + x].pdf = 0.25f * in_row * of_row * static_cast<float>(size * size);
    }
}

Environment environment_of_latlong(const Texture& map) {
  // Coordinates are rounded to 1/4096 of a texel: the last bits of a machine's arc functions do not show.
  auto rounded = [](double a) { return static_cast<float>(std::floor(a * 4096 + 0.5) / 4096); };
  int size = std::max(64, std::min(2048, map.height));
  return make_environment(size, [&](Vec3 d) {
    double u = 0.5 + std::atan2(double(d.x), double(-d.z)) / (2 * 3.14159265358979);
    double v = std::acos(std::max(-1.0, std::min(1.0, double(d.y)))) / 3.14159265358979;
    float y = std::max(0.5f, std::min(rounded(v * map.height), map.height - 0.5f));
    return look_up(map, {rounded(u * map.width) / map.width, 1.f - y / map.height});
  });
}

Sky sky_at(const Environment& e, Vec3 direction) {
  if (e.size == 0) return {{0.f, 0.f, 0.f}, 0.f};
  float stretch;
  Vec2 square = octahedral_square(direction, stretch);
  auto index = [&](float a) { return std::max(0, std::min(static_cast<int>(a * e.size), e.size - 1)); };
  const SkyTexel& texel = e.texels[static_cast<std::size_t>(index(square.y)) * e.size + index(square.x)];
  return {texel.radiance, texel.pdf / stretch};
}

LightSample sample_sky(const Environment& e, Vec2 u) {
  std::size_t y = first_above(e.rows.data(), e.rows.size(), u.y);
  const float* row = &e.columns[y * e.size];
  std::size_t x = first_above(row, e.size, u.x);
  // Where in the texel: what is left of the random numbers, so that strata stay whole.
  auto within = [](const float* sums, std::size_t i, float v) {
    float from = i > 0 ? sums[i - 1] : 0.f;
    return std::max(0.f, std::min((v - from) / (sums[i] - from), 0.9999f));
  };
  Vec2 square{(x + within(row, x, u.x)) / e.size, (y + within(e.rows.data(), y, u.y)) / e.size};
  const SkyTexel& texel = e.texels[y * e.size + x];
  float stretch;
  Vec3 wi = octahedral_direction(square, stretch);
  return {wi, std::numeric_limits<float>::infinity(), texel.radiance, texel.pdf / stretch};
}

}  // namespace wavefront
