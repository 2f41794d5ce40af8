#include "render.h"

#include <array>
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

}  // namespace

Picture render(const Scene& scene, const Task& task, const std::atomic<bool>& stop,
               const std::function<void(double)>& progress) {
  using Time = std::chrono::steady_clock;
  auto begin = Time::now();
  auto seconds = [&] { return std::chrono::duration<double>(Time::now() - begin).count(); };
  Film film(task.crop);
  tbb::enumerable_thread_specific<std::unique_ptr<Worker>> workers([] { return std::make_unique<Worker>(); });
  std::atomic<bool> ended{false};
  std::mutex telling;
  double done = 0., all = static_cast<double>(film.sums.size()) * (task.last_sample - task.first_sample);
  auto run = [&](const Block& block) {
    if (stop || (task.time_limit > 0. && seconds() > task.time_limit)) ended = true;
    if (ended) return;
    Worker& worker = *workers.local();
    trace(scene, task.settings, block, worker);
    film.add(block, worker.radiance);  // no other thread has this tile now
    worker.clock.lap(worker.statistics, Stage::accumulate);
    std::lock_guard<std::mutex> lock(telling);
    done += (block.x1 - block.x0) * (block.y1 - block.y0) * static_cast<double>(block.last - block.first);
    progress(done / all);
  };
  int threads = task.threads > 0 ? task.threads : tbb::this_task_arena::max_concurrency();
  tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::blocked_range2d<int> tiles(task.crop.y0, task.crop.y1, kTile, task.crop.x0, task.crop.x1, kTile);
  tbb::task_arena(threads).execute([&] {
    // A few samples of all tiles before more of any: what is interrupted is a picture too.
    for (std::uint32_t first = task.first_sample, last; first < task.last_sample && !ended; first = last) {
      last = std::min(first + kSamplesAtOnce, task.last_sample);
      tbb::parallel_for(
          tiles,
          [&](const auto& tile) {
            const auto &x = tile.cols(), &y = tile.rows();
            run({x.begin(), y.begin(), x.end(), y.end(), first, last});
          },
          tbb::simple_partitioner());
    }
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
