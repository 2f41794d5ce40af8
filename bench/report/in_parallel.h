// The report's programs on all cores.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

namespace report {

/// One per core, at most 8.
inline unsigned default_threads() {
  return std::min(8u, std::max(1u, std::thread::hardware_concurrency()));
}

/// Calls task(i) for every i below `tasks`, so many at once; whoever is done takes the next.
inline void in_parallel(std::size_t tasks, unsigned threads, const std::function<void(std::size_t)>& task) {
  std::atomic<std::size_t> next{0};
  auto work = [&] {
    for (std::size_t i; (i = next++) < tasks;) task(i);
  };
  std::vector<std::thread> others;
  for (unsigned i = 1; i < threads; ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
}

}  // namespace report
