// The wave: camera -> intersect -> bin -> shade -> shadow rays, until no path of the block lives. Dead paths leave room
// that new camera rays fill, so that queues stay long.
#include "intersect.h"
#include "queues.h"
#include "sobol.h"

namespace wavefront {
namespace {

/// The tent of width 2 that a pixel weighs its surroundings with.
float tent(float u) {
  return u < 0.5f ? std::sqrt(2.f * u) - 1.f : 1.f - std::sqrt(2.f - 2.f * u);
}

struct View {
  Frame frame;
  float pixel;  // its width, on a plane at distance 1
};
View view_of(const Camera& camera, int width) {
  Vec3 ahead = normalize(camera.at - camera.from);
  // Rounded, as machines differ in the last bits of a tangent.
  double half = std::tan(double(camera.fov) * (3.14159265358979 / 360));
  float rounded = static_cast<float>(std::floor(half * 0x1p20 + 0.5) * 0x1p-20);
  return {frame_of(ahead, ahead.cross({0.f, 1.f, 0.f})), 2.f * rounded / static_cast<float>(width)};
}

/// The path of a slot, at the end of the queue.
void start_path(const Scene& scene, const Task& task, const View& view, const Block& block, std::uint32_t slot,
                Worker& w) {
  Paths& paths = *w.paths;
  std::uint32_t width = block.window.width(), pixels = width * block.window.height(), pixel = slot % pixels;
  std::uint32_t x = block.window.x0 + pixel % width, y = block.window.y0 + pixel / width, p = paths.count++;
  w.slots.seed[slot] = mixed(x ^ mixed(y ^ mixed(task.seed)));
  w.slots.sample[slot] = reversed_bits(block.first + slot / pixels);
  w.slots.radiance.set(slot, Vec3(0.f));
  Random4 r = random4(w.slots.sample[slot], w.slots.seed[slot], 0);
  float right = static_cast<float>(x) + 0.5f + tent(r.x[0]) - 0.5f * static_cast<float>(task.width);
  float down = static_cast<float>(y) + 0.5f + tent(r.x[1]) - 0.5f * static_cast<float>(task.height);
  paths.origin.set(p, scene.camera.from);
  paths.direction.set(p, normalize(view.frame.to_world({view.pixel * right, view.pixel * down, 1.f})));
  paths.throughput.set(p, Vec3(1.f));
  paths.pdf[p] = 0x1p60f;  // no light was sampled for it
  paths.slot[p] = slot, paths.depth[p] = 0;
  ++w.statistics[Figure::paths];
}

/// Lights what escaped, and puts the rest into the order of kinds: kind k is between starts[k] and starts[k + 1].
using Starts = std::array<std::uint32_t, kKinds + 1>;
Starts bin_hits(const Scene& scene, const Task& task, Worker& w) {
  const Paths& paths = *w.paths;
  auto kind = [&](std::uint32_t p) { return static_cast<std::size_t>(scene.material_of(w.hits.primitive[p]).kind); };
  Starts starts{}, at;
  for (std::uint32_t p = 0; p < paths.count; ++p)
    if (w.hits.primitive[p] == kNothing) {
      LightSample sky = sky_at(scene, paths.direction.get(p));
      float weight = task.mis ? mis_weight(paths.pdf[p], sky.pdf) : 1.f;
      w.slots.radiance.add(paths.slot[p], weight * (paths.throughput.get(p) * sky.radiance));
    } else {
      ++starts[kind(p) + 1];
    }
  for (std::size_t k = 0; k < kKinds; ++k) starts[k + 1] += starts[k];
  at = starts;
  for (std::uint32_t p = 0; p < paths.count; ++p)
    if (w.hits.primitive[p] != kNothing) w.hits.order[at[kind(p)]++] = p;
  return starts;
}

}  // namespace

void trace(const Scene& scene, const Task& task, const Block& block, Worker& w) {
  View view = view_of(scene.camera, task.width);
  std::uint32_t slots = block.paths(), slot = 0;
  w.paths->count = 0;
  w.clock = Worker::seconds();
  while (true) {
    while (slot < slots && w.paths->count < kCapacity) start_path(scene, task, view, block, slot++, w);
    w.lap(Figure::camera);
    if (w.paths->count == 0) return;

    for (std::uint32_t p = 0; p < w.paths->count; ++p)
      w.hits.primitive[p] = intersect(scene, w.paths->origin.get(p), w.paths->direction.get(p));
    w.lap(Figure::intersect);

    Starts starts = bin_hits(scene, task, w);
    w.lap(Figure::bin);

    w.next->count = w.shadows.count = 0;
    for (std::size_t k = 0; k < kKinds; ++k)
      for (std::uint32_t first = starts[k]; first < starts[k + 1]; first += kBatch)
        shade(scene, task, static_cast<Kind>(k), first, std::min(first + kBatch, starts[k + 1]), w);

    const ShadowRays& shadows = w.shadows;
    for (std::uint32_t s = 0; s < shadows.count; ++s)
      if (!occluded(scene, shadows.origin.get(s), shadows.direction.get(s), shadows.distance[s]))
        w.slots.radiance.add(shadows.slot[s], shadows.radiance.get(s));
    w.statistics[Figure::rays] += shadows.count;
    std::swap(w.paths, w.next);
    w.lap(Figure::shadow);
  }
}

}  // namespace wavefront
