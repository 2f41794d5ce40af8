#include "render.h"

#include <atomic>
#include <mutex>

#include <tbb/blocked_range3d.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "queues.h"
#include "sobol.h"

namespace wavefront {
namespace {

/// Samples of a tile's pixels: pages, rows and columns. Its paths are numbered sample by sample, each row by row.
using Block = tbb::blocked_range3d<int>;
int pixels_of(const Block& block) {
  return static_cast<int>(block.rows().size() * block.cols().size());
}
Imath::V2i pixel_of(const Block& block, std::uint32_t slot) {
  int width = static_cast<int>(block.cols().size()), pixel = static_cast<int>(slot) % pixels_of(block);
  return {block.cols().begin() + pixel % width, block.rows().begin() + pixel / width};
}

/// The tent of width 2 that a pixel weighs its surroundings with.
float tent(float u) {
  return u < 0.5f ? std::sqrt(2.f * u) - 1.f : 1.f - std::sqrt(2.f - 2.f * u);
}

/// Axes of the picture, and the width of a pixel on a plane at distance 1.
using View = std::pair<Frame, float>;
View view_of(const Camera& camera, int width) {
  Vec3 ahead = normalize(camera.at - camera.from);
  float half = rounded(std::tan(double(camera.fov) * (kTurn / 720)), 0x1p-20);
  return {frame_of(ahead, ahead.cross({0.f, 1.f, 0.f})), 2.f * half / static_cast<float>(width)};
}

/// The path of a slot, at the end of the queue.
void start_path(const Scene& scene, const Task& task, const View& view, const Block& block, std::uint32_t slot,
                Worker& w) {
  Imath::V2i pixel = pixel_of(block, slot);
  w.seed[slot] = mixed(pixel.x ^ mixed(pixel.y ^ mixed(task.seed)));
  w.sample[slot] = reversed_bits(block.pages().begin() + slot / pixels_of(block));
  w.radiance.set(slot, Vec3(0.f));
  Imath::V4f r = random4(w.sample[slot], w.seed[slot], 0);
  Vec2 from_middle = Vec2(pixel) + Vec2(0.5f) + Vec2(tent(r.x), tent(r.y)) - 0.5f * Vec2(task.size);
  const auto& [frame, width] = view;
  Vec3 direction = normalize(frame.to_world({width * from_middle.x, width * from_middle.y, 1.f}));
  std::uint32_t p = w.paths->add(scene.camera.from, direction, Vec3(1.f), slot);
  w.paths->pdf[p] = 0x1p60f;  // no light was sampled for it
  w.paths->depth[p] = 0;
}

/// Ends the paths that met light or nothing, and bins the rest by kind.
void bin_hits(const Scene& scene, const Task& task, Worker& w) {
  const Paths& paths = *w.paths;
  for (Bin& bin : w.bins) bin.count = 0;
  for (std::uint32_t p = 0; p < paths.count; ++p) {
    Primitive primitive = w.hits[p];
    const Material* material = primitive == kNothing ? nullptr : &scene.material_of(primitive);
    if (material && material->emission == Vec3(0.f)) {  // lights do not reflect
      Bin& bin = w.bins[static_cast<std::size_t>(material->kind)];
      bin.path[bin.count++] = p;
      continue;
    }
    LightSample light = light_met(scene, primitive, paths.origin.get(p), paths.direction.get(p));
    float weight = task.mis ? mis_weight(paths.pdf[p], light.pdf) : 1.f;
    w.radiance.add(paths.slot[p], weight * (paths.throughput.get(p) * light.radiance));
  }
}

/// The wave: camera -> intersect -> bin -> shade -> shadow rays, until no path of the block lives. Dead paths leave
/// room that new camera rays fill, so that queues stay long. Radiance is in the slots; answers how many they are.
std::uint32_t trace(const Scene& scene, const Task& task, const Block& block, Worker& w) {
  View view = view_of(scene.camera, task.size.x);
  std::uint32_t slots = pixels_of(block) * block.pages().size(), slot = 0;
  w.paths->count = 0;
  w.clock = Worker::seconds();
  w.statistics["paths"] += slots;
  while (true) {
    while (slot < slots && w.paths->count < kCapacity) start_path(scene, task, view, block, slot++, w);
    w.lap("camera");
    if (w.paths->count == 0) return slots;

    for (std::uint32_t p = 0; p < w.paths->count; ++p)
      w.hits[p] = intersect(scene, w.paths->origin.get(p), w.paths->direction.get(p));
    w.lap("intersect");

    bin_hits(scene, task, w);
    w.lap("bin");

    w.next->count = w.shadows.count = 0;
    for (std::size_t k = 0; k < kKinds; ++k)
      for (std::uint32_t first = 0; first < w.bins[k].count; first += kBatch)
        shade(scene, task, static_cast<Kind>(k), first, w);

    const ShadowRays& shadows = w.shadows;
    for (std::uint32_t s = 0; s < shadows.count; ++s)
      if (!occluded(scene, shadows.origin.get(s), shadows.direction.get(s), shadows.distance[s]))
        w.radiance.add(shadows.slot[s], shadows.throughput.get(s));
    w.statistics["rays"] += shadows.count;
    std::swap(w.paths, w.next);
    w.lap("shadow");
  }
}

}  // namespace

Picture render(const Scene& scene, const Task& task, const std::function<bool(double)>& go_on) {
  constexpr int kTile = 32, kSamplesAtOnce = kSlots / (kTile * kTile);
  const Imath::Box2i& crop = task.crop;
  const std::size_t width = crop.size().x, pixels = width * crop.size().y;
  std::vector<Imath::V4d> film(pixels, Imath::V4d(0.));  // sums of radiance, and in `w` how many there are
  tbb::enumerable_thread_specific<Worker> workers;
  std::atomic<bool> ended{false};
  std::mutex telling;
  double done = 0., all = static_cast<double>(pixels) * (task.last_sample - task.first_sample);
  auto run = [&](const Block& block) {
    if (ended) return;
    Worker& worker = workers.local();
    std::uint32_t paths = trace(scene, task, block, worker);
    // No other thread has this tile now. Sample after sample, whatever ran first: the sum is always the same.
    for (std::uint32_t slot = 0; slot < paths; ++slot) {
      Imath::V2i pixel = pixel_of(block, slot) - crop.min;
      film[pixel.y * width + pixel.x] += Imath::V4d(worker.radiance.get(slot));  // whose w is 1
    }
    worker.lap("accumulate");
    std::lock_guard<std::mutex> lock(telling);
    done += paths;
    if (!go_on(done / all)) ended = true;
  };
  tbb::task_arena arena(task.threads > 0 ? task.threads : tbb::task_arena::automatic);
  tbb::global_control control(tbb::global_control::max_allowed_parallelism, arena.max_concurrency());
  arena.execute([&] {
    // A few samples of all tiles before more of any: what is interrupted is a picture too.
    for (int first = task.first_sample; first < task.last_sample && !ended; first += kSamplesAtOnce) {
      int last = std::min(first + kSamplesAtOnce, task.last_sample);
      Block samples(first, last, kSamplesAtOnce, crop.min.y, crop.max.y, kTile, crop.min.x, crop.max.x, kTile);
      tbb::parallel_for(samples, run, tbb::simple_partitioner());
    }
  });

  Picture picture{{}, {}, done == all};
  for (const Imath::V4d& sum : film)
    picture.pixels.push_back(Vec3(Imath::V3d(sum.x, sum.y, sum.z) / std::max(sum.w, 1.)));
  for (const Worker& worker : workers)
    for (const auto& [name, value] : worker.statistics) picture.statistics[name] += value;
  // Of all queues for one path under way, and of its slot.
  picture.statistics["bytes_per_path"] =
      (2 * sizeof(Paths) + sizeof(Worker::hits) + sizeof(Worker::bins) + sizeof(ShadowRays)) / kCapacity +
      (sizeof(Worker::seed) + sizeof(Worker::sample) + sizeof(Worker::radiance)) / kSlots;
  return picture;
}

}  // namespace wavefront
