// vndf_errors: how far the library's normals and its peers' are from the exact ones, for every hard case.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <vndf/vndf.h>

#include "arguments.h"
#include "in_parallel.h"
#include "json.h"
#include "peers.h"
#include "reference/errors.h"
#include "reference/ratio.h"

namespace {

using namespace vndf;
using namespace vndf::reference;
using report::number;

constexpr std::uint64_t kSeed = 2018;

constexpr struct {
  Warp warp;
  const char* name;
} kWarps[] = {{Warp::polar, "polar"}, {Warp::concentric, "concentric"}, {Warp::spherical_cap, "spherical_cap"}};

struct Options {
  std::size_t samples = std::size_t(1) << 22;
  std::size_t peer_samples = std::size_t(1) << 17;
  unsigned threads = report::default_threads();
  std::string only;
  std::string out = "-";
};

constexpr char kHelp[] =
    R"(vndf_errors: measures the library's normals and its peers' against exact ones, for every hard case

  --samples N        samples per hard case and warp of the library's (default 4194304)
  --peer-samples N   samples per hard case of each peer (default 131072)
  --threads N        hard cases measured at once; each takes about 70 bytes a sample (default: one per core, at most 8)
  --row NAME         this hard case only
  --out FILE         where the JSON goes (default -, standard output); progress is on standard error
)";

Options parse(int argc, char** argv) {
  Options options;
  report::Arguments arguments(argc, argv);
  while (arguments.more()) {
    if (arguments.common(kHelp, options.out)) continue;
    if (arguments.is("--samples")) {
      options.samples = std::size_t(arguments.number(1, 1 << 28));
    } else if (arguments.is("--peer-samples")) {
      options.peer_samples = std::size_t(arguments.number(1, 1 << 28));
    } else if (arguments.is("--threads")) {
      options.threads = unsigned(arguments.number(1, 1024));
    } else if (arguments.is("--row")) {
      options.only = arguments.value();
      auto named = [&](const HardCase& row) { return row.name == options.only; };
      if (std::none_of(hard_cases().begin(), hard_cases().end(), named)) {
        arguments.fail("no hard case is called '" + options.only + "'");
      }
    } else {
      arguments.unknown();
    }
  }
  return options;
}

/// One line of the result.
struct Row {
  std::string implementation, warp, isa;
  const HardCase* hard_case;
  std::size_t samples;
  NormalErrors errors;
  std::size_t nonfinite = 0;
  bool shared_domain = false;
  std::string worst_input;
  double ratio = -1;  // of our normals, or negative
};

struct Normals {
  std::vector<float> x, y, z;
  explicit Normals(std::size_t count) : x(count), y(count), z(count) {}
};

std::string input_text(const Inputs& in, std::size_t i) {
  char text[256];
  std::snprintf(text, sizeof text, "wo = (%.9g, %.9g, %.9g), alpha = (%.9g, %.9g), u = (%.9g, %.9g)", in.wo_x[i],
                in.wo_y[i], in.wo_z[i], in.alpha_x[i], in.alpha_y[i], in.u_x[i], in.u_y[i]);
  return text;
}

/// Whether these are inputs that every sampling routine promises to accept: unit views not below the horizon, and alpha
/// in (0, 1].
bool in_shared_domain(const Inputs& in) {
  for (std::size_t i = 0; i < in.size(); ++i) {
    double x = in.wo_x[i], y = in.wo_y[i], z = in.wo_z[i];
    bool unit = std::fabs(x * x + y * y + z * z - 1) < 1e-6;
    bool rough = in.alpha_x[i] > 0 && in.alpha_x[i] <= 1 && in.alpha_y[i] > 0 && in.alpha_y[i] <= 1;
    if (!unit || !rough || z < 0) return false;
  }
  return true;
}

Row compare(const char* implementation, const char* warp, const char* isa, const HardCase& hard_case, const Inputs& in,
            const OracleNormals& oracle, const Normals& wm) {
  Row row{implementation, warp, isa, &hard_case, in.size(), {}, 0, in_shared_domain(in), {}};
  row.errors = measure(in, oracle, wm.x.data(), wm.y.data(), wm.z.data());
  for (std::size_t i = 0; i < in.size(); ++i) {
    row.nonfinite += !std::isfinite(wm.x[i]) || !std::isfinite(wm.y[i]) || !std::isfinite(wm.z[i]);
  }
  row.worst_input = input_text(in, hard_case.no_visible_normal ? row.errors.worst_norm : row.errors.worst);
  return row;
}

/// The largest ratio of reference/ratio.h among the first samples: it takes quadruple precision.
double largest_ratio(Warp warp, const Inputs& in, const Normals& wm) {
  constexpr std::size_t kSamples = 1 << 12;
  constexpr Moves view = Moves::outwards, u = Moves::within_one;
  auto exact = [&](const std::array<exact::Quad, 7>& at) {
    auto normal = exact::sample_normal(warp, {at[0], at[1], at[2]}, exact::plain(at[3], at[4]), at[5], at[6]);
    return std::array<Exact, 1>{exact_vector(normal.wm)};
  };
  double largest = 0;
  for (std::size_t i = 0; i < std::min(kSamples, in.size()); ++i) {
    std::array<float, 7> at{in.wo_x[i], in.wo_y[i], in.wo_z[i], in.alpha_x[i], in.alpha_y[i], in.u_x[i], in.u_y[i]};
    std::array<Found, 1> found{Found{{wm.x[i], wm.y[i], wm.z[i]}}};
    keep_larger(largest, ratios<7, 1>(at, {view, view, view, view, view, u, u}, found, exact)[0]);
  }
  return largest;
}

/// The library, on the active instruction set: the others give the same bits, which the tests make sure of.
std::vector<Row> measure_ours(const HardCase& hard_case, Warp warp, const char* warp_name, std::size_t samples) {
  Inputs in = generate(hard_case, warp, samples, kSeed);
  Normals wm(samples);
  sample_normals(warp, samples, in.wo(), in.alpha(), in.u(), {wm.x.data(), wm.y.data(), wm.z.data()});
  OracleNormals oracle;
  if (hard_case.no_visible_normal) {
    // No normal is right more than another: what is measured is that it is a unit one.
    oracle.x.assign(wm.x.begin(), wm.x.end());
    oracle.y.assign(wm.y.begin(), wm.y.end());
    oracle.z.assign(wm.z.begin(), wm.z.end());
  } else {
    oracle = oracle_normals(warp, in);
  }
  std::vector<Row> rows{compare("sample_normals", warp_name, "any", hard_case, in, oracle, wm)};
  if (!hard_case.no_visible_normal) rows[0].ratio = largest_ratio(warp, in, wm);
  if (!in_shared_domain(in)) return rows;

  // Reflections against the exact view reflected at the exact normal. It takes unit views above the horizon.
  std::vector<float> pdf(samples), weight(samples);
  sample_reflection(warp, samples, in.wo(), in.alpha(), in.u(),
                    {{wm.x.data(), wm.y.data(), wm.z.data()}, pdf.data(), weight.data()});
  for (std::size_t i = 0; i < samples; ++i) {
    double x = in.wo_x[i], y = in.wo_y[i], z = in.wo_z[i];
    double twice_cos = 2 * (x * oracle.x[i] + y * oracle.y[i] + z * oracle.z[i]);
    oracle.x[i] = twice_cos * oracle.x[i] - x;
    oracle.y[i] = twice_cos * oracle.y[i] - y;
    oracle.z[i] = twice_cos * oracle.z[i] - z;
  }
  rows.push_back(compare("sample_reflection", warp_name, "any", hard_case, in, oracle, wm));
  return rows;
}

Warp warp_named(const std::string& name) {
  for (auto& warp : kWarps) {
    if (warp.name == name) return warp.warp;
  }
  return Warp::polar;
}

/// Every peer, each against its own formulas in long double: so the choice of a frame at the pole, which is a peer's
/// own affair, is no error. Each of these is evaluated once for all instruction sets.
std::vector<Row> measure_peers(const HardCase& hard_case, std::size_t samples) {
  struct Exact {
    Inputs in;
    OracleNormals normals;
  };
  std::map<peers::Oracle*, Exact> known;
  std::vector<Row> rows;
  for (const peers::Peer& peer : peers::peers()) {
    if (!peer.supported) continue;
    auto found = known.find(peer.oracle);
    if (found == known.end()) {
      Inputs in = generate(hard_case, warp_named(peer.warp), samples, kSeed);
      std::vector<long double> exact[3];
      for (auto& column : exact) column.resize(samples);
      const float* inputs[7] = {in.wo_x.data(),    in.wo_y.data(), in.wo_z.data(), in.alpha_x.data(),
                                in.alpha_y.data(), in.u_x.data(),  in.u_y.data()};
      long double* outputs[3] = {exact[0].data(), exact[1].data(), exact[2].data()};
      peer.oracle(samples, inputs, outputs);
      OracleNormals normals;
      normals.x.assign(exact[0].begin(), exact[0].end());
      normals.y.assign(exact[1].begin(), exact[1].end());
      normals.z.assign(exact[2].begin(), exact[2].end());
      found = known.emplace(peer.oracle, Exact{std::move(in), std::move(normals)}).first;
    }
    const Inputs& in = found->second.in;
    const float* inputs[7] = {in.wo_x.data(),    in.wo_y.data(), in.wo_z.data(), in.alpha_x.data(),
                              in.alpha_y.data(), in.u_x.data(),  in.u_y.data()};
    Normals wm(samples);
    float* outputs[3] = {wm.x.data(), wm.y.data(), wm.z.data()};
    peer.sample(samples, inputs, outputs);
    rows.push_back(compare(peer.name, peer.warp, peer.isa, hard_case, in, found->second.normals, wm));
  }
  return rows;
}

void write_row(std::FILE* file, const Row& row) {
  const NormalErrors& e = row.errors;
  std::fprintf(file,
               "  {\"implementation\": \"%s\", \"warp\": \"%s\", \"isa\": \"%s\", \"row\": \"%s\", \"samples\": %zu,",
               row.implementation.c_str(), row.warp.c_str(), row.isa.c_str(), row.hard_case->name, row.samples);
  std::fprintf(file, " \"mean_eps\": %s, \"p999_eps\": %s, \"max_eps\": %s, \"norm_eps\": %s, \"slope_error\": %s,",
               number(e.mean).c_str(), number(e.p999).c_str(), number(e.max).c_str(), number(e.max_norm).c_str(),
               row.hard_case->small_alpha ? number(e.max_slope).c_str() : "null");
  std::fprintf(file,
               " \"nonfinite\": %zu, \"undefined\": %s, \"shared_domain\": %s, \"worst_input\": \"%s\", \"ratio\": %s}",
               row.nonfinite, row.hard_case->no_visible_normal ? "true" : "false", row.shared_domain ? "true" : "false",
               row.worst_input.c_str(), row.ratio < 0 ? "null" : number(row.ratio).c_str());
}

void write(std::FILE* file, const Options& options, const std::vector<Row>& rows) {
  std::fprintf(file, "{\n\"samples\": %zu,\n\"peer_samples\": %zu,\n\"measured_isa\": \"%s\",\n", options.samples,
               options.peer_samples, active_isa());
  std::fputs("\"row_notes\": {", file);
  const char* separator = "";
  for (const HardCase& hard_case : hard_cases()) {
    std::fprintf(file, "%s\n  \"%s\": \"%s\"", separator, hard_case.name, hard_case.description);
    separator = ",";
  }
  std::fputs("\n},\n\"peers\": {", file);
  std::map<std::string, std::string> operations;
  for (const peers::Peer& peer : peers::peers()) operations[peer.name] = peer.operation;
  separator = "";
  for (const auto& [name, operation] : operations) {
    std::fprintf(file, "%s\n  \"%s\": \"%s\"", separator, name.c_str(), operation.c_str());
    separator = ",";
  }
  peers::FitError fit = peers::heitz_deon_2014_fit_error();
  std::fprintf(file,
               "\n},\n\"fit_error\": {\"max_slope\": %s, \"mean_slope\": %s, \"max_normal\": %s, \"mean_normal\": %s},",
               number(fit.max_slope).c_str(), number(fit.mean_slope).c_str(), number(fit.max_normal).c_str(),
               number(fit.mean_normal).c_str());
  std::fputs("\n\"rows\": [", file);
  separator = "\n";
  for (const Row& row : rows) {
    std::fputs(separator, file);
    write_row(file, row);
    separator = ",\n";
  }
  std::fputs("\n]\n}\n", file);
}

void show(const Row& row) {
  std::string ratio = row.ratio < 0 ? "" : "  ratio " + number(row.ratio);
  std::fprintf(stderr, "  %-22s %-13s %-7s %-25s mean %9.3g  p99.9 %9.3g  max %9.3g eps%s%s\n",
               row.implementation.c_str(), row.warp.c_str(), row.isa.c_str(), row.hard_case->name, row.errors.mean,
               row.errors.p999, row.errors.max, ratio.c_str(), row.nonfinite ? "  (not all finite)" : "");
}

std::vector<Row> measure_all(const Options& options) {
  std::vector<std::function<std::vector<Row>()>> tasks;
  for (const HardCase& hard_case : hard_cases()) {
    if (!options.only.empty() && options.only != hard_case.name) continue;
    for (const auto& warp : kWarps) {
      tasks.push_back([&] { return measure_ours(hard_case, warp.warp, warp.name, options.samples); });
    }
    tasks.push_back([&] { return measure_peers(hard_case, options.peer_samples); });
  }

  std::vector<std::vector<Row>> results(tasks.size());
  std::size_t done = 0;
  std::mutex terminal;
  report::in_parallel(tasks.size(), options.threads, [&](std::size_t task) {
    auto start = std::chrono::steady_clock::now();
    results[task] = tasks[task]();
    std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::lock_guard<std::mutex> lock(terminal);
    std::fprintf(stderr, "errors %zu/%zu, %.1f s\n", ++done, tasks.size(), seconds.count());
    for (const Row& row : results[task]) show(row);
  });

  std::vector<Row> rows;
  for (auto& result : results) rows.insert(rows.end(), result.begin(), result.end());
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  Options options = parse(argc, argv);
  // Opened first: a path that cannot be written is told at once, not after minutes.
  std::FILE* file = report::open_output(options.out);
  write(file, options, measure_all(options));
  report::close_output(file, options.out);
}
