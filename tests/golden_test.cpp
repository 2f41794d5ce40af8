// The golden hashes, which every build must reproduce: each instruction set, compiler and optimisation level, today and
// after any change that is not meant to change results. The inputs are made with integers alone.
#include <cstring>
#include <map>

#include "golden_hashes.h"
#include "shading/operations.h"
#include "support/operations.h"

namespace vndf::testing {
namespace {

constexpr std::size_t kCount = 1 << 16;

/// Columns for each letter of shading::Operation.
std::map<char, Table> make_columns() {
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
  return {{'w', wo}, {'l', turned}, {'m', turned}, {'a', alpha}, {'t', turned}, {'u', u}, {'e', eta}};
}

/// FNV-1a over the bits.
std::uint64_t hash(const Table& table, std::size_t from, std::size_t to) {
  std::uint64_t h = 0xcbf29ce484222325u;
  for (std::size_t c = from; c < to; ++c)
    for (float value : table[c]) {
      std::uint32_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      if (value != value) bits = 0x7fc00000;  // one NaN is as good as another
      h = (h ^ bits) * 0x100000001b3u;
    }
  return h;
}

class Golden : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (set_isa(GetParam().c_str()) != IsaError::none) GTEST_SKIP() << "not supported by this processor";
  }
  KeepIsa keep_;
};
INSTANTIATE_TEST_SUITE_P(, Golden, ::testing::ValuesIn(isa_names()), [](const auto& info) { return info.param; });

TEST_P(Golden, Bits) {
  static const std::map<char, Table> all = make_columns();
  auto rows = std::begin(kGolden);
  auto compare = [&](const std::string& name, const std::string& letters, std::size_t outputs, auto run) {
    std::vector<Column> in;
    std::map<char, std::size_t> used;
    for (char letter : letters) in.push_back(all.at(letter)[used[letter]++].data());
    Table out(outputs, std::vector<float>(kCount));
    run(kCount, in, results(out));
    std::size_t always = outputs == 9 ? 5 : outputs;
    std::uint64_t found = hash(out, 0, always), normals = outputs == 9 ? hash(out, always, outputs) : 0;
    bool same = rows != std::end(kGolden) && rows->name == name && rows->results == found && rows->normals == normals;
    EXPECT_TRUE(same) << "now {\"" << name << "\", " << std::hex << std::showbase << found << "u, " << normals << "u},";
    if (rows != std::end(kGolden)) ++rows;
  };
  for (const Operation& o : operations())
    compare(o.name, std::string("wwwaauu").substr(7 - o.inputs), o.outputs,
            [&](std::size_t n, const auto& in, const auto& out) { o.run(n, in.data(), out.data()); });
  for (const shading::Operation& o : shading::operations()) compare(o.name, o.inputs, o.outputs, o.run);
  EXPECT_EQ(rows, std::end(kGolden)) << "rows without a function";
}

}  // namespace
}  // namespace vndf::testing
