// What one thread renders with. Queues are structures of arrays whose capacity is fixed up front. Paths live in one of
// two path queues; what shading lets live is appended to the other, which is all the compaction there is.
#pragma once

#include <array>
#include <cstdint>
#include <ctime>
#include <memory>

#include "bsdf.h"
#include "images.h"
#include "lights.h"

namespace wavefront {

/// Paths under way, and paths of the largest block of a frame. Columns lie one behind the other: if they were a power
/// of two long, the same items of all of them would compete for the same lines of the cache.
constexpr std::uint32_t kCapacity = 4080, kSlots = 16384;

struct Paths {
  std::uint32_t count = 0;
  Columns3<kCapacity> origin, direction, throughput;
  float pdf[kCapacity];  // of the direction, by the BSDF
  std::uint32_t slot[kCapacity], depth[kCapacity];
};
/// What the paths met, and in which order they are shaded.
struct Hits {
  Primitive primitive[kCapacity];
  std::uint32_t order[kCapacity];
};
struct ShadowRays {
  std::uint32_t count = 0;
  Columns3<kCapacity> origin, direction, radiance;
  float distance[kCapacity];
  std::uint32_t slot[kCapacity];
};
/// What stays with a path of a block from its camera ray on: where its random numbers come from, and what it has found.
struct Slots {
  std::uint32_t seed[kSlots], sample[kSlots];
  Columns3<kSlots> radiance;
};
/// Vertices of a batch beside the library's columns.
struct Vertices {
  std::uint32_t path[kBatch];
  const Material* material[kBatch];
  Frame frame[kBatch];
  Vec3 position[kBatch], normal[kBatch], color[kBatch];
  LightSample light[kBatch];
  Columns3<kBatch> light_u;
  float keep[kBatch];  // the random number of Russian roulette
};
/// Bytes of all queues for one path under way, and of its slot.
constexpr std::size_t kBytesPerPath =
    (2 * sizeof(Paths) + sizeof(Hits) + sizeof(ShadowRays)) / kCapacity + sizeof(Slots) / kSlots;

/// What is measured: processor seconds of the stages, and counts. Shaded vertices are those of the library.
struct Figure {
  enum { camera, intersect, bin, gather, lights, library, scatter, shadow, accumulate, paths, vertices, shaded, rays };
};
constexpr const char* kFigures[] = {"camera", "intersect",  "bin",   "gather",   "lights", "library", "scatter",
                                    "shadow", "accumulate", "paths", "vertices", "shaded", "rays"};
using Statistics = std::array<double, std::size(kFigures)>;

struct Worker {
  std::unique_ptr<Paths> paths = std::make_unique<Paths>(), next = std::make_unique<Paths>();
  Hits hits;
  ShadowRays shadows;
  Slots slots;
  Batch batch;
  Vertices vertices;
  Statistics statistics{};

  /// Adds the thread's processor time since the last call to a stage: what else the machine does counts little. Clocks
  /// are read a few times for hundreds of items.
  void lap(int stage) {
    double before = clock;
    clock = seconds();
    statistics[stage] += clock - before;
  }
  static double seconds() {
    std::timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  double clock;
};

/// A frame, or a part of one.
struct Task {
  Sampling sampling;
  bool mis = true;
  std::uint32_t seed = 0;
  int width = 960, height = 540;  // of the whole frame
  Window crop{0, 0, 960, 540};
  std::uint32_t first_sample = 0, last_sample = 64;
  int threads = 0;         // 0: as many as there are
  double time_limit = 0.;  // in seconds, 0: none
};
/// Samples [first, last) of a window's pixels.
struct Block {
  Window window;
  std::uint32_t first, last;

  std::uint32_t paths() const { return window.width() * window.height() * (last - first); }
};

/// Radiance of all paths of a block, into the slots: sample by sample, each row by row.
void trace(const Scene& scene, const Task& task, const Block& block, Worker& worker);
/// Shades paths [first, last) of the order of hits, which are of one kind.
void shade(const Scene& scene, const Task& task, Kind kind, std::uint32_t first, std::uint32_t last, Worker& worker);

}  // namespace wavefront
