// Many threads at once: the first calls of a process, and batches while others change the set. ThreadSanitizer runs
// this.
#include <atomic>
#include <thread>

#include <gtest/gtest.h>

#include "support/inputs.h"

namespace vndf::testing {
namespace {

constexpr std::size_t kThreads = 6, kCount = 300;

/// Calls f(thread's number) in threads that begin together.
template <class F>
void together(F f) {
  std::atomic<std::size_t> waiting{kThreads};
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < kThreads; ++i)
    threads.emplace_back([&, i] {
      for (--waiting; waiting > 0;) std::this_thread::yield();
      f(i);
    });
  for (std::thread& thread : threads) thread.join();
}

// Googletest runs suites of this name first: nothing has called the library yet.
TEST(FirstCallsDeathTest, AgreeOnOneSet) {
  std::vector<const char*> names(kThreads);
  together([&](std::size_t i) { names[i] = active_isa(); });
  for (const char* name : names) EXPECT_EQ(name, names[0]);
}

TEST(Threads, BatchesWhileSetsChange) {
  KeepIsa keep;
  const auto& rows = operations();
  std::vector<Table> in, expected;
  for (const Operation& row : rows) {
    in.push_back(mixed_inputs(row, kCount, 1));
    expected.push_back(evaluate(row, in.back()));
  }
  std::vector<std::size_t> differences(kThreads);
  together([&](std::size_t i) {
    for (std::size_t call = 0; call < 40 * rows.size(); ++call) {
      const std::size_t k = (call + i * rows.size() / kThreads) % rows.size();
      if (!same_bits(rows[k], expected[k], evaluate(rows[k], in[k]), in[k])) ++differences[i];
      if (i == 0) (void)set_isa(isas().first[call % std::size_t(isas().last - isas().first)].name);
    }
  });
  for (std::size_t differ : differences) EXPECT_EQ(differ, 0u);
}

}  // namespace
}  // namespace vndf::testing
