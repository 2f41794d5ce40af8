// vndf_compare: two builds of the library side by side, by one compiler. Calls of the one and of the other take turns,
// so that a neighbour who comes and goes slows both: ratios are then steady to a percent or two where times of programs
// that run one after the other differ by a quarter.
#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "command_line.h"
#include "operations.h"

namespace {

using bench::Batch, bench::Operation;
using Clock = std::chrono::steady_clock;

[[noreturn]] void fail(const std::string& of, const char* why) {
  std::fprintf(stderr, "vndf_compare: %s %s\n", of.c_str(), why);
  std::exit(2);
}

const bench::Module& load(const std::string& file) {
  void* library = dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  void* module = library ? dlsym(library, "vndf_module") : nullptr;
  if (!module) fail(file, "is no libvndf_operations.so");
  return *static_cast<const bench::Module*>(module);
}

std::regex expression(const std::string& filter) try { return std::regex(filter); } catch (const std::regex_error&) {
  fail("--filter " + filter, "is no regular expression");
}

/// Nanoseconds of a call.
double time_of(const Operation& operation, const Batch& batch, int calls) {
  auto begin = Clock::now();
  for (int i = 0; i < calls; ++i) operation.call(batch);
  return std::chrono::duration<double, std::nano>(Clock::now() - begin).count() / calls;
}

void compare(const std::array<const Operation*, 2>& sides, const Batch& batch, int rounds) {
  constexpr double kTurn = 20e3;  // nanoseconds: long beside the clock's, short beside a neighbour's
  for (const Operation* side : sides) time_of(*side, batch, 1);
  const int calls = std::max(1, static_cast<int>(kTurn / time_of(*sides[0], batch, 1)));
  std::vector<double> ratios;
  std::array<double, 2> least{1e30, 1e30};
  for (int round = 0; round < rounds; ++round) {
    std::array<double, 2> times{};
    for (std::size_t turn : {0u, 1u}) {
      std::size_t side = (turn + static_cast<std::size_t>(round)) % 2;
      times[side] = time_of(*sides[side], batch, calls);
      least[side] = std::min(least[side], times[side]);
    }
    ratios.push_back(times[1] / times[0]);
  }
  std::sort(ratios.begin(), ratios.end());
  auto at = [&](double share) { return ratios[static_cast<std::size_t>(share * static_cast<double>(rounds - 1))]; };
  const auto lanes = static_cast<double>(batch.count);
  std::printf("%-56s %5.3f  %5.3f - %5.3f  %8.3f  %8.3f\n", sides[0]->name.c_str(), at(0.5), at(0.1), at(0.9),
              least[0] / lanes, least[1] / lanes);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compares two builds of the library: their libvndf_operations.so.", "vndf_compare");
  std::string before, after, filter = ".*";
  std::size_t count = 4096;
  int rounds = 151;
  app.add_option("before", before, "of the one build")->required()->check(CLI::ExistingFile);
  app.add_option("after", after, "of the other")->required()->check(CLI::ExistingFile);
  app.add_option("--filter", filter, "a regular expression that is found in <operation>/<warp>/<isa>");
  bench::add_number(app, "--count", count, "lanes of a call", 1, 1 << 24);
  bench::add_number(app, "--rounds", rounds, "turns of each", 1, 100000);
  bench::parse(app, argc, argv);

  const std::regex wanted = expression(filter);
  const std::array<const bench::Module*, 2> modules{&load(before), &load(after)};
  const std::vector<Operation> ones = modules[0]->operations(), others = modules[1]->operations();
  const Batch batch = bench::make_batch("camera", count);
  std::printf("%-56s %5s  %13s  %8s  %8s\n", "", "after", "80 % of turns", "before", "after");
  std::printf("%-56s %5s  %13s  %18s\n", "", "/ bef.", "", "ns a lane, fastest");
  bool any = false;
  for (const Operation& one : ones)
    for (const Operation& other : others) {
      if (one.name != other.name || !std::regex_search(one.name, wanted)) continue;
      if (!modules[0]->set_isa(one) || !modules[1]->set_isa(other)) continue;
      compare({&one, &other}, batch, rounds);
      any = true;
    }
  if (!any) fail("--filter " + filter, "is in no name that both have");
}
