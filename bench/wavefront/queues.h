// What one thread renders with. Queues are structures of arrays whose capacity is fixed up front. Paths live in one of
// two path queues; what shading lets live is appended to the other, which is all the compaction there is.
#pragma once

#include <ctime>

#include "render.h"

namespace wavefront {

/// Paths under way, and paths of the largest block of a frame. Columns lie one behind the other: if they were a power
/// of two long, the same items of all of them would compete for the same lines of the cache.
constexpr std::uint32_t kCapacity = 4080, kSlots = 16384;

/// Rays, and the share of the light that they find which reaches the camera.
struct Rays {
  std::uint32_t count = 0;
  Columns3<kCapacity> origin, direction, throughput;
  std::uint32_t slot[kCapacity];

  /// Answers the ray's number.
  std::uint32_t add(Vec3 from, Vec3 towards, Vec3 share, std::uint32_t of_slot) {
    origin.set(count, from);
    direction.set(count, towards);
    throughput.set(count, share);
    slot[count] = of_slot;
    return count++;
  }
};
struct Paths : Rays {
  float pdf[kCapacity];  // of the direction, by the BSDF
  std::uint32_t depth[kCapacity];
};
/// Their throughput is the light that is there where nothing is in between.
struct ShadowRays : Rays {
  float distance[kCapacity];
};
/// The paths that met one kind of surface.
struct Bin {
  std::uint32_t count, path[kCapacity];
};

struct Worker {
  std::unique_ptr<Paths> paths = std::make_unique<Paths>(), next = std::make_unique<Paths>();
  Primitive hits[kCapacity];  // what the paths met
  Bin bins[kKinds];
  ShadowRays shadows;
  Batch batch;
  // What stays with a path of a block from its camera ray on: where its random numbers come from, what it has found.
  std::uint32_t seed[kSlots], sample[kSlots];
  Columns3<kSlots> radiance;
  Statistics statistics;

  /// Adds the thread's processor time since the last call to a stage: what else the machine does counts little. Clocks
  /// are read a few times for hundreds of items.
  void lap(const char* stage) {
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

/// Shades a batch of the bin of a kind, from number `first` on.
void shade(const Scene& scene, const Task& task, Kind kind, std::uint32_t first, Worker& worker);

}  // namespace wavefront
