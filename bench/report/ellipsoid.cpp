// vndf_ellipsoid: of the ellipsoid NDF, the errors beside plain GGX, the share of samples that Walter's rejecting
// samplers throw away, and the density of visible normals over the hemisphere.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <vndf/ellipsoid.h>

#include "command_line.h"
#include "ellipsoid/cases.h"
#include "ellipsoid/rejection.h"
#include "error_row.h"
#include "output.h"
#include "reference/errors.h"
#include "warps.h"

namespace {

using namespace vndf;
using namespace vndf::ellipsoid;
using reference::Inputs;
using report::Json;

constexpr std::uint64_t kSeed = 2015;

// --- Errors ----------------------------------------------------------------------------------------------------------

/// Walter's plain equations in quadruple precision.
reference::OracleNormals exact_normals(Warp warp, const Inputs& in, const Angles& theta) {
  reference::OracleNormals normals;
  for (std::size_t i = 0; i < in.size(); ++i) {
    Vec3<double> m = exact_normal(warp, in, theta, i);
    normals.x.push_back(m.x);
    normals.y.push_back(m.y);
    normals.z.push_back(m.z);
  }
  return normals;
}

std::string input_text(const Inputs& in, const Angles& theta, std::size_t i) {
  char text[384];
  std::snprintf(text, sizeof text,
                "wo = (%.9g, %.9g, %.9g), alpha = (%.9g, %.9g), theta = (%.9g, %.9g, %.9g), u = (%.9g, %.9g)",
                in.wo_x[i], in.wo_y[i], in.wo_z[i], in.alpha_x[i], in.alpha_y[i], theta.x[i], theta.y[i], theta.z[i],
                in.u_x[i], in.u_y[i]);
  return text;
}

/// One row for the ellipsoid and one for plain GGX with the same inputs.
Json measure_errors(const Case& row, const bench::NamedWarp& named, std::size_t samples) {
  Inputs in = generate(row.inputs, named.warp, samples, kSeed);
  Angles theta(samples, row.lean, kSeed + 1);
  Directions wm(samples);
  auto compare = [&](const char* implementation, const reference::OracleNormals& exact, bool with_input) {
    reference::NormalErrors errors = reference::measure(in, exact, wm.x.data(), wm.y.data(), wm.z.data());
    Json line = report::error_row(implementation, named.name, row.inputs, samples, errors);
    line["worst_input"] = with_input ? input_text(in, theta, errors.worst) : "";
    return line;
  };
  sample_normals(named.warp, samples, in.wo(), theta.with(in.alpha()), in.u(), wm.out());
  Json ellipsoid = compare("ellipsoid", exact_normals(named.warp, in, theta), true);
  sample_normals(named.warp, samples, in.wo(), in.alpha(), in.u(), wm.out());
  return {ellipsoid, compare("plain", oracle_normals(named.warp, in), false)};
}

// --- Ellipsoids with a view ------------------------------------------------------------------------------------------

struct Setting {
  const char* name;
  Parameters parameters;
  double degrees, phi;  // of the view, from the normal and from x

  Vec3<double> view() const {
    double theta = degrees * kPi<double> / 180, azimuth = phi * kPi<double> / 180;
    return {std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth), std::cos(theta)};
  }

  Json json() const {
    const Parameters& p = parameters;
    return {{"name", name},
            {"alpha", {p.alpha_x, p.alpha_y}},
            {"theta", {p.theta_x, p.theta_y, p.theta_z}},
            {"degrees", degrees},
            {"phi", phi}};
  }
};

constexpr Parameters kPlain{0.3f, 0.3f, 0, 0, 0}, kSmooth{0.05f, 0.05f, 0, 0, 0}, kBrushed{0.15f, 0.5f, 0, 0, 0},
    kSkewed{0.2f, 0.5f, 0.4f, -0.3f, 0.6f};

const std::vector<Setting> kRejecting = {
    {"plain GGX, normal incidence", kPlain, 0, 0},
    {"plain GGX", kPlain, 75, 0},
    {"plain GGX, grazing", kPlain, 89, 0},
    {"plain GGX, smooth, grazing", kSmooth, 89, 0},
    {"anisotropic, view along the smooth axis", kBrushed, 75, 0},
    {"anisotropic, view along the rough axis", kBrushed, 75, 90},
    {"skewed", kSkewed, 75, 0},
    {"skewed, from the other side", kSkewed, 75, 180},
    {"skewed, grazing", kSkewed, 89, 90},
};

/// With the shares that versions 1, 2 and 3 reject.
Json measure_rejection(const Setting& setting, std::size_t kept) {
  reference::Random random(kSeed);
  auto rejected = [&](const auto& version) {
    return sample_by_rejection(version, random, double(kept), [](const Vec3<double>&) {}).rejected();
  };
  double first = rejected(Version1(setting.parameters, setting.view()));
  double second = rejected(Version2(setting.parameters, setting.view()));
  Json line = setting.json();
  line["rejected"] = {first, second, 0};
  return line;
}

constexpr Setting kDrawn[] = {{"anisotropic, view along the smooth axis", kBrushed, 75, 0},
                              {"anisotropic, view along the rough axis", kBrushed, 75, 90},
                              {"skewed", kSkewed, 75, 0}};

/// With the density of visible normals seen from above: rows of y, from -1 to 1, of columns of x; null outside the
/// disk.
Json measure_density(const Setting& setting, int size) {
  struct Cell {
    int row, column;
  };
  std::vector<Cell> cells;
  Directions m;
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      double x = (2. * column + 1) / size - 1, y = (2. * row + 1) / size - 1, z2 = 1 - x * x - y * y;
      if (z2 <= 0) continue;
      cells.push_back({row, column});
      m.x.push_back(float(x));
      m.y.push_back(float(y));
      m.z.push_back(float(std::sqrt(z2)));
    }
  Vec3<double> wo = setting.view();
  std::vector<float> pdf(cells.size());
  pdf_normals(pdf.size(), {float(wo.x), float(wo.y), float(wo.z)}, m.in(), setting.parameters.ellipsoid(), pdf.data());
  Json line = setting.json();
  line["pdf"] = std::vector<Json>(size, std::vector<Json>(size));
  for (std::size_t i = 0; i < cells.size(); ++i) line["pdf"][cells[i].row][cells[i].column] = pdf[i];
  return line;
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t samples = std::size_t(1) << 15, kept = std::size_t(1) << 16;
  int size = 192;
  unsigned threads = report::cores();
  CLI::App app("Errors of the ellipsoid NDF, what samplers by rejection reject, and densities to be drawn.",
               "vndf_ellipsoid");
  report::Output output(app);
  bench::add_number(app, "--samples", samples, "per row of errors and warp", 1, 1 << 24);
  bench::add_number(app, "--kept", kept, "samples that each sampler by rejection has to find", 1, 1 << 24);
  bench::add_number(app, "--size", size, "points a side of the densities' grids", 2, 4096);
  bench::add_number(app, "--threads", threads, "rows measured at once", 1, 1024);
  bench::parse(app, argc, argv);

  const std::vector<Case> rows = cases();
  const std::size_t warps = std::size(bench::kWarps);
  std::vector<Json> errors(rows.size() * warps), rejections(kRejecting.size());
  const std::size_t tasks = errors.size() + rejections.size();
  std::size_t done = 0;
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t task = 0; task < tasks; ++task) {
    if (task < errors.size()) {
      errors[task] = measure_errors(rows[task / warps], bench::kWarps[task % warps], samples);
    } else {
      rejections[task - errors.size()] = measure_rejection(kRejecting[task - errors.size()], kept);
    }
#pragma omp critical
    std::fprintf(stderr, "ellipsoid %zu/%zu\n", ++done, tasks);
  }

  Json document{{"row_notes", {}}, {"errors", Json::array()}, {"rejections", rejections}};
  for (const Case& row : rows) document["row_notes"][row.inputs.name] = row.inputs.description;
  for (const Json& pair : errors) document["errors"].insert(document["errors"].end(), pair.begin(), pair.end());
  for (const Setting& setting : kDrawn) document["densities"].push_back(measure_density(setting, size));
  output.write(document);
}
