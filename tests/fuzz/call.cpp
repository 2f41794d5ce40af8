#include "fuzz/call.h"

#include <algorithm>
#include <cstdio>
#include <deque>

#include "fuzz/fence.h"
#include "fuzz/inputs.h"
#include "support/float_mode.h"

namespace vndf::fuzz {
namespace {

using testing::Operation;
using testing::Result;
using Results = std::vector<std::vector<float>>;

constexpr std::size_t kMany = std::size_t(1) << 20;  // here and there about as many lanes, which stream
constexpr std::size_t kGap = 16;
constexpr double kEps = 0x1p-24;

/// Where a call's columns lie, the same for every set.
struct Place {
  std::size_t gap;
  bool at_end;
};
struct Call {
  Operation row;
  std::size_t count, split;  ///< the other sets take it in two calls
  std::vector<Values> in;
  std::vector<Place> in_places, out_places;
  std::vector<int> same_as;  ///< the input whose column an output is, kOwn or kUnwanted
  static constexpr int kOwn = -1, kUnwanted = -2;
};

Place place(Source& source) {
  return {source.one_in(2) ? 0 : source.below(kGap), source.one_in(2)};
}

std::size_t pick_count(Source& source) {
  return source.one_in(256) ? kMany - 40 + source.below(80) : source.below(601);
}

/// One of the table, or with a shape that make_shape took.
Operation pick_row(Source& source) {
  const auto& all = testing::operations();
  Operation row = all[source.below(std::uint32_t(all.size()))];
  const Shape shape = make_shape(source);
  const Warp warp = row.warp;
  if (row.name.find("normals_matrix") == 0)
    row.call = [=](std::size_t n, const testing::In& in, const testing::Out& out) {
      sample_normals(warp, n, in.wo, shape, in.pair(), out.wm);
    };
  return row;
}

Call any_call(Source& source) {
  Operation row = pick_row(source);
  std::size_t count = pick_count(source), split = source.below(std::uint32_t(count + 1));
  Call call{row, count, split, make_inputs(source, row, count), {}, {}, {}};
  for (std::size_t c = 0; c < call.in.size(); ++c) call.in_places.push_back(place(source));
  bool in_place = source.one_in(4) && !call.in.empty();
  for (const testing::Output& output : row.outputs) {
    auto input = int(source.below(std::uint32_t(call.in.size())));
    bool taken = std::count(call.same_as.begin(), call.same_as.end(), input) > 0;
    bool unwanted = output.optional && source.one_in(3);
    call.same_as.push_back(unwanted                                                      ? Call::kUnwanted
                           : in_place && !taken && !call.in[std::size_t(input)].constant ? input
                                                                                         : Call::kOwn);
    call.out_places.push_back(place(source));
  }
  return call;
}

/// A column of memory for each column that a function has.
std::deque<Fence>& fences(std::size_t columns) {
  static std::deque<Fence> all;
  while (all.size() < columns) all.emplace_back(kMany + 64 + kGap);
  return all;
}

std::string hex(float value) {
  char text[48];
  std::snprintf(text, sizeof text, "%a", double(value));
  return text;
}

std::string describe(const Call& call, std::size_t lane) {
  std::string text = "count " + std::to_string(call.count) + ", lane " + std::to_string(lane) + ":";
  for (std::size_t c = 0; c < call.in.size(); ++c)
    text += " " + call.row.inputs[c].name + (call.in[c].constant ? " all " : " ") + hex(call.in[c].all[lane]);
  return text;
}

/// Calls the function on the set in use. Says what is wrong with how it did.
std::string run(const Call& call, std::size_t split, Results& results) {
  const std::size_t inputs = call.in.size(), outputs = call.same_as.size();
  auto& memory = fences(inputs + outputs);
  std::vector<Column> in;
  std::vector<float*> writable(inputs), out(outputs);
  for (std::size_t c = 0; c < inputs; ++c) {
    const std::vector<float>& values = call.in[c].all;
    writable[c] = memory[c].place(call.count, call.in_places[c].gap, call.in_places[c].at_end);
    if (call.count) std::memcpy(writable[c], values.data(), call.count * sizeof(float));
    if (call.in[c].constant && call.count)
      in.push_back(values[0]);
    else
      in.push_back(writable[c]);
  }
  for (std::size_t c = 0; c < outputs; ++c) {
    Fence& own = memory[inputs + c];
    out[c] = own.place(call.count, call.out_places[c].gap, call.out_places[c].at_end);
    std::fill_n(out[c], call.count, -7.f);
    if (call.same_as[c] >= 0) out[c] = writable[std::size_t(call.same_as[c])];
    if (call.same_as[c] == Call::kUnwanted) out[c] = nullptr;
  }

  call.row.run(split, in.data(), out.data());
  if (split < call.count) {
    std::vector<Column> rest = in;
    std::vector<float*> rest_out = out;
    for (Column& column : rest)
      if (column.data) column.data += split;
    for (float*& column : rest_out)
      if (column) column += split;
    call.row.run(call.count - split, rest.data(), rest_out.data());
  }

  for (std::size_t c = 0; c < inputs; ++c) {
    bool is_output = std::count(call.same_as.begin(), call.same_as.end(), int(c)) > 0;
    if (!memory[c].intact()) return "written beside " + call.row.inputs[c].name;
    if (!is_output && call.count && std::memcmp(writable[c], call.in[c].all.data(), call.count * sizeof(float)) != 0)
      return call.row.inputs[c].name + " was changed";
  }
  results.assign(outputs, {});
  for (std::size_t c = 0; c < outputs; ++c) {
    if (!memory[inputs + c].intact()) return "written beside " + call.row.outputs[c].name;
    if (out[c]) results[c].assign(out[c], out[c] + call.count);
  }
  return "";
}

bool same_bits(float a, float b) {
  return std::memcmp(&a, &b, sizeof a) == 0 || (a != a && b != b);
}

/// The first lane in which two sets disagree.
std::string compare(const Call& call, const Results& expected, const Results& found) {
  for (std::size_t c = 0; c < expected.size(); ++c)
    for (std::size_t i = 0; i < expected[c].size(); ++i)
      if (!same_bits(expected[c][i], found[c][i]))
        return call.row.outputs[c].name + " is " + hex(found[c][i]) + " instead of " + hex(expected[c][i]) + "; " +
               describe(call, i);
  return "";
}

/// Whether a direction is as long as the view. Refraction is by the normal: what that is off, and the view, is
/// magnified by indices of a tenth. Reflection of views below the horizon has directions of no use.
bool is_length(double norm, const Call& call, std::size_t i) {
  const bool refracted = call.row.takes(testing::Kind::eta);
  if (!refracted && call.in[2].all[i] < 0) return true;
  const double view = length(call.in, 0, i);
  return std::fabs(norm - (refracted ? 1 : view)) <= (refracted ? 1024 * kEps + 100 * std::fabs(view - 1) : 16 * kEps);
}

/// What the documentation promises of one output of a lane in the domain.
bool as_promised(const Call& call, const Results& out, std::size_t c, std::size_t i) {
  const auto& outputs = call.row.outputs;
  const double value = out[c][i];
  if (!std::isfinite(value)) return false;
  const bool first = c == 0 || outputs[c - 1].result != outputs[c].result;
  auto norm = [&](std::size_t components) {
    double squares = 0;
    for (std::size_t k = c; k < c + components; ++k) squares += double(out[k][i]) * double(out[k][i]);
    return std::sqrt(squares);
  };
  switch (outputs[c].result) {
    case Result::normal:
      if (outputs[c].optional) return std::fabs(value) <= 1 + 6 * kEps;
      return !first || (std::fabs(norm(3) - 1) <= 6 * kEps && out[c + 2][i] >= 0);
    case Result::direction:
      return !first || is_length(norm(3), call, i);
    case Result::point:
      return !first || norm(2) <= 1 + 7 * kEps;
    case Result::cosine:
      return value <= 1;
    case Result::density:
      return value >= 0 && value <= 0x1p60;
    case Result::weight:
      return value >= 0 && value <= 1;
    case Result::share:  // of which no more is promised
      return value >= 0 && value <= 1 + 8 * kEps;
    case Result::side:
      return value == 1 || value == -1;
    case Result::f_cos:
      return value >= 0;
  }
  return false;
}

std::string check(const Call& call, const Results& out) {
  for (std::size_t i = 0; i < call.count; ++i) {
    if (!in_domain(call.row, call.in, i)) continue;
    for (std::size_t c = 0; c < out.size(); ++c)
      if (!out[c].empty() && !as_promised(call, out, c, i))
        return call.row.outputs[c].name + " is " + hex(out[c][i]) + "; " + describe(call, i);
  }
  return "";
}

}  // namespace

Outcome make_call(Source& source) {
  const Call call = any_call(source);
  const auto wanted = testing::kFloatModes[source.one_in(2) ? 0 : source.below(std::size(testing::kFloatModes))];
  Outcome outcome{0, ""};
  Results expected, found;
  for (const Isa& isa : isas()) {
    if (!isa.supported || set_isa(isa.name) != IsaError::none) continue;
    const bool scalar = &isa == isas().begin();
    {
      testing::InFloatMode in_mode(wanted);
      const auto mode = testing::float_mode();  // some emulators take less
      outcome.fault = run(call, scalar ? call.count : call.split, found);
      if (testing::float_mode() != mode && outcome.fault.empty()) outcome.fault = "the mode of the thread was changed";
    }
    if (scalar) expected = found;
    if (outcome.fault.empty()) outcome.fault = scalar ? check(call, found) : compare(call, expected, found);
    outcome.lanes += call.count;
    if (!outcome.fault.empty()) {
      outcome.fault = std::string(isa.name) + ": " + call.row.name + ": " + outcome.fault;
      break;
    }
  }
  return outcome;
}

}  // namespace vndf::fuzz
