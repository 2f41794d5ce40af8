// vndf_ellipsoid: of the ellipsoid NDF, the errors beside plain GGX, the share of samples that Walter's rejecting
// samplers throw away, and the density of visible normals over the hemisphere.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string>
#include <vector>

#include <vndf/ellipsoid.h>

#include "arguments.h"
#include "ellipsoid/cases.h"
#include "ellipsoid/rejection.h"
#include "in_parallel.h"
#include "json.h"
#include "reference/errors.h"

namespace {

using namespace vndf;
using namespace vndf::ellipsoid;
using reference::Inputs;
using reference::Random;
using report::number;

constexpr std::uint64_t kSeed = 2015;

struct Options {
  std::size_t samples = std::size_t(1) << 15;
  std::size_t kept = std::size_t(1) << 16;
  int size = 192;
  unsigned threads = report::default_threads();
  std::string out = "-";
};

constexpr char kHelp[] =
    R"(vndf_ellipsoid: errors of the ellipsoid NDF, what samplers by rejection reject, and densities to be drawn

  --samples N   samples per row of errors and warp (default 32768)
  --kept N      samples that each sampler by rejection has to find (default 65536)
  --size N      points a side of the densities' grids (default 192)
  --threads N   rows measured at once (default: one per core, at most 8)
  --out FILE    where the JSON goes (default -, standard output); progress is on standard error
)";

Options parse(int argc, char** argv) {
  Options options;
  report::Arguments arguments(argc, argv);
  while (arguments.more()) {
    if (arguments.common(kHelp, options.out)) continue;
    if (arguments.is("--samples")) {
      options.samples = std::size_t(arguments.number(1, 1 << 24));
    } else if (arguments.is("--kept")) {
      options.kept = std::size_t(arguments.number(1, 1 << 24));
    } else if (arguments.is("--size")) {
      options.size = int(arguments.number(2, 4096));
    } else if (arguments.is("--threads")) {
      options.threads = unsigned(arguments.number(1, 1024));
    } else {
      arguments.unknown();
    }
  }
  return options;
}

// --- Errors ----------------------------------------------------------------------------------------------------------

/// Walter's plain equations in quadruple precision.
reference::OracleNormals exact_normals(Warp warp, const Inputs& in, const Angles& theta) {
  reference::OracleNormals normals;
  for (std::size_t i = 0; i < in.size(); ++i) {
    V3<double> m = exact_normal(warp, in, theta, i);
    normals.x.push_back(m.x);
    normals.y.push_back(m.y);
    normals.z.push_back(m.z);
  }
  return normals;
}

struct Errors {
  Case row;
  const char* warp;
  std::size_t samples;
  reference::NormalErrors ellipsoid, plain;
  std::string worst_input;  // of the ellipsoid
};

std::string input_text(const Inputs& in, const Angles& theta, std::size_t i) {
  char text[384];
  std::snprintf(text, sizeof text,
                "wo = (%.9g, %.9g, %.9g), alpha = (%.9g, %.9g), theta = (%.9g, %.9g, %.9g), u = (%.9g, %.9g)",
                in.wo_x[i], in.wo_y[i], in.wo_z[i], in.alpha_x[i], in.alpha_y[i], theta.x[i], theta.y[i], theta.z[i],
                in.u_x[i], in.u_y[i]);
  return text;
}

Errors measure_errors(const Case& row, int warp, std::size_t samples) {
  Inputs in = generate(row.inputs, kWarps[warp], samples, kSeed);
  Angles theta(samples, row.lean, kSeed + 1);

  Directions wm(in.size());
  auto distance = [&](const reference::OracleNormals& exact) {
    return reference::measure(in, exact, wm.x.data(), wm.y.data(), wm.z.data());
  };
  Errors errors{row, kWarpNames[warp], in.size(), {}, {}, {}};
  sample_normals(kWarps[warp], in.size(), in.wo(), theta.with(in.alpha()), in.u(), wm.out());
  errors.ellipsoid = distance(exact_normals(kWarps[warp], in, theta));
  sample_normals(kWarps[warp], in.size(), in.wo(), in.alpha(), in.u(), wm.out());
  errors.plain = distance(oracle_normals(kWarps[warp], in));
  errors.worst_input = input_text(in, theta, errors.ellipsoid.worst);
  return errors;
}

// --- Ellipsoids with a view ------------------------------------------------------------------------------------------

struct Setting {
  const char* name;
  Parameters parameters;
  double degrees, phi;  // of the view, from the normal and from x

  V3<double> view() const {
    double theta = degrees * kPi<double> / 180, azimuth = phi * kPi<double> / 180;
    return {std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth), std::cos(theta)};
  }
};

constexpr Parameters kBrushed{0.15f, 0.5f, 0, 0, 0}, kSkewed{0.2f, 0.5f, 0.4f, -0.3f, 0.6f};

constexpr Setting kRejecting[] = {
    {"plain GGX, normal incidence", {0.3f, 0.3f, 0, 0, 0}, 0, 0},
    {"plain GGX", {0.3f, 0.3f, 0, 0, 0}, 75, 0},
    {"plain GGX, grazing", {0.3f, 0.3f, 0, 0, 0}, 89, 0},
    {"plain GGX, smooth, grazing", {0.05f, 0.05f, 0, 0, 0}, 89, 0},
    {"anisotropic, view along the smooth axis", kBrushed, 75, 0},
    {"anisotropic, view along the rough axis", kBrushed, 75, 90},
    {"skewed", kSkewed, 75, 0},
    {"skewed, from the other side", kSkewed, 75, 180},
    {"skewed, grazing", kSkewed, 89, 90},
};
constexpr std::size_t kRejectingCount = sizeof kRejecting / sizeof *kRejecting;

struct Rejection {
  Tries first, second;
};

Rejection measure_rejection(const Setting& setting, std::size_t kept) {
  Random random(kSeed);
  auto ignore = [](const V3<double>&) {};
  V3<double> psi = setting.view();
  return {sample_by_rejection(Version1(setting.parameters, psi), random, double(kept), ignore),
          sample_by_rejection(Version2(setting.parameters, psi), random, double(kept), ignore)};
}

constexpr Setting kDrawn[] = {{"anisotropic, view along the smooth axis", kBrushed, 75, 0},
                              {"anisotropic, view along the rough axis", kBrushed, 75, 90},
                              {"skewed", kSkewed, 75, 0}};

/// The density of visible normals seen from above: rows of y, from -1 to 1, of columns of x; null outside the disk.
std::vector<double> density(const Setting& setting, int size) {
  std::vector<std::size_t> at;
  Directions m;
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      double x = (2. * column + 1) / size - 1, y = (2. * row + 1) / size - 1, z2 = 1 - x * x - y * y;
      if (z2 <= 0) continue;
      at.push_back(std::size_t(row) * std::size_t(size) + std::size_t(column));
      m.x.push_back(float(x));
      m.y.push_back(float(y));
      m.z.push_back(float(std::sqrt(z2)));
    }
  V3<double> wo = setting.view();
  std::vector<float> pdf(at.size());
  pdf_normals(pdf.size(), {float(wo.x), float(wo.y), float(wo.z)}, m.in(), setting.parameters.ellipsoid(), pdf.data());
  std::vector<double> grid(std::size_t(size) * std::size_t(size), NAN);
  for (std::size_t i = 0; i < at.size(); ++i) grid[at[i]] = pdf[i];
  return grid;
}

// --- JSON ------------------------------------------------------------------------------------------------------------

void write_errors(std::FILE* file, const char* implementation, const Errors& errors,
                  const reference::NormalErrors& found, const char* worst_input) {
  std::fprintf(file, "{\"implementation\": \"%s\", \"warp\": \"%s\", \"row\": \"%s\", \"samples\": %zu, ",
               implementation, errors.warp, errors.row.inputs.name, errors.samples);
  std::fprintf(file, "\"mean_eps\": %s, \"p999_eps\": %s, \"max_eps\": %s, \"norm_eps\": %s, \"worst_input\": \"%s\"}",
               number(found.mean).c_str(), number(found.p999).c_str(), number(found.max).c_str(),
               number(found.max_norm).c_str(), worst_input);
}

void write_setting(std::FILE* file, const Setting& setting) {
  const Parameters& p = setting.parameters;
  std::fprintf(file, "{\"name\": \"%s\", \"alpha\": [%g, %g], \"theta\": [%g, %g, %g], \"degrees\": %g, \"phi\": %g, ",
               setting.name, p.alpha_x, p.alpha_y, p.theta_x, p.theta_y, p.theta_z, setting.degrees, setting.phi);
}

void write_density(std::FILE* file, const Setting& setting, int size) {
  write_setting(file, setting);
  std::fputs("\"pdf\": [", file);
  std::vector<double> grid = density(setting, size);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const char* separator = i == 0 ? "[" : i % std::size_t(size) == 0 ? "],\n[" : ",";
    std::fprintf(file, std::isfinite(grid[i]) ? "%s%.3g" : "%snull", separator, grid[i]);
  }
  std::fputs("]]}", file);
}

}  // namespace

int main(int argc, char** argv) {
  Options options = parse(argc, argv);
  std::FILE* file = report::open_output(options.out);

  const std::vector<Case> all = cases();
  std::vector<Errors> errors(3 * all.size());
  std::vector<Rejection> rejections(kRejectingCount);
  std::mutex terminal;
  report::in_parallel(errors.size() + kRejectingCount, options.threads, [&](std::size_t task) {
    if (task < errors.size()) {
      Errors& e = errors[task] = measure_errors(all[task / 3], int(task % 3), options.samples);
      std::lock_guard<std::mutex> lock(terminal);
      std::fprintf(stderr, "ellipsoid %-13s %-21s mean %6.2f  p99.9 %6.1f  max %6.1f eps, plain %6.2f %6.1f %6.1f\n",
                   e.warp, e.row.inputs.name, e.ellipsoid.mean, e.ellipsoid.p999, e.ellipsoid.max, e.plain.mean,
                   e.plain.p999, e.plain.max);
    } else {
      const Setting& setting = kRejecting[task - errors.size()];
      Rejection& r = rejections[task - errors.size()] = measure_rejection(setting, options.kept);
      std::lock_guard<std::mutex> lock(terminal);
      std::fprintf(stderr, "ellipsoid %-39s rejected: %5.1f %% by version 1, %5.1f %% by version 2, none by 3\n",
                   setting.name, 100 * r.first.rejected(), 100 * r.second.rejected());
    }
  });

  std::fputs("{\"row_notes\": {", file);
  const char* separator = "\n";
  for (const Case& row : all) {
    std::fprintf(file, "%s\"%s\": \"%s\"", separator, row.inputs.name, row.inputs.description);
    separator = ",\n";
  }
  std::fputs("\n},\n\"errors\": [", file);
  separator = "\n";
  for (const Errors& e : errors) {
    std::fputs(separator, file);
    separator = ",\n";
    write_errors(file, "ellipsoid", e, e.ellipsoid, e.worst_input.c_str());
    std::fputs(separator, file);
    write_errors(file, "plain", e, e.plain, "");
  }
  std::fputs("\n],\n\"rejections\": [", file);
  separator = "\n";
  for (std::size_t i = 0; i < kRejectingCount; ++i) {
    std::fputs(separator, file);
    separator = ",\n";
    write_setting(file, kRejecting[i]);
    std::fprintf(file, "\"rejected\": [%s, %s, 0]}", number(rejections[i].first.rejected()).c_str(),
                 number(rejections[i].second.rejected()).c_str());
  }
  std::fputs("\n],\n\"densities\": [", file);
  separator = "\n";
  for (const Setting& setting : kDrawn) {
    std::fputs(separator, file);
    separator = ",\n";
    write_density(file, setting, options.size);
  }
  std::fputs("\n]}\n", file);
  report::close_output(file, options.out);
}
