// The golden hashes, which every build must reproduce: each instruction set, compiler and optimisation level, today and
// after any change that is not meant to change results. The inputs are made with integers alone.
#include <cstring>
#include <map>

#include "golden_hashes.h"
#include "reference/random.h"
#include "support/bits.h"
#include "support/float_mode.h"

namespace vndf::testing {
namespace {

constexpr std::size_t kCount = 1 << 16;

/// The columns of each kind.
std::map<Kind, Table> make_columns() {
  Table wo(3), alpha(2), u(2);
  reference::Random random(2018);
  // Views of any direction and length up to 1.7, alpha in four binades: exactly the same floats everywhere.
  for (std::size_t i = 0; i < kCount; ++i) {
    for (auto& column : wo) column.push_back(2 * random.unit() - 1);
    for (auto& column : alpha) {
      float fraction = random.unit() + 0x1p-24f;
      const float scale[] = {1.f, 0x1p-3f, 0x1p-6f, 0x1p-9f};
      column.push_back(fraction * scale[random.below(4)]);
    }
    for (auto& column : u) column.push_back(random.unit());
  }
  Table turned = {wo[1], wo[2], wo[0]}, eta = {std::vector<float>(kCount, 1.5f)};
  u.push_back(alpha[0]);
  return {{Kind::view, wo},      {Kind::light, turned}, {Kind::normal, turned}, {Kind::alpha, alpha},
          {Kind::theta, turned}, {Kind::u, u},          {Kind::eta, eta},       {Kind::probability, {u[1]}}};
}

/// FNV-1a over the bits of the outputs that may be left out, or of the others.
std::uint64_t hash(const Operation& operation, const Table& table, bool optional) {
  std::uint64_t h = 0xcbf29ce484222325u;
  bool any = false;
  for (std::size_t c = 0; c < table.size(); ++c) {
    if (operation.outputs[c].optional != optional) continue;
    any = true;
    for (float value : table[c]) {
      std::uint32_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      if (value != value) bits = 0x7fc00000;  // one NaN is as good as another
      h = (h ^ bits) * 0x100000001b3u;
    }
  }
  return any ? h : 0;
}

class Golden : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (set_isa(GetParam().c_str()) != IsaError::none) GTEST_SKIP() << "not supported by this processor";
  }
  KeepIsa keep_;
};
INSTANTIATE_TEST_SUITE_P(, Golden, ::testing::ValuesIn(isa_names()), [](const auto& info) { return info.param; });

/// The light on the other side of the surface, near the view's opposite.
Table across(const std::map<Kind, Table>& all) {
  Table light = all.at(Kind::light);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < kCount; ++i) light[c][i] = light[c][i] * 0.25f - all.at(Kind::view)[c][i];
  return light;
}

Table inputs(const Operation& operation, const std::map<Kind, Table>& all) {
  Table in;
  for (const Input& input : operation.inputs) in.push_back(all.at(input.kind)[input.index]);
  return in;
}

/// Compares all rows, of which each is computed in a mode of the thread: mode(its place in the table).
template <class Mode>
void expect_golden(Mode mode) {
  std::map<Kind, Table> all = make_columns(), refracted = all;
  refracted[Kind::light] = across(all);
  std::map<std::string, GoldenHashes> rows;
  for (const GoldenHashes& row : kGolden) EXPECT_TRUE(rows.emplace(row.name, row).second) << row.name << " twice";
  std::size_t place = 0;
  for (const Operation& operation : operations()) {
    InFloatMode in_mode(mode(place++));
    Table out = evaluate(operation, inputs(operation, all));
    std::uint64_t results = hash(operation, out, false), optional = hash(operation, out, true), across = 0;
    if (operation.takes(Kind::light) && operation.takes(Kind::eta))
      across = hash(operation, evaluate(operation, inputs(operation, refracted)), false);
    const GoldenHashes& row = rows[operation.name];
    EXPECT_TRUE(row.results == results && row.optional == optional && row.across == across)
        << "now {\"" << operation.name << "\", " << std::hex << std::showbase << results << "u, " << optional << "u, "
        << across << "u},";
    rows.erase(operation.name);
  }
  for (const auto& row : rows) ADD_FAILURE() << row.first << " is no row of the table";
}

TEST_P(Golden, Bits) {
  expect_golden([](std::size_t) { return float_mode(); });
}

// Denormals flushed, taken as zeros, or both; other roundings.
TEST_P(Golden, BitsInAnyModeOfTheThread) {
  expect_golden([](std::size_t place) { return kFloatModes[place % std::size(kFloatModes)]; });
}

}  // namespace
}  // namespace vndf::testing
