// What the functions promise about their columns: any count, any alignment, constants, lanes that do not know one
// another, splitting, working in place, and nothing written outside.
#include <algorithm>
#include <cstring>
#include <numeric>

#include "support/guarded_column.h"
#include "support/operations.h"

namespace vndf::testing {
namespace {

// More than any cache holds, which kernels may write past the caches, and a tail.
constexpr std::size_t kHuge = (std::size_t(1) << 20) + 15;
// More than one block of the kernels, and a tail for every vector width.
constexpr std::size_t kMany = 2 * 256 + 15;

Table prefix(const Table& table, std::size_t count) {
  Table result;
  for (const auto& column : table) result.emplace_back(column.begin(), column.begin() + std::ptrdiff_t(count));
  return result;
}

/// Evaluates with every column at its own misalignment, and looks at the guards.
Table evaluate_guarded(const Operation& operation, const Table& in, std::size_t shift) {
  std::size_t count = in[0].size();
  std::vector<GuardedColumn> inputs, outputs;
  std::vector<Column> from;
  std::vector<float*> to;
  inputs.reserve(in.size());
  outputs.reserve(operation.outputs);
  for (std::size_t c = 0; c < in.size(); ++c) {
    inputs.emplace_back(in[c], (shift + 5 * c) % 16);
    from.push_back(inputs.back().data());
  }
  for (std::size_t c = 0; c < operation.outputs; ++c) {
    outputs.emplace_back(count, (3 * shift + 7 * c + 1) % 16);
    to.push_back(outputs.back().data());
  }
  operation.run(count, from.data(), to.data());
  Table out;
  for (std::size_t c = 0; c < in.size(); ++c) {
    EXPECT_TRUE(inputs[c].intact()) << "around input " << c;
    EXPECT_EQ(std::memcmp(inputs[c].data(), in[c].data(), count * sizeof(float)), 0) << "input " << c;
  }
  for (std::size_t c = 0; c < outputs.size(); ++c) {
    EXPECT_TRUE(outputs[c].intact()) << "around output " << c;
    out.push_back(outputs[c].values());
  }
  return out;
}

class Columns : public EveryOperation {};
VNDF_FOR_EVERY_OPERATION(Columns);

TEST_P(Columns, EveryCount) {
  Table in = mixed_inputs(operation(), 3 * 16 + 1, 1);
  Table expected = evaluate_on("scalar", operation(), in);
  for (std::size_t count = 0; count <= 3 * 16 + 1; ++count) {
    Table first = prefix(in, count);
    ASSERT_TRUE(same_bits(prefix(expected, count), evaluate_guarded(operation(), first, count), first)) << count;
  }
}

TEST_P(Columns, CountsAroundBlocks) {
  Table in = mixed_inputs(operation(), kMany, 2);
  Table expected = evaluate_on("scalar", operation(), in);
  for (std::size_t count = 256 - 17; count <= kMany; ++count) {
    Table first = prefix(in, count);
    ASSERT_TRUE(same_bits(prefix(expected, count), evaluate_guarded(operation(), first, 0), first)) << count;
  }
}

TEST_P(Columns, EveryMisalignment) {
  Table in = mixed_inputs(operation(), kMany, 3);
  Table expected = evaluate_on("scalar", operation(), in);
  for (std::size_t shift = 0; shift < 16; ++shift)
    ASSERT_TRUE(same_bits(expected, evaluate_guarded(operation(), in, shift), in)) << shift;
}

TEST_P(Columns, NoColumnsNeededForNothing) {
  std::vector<Column> none(operation().inputs, static_cast<const float*>(nullptr));
  float* nowhere[3] = {};
  operation().run(0, none.data(), nowhere);
}

// Whatever the other lanes hold, one lane's bits stay.
TEST_P(Columns, NoiseInOtherLanes) {
  Table good = mixed_inputs(operation(), kMany, 4);
  Table expected = evaluate_on("scalar", operation(), good);
  reference::Random random(4);
  for (std::uint64_t round = 0; round < 64; ++round) {
    Table in = round % 2 ? random_bits(operation(), kMany, round) : bad_inputs(operation(), kMany, round);
    std::vector<bool> kept(kMany);
    for (std::size_t i = 0; i < kMany; ++i) {
      kept[i] = random.below(16) <= round / 4;
      for (std::size_t c = 0; kept[i] && c < in.size(); ++c) in[c][i] = good[c][i];
    }
    Table out = evaluate(operation(), in);
    for (std::size_t c = 0; c < out.size(); ++c)
      for (std::size_t i = 0; i < kMany; ++i) {
        ASSERT_TRUE(!kept[i] || same_bits(out[c][i], expected[c][i])) << "lane " << i << ", " << describe(good, i);
      }
  }
}

// Nor does it matter in which lane a sample is computed.
TEST_P(Columns, RotatedLanes) {
  Table in = mixed_inputs(operation(), kMany, 5);
  Table expected = evaluate_on("scalar", operation(), in);
  for (std::size_t by = 1; by <= 16; ++by) {
    for (auto* table : {&in, &expected})
      for (auto& column : *table) std::rotate(column.begin(), column.begin() + 1, column.end());
    ASSERT_TRUE(same_bits(expected, evaluate(operation(), in), in)) << by;
  }
}

TEST_P(Columns, SplitAgainstWhole) {
  Table in = mixed_inputs(operation(), kMany, 6);
  Table expected = evaluate_on("scalar", operation(), in);
  reference::Random random(6);
  for (int round = 0; round < 100; ++round) {
    Table out(operation().outputs, std::vector<float>(kMany, -7.f));
    for (std::size_t begin = 0; begin < kMany;) {
      std::size_t length = std::min<std::size_t>(random.below(round < 50 ? 40 : 400), kMany - begin);
      std::vector<float*> to;
      for (auto& column : out) to.push_back(column.data() + begin);
      operation().run(length, columns(in, begin).data(), to.data());
      begin += length;
    }
    ASSERT_TRUE(same_bits(expected, out, in));
  }
}

TEST_P(Columns, ConstantsGiveTheBitsOfRepeatedValues) {
  Table in = mixed_inputs(operation(), kMany, 7);
  for (unsigned constants = 1; constants < 1u << operation().inputs; ++constants)
    for (std::size_t count : {std::size_t(1), std::size_t(17), kMany}) {
      Table repeated = prefix(in, count);
      std::vector<Column> mixed = columns(repeated);
      for (std::size_t c = 0; c < repeated.size(); ++c)
        if (constants >> c & 1) {
          float value = in[c][(constants * 31 + c) % kMany];
          std::fill(repeated[c].begin(), repeated[c].end(), value);
          mixed[c] = Column(value);
        }
      Table out(operation().outputs, std::vector<float>(count));
      std::vector<float*> to;
      for (auto& column : out) to.push_back(column.data());
      operation().run(count, mixed.data(), to.data());
      ASSERT_TRUE(same_bits(evaluate(operation(), repeated), out, repeated)) << "constants " << constants;
    }
}

// Outputs in place of every choice of input columns, in every order.
TEST_P(Columns, InPlace) {
  Table in = mixed_inputs(operation(), 256 + 17, 8);
  Table expected = evaluate_on("scalar", operation(), in);
  std::vector<std::size_t> order(operation().inputs);
  std::iota(order.begin(), order.end(), 0);
  do {
    Table work = in;
    std::vector<float*> to;
    for (std::size_t c = 0; c < operation().outputs; ++c) to.push_back(work[order[c]].data());
    operation().run(work[0].size(), columns(work).data(), to.data());
    for (std::size_t c = 0; c < operation().outputs; ++c)
      ASSERT_TRUE(same_bits({expected[c]}, {work[order[c]]}, in)) << "output " << c << " over input " << order[c];
    // The next choice of outputs; the order of the columns that stay does not matter.
    std::reverse(order.begin() + std::ptrdiff_t(operation().outputs), order.end());
  } while (std::next_permutation(order.begin(), order.end()));
}

// The sizes at which a kernel may take another path: aligned for it, misaligned in one output, and in place.
TEST_P(Columns, HugeBatches) {
  Table in = mixed_inputs(operation(), kHuge, 10);
  Table expected = evaluate_on("scalar", operation(), prefix(in, kMany));
  for (std::size_t begin = kMany; begin < kHuge; begin += kMany) {
    Table part;
    std::size_t end = std::min(begin + kMany, kHuge);
    for (const auto& column : in)
      part.emplace_back(column.begin() + std::ptrdiff_t(begin), column.begin() + std::ptrdiff_t(end));
    Table results = evaluate_on("scalar", operation(), part);
    for (std::size_t c = 0; c < results.size(); ++c)
      expected[c].insert(expected[c].end(), results[c].begin(), results[c].end());
  }
  for (std::size_t misaligned = 0; misaligned <= operation().outputs; ++misaligned) {
    std::vector<GuardedColumn> outputs;
    std::vector<float*> to;
    outputs.reserve(operation().outputs);
    for (std::size_t c = 0; c < operation().outputs; ++c) {
      outputs.emplace_back(kHuge, c + 1 == misaligned ? 1 : 0);
      to.push_back(outputs.back().data());
    }
    operation().run(kHuge, columns(in).data(), to.data());
    for (std::size_t c = 0; c < outputs.size(); ++c) {
      EXPECT_TRUE(outputs[c].intact()) << "around output " << c;
      ASSERT_TRUE(same_bits({expected[c]}, {outputs[c].values()}, in))
          << "output " << c << ", misaligned " << misaligned;
    }
  }
  std::vector<GuardedColumn> work;
  std::vector<Column> from;
  work.reserve(in.size());
  for (const auto& column : in) {
    work.emplace_back(column, 0);
    from.push_back(work.back().data());
  }
  std::vector<float*> to;
  for (std::size_t c = 0; c < operation().outputs; ++c) to.push_back(work[c].data());
  operation().run(kHuge, from.data(), to.data());
  for (std::size_t c = 0; c < operation().outputs; ++c)
    ASSERT_TRUE(work[c].intact() && same_bits({expected[c]}, {work[c].values()}, in)) << "in place, output " << c;
}

// One column as several inputs (isotropic roughness), and as an output too.
TEST_P(Columns, OneColumnAsSeveralInputs) {
  Table in = mixed_inputs(operation(), kMany, 9);
  for (std::size_t a = 0; a < operation().inputs; ++a)
    for (std::size_t b = 0; b < a; ++b) {
      Table twice = in;
      twice[b] = twice[a];
      Table expected = evaluate_on("scalar", operation(), twice);
      Table work = in;
      std::vector<Column> from = columns(work);
      from[b] = from[a];
      Table out(operation().outputs, std::vector<float>(kMany));
      std::vector<float*> to;
      for (auto& column : out) to.push_back(column.data());
      to.back() = work[a].data();
      operation().run(kMany, from.data(), to.data());
      out.back() = work[a];
      ASSERT_TRUE(same_bits(expected, out, twice)) << "inputs " << a << " and " << b;
    }
}

TEST(Column, IsANumberOrAPointer) {
  const Columns3 wo{0, 0.5, 1.f};
  EXPECT_EQ(wo.x.data, nullptr);
  EXPECT_EQ(wo.x.value, 0);
  EXPECT_EQ(wo.y.value, 0.5f);
  const float values[] = {1.f};
  EXPECT_EQ(Column(values).data, values);
}

}  // namespace
}  // namespace vndf::testing
