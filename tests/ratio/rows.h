// The rows of the ratio tests: every hard case, and what renderers make.
#pragma once

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "reference/hard_cases.h"
#include "support/bits.h"

namespace vndf::reference {

inline void PrintTo(const HardCase& row, std::ostream* out) {
  *out << row.name;
}

inline void PrintTo(const Refraction& refraction, std::ostream* out) {
  *out << refraction.name;
}

}  // namespace vndf::reference

namespace vndf::ratio {

using reference::HardCase;
using testing::Table;

/// What a function asks of views.
enum class Views { any, unit, unit_above };

/// The hard cases that a function takes: those with a normal that is right, and with views of unit length but for a
/// thousandth; those all below the horizon are left out where views are turned up.
inline std::vector<HardCase> rows(Views views) {
  std::vector<HardCase> result;
  for (auto* cases : {&reference::hard_cases(), &reference::renderer_cases()})
    for (const HardCase& row : *cases) {
      auto in = reference::generate(row, Warp::polar, 64, 1);
      bool any_length = false, above = false;
      for (std::size_t i = 0; i < in.size(); ++i) {
        any_length |= std::fabs(std::hypot(in.wo_x[i], in.wo_y[i], in.wo_z[i]) - 1) > 2e-3;
        above |= in.wo_z[i] >= 0;
      }
      if (row.no_visible_normal || (views != Views::any && any_length) || (views == Views::unit_above && !above))
        continue;
      result.push_back(row);
    }
  return result;
}

/// A number from the environment, or a default.
inline std::size_t setting(const char* name, std::size_t otherwise) {
  const char* value = std::getenv(name);
  return value ? std::size_t(std::strtoull(value, nullptr, 0)) : otherwise;
}
/// Samples per row, as a power of two: VNDF_SAMPLES, or a default. A hundred times as many find ratios a little larger.
inline std::size_t sample_count(std::size_t otherwise) {
  return std::size_t(1) << setting("VNDF_SAMPLES", otherwise);
}
/// Of all that is drawn: VNDF_SEED, or what a search sets.
inline std::uint64_t& seed() {
  static std::uint64_t value = setting("VNDF_SEED", 13);
  return value;
}

using testing::kWarpNames;
using testing::kWarps;
using testing::Results;

/// wo, the surface and u of a row, by columns: 3 + Surface::kInputs + 2.
template <class Surface>
Table sampling_inputs(const HardCase& row, Warp warp, Views views, std::size_t count) {
  auto in = reference::generate(row, warp, count, seed());
  if (views == Views::unit_above)
    for (float& z : in.wo_z) z = std::fabs(z);
  Table columns{in.wo_x, in.wo_y, in.wo_z};
  for (std::size_t c = 0; c < Surface::kInputs; ++c) columns.emplace_back(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::array<float, 5> shape{in.alpha_x[i], in.alpha_y[i]};
    reference::Random random(seed() + 1, i);
    Surface::add_angles(random, shape.data());
    for (std::size_t c = 0; c < Surface::kInputs; ++c) columns[3 + c][i] = shape[c];
  }
  columns.push_back(in.u_x);
  columns.push_back(in.u_y);
  return columns;
}

}  // namespace vndf::ratio
