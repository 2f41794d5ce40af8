// What every function promises about its columns: any count, any alignment, constants, lanes that do not know one
// another, splitting, working in place, outputs that are not wanted, and nothing written outside.
#include <algorithm>
#include <numeric>

#include "support/every_operation.h"
#include "support/guarded_column.h"

namespace vndf::testing {
namespace {

// More than one block of the kernels, and a tail for every vector width.
constexpr std::size_t kMany = 2 * 256 + 15;

Table part(const Table& table, std::size_t from, std::size_t count) {
  Table result;
  for (const auto& column : table) {
    auto begin = column.begin() + std::ptrdiff_t(from);
    result.emplace_back(begin, begin + std::ptrdiff_t(count));
  }
  return result;
}

class Columns : public EveryOperation {
 protected:
  std::size_t inputs() const { return operation().inputs.size(); }
  std::size_t outputs() const { return operation().outputs.size(); }
  bool is(std::size_t input, Kind kind) const { return operation().inputs[input].kind == kind; }

  Table mixed(std::size_t count, std::uint64_t seed) const { return mixed_inputs(operation(), count, seed); }
  Table scalar(const Table& in) const {
    return on_scalar([&] { return evaluate(operation(), in); });
  }
  ::testing::AssertionResult same(const Table& expected, const Table& actual, const Table& in) const {
    return same_bits(operation(), expected, actual, in);
  }
  /// Evaluates with every column at its own misalignment, and looks at the guards.
  Table guarded(const Table& in, std::size_t shift) const;
};
VNDF_FOR_EVERY_OPERATION(Columns, true);

Table Columns::guarded(const Table& in, std::size_t shift) const {
  std::size_t count = in[0].size();
  std::vector<GuardedColumn> ins, outs;
  std::vector<Column> from;
  std::vector<float*> to;
  for (std::size_t c = 0; c < in.size(); ++c) ins.emplace_back(in[c], (shift + 5 * c) % 16);
  for (std::size_t c = 0; c < outputs(); ++c) outs.emplace_back(count, (3 * shift + 7 * c + 1) % 16);
  for (auto& column : ins) from.push_back(column.data());
  for (auto& column : outs) to.push_back(column.data());
  operation().run(count, from.data(), to.data());
  Table out;
  for (std::size_t c = 0; c < in.size(); ++c) {
    EXPECT_TRUE(ins[c].intact()) << "around " << operation().inputs[c].name;
    EXPECT_TRUE(std::equal(in[c].begin(), in[c].end(), ins[c].data(),
                           [](float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; }))
        << operation().inputs[c].name << " was written";
  }
  for (std::size_t c = 0; c < outs.size(); ++c) {
    EXPECT_TRUE(outs[c].intact()) << "around " << operation().outputs[c].name;
    out.push_back(outs[c].values());
  }
  return out;
}

TEST_P(Columns, EveryCount) {
  constexpr std::size_t kCount = 3 * 16 + 1;
  Table in = mixed(kCount, 1), expected = scalar(in);
  on_every_isa([&] {
    for (std::size_t count = 0; count <= kCount; ++count) {
      Table first = part(in, 0, count);
      ASSERT_TRUE(same(part(expected, 0, count), guarded(first, count), first)) << count;
    }
  });
}

TEST_P(Columns, CountsAroundBlocks) {
  Table in = mixed(kMany, 2), expected = scalar(in);
  on_every_isa([&] {
    for (std::size_t count = 256 - 17; count <= kMany; ++count) {
      Table first = part(in, 0, count);
      ASSERT_TRUE(same(part(expected, 0, count), guarded(first, 0), first)) << count;
    }
  });
}

TEST_P(Columns, EveryMisalignment) {
  Table in = mixed(kMany, 3), expected = scalar(in);
  on_every_isa([&] {
    for (std::size_t shift = 0; shift < 16; ++shift) ASSERT_TRUE(same(expected, guarded(in, shift), in)) << shift;
  });
}

TEST_P(Columns, NoneAreNeededForNothing) {
  const std::vector<Column> none(inputs(), static_cast<const float*>(nullptr));
  const std::vector<float*> nowhere(outputs());
  on_every_isa([&] { operation().run(0, none.data(), nowhere.data()); });
}

// Whatever the other lanes hold, one lane's bits stay.
TEST_P(Columns, NoiseInOtherLanes) {
  Table good = mixed(kMany, 4), expected = scalar(good);
  on_every_isa([&] {
    reference::Random random(4);
    for (std::uint64_t round = 0; round < 32; ++round) {
      Table in = bad_inputs(operation(), kMany, round);
      std::vector<bool> kept(kMany);
      for (std::size_t i = 0; i < kMany; ++i) {
        kept[i] = random.below(16) <= round / 2;
        for (std::size_t c = 0; kept[i] && c < in.size(); ++c) in[c][i] = good[c][i];
      }
      Table out = evaluate(operation(), in);
      for (std::size_t c = 0; c < out.size(); ++c)
        for (std::size_t i = 0; i < kMany; ++i)
          if (kept[i]) {
            ASSERT_TRUE(same_bits(out[c][i], expected[c][i])) << "lane " << i << ", " << describe(operation(), good, i);
          }
    }
  });
}

// Nor does it matter in which lane a sample is computed.
TEST_P(Columns, RotatedLanes) {
  Table in = mixed(kMany, 5), expected = scalar(in);
  for (std::size_t by = 1; by <= 16; ++by) {
    for (auto* table : {&in, &expected})
      for (auto& column : *table) std::rotate(column.begin(), column.begin() + 1, column.end());
    on_every_isa([&] { ASSERT_TRUE(same(expected, evaluate(operation(), in), in)) << by; });
  }
}

TEST_P(Columns, SplitAgainstWhole) {
  Table in = mixed(kMany, 6), expected = scalar(in);
  on_every_isa([&] {
    reference::Random random(6);
    for (int round = 0; round < 100; ++round) {
      Table out(outputs(), std::vector<float>(kMany, -7.f));
      for (std::size_t begin = 0; begin < kMany;) {
        std::size_t length = std::min<std::size_t>(random.below(round < 50 ? 40 : 400), kMany - begin);
        operation().run(length, columns(in, begin).data(), results(out, begin).data());
        begin += length;
      }
      ASSERT_TRUE(same(expected, out, in));
    }
  });
}

// All sets of columns as constants, or some hundred of them, and all columns of the surface.
TEST_P(Columns, ConstantsGiveTheBitsOfRepeatedValues) {
  Table in = mixed(kMany, 7);
  unsigned surface = 0, step = (1u << inputs()) / 128 | 1;
  for (std::size_t c = 0; c < inputs(); ++c)
    if (is(c, Kind::alpha) || is(c, Kind::theta)) surface |= 1u << c;
  std::vector<unsigned> sets = {surface};
  for (unsigned set = 1; set < 1u << inputs(); set += step) sets.push_back(set);
  // What only turns goes another way, which rounds otherwise, where the whole surface is constant.
  bool turns = operation().name.find("_turned") != std::string::npos;
  on_every_isa([&] {
    for (unsigned set : sets) {
      if (turns && (set & surface) == surface) continue;
      for (std::size_t count : {std::size_t(1), std::size_t(17), kMany}) {
        Table repeated = part(in, 0, count);
        std::vector<Column> mixed = columns(repeated);
        for (std::size_t c = 0; c < inputs(); ++c)
          if (set >> c & 1) {
            float value = in[c][(set * 31 + c) % kMany];
            if (is(c, Kind::theta) && value == 0) value = 0.25f;  // the constant 0 is told apart
            repeated[c].assign(count, value);
            mixed[c] = Column(value);
          }
        Table expected = evaluate(operation(), repeated);
        ASSERT_TRUE(same(expected, evaluate(operation(), repeated, mixed), repeated)) << "constants " << set;
      }
    }
  });
}

// Zeros among the angles are numbers like any other, unless both theta_x and theta_y are the constant 0.
TEST_P(Columns, OfZeroAngles) {
  std::size_t x = 0;
  while (x < inputs() && operation().inputs[x].name != "theta.x") ++x;
  if (x == inputs()) return;
  Table in = good_inputs(operation(), 1 << 14, 1);
  in[x].assign(in[x].size(), 0.f);
  in[x + 1] = in[x];
  on_every_isa([&] {
    Table expected = evaluate(operation(), in);
    for (std::size_t c : {x, x + 1}) {
      std::vector<Column> from = columns(in);
      from[c] = 0.f;
      ASSERT_TRUE(same(expected, evaluate(operation(), in, from), in)) << c;
    }
  });
}

// Outputs in place of inputs, each of each. Of few columns, every choice: 2000 draws of 210 miss none.
TEST_P(Columns, InPlace) {
  Table in = mixed(256 + 150, 8), expected = scalar(in);
  const int rounds = inputs() <= 7 && outputs() <= 3 ? 2000 : 100;
  on_every_isa([&] {
    reference::Random random(8);
    std::vector<std::size_t> order(inputs());
    std::iota(order.begin(), order.end(), 0);
    for (int round = 0; round < rounds; ++round) {
      if (round < int(inputs()))
        std::rotate(order.begin(), order.begin() + 1, order.end());
      else
        for (std::size_t c = inputs(); c > 1; --c) std::swap(order[c - 1], order[random.below(std::uint32_t(c))]);
      Table work = in, spare(outputs(), std::vector<float>(in[0].size()));
      auto place = [&](std::size_t c) -> auto& {
        return c < inputs() ? work[order[c]] : spare[c];
      };
      std::vector<float*> to;
      for (std::size_t c = 0; c < outputs(); ++c) to.push_back(place(c).data());
      operation().run(in[0].size(), columns(work).data(), to.data());
      Table out;
      for (std::size_t c = 0; c < outputs(); ++c) out.push_back(place(c));
      ASSERT_TRUE(same(expected, out, in)) << "the first over input " << order[0];
    }
  });
}

// One column as several inputs (isotropic roughness), and as an output too.
TEST_P(Columns, OneColumnAsSeveralInputs) {
  Table in = mixed(kMany, 9);
  for (std::size_t a = 0; a < inputs(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      Table twice = in;
      twice[b] = twice[a];
      Table expected = scalar(twice);
      on_every_isa([&] {
        Table work = in, out(outputs(), std::vector<float>(kMany));
        std::vector<Column> from = columns(work);
        from[b] = from[a];
        std::vector<float*> to = results(out);
        to.back() = work[a].data();
        operation().run(kMany, from.data(), to.data());
        out.back() = work[a];
        ASSERT_TRUE(same(expected, out, twice)) << "inputs " << a << " and " << b;
      });
    }
}

// Any of the outputs that may be left out, or none: the others keep their bits.
TEST_P(Columns, WantedOutputsDoNotChangeOneAnother) {
  std::vector<std::size_t> optional;
  for (std::size_t c = 0; c < outputs(); ++c)
    if (operation().outputs[c].optional) optional.push_back(c);
  Table in = mixed(300, 10), all = scalar(in);
  on_every_isa([&] {
    for (unsigned left_out = 0; left_out < 1u << optional.size(); ++left_out) {
      Table out(outputs(), std::vector<float>(300)), expected = all;
      std::vector<float*> to = results(out);
      for (std::size_t k = 0; k < optional.size(); ++k)
        if (left_out >> k & 1) {
          to[optional[k]] = nullptr;
          expected[optional[k]].assign(300, 0.f);
        }
      operation().run(300, columns(in).data(), to.data());
      ASSERT_TRUE(same(expected, out, in)) << "left out " << left_out;
    }
  });
}

/// Columns that are longer than the caches, aligned for what is written past them. The inputs repeat some, whose number
/// divides no block.
class Huge {
 public:
  static constexpr std::size_t kCount = (std::size_t(1) << 20) + 15;

  Huge(const Operation& operation, const Table& in, const Table& expected)
      : operation_(operation), in_(in), expected_(expected) {
    for (std::size_t c = 0; c < in.size(); ++c) from_.emplace_back(kCount, 0);
    fill();
  }

  /// Outputs in place or not, without every `skipped`th of the optional ones (0: with all), and one of them misaligned.
  void run(bool in_place, std::size_t skipped, std::size_t misaligned) {
    const std::size_t outputs = expected_.size();
    std::vector<GuardedColumn> apart;
    std::vector<GuardedColumn*> to;
    apart.reserve(outputs);
    for (std::size_t c = 0, optional = 0; c < outputs; ++c) {
      bool over_input = in_place && c < from_.size();
      if (!over_input) apart.emplace_back(kCount, c == misaligned ? 1 : 0);
      to.push_back(over_input ? &from_[c] : &apart.back());
      if (skipped && operation_.outputs[c].optional && ++optional % skipped == 0) to.back() = nullptr;
    }
    std::vector<Column> columns;
    std::vector<float*> results;
    for (auto& column : from_) columns.push_back(column.data());
    for (auto* column : to) results.push_back(column ? column->data() : nullptr);
    operation_.run(kCount, columns.data(), results.data());
    for (std::size_t c = 0; c < outputs; ++c) {
      if (!to[c]) continue;
      std::size_t i = 0;
      while (i < kCount && same_bits(results[c][i], expected_[c][i % expected_[c].size()])) ++i;
      ASSERT_EQ(i, kCount) << operation_.outputs[c].name << " differs, in place " << in_place << ", misaligned "
                           << misaligned;
      ASSERT_TRUE(to[c]->intact()) << "around " << operation_.outputs[c].name;
    }
    if (in_place) fill();
  }

 private:
  void fill() {
    for (std::size_t c = 0; c < in_.size(); ++c)
      for (std::size_t i = 0; i < kCount; i += in_[c].size())
        std::copy_n(in_[c].begin(), std::min(in_[c].size(), kCount - i), from_[c].data() + i);
  }

  const Operation& operation_;
  const Table &in_, &expected_;
  std::vector<GuardedColumn> from_;
};

TEST_P(Columns, HugeBatches) {
  Table in = mixed(65521, 11), expected = scalar(in);
  Huge huge(operation(), in, expected);
  const bool options = operation().outputs.back().optional;
  on_every_isa([&] {
    huge.run(false, 0, outputs());
    huge.run(true, options ? 2 : 0, outputs());
    if (options) huge.run(false, 1, outputs());
    // The kernels ask each output; three of one function are enough.
    for (std::size_t c = 0; c < outputs() && outputs() <= 3; ++c) huge.run(false, 0, c);
  });
}

TEST(Column, IsANumberOrAPointer) {
  const Columns3 wo{0, 0.5, 1.f};
  EXPECT_EQ(wo.x.data, nullptr);
  EXPECT_EQ(wo.x.value, 0);
  EXPECT_EQ(wo.y.value, 0.5f);
  const float values[] = {1.f};
  EXPECT_EQ(Column(values).data, values);
}

#if defined(NDEBUG)
// preconditions_test has what debug builds say.
TEST(Column, ThatIsNullIsTheConstantZero) {
  const float* forgotten = nullptr;
  float null[3], zero[3];
  sample_normals(Warp::polar, 1, {0.6f, 0, 0.8f}, {forgotten, 0.3f}, {0.3f, 0.4f}, {&null[0], &null[1], &null[2]});
  sample_normals(Warp::polar, 1, {0.6f, 0, 0.8f}, {0, 0.3f}, {0.3f, 0.4f}, {&zero[0], &zero[1], &zero[2]});
  for (int c = 0; c < 3; ++c) EXPECT_EQ(null[c], zero[c]);
}
#endif

}  // namespace
}  // namespace vndf::testing
