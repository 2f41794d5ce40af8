#include "support/operations.h"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>

namespace vndf::testing {
namespace {

template <Warp warp>
void run_normals(std::size_t count, const Column* in, float* const* out) {
  sample_normals(warp, count, {in[0], in[1], in[2]}, {in[3], in[4]}, {in[5], in[6]}, {out[0], out[1], out[2]});
}

template <DiskMap map>
void run_disk(std::size_t count, const Column* in, float* const* out) {
  sample_disk(map, count, {in[0], in[1]}, {out[0], out[1]});
}

float from_bits(std::uint32_t bits) {
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kLargest = std::numeric_limits<float>::max();

template <std::size_t N>
float pick(reference::Random& random, const float (&values)[N]) {
  return values[random.below(N)];
}

float any_wo(reference::Random& random) {
  static const float values[] = {0.f,      -0.f,    1.f,   -1.f,   0.6f,      -0.6f,      1e-20f,    -1e-20f,
                                 1e20f,    -1e20f,  1e30f, 1e-30f, 1e-40f,    -1e-40f,    0x1p-149f, 1e-38f,
                                 0x1p-75f, 0x1p75f, kNan,  -kNan,  kInfinity, -kInfinity, kLargest,  -kLargest};
  return random.below(2) ? pick(random, values) : float(random.uniform(-1, 1));
}
float any_alpha(reference::Random& random) {
  static const float values[] = {0.f,   -0.f, 0x1p-149f, 1e-40f, 1e-38f,  1e-30f, 1e-20f,    1e-6f,      1.f,
                                 100.f, 1e6f, 1e30f,     -0.5f,  -1e-30f, kNan,   kInfinity, -kInfinity, kLargest};
  return random.below(2) ? pick(random, values) : float(random.uniform(0, 1));
}
float any_u(reference::Random& random) {
  static const float values[] = {0.f,   -0.f,   1 - 0x1p-24f, 1.f,       1 + 0x1p-23f, -0x1p-24f,
                                 0.5f,  0.25f,  0.75f,        -1.f,      2.f,          1e-40f,
                                 1e10f, -1e30f, kNan,         kInfinity, -kInfinity,   kLargest};
  return random.below(2) ? pick(random, values) : random.unit();
}

}  // namespace

const std::vector<Operation>& operations() {
  static const std::vector<Operation> rows = {
      {"normals_polar", 7, 3, Warp::polar, run_normals<Warp::polar>},
      {"normals_concentric", 7, 3, Warp::concentric, run_normals<Warp::concentric>},
      {"normals_spherical_cap", 7, 3, Warp::spherical_cap, run_normals<Warp::spherical_cap>},
      {"disk_polar", 2, 2, Warp::polar, run_disk<DiskMap::polar>},
      {"disk_concentric", 2, 2, Warp::concentric, run_disk<DiskMap::concentric>},
  };
  return rows;
}

void PrintTo(const Operation& operation, std::ostream* out) {
  *out << operation.name;
}

Table hard_inputs(const Operation& operation, const reference::HardCase& hard_case, std::size_t count,
                  std::uint64_t seed) {
  reference::Inputs in = reference::generate(hard_case, operation.warp, count, seed);
  Table table{std::move(in.wo_x),    std::move(in.wo_y), std::move(in.wo_z), std::move(in.alpha_x),
              std::move(in.alpha_y), std::move(in.u_x),  std::move(in.u_y)};
  table.erase(table.begin(), table.end() - std::ptrdiff_t(operation.inputs));
  return table;
}

Table bad_inputs(const Operation& operation, std::size_t count, std::uint64_t seed) {
  using Any = float (*)(reference::Random&);
  constexpr Any kinds[] = {any_wo, any_wo, any_wo, any_alpha, any_alpha, any_u, any_u};
  Table table(operation.inputs, std::vector<float>(count));
  for (std::size_t i = 0; i < count; ++i) {
    reference::Random random(seed, i);
    for (std::size_t c = 0; c < operation.inputs; ++c) table[c][i] = kinds[7 - operation.inputs + c](random);
  }
  return table;
}

Table random_bits(const Operation& operation, std::size_t count, std::uint64_t seed) {
  Table table(operation.inputs, std::vector<float>(count));
  for (std::size_t i = 0; i < count; ++i) {
    reference::Random random(seed, i);
    for (auto& column : table) column[i] = from_bits(std::uint32_t(random.bits()));
  }
  return table;
}

Table mixed_inputs(const Operation& operation, std::size_t count, std::uint64_t seed) {
  std::vector<Table> sources;
  std::size_t kinds = reference::hard_cases().size() + 2;
  std::size_t each = count / kinds + 1;
  for (const auto& row : reference::hard_cases()) sources.push_back(hard_inputs(operation, row, each, seed));
  sources.push_back(bad_inputs(operation, each, seed));
  sources.push_back(random_bits(operation, each, seed));
  Table table(operation.inputs, std::vector<float>(count));
  for (std::size_t c = 0; c < table.size(); ++c)
    for (std::size_t i = 0; i < count; ++i) table[c][i] = sources[i % kinds][c][i / kinds];
  return table;
}

Table evaluate(const Operation& operation, const Table& in) {
  Table out(operation.outputs, std::vector<float>(in[0].size()));
  operation.run(in[0].size(), columns(in).data(), results(out).data());
  return out;
}

Table evaluate_on(const char* isa, const Operation& operation, const Table& in) {
  KeepIsa keep;
  EXPECT_EQ(set_isa(isa), IsaError::none) << isa;
  return evaluate(operation, in);
}

::testing::AssertionResult same_bits(const Table& expected, const Table& actual, const Table& in) {
  std::size_t differences = 0, first = 0, first_column = 0;
  for (std::size_t c = 0; c < expected.size(); ++c)
    for (std::size_t i = 0; i < expected[c].size(); ++i)
      if (!same_bits(expected[c][i], actual[c][i]) && differences++ == 0) {
        first = i;
        first_column = c;
      }
  if (differences == 0) return ::testing::AssertionSuccess();
  char values[100];
  std::snprintf(values, sizeof values, "%a instead of %a", actual[first_column][first], expected[first_column][first]);
  return ::testing::AssertionFailure() << differences << " values differ; output " << first_column << " at index "
                                       << first << " is " << values << " for " << describe(in, first);
}

std::string describe(const Table& in, std::size_t index) {
  std::string text;
  static const char* const names[] = {"wo", ", ", ", ", "  alpha", ", ", "  u", ", "};
  for (std::size_t c = 0; c < in.size(); ++c) {
    const char* name = names[7 - in.size() + c];
    char value[60];
    std::snprintf(value, sizeof value, "%s%s%a", name, name[0] == ',' ? "" : " ", in[c][index]);
    text += value;
  }
  return text;
}

std::vector<std::string> isa_names() {
  std::vector<std::string> names;
  for (const Isa& isa : isas()) names.push_back(isa.name);
  return names;
}

std::vector<std::string> supported_isa_names() {
  std::vector<std::string> names;
  for (const Isa& isa : isas())
    if (isa.supported) names.push_back(isa.name);
  return names;
}

std::string operation_and_isa(const ::testing::TestParamInfo<EveryOperation::ParamType>& info) {
  return std::string(std::get<0>(info.param).name) + "_" + std::get<1>(info.param);
}

}  // namespace vndf::testing
