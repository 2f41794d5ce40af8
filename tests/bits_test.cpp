// Every instruction set gives the bits of the scalar one, whatever the inputs and the mode of the thread are.
#include <algorithm>

#include "support/every_operation.h"
#include "support/float_mode.h"

namespace vndf::testing {
namespace {

const std::size_t kChunk = samples(16);

class Bits : public EveryOperation {
 protected:
  void expect_same_bits(const Table& in) const {
    Table expected = on_scalar([&] { return evaluate(operation(), in); });
    on_every_isa([&] { ASSERT_TRUE(same_bits(operation(), expected, evaluate(operation(), in), in)); });
  }
  /// The normals and the disks of plain GGX are what all other functions begin with.
  bool is_first() const {
    Result first = operation().outputs[0].result;
    bool plain = operation().takes(Kind::alpha) && !operation().takes(Kind::theta);
    return first == Result::point || (first == Result::normal && plain);
  }
};
VNDF_FOR_EVERY_OPERATION(Bits, true);

TEST_P(Bits, HardCases) {
  const auto& rows = reference::hard_cases();
  const std::size_t all = samples(is_first() ? 24 : 19);
  const std::size_t chunk = std::min(kChunk, all / rows.size() + 1), chunks = all / chunk / rows.size() + 1;
  for (const auto& row : rows)
    for (std::size_t k = 0; k < chunks && !HasFailure(); ++k) {
      SCOPED_TRACE(row.name);
      expect_same_bits(hard_inputs(operation(), row, chunk, k));
    }
}

TEST_P(Bits, BadInputs) {
  for (std::uint64_t seed = 0; seed < (is_first() ? 32 : 8) && !HasFailure(); ++seed) {
    expect_same_bits(bad_inputs(operation(), kChunk, seed));
    expect_same_bits(random_bits(operation(), kChunk, seed));
    expect_same_bits(mixed_inputs(operation(), kChunk / 2, seed));
  }
}

// Ray tracers ask renderers to flush denormals and to take them as zeros.
TEST_P(Bits, InAnyModeOfTheThread) {
  for (std::uint64_t seed = 20; seed < (is_first() ? 28 : 21) && !HasFailure(); ++seed)
    for (const Table& in : {mixed_inputs(operation(), kChunk, seed), bad_inputs(operation(), kChunk, seed)}) {
      Table expected = on_scalar([&] { return evaluate(operation(), in); });
      for (auto mode : kFloatModes)
        on_every_isa([&] {
          Table out(operation().outputs.size(), std::vector<float>(in[0].size()));
          {
            InFloatMode in_mode(mode);
            operation().run(in[0].size(), columns(in).data(), results(out).data());
          }
          ASSERT_TRUE(same_bits(operation(), expected, out, in)) << "mode " << std::hex << mode;
        });
    }
}

// Without angles, given as constants or as columns, ellipsoids are plain GGX with separable masking, to the bit. But
// the weights across of columns of theta_x and theta_y, which are eq. 50 of Walter et al. 2015 in one division, are
// within 4 eps.
TEST_P(Bits, OfNoAnglesAreThoseOfPlainGgx) {
  if (!operation().takes(Kind::theta)) return;
  std::string name = operation().name;
  name.erase(name.find("_t"), std::string("_turned").size());
  const Operation* separable = find_operation(name + "_separable");
  const Operation* counterpart = separable ? separable : find_operation(name);
  if (!counterpart) GTEST_SKIP() << "plain GGX has no " << name;
  const Operation& plain = *counterpart;
  Table in = good_inputs(operation(), samples(18), 22);
  for (std::size_t c = 0; c < in.size(); ++c)
    if (operation().inputs[c].kind == Kind::theta) in[c].assign(in[c].size(), 0.f);
  if (name.find("reflection") == 0)
    for (float& z : in[2]) z = std::fabs(z);
  Table of_plain;
  for (const Input& input : plain.inputs) of_plain.push_back(in[operation().input(input.name)]);
  on_every_isa([&] {
    for (bool constants : {false, true}) {
      std::vector<Column> from = columns(in);
      for (std::size_t c = 0; c < from.size(); ++c)
        if (constants && operation().inputs[c].kind == Kind::theta) from[c] = 0.f;
      Table expected = evaluate(plain, of_plain), out = evaluate(operation(), in, from);
      std::size_t across = operation().output(operation().takes(Kind::light) ? "f_cos" : "weight");
      if (operation().takes(Kind::eta) && operation().input("theta.x") < in.size() && !constants)
        for (std::size_t i = 0; i < in[0].size(); ++i) {
          float exact = expected[across][i], found = out[across][i];
          bool unit = std::fabs(std::hypot(in[0][i], in[1][i], in[2][i]) - 1) < 1e-3f;
          float bound = operation().takes(Kind::probability) ? 0x1p-21f : 0x1p-22f;  // two more quotients
          ASSERT_TRUE(!unit || std::fabs(found - exact) <= bound * exact)
              << found << " for " << describe(plain, of_plain, i);
          out[across][i] = exact;
        }
      ASSERT_TRUE(same_bits(plain, expected, out, of_plain)) << "constants " << constants;
    }
  });
}

}  // namespace
}  // namespace vndf::testing
