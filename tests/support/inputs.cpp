#include "support/inputs.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace vndf::testing {
namespace {

using reference::Inputs;
using reference::Random;

float any_bits(Random& random) {
  auto bits = std::uint32_t(random.bits());
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

float good_value(Random& random, Kind kind) {
  switch (kind) {
    case Kind::alpha:
      return float(random.below(2) ? random.uniform(0, 1) : random.log_uniform(1e-4, 2));
    case Kind::theta:  // leans a little, or as it likes
      return float(random.below(4) ? random.uniform(-0.5, 0.5) : random.uniform(-3.2, 3.2));
    case Kind::eta:
      return random.below(2) ? 1.5f : float(random.uniform(0.4, 2.5));
    case Kind::u:
      return random.unit();
    case Kind::probability:  // or one lobe alone
      return random.below(4) ? random.unit() : float(random.below(2));
    case Kind::view:
    case Kind::light:
    case Kind::normal:
      break;
  }
  return float(random.uniform(-1, 1));
}

/// Columns of `tables`, index by index in turn.
Table dealt(const std::vector<Table>& tables, std::size_t count) {
  Table result(tables[0].size(), std::vector<float>(count));
  for (std::size_t c = 0; c < result.size(); ++c)
    for (std::size_t i = 0; i < count; ++i) result[c][i] = tables[i % tables.size()][c][i / tables.size()];
  return result;
}

template <class Value>
Table filled(const Operation& operation, std::size_t count, std::uint64_t seed, Value value) {
  Table table(operation.inputs.size(), std::vector<float>(count));
  for (std::size_t i = 0; i < count; ++i) {
    Random random(seed, i);
    for (std::size_t c = 0; c < table.size(); ++c) table[c][i] = value(random, operation.inputs[c].kind);
  }
  return table;
}

std::vector<Table> hard_tables(const Operation& operation, std::size_t count, std::uint64_t seed) {
  std::vector<Table> tables;
  for (const auto& row : reference::hard_cases()) tables.push_back(hard_inputs(operation, row, count, seed));
  return tables;
}

}  // namespace

std::size_t samples(int exponent) {
  const char* most = std::getenv("VNDF_TEST_SAMPLES");
  return std::size_t(1) << (most ? std::min(exponent, std::atoi(most)) : exponent);
}

Table hard_inputs(const Operation& operation, const reference::HardCase& hard_case, std::size_t count,
                  std::uint64_t seed) {
  Inputs in = reference::generate(hard_case, operation.warp, count, seed);
  Table view{in.wo_x, in.wo_y, in.wo_z}, alpha{in.alpha_x, in.alpha_y}, u{in.u_x, in.u_y};
  Table light(3, std::vector<float>(count)), normal = light;
  if (operation.takes(Kind::normal))
    sample_normals(operation.warp, count, in.wo(), in.alpha(), in.u(),
                   {normal[0].data(), normal[1].data(), normal[2].data()});
  if (operation.takes(Kind::light)) {
    Table rest(3, std::vector<float>(count));
    for (std::size_t i = 0; i < count; ++i) rest[0][i] = Random(seed + 1, i).unit();
    sample_dielectric(
        operation.warp, count, in.wo(), in.alpha(), 1.5f, {in.u_x.data(), in.u_y.data(), rest[0].data()},
        {{light[0].data(), light[1].data(), light[2].data()}, rest[0].data(), rest[1].data(), rest[2].data()});
  }
  Table table;
  for (const Input& input : operation.inputs) {
    const Table* known = input.kind == Kind::view     ? &view
                         : input.kind == Kind::alpha  ? &alpha
                         : input.kind == Kind::u      ? &u
                         : input.kind == Kind::light  ? &light
                         : input.kind == Kind::normal ? &normal
                                                      : nullptr;
    bool given = known && input.index < known->size();
    table.push_back(given ? (*known)[input.index] : std::vector<float>(count));
    std::size_t c = table.size() - 1;
    if (given && input.kind != Kind::light) continue;
    for (std::size_t i = 0; i < count; ++i)
      if (!given || Random(seed + 2, i).below(4) == 0) {
        Random random(seed + 3 + c, i);
        table[c][i] = good_value(random, input.kind);
      }
  }
  return table;
}

Table good_inputs(const Operation& operation, std::size_t count, std::uint64_t seed) {
  return dealt(hard_tables(operation, count / reference::hard_cases().size() + 1, seed), count);
}

float bad_value(Random& random, Kind kind) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity(),
                  kMax = std::numeric_limits<float>::max();
  static const float values[] = {0.f,    -0.f,   1.f,     -1.f,      0.6f,         -0.6f,        0.5f,     -0.5f,
                                 0.25f,  0.75f,  2.f,     -0.3f,     100.f,        1e6f,         1e10f,    1e20f,
                                 -1e20f, 1e30f,  -1e30f,  1e-6f,     1e-20f,       -1e-20f,      1e-30f,   -1e-30f,
                                 1e-38f, 1e-40f, -1e-40f, 0x1p-149f, 0x1p-75f,     0x1p75f,      kNan,     -kNan,
                                 kInf,   -kInf,  kMax,    -kMax,     1 - 0x1p-24f, 1 + 0x1p-23f, -0x1p-24f};
  switch (random.below(8)) {
    case 0:
      return any_bits(random);
    case 1:
    case 2:
    case 3:
      return values[random.below(std::size(values))];
    default:
      return good_value(random, kind);
  }
}

Table bad_inputs(const Operation& operation, std::size_t count, std::uint64_t seed) {
  return filled(operation, count, seed, bad_value);
}

Table random_bits(const Operation& operation, std::size_t count, std::uint64_t seed) {
  return filled(operation, count, seed, [](Random& random, Kind) { return any_bits(random); });
}

Table mixed_inputs(const Operation& operation, std::size_t count, std::uint64_t seed) {
  std::size_t each = count / (reference::hard_cases().size() + 2) + 1;
  std::vector<Table> tables = hard_tables(operation, each, seed);
  tables.push_back(bad_inputs(operation, each, seed));
  tables.push_back(random_bits(operation, each, seed));
  return dealt(tables, count);
}

::testing::AssertionResult same_bits(const Operation& operation, const Table& expected, const Table& actual,
                                     const Table& in) {
  std::size_t differences = 0, first = 0, column = 0;
  for (std::size_t c = 0; c < expected.size(); ++c)
    for (std::size_t i = 0; i < expected[c].size(); ++i)
      if (!same_bits(expected[c][i], actual[c][i]) && differences++ == 0) {
        first = i;
        column = c;
      }
  if (differences == 0) return ::testing::AssertionSuccess();
  char values[100];
  std::snprintf(values, sizeof values, " is %a instead of %a for ", actual[column][first], expected[column][first]);
  return ::testing::AssertionFailure() << operation.name << ": " << differences << " values differ; "
                                       << operation.outputs[column].name << " at index " << first << values
                                       << describe(operation, in, first);
}

std::string describe(const Operation& operation, const Table& in, std::size_t index) {
  std::string text;
  for (std::size_t c = 0; c < in.size(); ++c) {
    char value[60];
    std::snprintf(value, sizeof value, "%s%s %a", c ? ", " : "", operation.inputs[c].name.c_str(), in[c][index]);
    text += value;
  }
  return text;
}

}  // namespace vndf::testing
