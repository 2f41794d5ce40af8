// vndf_bench: throughput of the library, its peers and a plain copy, on Google Benchmark.
//
// Names: <operation>/<warp>/<isa>/<input>/<count>, e.g. sample_normals/polar/avx512/camera/4096. A peer's name stands
// for its operation. Counters: items_per_second (samples) bytes_per_second (columns read and written) and
// time_per_sample (in seconds; the console shows nanoseconds).
#include <benchmark/benchmark.h>

#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <vndf/vndf.h>

#include "command_line.h"
#include "operations.h"
#include "peers.h"

// One line per instruction set of the library: VNDF_COPY(isa).
using CopyFunction = peers::Sample;
#define VNDF_COPY(isa) CopyFunction copy_plain_##isa, copy_streaming_##isa;
#include "copies.h"
#undef VNDF_COPY

namespace {

using bench::Call, bench::Operation;

struct Data {
  const char* input;
  std::size_t count;
};
constexpr Data kData[] = {{"camera", 1},     {"camera", 2},        {"camera", 4},
                          {"camera", 8},     {"camera", 12},       {"camera", 16},
                          {"camera", 24},    {"camera", 32},       {"camera", 64},
                          {"camera", 256},   {"camera", 1024},     {"camera", 4096},
                          {"camera", 32768}, {"camera", 262144},   {"camera", 4194304},
                          {"uniform", 4096}, {"uniform", 4194304}, {"camera_unaligned", 4096}};

/// Batches live as long as the program: benchmarks may be repeated and interleaved.
const bench::Batch& batch_of(const Data& data) {
  static std::map<std::pair<std::string, std::size_t>, bench::Batch> batches;
  auto [entry, missing] = batches.try_emplace({data.input, data.count});
  if (missing) entry->second = bench::make_batch(data.input, data.count);
  return entry->second;
}

void measure(benchmark::State& state, const Operation& operation, const bench::Batch& batch) {
  if (!set_isa(operation)) state.SkipWithError("instruction set refused");
  for (auto _ : state) {
    operation.call(batch);
    benchmark::ClobberMemory();  // the arena escaped when it was allocated: its contents count as used
  }
  double samples = static_cast<double>(state.iterations()) * static_cast<double>(batch.count);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(batch.count));
  state.SetBytesProcessed(state.items_processed() * operation.columns * static_cast<std::int64_t>(sizeof(float)));
  using benchmark::Counter;
  state.counters["time_per_sample"] = Counter(samples, Counter::kIsRate | Counter::kInvert);
}

Call columns(CopyFunction* function) {
  return [function](const bench::Batch& b) { function(b.count, b.in.data(), b.out.data()); };
}

/// Peers, the library, and the copy.
std::vector<Operation> all_operations() {
  std::vector<Operation> all;
  auto supported = [](const char* name) {
    for (const vndf::Isa& isa : vndf::isas())
      if (isa.supported && std::strcmp(isa.name, name) == 0) return true;
    return false;
  };
  for (const peers::Peer& peer : peers::peers())
    if (peer.supported)
      all.push_back(
          {std::string(peer.name) + "/" + peer.warp + "/" + peer.isa, nullptr, peer.columns, columns(peer.sample)});
  for (const Operation& operation : bench::operations()) all.push_back(operation);
#define VNDF_COPY(isa)                                                                   \
  if (supported(#isa)) {                                                                 \
    all.push_back({"copy/plain/" #isa, nullptr, 10, columns(copy_plain_##isa)});         \
    all.push_back({"copy/streaming/" #isa, nullptr, 10, columns(copy_streaming_##isa)}); \
  }
#include "copies.h"
#undef VNDF_COPY
  return all;
}

void register_benchmarks() {
  const std::vector<Operation> all = all_operations();
  for (const Data& data : kData)
    for (const Operation& operation : all) {
      bool aligned_only = operation.name.rfind("copy/streaming", 0) == 0;
      if (aligned_only && std::strcmp(data.input, "camera_unaligned") == 0) continue;
      if (operation.once && (std::strcmp(data.input, "camera") != 0 || data.count != 4096)) continue;
      std::string name = operation.name + "/" + data.input + "/" + std::to_string(data.count);
      benchmark::RegisterBenchmark(
          name.c_str(), [operation, data](benchmark::State& state) { measure(state, operation, batch_of(data)); });
    }

  // Two threads, each on columns of its own, on the best set. Real time: the processor times of two threads add up.
  const std::string best = std::string("sample_normals/polar/") + vndf::active_isa();
  for (const Operation& operation : all) {
    if (operation.name != best) continue;
    auto two_threads = [operation](benchmark::State& state) {
      measure(state, operation, bench::make_batch("camera", 4096));
    };
    benchmark::RegisterBenchmark((best + "/camera/4096").c_str(), two_threads)->Threads(2)->UseRealTime();
  }
}

constexpr char kFooter[] =
    R"(Benchmarks are named <operation>/<warp>/<isa>/<input>/<count>. The options are Google Benchmark's:
  --benchmark_list_tests                          names, and nothing is run
  --benchmark_filter=REGEX                        those whose names match; -REGEX: the others
  --benchmark_min_time=SECONDS                    of one repetition
  --benchmark_repetitions=N                       with --benchmark_report_aggregates_only for medians alone
  --benchmark_enable_random_interleaving=true     repetitions of all benchmarks in random order
  --benchmark_out=FILE                            results as a file as well
and all others that it has.)";

/// For the report, which marks what this machine cannot run.
void tell_isas() {
  std::string measured, missing;
  for (const vndf::Isa& isa : vndf::isas()) (isa.supported ? measured : missing) += std::string(isa.name) + " ";
  benchmark::AddCustomContext("isas", measured);
  benchmark::AddCustomContext("missing_isas", missing);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Throughput of the library, its peers and a plain copy, in samples per second.", "vndf_bench");
  app.footer(kFooter);
  // These two are read here because Google Benchmark answers a value it does not know with its usage and success.
  std::string format;
  for (const char* option : {"--benchmark_format", "--benchmark_out_format"})
    app.add_option(option, format, "of the console or of the file")->check(CLI::IsMember({"console", "json", "csv"}));
  app.allow_extras();
  bench::parse(app, argc, argv);
  benchmark::Initialize(&argc, argv);
  app.allow_extras(false);  // what is left now is known to neither
  bench::parse(app, argc, argv);

  tell_isas();
  register_benchmarks();
  if (benchmark::RunSpecifiedBenchmarks() == 0) return 2;  // it has said that the filter matches nothing
  benchmark::Shutdown();
}
