#include "render.h"

#include <array>
#include <chrono>
#include <mutex>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace wavefront {
namespace {

constexpr int kTile = 32;
constexpr std::uint32_t kSamplesAtOnce = kSlots / (kTile * kTile);

struct Film {
  Window crop;
  std::vector<std::array<double, 3>> sums;
  std::vector<std::uint32_t> counts;

  explicit Film(const Window& window) : crop(window) {
    std::size_t pixels = static_cast<std::size_t>(crop.x1 - crop.x0) * (crop.y1 - crop.y0);
    sums.resize(pixels), counts.resize(pixels);
  }
  /// Sample after sample, whatever ran first: the order, and so the sum, is always the same.
  void add(const Block& block, const Columns3& radiance) {
    std::uint32_t slot = 0;
    for (std::uint32_t sample = block.first; sample < block.last; ++sample)
      for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x, ++slot) {
          std::size_t pixel = static_cast<std::size_t>(y - crop.y0) * (crop.x1 - crop.x0) + (x - crop.x0);
          sums[pixel][0] += radiance.x[slot], sums[pixel][1] += radiance.y[slot], sums[pixel][2] += radiance.z[slot];
          ++counts[pixel];
        }
  }
  std::vector<Vec3> means() const {
    std::vector<Vec3> pixels;
    for (std::size_t i = 0; i < sums.size(); ++i) {
      auto mean = [&](double sum) { return counts[i] > 0 ? static_cast<float>(sum / counts[i]) : 0.f; };
      pixels.push_back({mean(sums[i][0]), mean(sums[i][1]), mean(sums[i][2])});
    }
    return pixels;
  }
};

/// Tiles of the crop, all of a few samples before more samples of any: what is interrupted is a picture too.
std::vector<Block> blocks_of(const Task& task) {
  std::vector<Block> blocks;
  const Window& crop = task.crop;
  for (std::uint32_t first = task.first_sample; first < task.last_sample; first += kSamplesAtOnce)
    for (int y = crop.y0; y < crop.y1; y += kTile)
      for (int x = crop.x0; x < crop.x1; x += kTile)
        blocks.push_back({x, y, std::min(x + kTile, crop.x1), std::min(y + kTile, crop.y1), first,
                          std::min(first + kSamplesAtOnce, task.last_sample)});
  return blocks;
}

}  // namespace

Picture render(const Scene& scene, const Task& task, const std::atomic<bool>& stop,
               const std::function<void(double)>& progress) {
  using Time = std::chrono::steady_clock;
  auto begin = Time::now();
  auto seconds = [&] { return std::chrono::duration<double>(Time::now() - begin).count(); };
  Film film(task.crop);
  std::vector<Block> blocks = blocks_of(task);
  std::size_t tiles = 0;
  while (tiles < blocks.size() && blocks[tiles].first == task.first_sample) ++tiles;

  tbb::enumerable_thread_specific<std::unique_ptr<Worker>> workers([] { return std::make_unique<Worker>(); });
  std::atomic<bool> ended{false};
  std::mutex telling;
  std::size_t done = 0;
  auto run = [&](std::size_t number) {
    if (stop || (task.time_limit > 0. && seconds() > task.time_limit)) ended = true;
    if (ended) return;
    Worker& worker = *workers.local();
    trace(scene, task.settings, blocks[number], worker);
    film.add(blocks[number], worker.radiance);  // no other thread has this tile now
    worker.clock.lap(worker.statistics, Stage::accumulate);
    std::lock_guard<std::mutex> lock(telling);
    progress(static_cast<double>(++done) / static_cast<double>(blocks.size()));
  };
  int threads = task.threads > 0 ? task.threads : tbb::this_task_arena::max_concurrency();
  tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena(threads).execute([&] {
    // Samples of one tile come one after the other: a task is a tile of one pass.
    for (std::size_t pass = 0; pass < blocks.size() && !ended; pass += tiles)
      tbb::parallel_for(pass, pass + tiles, run, tbb::simple_partitioner());
  });

  Picture picture{film.means(), {}, seconds(), !ended};
  for (const auto& worker : workers) {
    const Statistics& s = worker->statistics;
    for (int i = 0; i < kStages; ++i) picture.statistics.seconds[i] += s.seconds[i];
    picture.statistics.paths += s.paths, picture.statistics.vertices += s.vertices;
    picture.statistics.shaded_by_library += s.shaded_by_library, picture.statistics.shadow_rays += s.shadow_rays;
  }
  return picture;
}

}  // namespace wavefront
