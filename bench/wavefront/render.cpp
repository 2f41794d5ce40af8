#include "render.h"

#include <chrono>
#include <mutex>

#include <tbb/blocked_range2d.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace wavefront {
namespace {

constexpr int kTile = 32;
constexpr std::uint32_t kSamplesAtOnce = kSlots / (kTile * kTile);

/// Sums of radiance, and in `w` how many there are.
using Film = std::vector<Imath::V4d>;

/// Sample after sample, whatever ran first: the order, and so the sum, is always the same.
void add(const Window& crop, const Block& block, const Columns3<kSlots>& radiance, Film& film) {
  std::uint32_t slot = 0;
  for (std::uint32_t sample = block.first; sample < block.last; ++sample)
    for (int y = block.window.y0; y < block.window.y1; ++y)
      for (int x = block.window.x0; x < block.window.x1; ++x, ++slot)
        film[(y - crop.y0) * std::size_t(crop.width()) + (x - crop.x0)] +=
            Imath::V4d(radiance.x[slot], radiance.y[slot], radiance.z[slot], 1.);
}

}  // namespace

Picture render(const Scene& scene, const Task& task, const std::atomic<bool>& stop,
               const std::function<void(double)>& progress) {
  using Time = std::chrono::steady_clock;
  auto begin = Time::now();
  auto seconds = [&] { return std::chrono::duration<double>(Time::now() - begin).count(); };
  const Window& crop = task.crop;
  Film film(crop.pixels(), Imath::V4d(0.));
  tbb::enumerable_thread_specific<std::unique_ptr<Worker>> workers([] { return std::make_unique<Worker>(); });
  std::atomic<bool> ended{false};
  std::mutex telling;
  double done = 0., all = static_cast<double>(crop.pixels()) * (task.last_sample - task.first_sample);
  auto run = [&](const Block& block) {
    if (stop || (task.time_limit > 0. && seconds() > task.time_limit)) ended = true;
    if (ended) return;
    Worker& worker = *workers.local();
    trace(scene, task, block, worker);
    add(crop, block, worker.slots.radiance, film);  // no other thread has this tile now
    worker.lap(Figure::accumulate);
    std::lock_guard<std::mutex> lock(telling);
    done += block.paths();
    progress(done / all);
  };
  tbb::task_arena arena(task.threads > 0 ? task.threads : tbb::task_arena::automatic);
  tbb::global_control control(tbb::global_control::max_allowed_parallelism, arena.max_concurrency());
  tbb::blocked_range2d<int> tiles(crop.y0, crop.y1, kTile, crop.x0, crop.x1, kTile);
  arena.execute([&] {
    // A few samples of all tiles before more of any: what is interrupted is a picture too.
    for (std::uint32_t first = task.first_sample, last; first < task.last_sample && !ended; first = last) {
      last = std::min(first + kSamplesAtOnce, task.last_sample);
      auto run_tile = [&](const tbb::blocked_range2d<int>& tile) {
        const auto &x = tile.cols(), &y = tile.rows();
        run({{x.begin(), y.begin(), x.end(), y.end()}, first, last});
      };
      tbb::parallel_for(tiles, run_tile, tbb::simple_partitioner());
    }
  });

  Picture picture{{}, {}, seconds(), !ended};
  for (const Imath::V4d& sum : film)
    picture.pixels.push_back(Vec3(Imath::V3d(sum.x, sum.y, sum.z) / std::max(sum.w, 1.)));
  for (const auto& worker : workers)
    for (std::size_t i = 0; i < std::size(kFigures); ++i) picture.statistics[i] += worker->statistics[i];
  return picture;
}

}  // namespace wavefront
