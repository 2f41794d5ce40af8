// What one thread renders with: its queues, and the stages that take paths through them.
#pragma once

#include <array>
#include <ctime>

#include "bsdf.h"
#include "environment.h"
#include "intersect.h"

namespace wavefront {

struct Settings {
  Sampling sampling;
  bool mis = true;
  std::uint32_t seed = 0;
  int width = 960, height = 540;  // of the whole frame
};

enum class Stage { camera, intersect, bin, gather, lights, library, scatter, shadow, accumulate };
constexpr int kStages = 9;
constexpr const char* kStageNames[kStages] = {"camera",  "intersect", "bin",    "gather",    "lights",
                                              "library", "scatter",   "shadow", "accumulate"};
struct Statistics {
  std::array<double, kStages> seconds{};
  std::uint64_t paths = 0, vertices = 0, shaded_by_library = 0, shadow_rays = 0;
};
/// Adds the thread's processor time since the last call to a stage: what else the machine does counts little. Clocks
/// are read a few times for hundreds of items.
class Clock {
 public:
  void lap(Statistics& statistics, Stage stage) {
    double now = seconds();
    statistics.seconds[static_cast<int>(stage)] += now - last_;
    last_ = now;
  }

 private:
  static double seconds() {
    std::timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  double last_ = seconds();
};

/// Pixels [x0, x1) x [y0, y1) and samples [first, last).
struct Block {
  int x0, y0, x1, y1;
  std::uint32_t first, last;
};
constexpr std::uint32_t kSlots = 16384;  // paths of the largest block

/// Vertices of a batch beside the library's columns.
struct Vertices {
  std::uint32_t path[kBatch];
  const Material* material[kBatch];
  Frame frame[kBatch];
  Vec3 position[kBatch], normal[kBatch], color[kBatch];
  LightSample light[kBatch];
  float keep[kBatch];  // the random number of Russian roulette
  Column<float> light_u{kBatch}, light_v{kBatch}, select{kBatch}, disk_x{kBatch}, disk_y{kBatch};
};

struct Worker {
  Paths paths, next;
  Hits hits;
  ShadowRays shadows;
  Batch batch;
  Vertices vertices;
  Columns3 radiance{kSlots};
  Statistics statistics;
  Clock clock;
};

/// Radiance of all paths of a block, into worker.radiance: sample by sample, each row by row.
void trace(const Scene& scene, const Settings& settings, const Block& block, Worker& worker);
/// Shades paths [first, last) of the order of hits, which are of one bin.
void shade(const Scene& scene, const Settings& settings, const Bin& bin, std::uint32_t first, std::uint32_t last,
           Worker& worker);

}  // namespace wavefront
