// The wave: camera -> intersect -> bin -> shade -> shadow rays, until no path of the block lives. Dead paths leave room
// that new camera rays fill, so that queues stay long.
#include "lights.h"
#include "sobol.h"
#include "worker.h"

namespace wavefront {
namespace {

constexpr int kMostBins = 64;

/// The tent of width 2 that a pixel weighs its surroundings with.
float tent(float u) {
  return u < 0.5f ? std::sqrt(2.f * u) - 1.f : 1.f - std::sqrt(2.f - 2.f * u);
}

struct View {
  Vec3 from, right, down, corner;  // on a plane at distance 1; right and down are of one pixel
};
View view_of(const Camera& camera, int width, int height) {
  Vec3 ahead = normalize(camera.at - camera.from);
  auto [right, down, forward] = frame_of(ahead, cross(ahead, {0.f, 1.f, 0.f}));
  // Rounded, as machines differ in the last bits of a tangent.
  double half = std::tan(double(camera.fov) * (3.14159265358979 / 360));
  float pixel = 2.f * static_cast<float>(std::floor(half * 0x1p20 + 0.5) * 0x1p-20) / static_cast<float>(width);
  Vec3 corner = forward - (0.5f * width * pixel) * right - (0.5f * height * pixel) * down;
  return {camera.from, pixel * right, pixel * down, corner};
}

/// Paths number `begin` and on of the block, as many as there is room for.
std::uint32_t start_paths(const Settings& settings, const View& view, const Block& block, std::uint32_t begin,
                          std::uint32_t end, Worker& w) {
  Paths& paths = w.paths;
  std::uint32_t width = block.x1 - block.x0, pixels = width * (block.y1 - block.y0), slot = begin;
  for (; slot < end && paths.count < kCapacity; ++slot, ++paths.count) {
    std::uint32_t p = paths.count, pixel = slot % pixels;
    std::uint32_t x = block.x0 + pixel % width, y = block.y0 + pixel / width;
    paths.slot[p] = slot;
    paths.seed[p] = pixel_seed(x, y, settings.seed);
    paths.sample[p] = reversed(block.first + slot / pixels);
    paths.depth[p] = 0;
    paths.pdf[p] = 0x1p60f;  // no light was sampled for it
    Random4 r = random4(paths.sample[p], paths.seed[p], 0);
    Vec3 right = (static_cast<float>(x) + 0.5f + tent(r.x[0])) * view.right;
    Vec3 down = (static_cast<float>(y) + 0.5f + tent(r.x[1])) * view.down;
    paths.origin.set(p, view.from);
    paths.direction.set(p, normalize(view.corner + right + down));
    paths.throughput.set(p, {1.f, 1.f, 1.f});
    w.radiance.set(slot, {0.f, 0.f, 0.f});
  }
  w.statistics.paths += slot - begin;
  return slot;
}

/// Counts the bins, lights what escaped, and puts the rest into the order of bins. starts[b] is where bin b begins.
void bin_hits(const Scene& scene, const Settings& settings, Worker& w, std::uint32_t (&starts)[kMostBins + 1]) {
  std::fill(std::begin(starts), std::end(starts), 0u);
  for (std::uint32_t p = 0; p < w.paths.count; ++p) {
    Primitive primitive = w.hits.primitive[p];
    if (primitive == kNothing) {
      Vec3 light = escaped_light(scene, w.paths.direction.get(p), w.paths.pdf[p], settings.mis);
      w.radiance.add(w.paths.slot[p], w.paths.throughput.get(p) * light);
      continue;
    }
    w.hits.bin[p] = static_cast<std::uint16_t>(scene.materials[scene.material_of(primitive)].bin);
    ++starts[w.hits.bin[p] + 1];
  }
  for (int b = 0; b < kMostBins; ++b) starts[b + 1] += starts[b];
  std::uint32_t at[kMostBins];
  std::copy(starts, starts + kMostBins, at);
  for (std::uint32_t p = 0; p < w.paths.count; ++p)
    if (w.hits.primitive[p] != kNothing) w.hits.order[at[w.hits.bin[p]]++] = p;
}

}  // namespace

void trace(const Scene& scene, const Settings& settings, const Block& block, Worker& w) {
  View view = view_of(scene.camera, settings.width, settings.height);
  std::uint32_t total = (block.x1 - block.x0) * (block.y1 - block.y0) * (block.last - block.first), started = 0;
  w.paths.count = 0;
  w.clock = Clock();
  while (true) {
    started = start_paths(settings, view, block, started, total, w);
    w.clock.lap(w.statistics, Stage::camera);
    if (w.paths.count == 0) return;

    for (std::uint32_t p = 0; p < w.paths.count; ++p)
      w.hits.primitive[p] = intersect(scene, w.paths.origin.get(p), w.paths.direction.get(p));
    w.clock.lap(w.statistics, Stage::intersect);

    std::uint32_t starts[kMostBins + 1];
    bin_hits(scene, settings, w, starts);
    w.clock.lap(w.statistics, Stage::bin);

    w.next.count = w.shadows.count = 0;
    for (std::size_t b = 0; b < scene.bins.size(); ++b)
      for (std::uint32_t first = starts[b]; first < starts[b + 1]; first += kBatch)
        shade(scene, settings, scene.bins[b], first, std::min(first + kBatch, starts[b + 1]), w);

    for (std::uint32_t s = 0; s < w.shadows.count; ++s)
      if (!occluded(scene, w.shadows.origin.get(s), w.shadows.direction.get(s), w.shadows.distance[s]))
        w.radiance.add(w.shadows.slot[s], w.shadows.radiance.get(s));
    w.statistics.shadow_rays += w.shadows.count;
    std::swap(w.paths, w.next);
    w.clock.lap(w.statistics, Stage::shadow);
  }
}

}  // namespace wavefront
