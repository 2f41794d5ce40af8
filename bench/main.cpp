// vndf_bench: throughput of the library, its peers and a plain copy, on Google Benchmark.
//
// Names: <operation>/<warp>/<isa>/<input>/<count>, e.g. sample_normals/polar/avx512/camera/4096. A peer's name stands
// for its operation. Counters: items_per_second (samples) bytes_per_second (columns read and written) and
// time_per_sample (in seconds; the console shows nanoseconds).
#include <benchmark/benchmark.h>

#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <vndf/ellipsoid.h>
#include <vndf/vndf.h>

#include "command_line.h"
#include "inputs.h"
#include "peers.h"
#include "warps.h"

// One line per instruction set of the library: VNDF_COPY(isa).
using CopyFunction = peers::Sample;
#define VNDF_COPY(isa) CopyFunction copy_plain_##isa, copy_streaming_##isa;
#include "copies.h"
#undef VNDF_COPY

namespace {

/// One call on all of a batch.
using Call = std::function<void(const bench::Batch&)>;

struct Operation {
  std::string name;  // <operation>/<warp>/<isa>
  const char* isa;   // to set in the library, or null
  int columns;       // read and written
  Call call;
  bool once = false;  // with camera/4096 alone
};

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

void measure(benchmark::State& state, const Call& call, int columns, const bench::Batch& batch) {
  for (auto _ : state) {
    call(batch);
    benchmark::ClobberMemory();  // the arena escaped when it was allocated: its contents count as used
  }
  double samples = static_cast<double>(state.iterations()) * static_cast<double>(batch.count);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(batch.count));
  state.SetBytesProcessed(state.items_processed() * columns * static_cast<std::int64_t>(sizeof(float)));
  using benchmark::Counter;
  state.counters["time_per_sample"] = Counter(samples, Counter::kIsRate | Counter::kInvert);
}

void set_isa(benchmark::State& state, const char* isa) {
  if (isa && vndf::set_isa(isa) != vndf::IsaError::none) state.SkipWithError("instruction set refused");
}

vndf::Columns3 wo(const bench::Batch& b) {
  return {b.in[0], b.in[1], b.in[2]};
}
vndf::Columns2 alpha(const bench::Batch& b) {
  return {b.in[3], b.in[4]};
}
vndf::Columns2 u(const bench::Batch& b) {
  return {b.in[5], b.in[6]};
}
vndf::Columns3 light(const bench::Batch& b) {
  return {b.in[11], b.in[12], b.in[13]};
}
vndf::Columns3 light_on_both_sides(const bench::Batch& b) {
  return {b.in[11], b.in[12], b.in[14]};
}
vndf::Out3 wm(const bench::Batch& b) {
  return {b.out[0], b.out[1], b.out[2]};
}
vndf::Out3 wi(const bench::Batch& b) {
  return {b.out[3], b.out[4], b.out[5]};
}

Call sample_normals(vndf::Warp warp) {
  return [warp](const bench::Batch& b) { vndf::sample_normals(warp, b.count, wo(b), alpha(b), u(b), wm(b)); };
}

// Ellipsoids: five constants, theta_z per lane, five columns.
struct EllipsoidKind {
  const char* name;
  int columns;  // read
  vndf::Ellipsoid (*of)(const bench::Batch&);
};
constexpr EllipsoidKind kEllipsoids[] = {
    {"one_shape", 0,
     [](const bench::Batch&) {
       return vndf::Ellipsoid({0.2f, 0.5f}, 0.3f, -0.2f, 0.5f);
     }},
    {"turned", 3, [](const bench::Batch& b) { return vndf::Ellipsoid(alpha(b), 0.f, 0.f, b.in[10]); }},
    {"tilted", 5, [](const bench::Batch& b) { return vndf::Ellipsoid(alpha(b), b.in[8], b.in[9], b.in[10]); }},
};
Call sample_normals(vndf::Warp warp, const EllipsoidKind& kind) {
  return [=](const bench::Batch& b) { vndf::sample_normals(warp, b.count, wo(b), kind.of(b), u(b), wm(b)); };
}
Call sample_reflection(vndf::Warp warp, const EllipsoidKind& kind) {
  return [=](const bench::Batch& b) {
    vndf::sample_reflection(warp, b.count, wo(b), kind.of(b), u(b), {wi(b), b.out[6], b.out[7]});
  };
}

Call sample_disk(vndf::DiskMap map) {
  return [map](const bench::Batch& b) { vndf::sample_disk(map, b.count, u(b), {b.out[0], b.out[1]}); };
}

Call sample_reflection(vndf::Warp warp, bool bounded = false) {
  vndf::ReflectionOptions options;
  options.bounded = bounded;
  return [=](const bench::Batch& b) {
    vndf::sample_reflection(warp, b.count, wo(b), alpha(b), u(b), {wi(b), b.out[6], b.out[7]}, options);
  };
}

/// What sample_reflection does, in three passes: normals, reflected directions, their density and weight. The loops of
/// this file are compiled for the baseline of the processor's architecture.
Call separate_reflection(vndf::Warp warp) {
  return [warp](const bench::Batch& b) {
    vndf::sample_normals(warp, b.count, wo(b), alpha(b), u(b), wm(b));
    for (std::size_t i = 0; i < b.count; ++i) {
      float twice_cos = 2 * (b.in[0][i] * b.out[0][i] + b.in[1][i] * b.out[1][i] + b.in[2][i] * b.out[2][i]);
      for (int c = 0; c < 3; ++c) b.out[3 + c][i] = twice_cos * b.out[c][i] - b.in[c][i];
    }
    vndf::evaluate_reflection(b.count, wo(b), {b.out[3], b.out[4], b.out[5]}, alpha(b), {b.out[7], b.out[6]});
    for (std::size_t i = 0; i < b.count; ++i) b.out[7][i] = b.out[6][i] > 0 ? b.out[7][i] / b.out[6][i] : 0;
  };
}

Call evaluate_reflection() {
  return [](const bench::Batch& b) {
    vndf::evaluate_reflection(b.count, wo(b), light(b), alpha(b), {b.out[6], b.out[7]});
  };
}
Call evaluate_reflection(const EllipsoidKind& kind) {
  return [=](const bench::Batch& b) {
    vndf::evaluate_reflection(b.count, wo(b), light(b), kind.of(b), {b.out[6], b.out[7]});
  };
}
Call pdf_normals() {
  return [](const bench::Batch& b) { vndf::pdf_normals(b.count, wo(b), light(b), alpha(b), b.out[6]); };
}

constexpr float kEta = 1.5f;
Call sample_dielectric(vndf::Warp warp) {
  return [warp](const bench::Batch& b) {
    vndf::sample_dielectric(warp, b.count, wo(b), alpha(b), kEta, {b.in[5], b.in[6], b.in[7]},
                            {wi(b), b.out[6], b.out[7], b.out[0]});
  };
}
Call evaluate_dielectric() {
  return [](const bench::Batch& b) {
    vndf::evaluate_dielectric(b.count, wo(b), light(b), alpha(b), kEta, {b.out[6], b.out[7]});
  };
}

// Options, of the concentric warp and for the evaluations; those of dielectrics with lights on both sides.
Call sample_reflection(const vndf::ReflectionOptions& options) {
  return [=](const bench::Batch& b) {
    vndf::sample_reflection(vndf::Warp::concentric, b.count, wo(b), alpha(b), u(b), {wi(b), b.out[6], b.out[7]},
                            options);
  };
}
Call sample_reflection_all_outputs() {
  return [](const bench::Batch& b) {
    vndf::sample_reflection(vndf::Warp::concentric, b.count, wo(b), alpha(b), u(b),
                            {wi(b), b.out[6], b.out[7], wm(b), b.out[9]});
  };
}
Call evaluate_reflection_all_outputs() {
  return [](const bench::Batch& b) {
    vndf::evaluate_reflection(b.count, wo(b), light(b), alpha(b), {b.out[6], b.out[7], b.out[9]});
  };
}
struct DielectricKind {
  const char* name;
  vndf::AcrossMasking across;
  bool radiance;
  bool given;  // the probability of reflection, one value
};
constexpr DielectricKind kDielectrics[] = {
    {"_as_reflection", vndf::AcrossMasking::as_reflection, false, false},
    {"_correlated_across", vndf::AcrossMasking::height_correlated, false, false},
    {"_radiance", vndf::AcrossMasking::separable, true, false},
    {"_probability", vndf::AcrossMasking::separable, false, true},
};
vndf::DielectricOptions options_of(const DielectricKind& kind) {
  vndf::DielectricOptions options;
  options.across = kind.across;
  options.radiance = kind.radiance;
  if (kind.given) options.reflection_probability = 0.5f;
  return options;
}
Call sample_dielectric(const DielectricKind& kind) {
  return [options = options_of(kind)](const bench::Batch& b) {
    vndf::sample_dielectric(vndf::Warp::concentric, b.count, wo(b), alpha(b), kEta, {b.in[5], b.in[6], b.in[7]},
                            {wi(b), b.out[6], b.out[7], b.out[8]}, options);
  };
}
Call sample_dielectric_all_outputs() {
  return [](const bench::Batch& b) {
    vndf::sample_dielectric(vndf::Warp::concentric, b.count, wo(b), alpha(b), kEta, {b.in[5], b.in[6], b.in[7]},
                            {wi(b), b.out[6], b.out[7], b.out[8], wm(b), b.out[9], b.out[10], b.out[11]});
  };
}
Call evaluate_dielectric(const vndf::DielectricOptions& options) {
  return [=](const bench::Batch& b) {
    vndf::evaluate_dielectric(b.count, wo(b), light_on_both_sides(b), alpha(b), kEta, {b.out[6], b.out[7]}, options);
  };
}

Call columns(CopyFunction* function) {
  return [function](const bench::Batch& b) { function(b.count, b.in.data(), b.out.data()); };
}

std::vector<Operation> operations() {
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
  for (const vndf::Isa& isa : vndf::isas()) {
    if (!isa.supported) continue;
    auto add = [&](const std::string& name, int columns, Call call) {
      all.push_back({name + "/" + isa.name, isa.name, columns, std::move(call)});
    };
    for (auto [warp, name] : bench::kWarps) add(std::string("sample_normals/") + name, 10, sample_normals(warp));
    for (const EllipsoidKind& kind : kEllipsoids) {
      std::string suffix = std::string("_") + kind.name + "/";
      for (auto [warp, name] : bench::kWarps) {
        add("sample_normals" + suffix + name, 8 + kind.columns, sample_normals(warp, kind));
        add("sample_reflection" + suffix + name, 10 + kind.columns, sample_reflection(warp, kind));
      }
      add("evaluate_reflection" + suffix + "none", 8 + kind.columns, evaluate_reflection(kind));
    }
    add("sample_disk/polar", 4, sample_disk(vndf::DiskMap::polar));
    add("sample_disk/concentric", 4, sample_disk(vndf::DiskMap::concentric));
    for (auto [warp, name] : bench::kWarps) add(std::string("sample_reflection/") + name, 12, sample_reflection(warp));
    add("sample_reflection_bounded/spherical_cap", 12, sample_reflection(vndf::Warp::spherical_cap, true));
    add("separate_reflection/polar", 12, separate_reflection(vndf::Warp::polar));
    add("evaluate_reflection/none", 10, evaluate_reflection());
    add("pdf_normals/none", 9, pdf_normals());
    for (auto [warp, name] : bench::kWarps) add(std::string("sample_dielectric/") + name, 14, sample_dielectric(warp));
    add("evaluate_dielectric/none", 10, evaluate_dielectric());

    auto add_option = [&](const std::string& name, int columns, Call call) {
      add(name, columns, std::move(call));
      all.back().once = true;
    };
    add_option("sample_reflection_two_sided/concentric", 12, sample_reflection({{}, false, true}));
    add_option("sample_reflection_all_outputs/concentric", 16, sample_reflection_all_outputs());
    add_option("evaluate_reflection_all_outputs/none", 11, evaluate_reflection_all_outputs());
    for (const DielectricKind& kind : kDielectrics) {
      add_option(std::string("sample_dielectric") + kind.name + "/concentric", 14, sample_dielectric(kind));
      add_option(std::string("evaluate_dielectric") + kind.name + "/none", 10, evaluate_dielectric(options_of(kind)));
    }
    add_option("evaluate_dielectric_both_sides/none", 10, evaluate_dielectric(vndf::DielectricOptions{}));
    add_option("sample_dielectric_all_outputs/concentric", 20, sample_dielectric_all_outputs());
  }
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
  const std::vector<Operation> all = operations();
  for (const Data& data : kData)
    for (const Operation& operation : all) {
      bool aligned_only = operation.name.rfind("copy/streaming", 0) == 0;
      if (aligned_only && std::strcmp(data.input, "camera_unaligned") == 0) continue;
      if (operation.once && (std::strcmp(data.input, "camera") != 0 || data.count != 4096)) continue;
      std::string name = operation.name + "/" + data.input + "/" + std::to_string(data.count);
      benchmark::RegisterBenchmark(name.c_str(), [operation, data](benchmark::State& state) {
        set_isa(state, operation.isa);
        measure(state, operation.call, operation.columns, batch_of(data));
      });
    }

  // Two threads, each on columns of its own, on the best set. Real time: the processor times of two threads add up.
  const char* best = vndf::active_isa();
  std::string name = std::string("sample_normals/polar/") + best + "/camera/4096";
  auto two_threads = [best](benchmark::State& state) {
    set_isa(state, best);
    measure(state, sample_normals(vndf::Warp::polar), 10, bench::make_batch("camera", 4096));
  };
  benchmark::RegisterBenchmark(name.c_str(), two_threads)->Threads(2)->UseRealTime();
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
