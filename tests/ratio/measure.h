// The ratios of a function over a row, printed and held against bounds.
//
// A subject is a function of the library. It has
//   kInputs, kResults; kDirections, the unit vectors that its inputs begin with
//   kViews, the rows that it takes; static Table inputs(const HardCase&, std::size_t count)
//   static const std::array<Bound, kResults> bounds
//   static std::array<Moves, kInputs> moves(): how its inputs move
//   static std::vector<Founds> run(const Table&): what the library gives
//   static std::array<Exact, kResults> exact(const std::array<Quad, kInputs>&, const Founds&)
//   static bool in_domain(const std::array<float, kInputs>&): whether bounds are promised
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstring>

#include <gtest/gtest.h>

#include "ratio/rows.h"
#include "reference/ratio.h"
#include "support/bits.h"

namespace vndf::ratio {

using exact::Quad;
using exact::Vec;
using reference::Exact;
using reference::Found;
using reference::Moves;
using reference::Ratios;

struct Bound {
  const char* what;
  double max, p999;
};

template <std::size_t inputs>
std::array<float, inputs> inputs_at(const Table& in, std::size_t i) {
  std::array<float, inputs> values;
  for (std::size_t c = 0; c < inputs; ++c) values[c] = in[c][i];
  return values;
}

template <std::size_t inputs>
std::string describe(const std::array<float, inputs>& in) {
  std::string text;
  for (float value : in) {
    char number[40];
    std::snprintf(number, sizeof number, "%s%a", text.empty() ? "" : ", ", value);
    text += number;
  }
  return text;
}

template <class Subject>
auto ratios_of(const std::array<float, Subject::kInputs>& in, const typename Subject::Founds& found) {
  return reference::ratios<Subject::kInputs, Subject::kResults>(
      in, Subject::moves(), found, [&](const auto& at) { return Subject::exact(at, found); });
}

/// One line of ratios, and its bounds.
template <class Subject>
void measure_table(const std::string& row, const Table& in) {
  const std::vector<typename Subject::Founds> found = Subject::run(in);
  std::array<Ratios, Subject::kResults> ratios;
  for (std::size_t i = 0; i < found.size(); ++i) {
    auto at = inputs_at<Subject::kInputs>(in, i);
    if (!Subject::in_domain(at)) continue;
    auto of = ratios_of<Subject>(at, found[i]);
    for (std::size_t r = 0; r < Subject::kResults; ++r) ratios[r].add(of[r], i);
  }
  std::printf("ratios %s:", row.c_str());
  for (std::size_t r = 0; r < Subject::kResults; ++r)
    if (ratios[r].size())
      std::printf("  %s %.2f, %.2f, %.2f", Subject::bounds[r].what, ratios[r].mean(), ratios[r].p999(),
                  ratios[r].max());
  std::printf("  (mean at most, p99.9, max)\n");
  for (std::size_t r = 0; r < Subject::kResults; ++r) {
    const Bound& bound = Subject::bounds[r];
    if (!ratios[r].size()) continue;
    auto worst = inputs_at<Subject::kInputs>(in, ratios[r].worst());
    EXPECT_LE(ratios[r].max(), bound.max) << bound.what << " at " << describe(worst);
    EXPECT_LE(ratios[r].p999(), bound.p999) << bound.what;
  }
}

template <class Subject, class... More>
void measure(const std::string& name, const HardCase& row, std::size_t count, const More&... more) {
  measure_table<Subject>(name, Subject::inputs(row, count, more...));
}

// Parts of subjects.

/// The last inputs are those in [0, 1].
template <std::size_t inputs>
std::array<Moves, inputs> moves_of(std::size_t first_u = inputs) {
  std::array<Moves, inputs> moves;
  for (std::size_t i = 0; i < inputs; ++i) moves[i] = i < first_u ? Moves::outwards : Moves::within_one;
  return moves;
}

/// Within 8 eps, as directions that were sampled are.
inline bool is_unit(const float* v, double off = 8 * 0x1p-24) {
  return std::fabs(std::hypot(double(v[0]), double(v[1]), double(v[2])) - 1) <= off;
}
/// As far off as a renderer may let them come.
inline bool is_nearly_unit(const float* v) {
  return is_unit(v, 1.01e-3);
}
template <std::size_t inputs>
bool in_unit_interval(const std::array<float, inputs>& in, std::size_t first) {
  for (std::size_t i = first; i < inputs; ++i)
    if (!(in[i] >= 0 && in[i] <= 1)) return false;
  return true;
}
/// Of wo and alpha: A wo is along the normal, or its azimuth is more than what turns it to that of the x axis.
inline bool has_azimuth(const float* in) {
  double larger = std::max(std::fabs(double(in[0]) * in[3]), std::fabs(double(in[1]) * in[4]));
  return larger == 0 || larger > std::max(0x1p-108, 0x1p-54 * std::fabs(double(in[2])));
}
/// alpha, and angles where there are more inputs. Ellipsoids that lean have the bounds for alpha up to 1.
template <class Surface>
bool is_surface(const float* in) {
  const float largest = Surface::kInputs == 5 ? 1.f : 100.f;
  for (std::size_t i = 0; i < Surface::kInputs; ++i)
    if (i < 2 ? !(in[i] >= 0.999e-6f && in[i] <= largest) : !(std::fabs(in[i]) < 3.1416f)) return false;
  return true;
}

/// eta from 0.1 to 10, and not so close to 1 that the surface counts as index-matched.
inline bool is_index(float eta) {
  return eta >= 0.1f && eta <= 10.f && std::fabs(eta - 1) >= 0.99e-4f;
}

/// A result with its slack.
inline Exact exact_with(Quad slack, Quad value, bool compared) {
  Exact result = reference::exact_number(value, compared);
  result.size += Quad(0x1p25) * slack;
  return result;
}

/// Cosines next to 1 are returned as 1.
inline Quad at_most_one(float found, Quad exact) {
  return found == 1 && exact > 1 && exact < Quad(1 + 0x1p-20 + 0x1p-23) ? Quad(1) : exact;
}
inline Vec at_most_one(const std::array<float, 3>& found, Vec exact) {
  exact.z = at_most_one(found[2], exact.z);
  if (found[2] == -1) exact.z = -at_most_one(1, -exact.z);
  return exact;
}

}  // namespace vndf::ratio
