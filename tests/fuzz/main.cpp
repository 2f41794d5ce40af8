// Calls at random until the time or the number of calls is over:
//   vndf_fuzz [--calls n] [--seconds n] [--seed n [--first n]]
// Without a seed, a new one. The seed and the number of a call make it again: --seed s --first n --calls 1.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>

#include "fuzz/call.h"

int main(int argc, char** argv) {
  std::uint64_t seed = std::random_device()(), calls = UINT64_MAX, first = 0, seconds = 60;
  for (int i = 1; i < argc; i += 2) {
    char* end = nullptr;
    const std::uint64_t value = i + 1 < argc ? std::strtoull(argv[i + 1], &end, 0) : 0;
    const bool is_number = end && end != argv[i + 1] && !*end;
    if (is_number && !std::strcmp(argv[i], "--seed")) {
      seed = value;
    } else if (is_number && !std::strcmp(argv[i], "--calls")) {
      calls = value, seconds = UINT32_MAX;
    } else if (is_number && !std::strcmp(argv[i], "--first")) {
      first = value;
    } else if (is_number && !std::strcmp(argv[i], "--seconds")) {
      seconds = value;
    } else {
      std::fprintf(stderr, "usage: vndf_fuzz [--calls n] [--seconds n] [--seed n [--first n]]\n");
      return 2;
    }
  }
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  std::fflush(stdout);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
  double lanes = 0;
  std::uint64_t call = 0;
  for (; call < calls && std::chrono::steady_clock::now() < end; ++call) {
    vndf::fuzz::Source source(seed, first + call);
    const auto outcome = vndf::fuzz::make_call(source);
    lanes += double(outcome.lanes);
    if (!outcome.fault.empty()) {
      std::printf("fault in call %llu: %s\n", static_cast<unsigned long long>(first + call), outcome.fault.c_str());
      return 1;
    }
  }
  std::printf("%llu calls, %.4g lanes on all sets, no fault\n", static_cast<unsigned long long>(call), lanes);
}
