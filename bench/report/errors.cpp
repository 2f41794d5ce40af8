// vndf_errors: how far the library's normals and directions are from the exact ones, and its peers' normals, for every
// hard case.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <vndf/vndf.h>

#include "command_line.h"
#include "error_row.h"
#include "output.h"
#include "peers.h"
#include "reference/errors.h"
#include "reference/ratio.h"
#include "warps.h"

namespace {

using namespace vndf;
using namespace vndf::reference;
using report::Json;

constexpr std::uint64_t kSeed = 2018;

struct Normals {
  std::vector<float> x, y, z;
  explicit Normals(std::size_t count) : x(count), y(count), z(count) {}
  Out3 out() { return {x.data(), y.data(), z.data()}; }
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

Json compare(const char* implementation, const char* warp, const char* isa, const HardCase& hard_case, const Inputs& in,
             const OracleNormals& oracle, const Normals& wm) {
  NormalErrors errors = measure(in, oracle, wm.x.data(), wm.y.data(), wm.z.data());
  std::size_t nonfinite = 0;
  for (std::size_t i = 0; i < in.size(); ++i) {
    nonfinite += !std::isfinite(wm.x[i]) || !std::isfinite(wm.y[i]) || !std::isfinite(wm.z[i]);
  }
  Json row = report::error_row(implementation, warp, hard_case, in.size(), errors);
  row["isa"] = isa;
  row["slope_error"] = hard_case.small_alpha ? Json(errors.max_slope) : Json();
  row["nonfinite"] = nonfinite;
  row["undefined"] = hard_case.no_visible_normal;
  row["shared_domain"] = in_shared_domain(in);
  row["worst_input"] = input_text(in, hard_case.no_visible_normal ? errors.worst_norm : errors.worst);
  row["ratio"] = nullptr;
  return row;
}

/// The largest ratio of reference/ratio.h among the first samples: it takes quadruple precision. `exact(i, at)` is what
/// sample i should give for the inputs `at`.
template <class Function>
double largest_ratio(const Inputs& in, const Normals& result, Function exact) {
  constexpr std::size_t kSamples = 1 << 12;
  constexpr Moves view = Moves::outwards, u = Moves::within_one;
  double largest = 0;
  for (std::size_t i = 0; i < std::min(kSamples, in.size()); ++i) {
    std::array<float, 7> at{in.wo_x[i], in.wo_y[i], in.wo_z[i], in.alpha_x[i], in.alpha_y[i], in.u_x[i], in.u_y[i]};
    std::array<Found, 1> found{Found{{result.x[i], result.y[i], result.z[i]}}};
    auto right = [&](const std::array<Quad, 7>& moved) { return std::array<Exact, 1>{exact(i, moved)}; };
    keep_larger(largest, ratios<7, 1>(at, {view, view, view, view, view, u, u}, found, right)[0]);
  }
  return largest;
}

/// Glass, its side chosen by Fresnel's share: reflected and refracted directions, against those of the exact normal by
/// Walter et al. 2007, eq. 39 and 40, on the side that the library took.
Json measure_dielectric(const HardCase& hard_case, const bench::NamedWarp& named, const Inputs& in,
                        const OracleNormals& normals) {
  constexpr float kEta = 1.5f;
  const std::size_t samples = in.size();
  std::vector<float> choice(samples), pdf(samples), weight(samples), side(samples);
  for (std::size_t i = 0; i < samples; ++i) choice[i] = Random(kSeed, i).unit();
  Normals wi(samples);
  sample_dielectric(named.warp, samples, in.wo(), in.alpha(), kEta, {in.u_x.data(), in.u_y.data(), choice.data()},
                    {wi.out(), pdf.data(), weight.data(), side.data()});
  OracleNormals exact = normals;
  for (std::size_t i = 0; i < samples; ++i) {
    double x = in.wo_x[i], y = in.wo_y[i], z = in.wo_z[i], eta = kEta;
    double cos = x * exact.x[i] + y * exact.y[i] + z * exact.z[i];
    double of_normal = 2 * cos, of_view = 1;
    if (side[i] < 0) {
      of_normal = cos / eta - std::sqrt((eta * eta - 1) + cos * cos) / eta;
      of_view = 1 / eta;
    }
    exact.x[i] = of_normal * exact.x[i] - of_view * x;
    exact.y[i] = of_normal * exact.y[i] - of_view * y;
    exact.z[i] = of_normal * exact.z[i] - of_view * z;
  }
  Json row = compare("sample_dielectric", named.name, "any", hard_case, in, exact, wi);
  row["ratio"] = largest_ratio(in, wi, [&](std::size_t i, const std::array<Quad, 7>& at) {
    return exact_vector(exact::sample_dielectric(named.warp, side[i] > 0, {at[0], at[1], at[2]},
                                                 exact::plain(at[3], at[4]), kEta, at[5], at[6])
                            .wi);
  });
  return row;
}

/// The disk has neither views nor roughness, so that of the hard cases the random numbers count.
Json measure_disk(const HardCase& hard_case, DiskMap map, const char* name, std::size_t samples) {
  Inputs in = generate(hard_case, map == DiskMap::polar ? Warp::polar : Warp::concentric, samples, kSeed);
  Normals t(samples);
  sample_disk(map, samples, in.u(), {t.x.data(), t.y.data()});
  OracleNormals exact;
  exact.x.resize(samples), exact.y.resize(samples), exact.z.resize(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    const float u[2] = {in.u_x[i], in.u_y[i]};
    OracleDisk disk = oracle_disk(map, u);
    exact.x[i] = disk.t1, exact.y[i] = disk.t2;
  }
  Json row = compare("sample_disk", name, "any", hard_case, in, exact, t);
  row["norm_eps"] = row["slope_error"] = nullptr;
  row["undefined"] = false;
  row["shared_domain"] = true;
  return row;
}

/// The library, on the active instruction set: the others give the same bits, which the tests make sure of.
std::vector<Json> measure_ours(const HardCase& hard_case, const bench::NamedWarp& named, std::size_t samples) {
  Warp warp = named.warp;
  Inputs in = generate(hard_case, warp, samples, kSeed);
  Normals wm(samples);
  sample_normals(warp, samples, in.wo(), in.alpha(), in.u(), wm.out());
  OracleNormals oracle;
  if (hard_case.no_visible_normal) {
    // No normal is right more than another: what is measured is that it is a unit one.
    oracle.x.assign(wm.x.begin(), wm.x.end());
    oracle.y.assign(wm.y.begin(), wm.y.end());
    oracle.z.assign(wm.z.begin(), wm.z.end());
  } else {
    oracle = oracle_normals(warp, in);
  }
  std::vector<Json> rows{compare("sample_normals", named.name, "any", hard_case, in, oracle, wm)};
  if (!hard_case.no_visible_normal)
    rows[0]["ratio"] = largest_ratio(in, wm, [&](std::size_t, const std::array<Quad, 7>& at) {
      return exact_vector(
          exact::sample_normal(warp, {at[0], at[1], at[2]}, exact::plain(at[3], at[4]), at[5], at[6]).wm);
    });
  if (!in_shared_domain(in)) return rows;

  rows.push_back(measure_dielectric(hard_case, named, in, oracle));
  // Reflections against the exact view reflected at the exact normal. It takes unit views above the horizon.
  std::vector<float> pdf(samples), weight(samples);
  sample_reflection(warp, samples, in.wo(), in.alpha(), in.u(), {wm.out(), pdf.data(), weight.data()});
  for (std::size_t i = 0; i < samples; ++i) {
    double x = in.wo_x[i], y = in.wo_y[i], z = in.wo_z[i];
    double twice_cos = 2 * (x * oracle.x[i] + y * oracle.y[i] + z * oracle.z[i]);
    oracle.x[i] = twice_cos * oracle.x[i] - x;
    oracle.y[i] = twice_cos * oracle.y[i] - y;
    oracle.z[i] = twice_cos * oracle.z[i] - z;
  }
  rows.push_back(compare("sample_reflection", named.name, "any", hard_case, in, oracle, wm));
  return rows;
}

/// For a peer with a parameterisation of its own any of ours does: the random numbers of the first.
Warp warp_named(const std::string& name) {
  for (const auto& warp : bench::kWarps) {
    if (warp.name == name) return warp.warp;
  }
  return bench::kWarps[0].warp;
}

/// Every peer, each against its own formulas in long double: so the choice of a frame at the pole, which is a peer's
/// own affair, is no error. Each of these is evaluated once for all instruction sets.
std::vector<Json> measure_peers(const HardCase& hard_case, std::size_t samples) {
  struct Exact {
    Inputs in;
    OracleNormals normals;
  };
  std::map<peers::Oracle*, Exact> known;
  std::vector<Json> rows;
  for (const peers::Peer& peer : peers::peers()) {
    if (!peer.supported || !peer.oracle) continue;
    auto [found, missing] = known.try_emplace(peer.oracle, Exact{Inputs(0), {}});
    auto& [in, exact] = found->second;
    if (missing) in = generate(hard_case, warp_named(peer.warp), samples, kSeed);
    const float* inputs[7] = {in.wo_x.data(),    in.wo_y.data(), in.wo_z.data(), in.alpha_x.data(),
                              in.alpha_y.data(), in.u_x.data(),  in.u_y.data()};
    if (missing) {
      std::vector<long double> x(samples), y(samples), z(samples);
      long double* outputs[3] = {x.data(), y.data(), z.data()};
      peer.oracle(samples, inputs, outputs);
      exact.x.assign(x.begin(), x.end());
      exact.y.assign(y.begin(), y.end());
      exact.z.assign(z.begin(), z.end());
    }
    Normals wm(samples);
    float* outputs[3] = {wm.x.data(), wm.y.data(), wm.z.data()};
    peer.sample(samples, inputs, outputs);
    rows.push_back(compare(peer.name, peer.warp, peer.isa, hard_case, in, exact, wm));
  }
  return rows;
}

using Task = std::function<std::vector<Json>()>;

Json run(const std::vector<Task>& tasks, [[maybe_unused]] unsigned threads) {
  std::vector<std::vector<Json>> results(tasks.size());
  std::size_t done = 0;
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t task = 0; task < tasks.size(); ++task) {
    results[task] = tasks[task]();
#pragma omp critical
    std::fprintf(stderr, "errors %zu/%zu\n", ++done, tasks.size());
  }
  Json rows = Json::array();
  for (const auto& result : results) {
    for (const Json& row : result) rows.push_back(row);
  }
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t samples = std::size_t(1) << 22, peer_samples = std::size_t(1) << 17;
  unsigned threads = report::cores();
  std::string only;
  std::vector<std::string> names;
  for (const HardCase& hard_case : hard_cases()) names.push_back(hard_case.name);

  CLI::App app(
      "Measures the library's normals and directions, and its peers' normals, against exact ones, for every hard case.",
      "vndf_errors");
  report::Output output(app);
  bench::add_number(app, "--samples", samples, "per hard case and warp of the library's", 1, 1 << 28);
  bench::add_number(app, "--peer-samples", peer_samples, "per hard case of each peer", 1, 1 << 28);
  bench::add_number(app, "--threads", threads, "hard cases measured at once; each takes about 70 bytes a sample", 1,
                    1024);
  app.add_option("--row", only, "this hard case only")->check(CLI::IsMember(names));
  bench::parse(app, argc, argv);

  std::vector<Task> tasks;
  for (const HardCase& hard_case : hard_cases()) {
    if (!only.empty() && only != hard_case.name) continue;
    for (const auto& warp : bench::kWarps) tasks.push_back([&] { return measure_ours(hard_case, warp, samples); });
    tasks.push_back([&] {
      return std::vector<Json>{measure_disk(hard_case, DiskMap::polar, "polar", samples),
                               measure_disk(hard_case, DiskMap::concentric, "concentric", samples)};
    });
    tasks.push_back([&] { return measure_peers(hard_case, peer_samples); });
  }
  Json row_notes, operations;
  for (const HardCase& hard_case : hard_cases()) row_notes[hard_case.name] = hard_case.description;
  for (const peers::Peer& peer : peers::peers()) operations[peer.name] = peer.operation;
  peers::FitError fit = peers::heitz_deon_2014_fit_error();
  output.write({{"samples", samples},
                {"peer_samples", peer_samples},
                {"measured_isa", active_isa()},
                {"row_notes", row_notes},
                {"peers", operations},
                {"fit_error",
                 {{"max_slope", fit.max_slope},
                  {"mean_slope", fit.mean_slope},
                  {"max_normal", fit.max_normal},
                  {"mean_normal", fit.mean_normal}}},
                {"rows", run(tasks, threads)}});
}
