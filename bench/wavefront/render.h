// A frame, or a part of one, on all threads.
#pragma once

#include <atomic>
#include <functional>

#include "images.h"
#include "worker.h"

namespace wavefront {

struct Task {
  Settings settings;
  Window crop;
  std::uint32_t first_sample = 0, last_sample = 64;
  int threads = 0;         // 0: as many as there are
  double time_limit = 0.;  // in seconds, 0: none
};
struct Picture {
  std::vector<Vec3> pixels;  // of the crop: means
  Statistics statistics;     // seconds are those of all threads together
  double seconds = 0.;
  bool complete = true;  // else the time or the patience ended
};

/// `progress` is told the share that is done, from any thread, one at a time. Where `stop` becomes true, what there is
/// so far is returned.
Picture render(const Scene& scene, const Task& task, const std::atomic<bool>& stop,
               const std::function<void(double)>& progress);

}  // namespace wavefront
