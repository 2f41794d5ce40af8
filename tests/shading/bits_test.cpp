// Every instruction set gives the bits of the scalar one; counts, columns, constants, aliasing and wanted outputs do
// not matter; and no input, however bad, does harm.
#include <cmath>
#include <string>

#include <algorithm>

#include <gtest/gtest.h>

#include "reference/hard_cases.h"
#include "shading/inputs.h"
#include "shading/operations.h"
#include "support/guarded_column.h"

namespace vndf::shading {
namespace {

using reference::Random;
using testing::columns;
using testing::GuardedColumn;
using testing::KeepIsa;
using testing::on_every_isa;
using testing::results;
using testing::same_bits;

class Bits : public ::testing::TestWithParam<Operation> {
 protected:
  Table on_scalar(const Table& in) {
    EXPECT_EQ(set_isa("scalar"), IsaError::none);
    return evaluate(GetParam(), in);
  }
  KeepIsa keep_;
};
INSTANTIATE_TEST_SUITE_P(, Bits, ::testing::ValuesIn(operations()), [](const auto& info) { return info.param.name; });

// 2^19 inputs for each operation.
TEST_P(Bits, SameOnEveryInstructionSet) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Table in = inputs(GetParam(), std::size_t(1) << 16, seed);
    Table expected = on_scalar(in);
    on_every_isa([&] { EXPECT_TRUE(same_bits(expected, evaluate(GetParam(), in))); });
  }
}

#if defined(__x86_64__)
TEST_P(Bits, SameWithDenormalsFlushed) {
  Table in = inputs(GetParam(), std::size_t(1) << 15, 20);
  unsigned before = __builtin_ia32_stmxcsr();
  for (unsigned bits : {0x8000u, 0x0040u, 0x8040u}) {
    __builtin_ia32_ldmxcsr(before | bits);
    Table expected = on_scalar(in);
    on_every_isa([&] { EXPECT_TRUE(same_bits(expected, evaluate(GetParam(), in))) << std::hex << bits; });
    __builtin_ia32_ldmxcsr(before);
  }
}
#endif

TEST_P(Bits, CountsAndMisalignedColumns) {
  Table all = inputs(GetParam(), 600, 30);
  Table expected = on_scalar(all);
  on_every_isa([&] {
    for (std::size_t count :
         {0, 1, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 33, 127, 128, 129, 255, 256, 257, 271, 384, 512, 513})
      for (std::size_t shift : {0, 1}) {
        Table in(all.size());
        for (std::size_t c = 0; c < all.size(); ++c) {
          in[c].assign(shift, 0.f);
          in[c].insert(in[c].end(), all[c].begin(), all[c].begin() + std::ptrdiff_t(count));
        }
        Table out(GetParam().outputs, std::vector<float>(count + shift + 20, -7.f));
        GetParam().run(count, columns(in, shift), results(out, shift));
        for (std::size_t c = 0; c < out.size(); ++c)
          for (std::size_t i = 0; i < out[c].size(); ++i) {
            bool inside = i >= shift && i < count + shift;
            ASSERT_TRUE(same_bits(out[c][i], inside ? expected[c][i - shift] : -7.f)) << count << " at " << i;
          }
      }
  });
}

// Any columns as constants, and all that make a shape.
TEST_P(Bits, ConstantsGiveTheBitsOfRepeatedValues) {
  Table in = inputs(GetParam(), 275, 40);
  std::vector<std::size_t> sets = {0};
  for (std::size_t c = 0; c < in.size(); ++c)
    if (GetParam().inputs[c] == 'a' || GetParam().inputs[c] == 't') sets[0] |= std::size_t(1) << c;
  std::size_t whole_shape = sets[0];
  for (std::size_t set = 1; set < std::size_t(1) << in.size(); set += 1 + set / 5) sets.push_back(set);
  // What only turns goes another way as soon as something of the shape is a column; see ellipsoid/accuracy_test.cpp.
  if (GetParam().name.find("_turned") != std::string::npos)
    sets.erase(
        std::remove_if(sets.begin(), sets.end(), [&](std::size_t set) { return (set & whole_shape) == whole_shape; }),
        sets.end());
  on_every_isa([&] {
    for (std::size_t constants : sets)
      for (std::size_t row : {constants % 275, (constants + 100) % 275}) {
        Table repeated = in;
        std::vector<Column> mixed;
        for (std::size_t c = 0; c < in.size(); ++c) {
          bool constant = constants >> c & 1;
          float value = in[c][row];
          // The constant 0 is told apart.
          if (GetParam().inputs[c] == 't' && value == 0) value = 0.25f;
          if (constant) repeated[c].assign(275, value);
          mixed.push_back(constant ? Column(value) : Column(repeated[c].data()));
        }
        Table out(GetParam().outputs, std::vector<float>(275));
        GetParam().run(275, mixed, results(out));
        Table expected = evaluate(GetParam(), repeated);
        ASSERT_TRUE(same_bits(expected, out)) << constants;
      }
  });
}

// Each output in place of each input.
TEST_P(Bits, InPlace) {
  Table in = inputs(GetParam(), 256 + 150, 50);
  Table expected = on_scalar(in);
  on_every_isa([&] {
    for (std::size_t turn = 0; turn < in.size(); ++turn) {
      Table work = in, spare(GetParam().outputs, std::vector<float>(in[0].size()));
      std::vector<float*> to;
      for (std::size_t c = 0; c < GetParam().outputs; ++c)
        to.push_back(c < in.size() ? work[(c + turn) % in.size()].data() : spare[c].data());
      GetParam().run(in[0].size(), columns(work), to);
      for (std::size_t c = 0; c < GetParam().outputs; ++c)
        ASSERT_TRUE(same_bits(Table{expected[c]}, Table{c < in.size() ? work[(c + turn) % in.size()] : spare[c]})) << c;
    }
  });
}

TEST_P(Bits, NoiseInOtherLanes) {
  Table good = inputs(GetParam(), 527, 60, true);
  Table expected = on_scalar(good);
  on_every_isa([&] {
    for (std::uint64_t round = 0; round < 8; ++round) {
      Table in = inputs(GetParam(), 527, 61 + round);
      std::vector<bool> kept(527);
      Random random(round);
      for (std::size_t i = 0; i < 527; ++i)
        for (std::size_t c = 0; c < in.size(); ++c) {
          if (c == 0) kept[i] = random.below(4) == 0;
          in[c][i] = kept[i] ? good[c][i] : bad_value(random, GetParam().inputs[c]);
        }
      Table out = evaluate(GetParam(), in);
      for (std::size_t c = 0; c < out.size(); ++c)
        for (std::size_t i = 0; i < 527; ++i) {
          ASSERT_TRUE(!kept[i] || same_bits(out[c][i], expected[c][i]));
        }
    }
  });
}

Table repeated(const Table& table, std::size_t count) {
  Table result(table.size(), std::vector<float>(count));
  for (std::size_t c = 0; c < table.size(); ++c)
    for (std::size_t i = 0; i < count; ++i) result[c][i] = table[c][i % table[c].size()];
  return result;
}

// Results that are written past the caches are those of smaller batches, which are not: with all outputs, in place with
// every second of the optional ones, and with none of them. No block divides the period of the inputs.
TEST_P(Bits, HugeBatches) {
  constexpr std::size_t kHuge = (std::size_t(1) << 20) + 15, kPeriod = 65521;
  Table in = inputs(GetParam(), kPeriod, 90);
  Table expected = repeated(on_scalar(in), kHuge);
  in = repeated(in, kHuge);
  std::size_t outputs = GetParam().outputs;
  std::vector<GuardedColumn> all;  // for the inputs, then for outputs that are not in place
  for (std::size_t c = 0; c < in.size() + outputs; ++c) all.emplace_back(kHuge, 0);
  on_every_isa([&] {
    for (unsigned wanted : {15, 5, 0}) {
      if (wanted == 0 && outputs < 9) continue;
      std::vector<Column> from;
      for (std::size_t c = 0; c < in.size(); ++c) {
        std::copy(in[c].begin(), in[c].end(), all[c].data());
        from.push_back(all[c].data());
      }
      for (std::size_t c = in.size(); c < all.size(); ++c) std::fill_n(all[c].data(), kHuge, -7.f);
      GuardedColumn* out = &all[wanted == 5 ? 0 : in.size()];
      std::vector<float*> to;
      for (std::size_t c = 0; c < outputs; ++c)
        to.push_back(outputs < 9 || c < 5 || wanted >> (c - 5) & 1 ? out[c].data() : nullptr);
      GetParam().run(kHuge, from, to);
      for (std::size_t c = 0; c < outputs; ++c) {
        if (!to[c]) continue;
        ASSERT_TRUE(out[c].intact()) << c;
        ASSERT_TRUE(
            std::equal(expected[c].begin(), expected[c].end(), to[c], [](float a, float b) { return same_bits(a, b); }))
            << c << " wanted " << wanted;
      }
    }
  });
}

// Any of the optional outputs, or none: the others keep their bits.
TEST(WantedOutputs, DoNotChangeOneAnother) {
  for (const Operation& operation : operations()) {
    if (operation.outputs != 9) continue;
    Table in = inputs(operation, 300, 70);
    on_every_isa([&] {
      Table expected = evaluate(operation, in);
      for (unsigned wanted = 0; wanted < 16; ++wanted) {
        Table out(9, std::vector<float>(300));
        std::vector<float*> to;
        for (std::size_t c = 0; c < 9; ++c) to.push_back(c < 5 || wanted >> (c - 5) & 1 ? out[c].data() : nullptr);
        operation.run(300, columns(in), to);
        for (std::size_t c = 0; c < 9; ++c)
          if (to[c]) {
            ASSERT_TRUE(same_bits(Table{expected[c]}, Table{out[c]})) << operation.name << " " << c;
          }
      }
    });
  }
}

// The normal of sample_reflection is that of sample_normals.
TEST(WantedOutputs, NormalIsThatOfSampleNormals) {
  std::size_t count = std::size_t(1) << 16;
  for (const auto& row : reference::hard_cases()) {
    for (Warp warp : kWarps) {
      auto in = reference::generate(row, warp, count, 80);
      Directions wm(count);
      Samples sample(count);
      sample_normals(warp, count, in.wo(), in.alpha(), in.u(), wm.out());
      sample_reflection(warp, count, in.wo(), in.alpha(), in.u(), sample.with_normals());
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_TRUE(same_bits(wm.x[i], sample.wm.x[i]) && same_bits(wm.y[i], sample.wm.y[i]) &&
                    same_bits(wm.z[i], sample.wm.z[i]))
            << row.name << " " << int(warp) << " at " << i;
      }
    }
  }
}

// Good inputs give finite results: unit views, alpha from 1e-6 to 100, u in [0, 1] with both ends.
TEST(GoodInputs, GiveFiniteResults) {
  const float views[][3] = {{0, 0, 1},        {0, 0, -1},     {1, 0, 0},           {0, -1, 0},     {0.6f, 0, 0.8f},
                            {0.6f, 0, -0.8f}, {1, 0, 1e-30f}, {1, 1e-20f, 1e-10f}, {1e-20f, 0, 1}, {1e-40f, 0, 1},
                            {0.8f, 0.6f, 0},  {1, 0, -0.f},   {1e-6f, 1e-6f, 1},   {1e-6f, 0, -1}, {1, 0, -1e-30f}};
  const float alphas[] = {1e-6f, 1e-4f, 0.01f, 0.5f, 1.f, 3.f, 100.f};
  const float us[] = {0.f, 0x1p-24f, 0.25f, 0.3f, 0.5f, 0.75f, 1 - 0x1p-24f, 1.f};
  const float etas[] = {0.4f, 1 / 1.5f, 0.99999f, 1.00001f, 1.5f, 2.5f};
  for (const auto& v : views)
    for (float ax : alphas)
      for (float ay : alphas)
        for (float u1 : us)
          for (float u2 : us)
            for (Warp warp : kWarps) {
              for (bool bounded : {false, true}) {
                ReflectionOptions options;
                options.bounded = bounded;
                Samples s(1);
                Values e(1);
                float pdf;
                sample_reflection(warp, 1, {v[0], v[1], v[2]}, {ax, ay}, {u1, u2}, s.with_normals(), options);
                evaluate_reflection(1, {v[0], v[1], v[2]}, s.wi.in(), {ax, ay}, e.out(), options);
                pdf_normals(1, {v[0], v[1], v[2]}, s.wm.in(), {ax, ay}, &pdf);
                for (float x : {s.wi.x[0], s.wi.y[0], s.wi.z[0], s.pdf[0], s.weight[0], s.wm.x[0], s.wm.y[0], s.wm.z[0],
                                s.cos[0], e.f_cos[0], e.pdf[0], pdf})
                  ASSERT_TRUE(std::isfinite(x)) << v[0] << " " << v[1] << " " << v[2] << " alpha " << ax << " " << ay
                                                << " u " << u1 << " " << u2 << " " << int(warp) << bounded;
                for (float density : {s.pdf[0], e.pdf[0], pdf})
                  ASSERT_TRUE(density >= 0 && density <= 0x1p60f) << density;
                ASSERT_GE(s.weight[0], 0);
                ASSERT_LE(s.weight[0], 1);
                if (v[2] < 0 || !(s.wi.z[0] > 0)) {
                  ASSERT_EQ(s.pdf[0], 0);
                  ASSERT_EQ(s.weight[0], 0);
                }
              }
              for (float eta : etas)
                for (float u3 : {0.f, 0.5f, 1.f}) {
                  Samples s(1);
                  Values e(1);
                  sample_dielectric(warp, 1, {v[0], v[1], v[2]}, {ax, ay}, eta, {u1, u2, u3}, s.dielectric());
                  evaluate_dielectric(1, {v[0], v[1], v[2]}, s.wi.in(), {ax, ay}, eta, e.out());
                  for (float x :
                       {s.wi.x[0], s.wi.y[0], s.wi.z[0], s.pdf[0], s.weight[0], s.side[0], e.f_cos[0], e.pdf[0]})
                    ASSERT_TRUE(std::isfinite(x))
                        << v[0] << " " << v[1] << " " << v[2] << " alpha " << ax << " " << ay << " u " << u1 << " "
                        << u2 << " " << u3 << " eta " << eta << " " << int(warp);
                  for (float density : {s.pdf[0], e.pdf[0]}) ASSERT_TRUE(density >= 0 && density <= 0x1p60f) << density;
                  ASSERT_GE(s.weight[0], 0);
                  ASSERT_LE(s.weight[0], 1);
                }
            }
}

}  // namespace
}  // namespace vndf::shading
