// A frame, or a part of one, on all threads.
#pragma once

#include <atomic>
#include <functional>

#include "queues.h"

namespace wavefront {

struct Picture {
  std::vector<Vec3> pixels;  // of the crop: means
  Statistics statistics;     // of all threads together
  double seconds = 0.;
  bool complete = true;  // else the time or the patience ended
};

/// `progress` is told the share that is done, from any thread, one at a time. Where `stop` becomes true, what there is
/// so far is returned.
Picture render(const Scene& scene, const Task& task, const std::atomic<bool>& stop,
               const std::function<void(double)>& progress);

}  // namespace wavefront
