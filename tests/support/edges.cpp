#include "support/edges.h"

#include <algorithm>
#include <array>

#include "reference/errors.h"

namespace vndf::testing {
namespace {

using reference::kEps;
using reference::Random;
using Group = std::vector<float>;  // the columns of one kind
constexpr double kPi = 3.14159265358979323846;
constexpr float kRight = 1.5707964f;  // the float next to a right angle
constexpr float kLargestPdf = 0x1p60f;

const std::vector<Group> kViews = {{0, 0, 1},          {0, 0, -1},
                                   {1, 0, 0},          {0, -1, 0},
                                   {0.6f, 0, 0.8f},    {0.6f, 0, -0.8f},
                                   {1, 0, 1e-30f},     {1, 1e-20f, 1e-10f},
                                   {1e-20f, 0, 1},     {1e-40f, 0, 1},
                                   {0.8f, 0.6f, 0},    {1, 0, -0.f},
                                   {1e-6f, 1e-6f, 1},  {1e-6f, 0, -1},
                                   {1, 0, -1e-30f},    {0.8f, 0.6f, 1e-40f},
                                   {0, -1, 0x1p-149f}, {-0.96f, 0.28f, 1e-35f}};
const std::vector<Group> kPairsOfAlpha = {{1e-6f, 1e-6f}, {1e-6f, 1}, {100, 1e-6f}, {0.01f, 0.5f},
                                          {0.5f, 0.5f},   {1, 1},     {3, 1e-4f},   {100, 100}};
const Group kAlphas = {1e-6f, 1e-4f, 0.01f, 0.5f, 1, 3, 100};
const std::vector<Group> kMirrors = {{0, 0}, {0, 0.3f}, {0.3f, 0}, {0, 100}, {1e-6f, 0}};
const Group kTinyAlphas = {1e-30f, 1e-20f, 1e-10f, 1e-8f, 1e-6f, 1e-5f};
const std::vector<Group> kThetas = {{0, 0, 0},
                                    {0, 0, 0.7f},
                                    {0.5f, -0.5f, 1},
                                    {1e-20f, 0, 0},
                                    {kRight, 0, 0},
                                    {0, kRight, 0.2f},
                                    {3.1f, 0, 1},
                                    {2, -2, 3},
                                    {0, kRight, 0},
                                    {0.3f, -0.2f, 1},
                                    {-0.42f, kRight, 0.82f},
                                    {1e-3f, 1e-3f, -3.14159274f}};
const Group kNumbers = {0, 0x1p-24f, 0.25f, 0.3f, 0.5f, 0.75f, 1 - 0x1p-24f, 1};
const Group kEtas = {0.4f, 1 / 1.5f, 0.99999f, 1.00001f, 1.5f, 2.5f};
const Group kMoreEtas = {1,       1 + 0x1p-16f, 1 - 0x1p-16f, 1 + 0x1p-15f, 1 - 0x1p-15f, 1.001f,
                         1.0001f, 1 / 1.0001f,  0.1f,         10,           0.51f,        1 / 0.51f};
const Group kHeights = {0x1p-149f, 1e-40f, 1e-38f, 1e-35f, 1e-31f, 1e-30f, 1e-20f, 1e-10f, -1e-35f, -1e-10f};

template <class Values>
auto pick(Random& random, const Values& values) {
  return values[random.below(std::uint32_t(values.size()))];
}
Group direction_at(Random& random, double z) {
  double phi = random.uniform(0, 2 * kPi), s = std::sqrt((1 - z) * (1 + z));
  return {float(s * std::cos(phi)), float(s * std::sin(phi)), float(z)};
}
Group any_view(Random& random) {
  switch (random.below(6)) {
    case 0:
      return direction_at(random, 0);
    case 1:
      return direction_at(random, random.log_uniform(1e-30, 1e-3));
    case 2:
      return pick(random, kViews);
    case 3: {
      double s = random.log_uniform(1e-12, 1e-2);
      return direction_at(random, std::sqrt(1 - s * s));
    }
    default:
      return direction_at(random, random.uniform(0, 1));
  }
}
Group turned_below_at_times(Random& random, Group direction) {
  if (random.below(4) == 0) direction[2] = -direction[2];
  return direction;
}
/// Sometimes from where the view goes, but for rounding.
Group any_light(Random& random, const Group& view) {
  if (random.below(4)) return turned_below_at_times(random, any_view(random));
  static const Group offsets = {0, 1e-40f, 1e-25f, 0x1p-24f};
  float off = pick(random, offsets);
  return {view[0] == 0 ? off : -view[0] * (1 - off), -view[1], random.below(2) ? pick(random, kHeights) : -view[2]};
}
Group tiny_alpha(Random& random) {
  float alpha = pick(random, kTinyAlphas);
  return random.below(2) ? pick(random, kMirrors) : Group{alpha, alpha};
}
Group any_alpha(Random& random) {
  if (random.below(4) == 0) return pick(random, kPairsOfAlpha);
  auto one = [&] { return random.below(4) ? float(random.log_uniform(1e-6, 100)) : pick(random, kAlphas); };
  float x = one();
  return {x, random.below(3) ? one() : x};
}
float any_number(Random& random) {
  static const Group edges = {0, 0x1p-32f, 0x1p-24f, 0x1p-12f, 0.5f, 1 - 0x1p-12f, 1 - 0x1p-24f, 1};
  if (random.below(2)) return random.unit();
  return random.below(3) ? pick(random, edges) : 1 - float(1 + random.below(64)) * float(kEps);
}
Group any_group(Random& random, Kind kind, const Group& view) {
  switch (kind) {
    case Kind::view:
      return turned_below_at_times(random, any_view(random));
    case Kind::light:
      return any_light(random, view);
    case Kind::normal:
      return any_view(random);
    case Kind::alpha:
      return any_alpha(random);
    case Kind::theta: {
      Group theta = pick(random, kThetas);
      for (float& angle : theta)
        if (random.below(4) == 0) angle = float(random.uniform(-3.2, 3.2));
      return theta;
    }
    case Kind::eta:
      return {random.below(2) ? pick(random, random.below(2) ? kEtas : kMoreEtas) : float(random.log_uniform(0.1, 10))};
    case Kind::u:
    case Kind::probability:
      break;
  }
  return {any_number(random), any_number(random), any_number(random)};
}

std::vector<Group> product(const Group& a, const Group& b) {
  std::vector<Group> all;
  for (float x : a)
    for (float y : b) all.push_back({x, y});
  return all;
}
std::vector<Group> literals(const Operation& operation, Kind kind) {
  switch (kind) {
    case Kind::alpha:
      return operation.takes(Kind::theta) ? kPairsOfAlpha : product(kAlphas, kAlphas);
    case Kind::theta:
      return kThetas;
    case Kind::eta:
      return product(kEtas, {0});
    case Kind::probability:
      return {{0}, {0.3f}, {1}};
    case Kind::u: {
      std::vector<Group> all;
      for (const Group& pair : product(kNumbers, kNumbers))
        for (float third : operation.takes(Kind::eta) ? Group{0, 0.5f, 1} : Group{0})
          all.push_back({pair[0], pair[1], third});
      return all;
    }
    case Kind::view:
    case Kind::light:
    case Kind::normal:
      break;
  }
  return kViews;
}

/// theta_z alone is the third angle.
float member(const Operation& operation, std::size_t c, const Group& group) {
  bool last = operation.inputs[c].name == "theta.z";
  return group[last ? 2 : operation.inputs[c].index];
}

/// The columns of a row by name, or null pointers.
struct Named {
  const Operation& operation;
  const Table &in, &out;
  const float* input(const char* name) const { return find(in, operation.input(name)); }
  const float* output(const char* name) const { return find(out, operation.output(name)); }

 private:
  static const float* find(const Table& table, std::size_t c) { return c < table.size() ? table[c].data() : nullptr; }
};
double length(const float* x, const float* y, const float* z, std::size_t i) {
  return std::hypot(double(x[i]), double(y[i]), double(z[i]));
}

/// Leaning by an angle next to this one.
bool is_right(float theta) {
  return std::fabs(std::fabs(theta) - kRight) < 0.01f;
}

bool in_range(Result result, float value) {
  switch (result) {
    case Result::density:
      return value >= 0 && value <= kLargestPdf && survives_heuristics(value);
    case Result::weight:
      return value >= 0 && value <= 1;
    case Result::f_cos:
      return value >= 0 && std::isfinite(value);
    case Result::side:
      return std::fabs(value) == 1;
    case Result::share:
      return value >= 0 && value <= 1 + 12 * kEps;
    default:
      return std::isfinite(value);
  }
}

}  // namespace

bool survives_heuristics(float pdf) {
  for (float other : {0.f, 1e-20f, 1.f, 1e10f, kLargestPdf}) {
    if (pdf + other == 0) continue;
    float balance = pdf / (pdf + other), power = pdf * pdf / (pdf * pdf + other * other);
    if (pdf * pdf + other * other == 0) power = 0;  // both under the root of the smallest number
    if (!(balance >= 0 && balance <= 1 && power >= 0 && power <= 1)) return false;
  }
  return true;
}

Table edge_inputs(const Operation& operation, Roughness roughness, std::size_t count, std::uint64_t seed) {
  Table table(operation.inputs.size(), std::vector<float>(count));
  for (std::size_t i = 0; i < count; ++i) {
    Random random(seed, i);
    Group view, group;
    for (std::size_t c = 0; c < table.size(); ++c) {
      const Input& input = operation.inputs[c];
      if (input.index == 0) group = any_group(random, input.kind, view);
      if (input.index == 0 && input.kind == Kind::alpha && roughness == Roughness::tiny) group = tiny_alpha(random);
      if (input.kind == Kind::view) view = group;
      table[c][i] = member(operation, c, group);
    }
  }
  return table;
}

Table grid_inputs(const Operation& operation) {
  Table table(operation.inputs.size());
  std::size_t count = 1;
  for (const Input& input : operation.inputs)
    if (input.index == 0) count *= literals(operation, input.kind).size();
  std::size_t step = 1;
  std::vector<Group> values;
  std::size_t size = 1;
  for (std::size_t c = 0; c < table.size(); ++c) {
    if (operation.inputs[c].index == 0) {
      step *= size;
      values = literals(operation, operation.inputs[c].kind);
      size = values.size();
    }
    for (std::size_t i = 0; i < count; ++i) table[c].push_back(member(operation, c, values[i / step % size]));
  }
  return table;
}

void expect_sound(const Operation& operation, const Table& in, const Table& out, Roughness roughness) {
  const Named of{operation, in, out};
  const float *wo_x = of.input("wo.x"), *wo_y = of.input("wo.y"), *wo_z = of.input("wo.z");
  const float *wi_x = of.output("wi.x"), *wi_y = of.output("wi.y"), *wi_z = of.output("wi.z");
  const float *wm_x = of.output("wm.x"), *wm_y = of.output("wm.y"), *wm_z = of.output("wm.z");
  const float *cos = of.output("wo_dot_wm"), *side = of.output("side");
  const float *pdf = of.output("pdf"), *weight = of.output("weight");
  const float *light_x = of.input("wi.x"), *light_y = of.input("wi.y"), *light_z = of.input("wi.z");
  const bool plain = operation.takes(Kind::alpha) && !operation.takes(Kind::theta);
  const float *theta_x = of.input("theta.x"), *theta_y = of.input("theta.y");
  const bool bounded = operation.name.find("_bounded") != std::string::npos;
  const bool two_sided = operation.name.find("_two_sided") != std::string::npos;
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    auto what = [&](const char* wrong) {
      std::string text = operation.name + ": " + wrong + " for " + describe(operation, in, i) + ":";
      for (std::size_t c = 0; c < out.size(); ++c)
        text += " " + operation.outputs[c].name + " " + std::to_string(out[c][i]);
      return text;
    };
    const double view = wo_x ? length(wo_x, wo_y, wo_z, i) : 1;
    const bool nearly_unit = view == 0 || std::fabs(view - 1) <= 2e-3;
    for (std::size_t c = 0; c < out.size(); ++c) {
      const Output& column = operation.outputs[c];
      bool of_normal = column.result == Result::normal || column.result == Result::cosine;
      // Normals are those of any view, but for the bound; and of any alpha, but for 0 and ellipsoids.
      bool promised = of_normal ? roughness == Roughness::promised : nearly_unit;
      if (bounded || column.result == Result::cosine) promised &= nearly_unit;
      // A leaning ellipsoid can have normals that turn away from the view, by rounding.
      if (column.result == Result::share) promised &= plain || pdf[i] > 0;
      // Below 1e-6 those of a disk that is seen from its edge are not.
      if (roughness == Roughness::tiny && column.result == Result::cosine)
        promised = nearly_unit && !(theta_x && (is_right(theta_x[i]) || is_right(theta_y[i])));
      ASSERT_TRUE(!promised || in_range(column.result, out[c][i])) << what(column.name.c_str());
    }
    if (!wo_x) continue;
    const bool above = wo_z[i] >= 0 || two_sided, unit = std::fabs(view - 1) <= 1e-6;
    if (wi_x && nearly_unit) {
      bool reflects = side ? side[i] > 0 : true, right = (double(wi_z[i]) * wo_z[i] > 0) == reflects;
      if (!side && !two_sided) right = above && wi_z[i] > 0;
      if (two_sided) right = std::signbit(wo_z[i]) ? wi_z[i] < 0 : wi_z[i] > 0;
      ASSERT_TRUE(right || (side && (wo_z[i] == 0 || wi_z[i] == 0)) || (pdf[i] == 0 && weight[i] == 0))
          << what("the wrong side");
    }
    if (roughness == Roughness::tiny) continue;
    if (wm_x && (!bounded || (above && (unit || view == 0)))) {
      ASSERT_LE(std::fabs(length(wm_x, wm_y, wm_z, i) - 1), 5 * kEps) << what("|wm|");
      // The normal is the upper one, or on the side of the view where that may be below.
      bool lower = (side && wo_z[i] < 0) || (two_sided && std::signbit(wo_z[i]));
      ASSERT_GE(lower ? -wm_z[i] : wm_z[i], 0) << what("wm.z");
    }
    const double light = wi_x ? length(wi_x, wi_y, wi_z, i) : 1;
    const bool as_sampled = std::fabs(view - 1) <= 8 * kEps;
    // Refraction takes the cosine of the exact normal, from which rounding leads far where a sharp shape is seen along.
    ASSERT_TRUE(!side || !as_sampled || std::fabs(light - 1) <= (plain ? 96 : 2048) * kEps) << what("|wi|");
    if (!above || !nearly_unit || view == 0) continue;
    if (wi_x && !side) {
      // 73 eps were seen below the surface, of an ellipsoid of alpha 1e-5 that leans by right angles both ways.
      double bound = plain || pdf[i] > 0 ? (as_sampled ? 16 : 24) : 128;
      ASSERT_LE(std::fabs(light / view - 1), bound * kEps) << what("|wi|");
    }
    if (!unit) continue;
    ASSERT_TRUE(!wi_x || std::fabs(wi_z[i]) <= 1) << what("wi.z");
    if (light_x && std::fabs(length(light_x, light_y, light_z, i) - 1) > 1e-6) continue;
    ASSERT_TRUE(!cos || (cos[i] <= 1 && (cos[i] >= 0 || !plain))) << what("wo.wm");
  }
}

void expect_sound(const Operation& operation, const Table& in, const std::vector<Column>& columns,
                  Roughness roughness) {
  const Table out = evaluate(operation, in, columns);
  expect_sound(operation, in, out, roughness);
  const Operation* evaluation = evaluation_of(operation);
  if (!evaluation || ::testing::Test::HasFailure()) return;
  Table pairs;
  std::vector<Column> of_pairs;
  for (const Input& input : evaluation->inputs) {
    std::size_t c = operation.input(input.name);
    pairs.push_back(c < in.size() ? in[c] : out[operation.output(input.name)]);
    of_pairs.push_back(c < in.size() ? columns[c] : Column(static_cast<const float*>(nullptr)));
  }
  for (std::size_t c = 0; c < pairs.size(); ++c)
    if (operation.input(evaluation->inputs[c].name) == in.size()) of_pairs[c] = pairs[c].data();
  expect_sound(*evaluation, pairs, evaluate(*evaluation, pairs, of_pairs), roughness);
}

}  // namespace vndf::testing
