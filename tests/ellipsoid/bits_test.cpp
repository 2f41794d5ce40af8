// Every instruction set gives the bits of the scalar one; columns, constants and counts do not matter; and no input,
// however bad, does harm.
#include <cstring>
#include <functional>

#include <gtest/gtest.h>

#include "ellipsoid/model.h"
#include "reference/random.h"

namespace vndf::ellipsoid {
namespace {

using reference::Random;
using Table = std::vector<std::vector<float>>;  // wo, second, alpha, theta, u: 13 columns

float value(Random& random, std::size_t c, bool bad) {
  static const float values[] = {0.f, -0.f,  1.f, -1.f,     1e-40f,    1e-20f, 1e20f, 1e-6f,
                                 2.f, 100.f, NAN, INFINITY, -INFINITY, 3e38f,  -0.3f, 1e-30f};
  if (bad && random.below(4) == 0) return values[random.below(sizeof values / sizeof *values)];
  if (bad && random.below(16) == 0) {
    auto bits = std::uint32_t(random.bits());
    float any;
    std::memcpy(&any, &bits, sizeof any);
    return any;
  }
  if (c < 6) return float(random.uniform(-1, 1));
  if (c < 8) return float(random.log_uniform(1e-3, 1));
  return c < 11 ? float(random.uniform(-3.2, 3.2)) : random.unit();
}
Table inputs(std::size_t count, std::uint64_t seed, bool bad) {
  Table table(13, std::vector<float>(count));
  for (std::size_t i = 0; i < count; ++i) {
    Random random(seed, i);
    for (std::size_t c = 0; c < 13; ++c) table[c][i] = value(random, c, bad && i % 2);
    for (std::size_t c = 0; c < 6; c += 3) {  // unit views and lights
      V3<double> v = {table[c][i], table[c + 1][i], table[c + 2][i]};
      if (i % 2 == 0) v = direction(v);
      if (i % 16 == 4) v = {0, 0, 1};  // psi parallel to n
      table[c][i] = float(v.x);
      table[c + 1][i] = float(v.y);
      table[c + 2][i] = float(v.z);
    }
  }
  return table;
}

/// All functions; angles that are constants 0 where `turned`.
constexpr std::size_t kOutputs = 3 * 3 + 3 * 9 + 2 + 1;
Table evaluate(const std::vector<Column>& in, std::size_t count) {
  Table out(kOutputs, std::vector<float>(count));
  Ellipsoid e({in[6], in[7]}, in[8], in[9], in[10]);
  Columns3 wo{in[0], in[1], in[2]}, second{in[3], in[4], in[5]};
  Columns2 u{in[11], in[12]};
  std::size_t c = 0;
  auto next = [&] { return out[c++].data(); };
  auto three = [&] {
    Out3 o;
    o.x = next();
    o.y = next();
    o.z = next();
    return o;
  };
  for (Warp warp : kWarps) {
    sample_normals(warp, count, wo, e, u, three());
    ReflectionSamples s;
    s.wi = three();
    s.pdf = next();
    s.weight = next();
    s.wm = three();
    s.wo_dot_wm = next();
    sample_reflection(warp, count, wo, e, u, s);
  }
  float* f = next();
  float* pdf = next();
  evaluate_reflection(count, wo, second, e, {f, pdf});
  pdf_normals(count, wo, second, e, next());
  return out;
}
std::vector<Column> columns(const Table& table) {
  std::vector<Column> result;
  for (const auto& column : table) result.push_back(column.data());
  return result;
}

::testing::AssertionResult same_bits(const Table& a, const Table& b, std::size_t count) {
  for (std::size_t c = 0; c < a.size(); ++c)
    for (std::size_t i = 0; i < count; ++i)
      if (std::memcmp(&a[c][i], &b[c][i], 4) != 0 && !(std::isnan(a[c][i]) && std::isnan(b[c][i])))
        return ::testing::AssertionFailure() << "output " << c << " at " << i << ": " << a[c][i] << ", " << b[c][i];
  return ::testing::AssertionSuccess();
}

class Bits : public ::testing::Test {
 protected:
  Bits() : name_(active_isa()) {}
  ~Bits() override { (void)set_isa(name_.c_str()); }
  template <class F>
  void on_every_isa(F f) {
    for (const Isa& isa : isas())
      if (isa.supported) {
        ASSERT_EQ(set_isa(isa.name), IsaError::none);
        SCOPED_TRACE(isa.name);
        f();
      }
  }

 private:
  std::string name_;
};

// Five columns; theta_z alone; five constants.
TEST_F(Bits, SameOnEveryInstructionSetForAnyInput) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    constexpr std::size_t kCount = 1 << 15;
    Table in = inputs(kCount, seed, true);
    for (int kind = 0; kind < 3; ++kind) {
      auto from = columns(in);
      for (std::size_t c = 6; c < 11; ++c)
        if (kind == 2) from[c] = in[c][seed];
      if (kind == 1) from[8] = from[9] = 0.f;
      ASSERT_EQ(set_isa("scalar"), IsaError::none);
      Table expected = evaluate(from, kCount);
      on_every_isa([&] { EXPECT_TRUE(same_bits(expected, evaluate(from, kCount), kCount)) << kind; });
    }
  }
}

TEST_F(Bits, Counts) {
  Table in = inputs(600, 7, true);
  for (bool turned : {false, true}) {
    auto from = columns(in);
    if (turned) from[8] = from[9] = 0.f;
    Table expected = evaluate(from, 600);
    on_every_isa([&] {
      for (std::size_t count : {0, 1, 3, 4, 7, 8, 15, 16, 17, 33, 127, 129, 255, 256, 257, 271, 512, 513})
        EXPECT_TRUE(same_bits(expected, evaluate(from, count), 0) && same_bits(evaluate(from, count), expected, count))
            << count;
    });
  }
}

// Any columns as constants, all five of a shape and none, and theta_x = theta_y = 0 in each way of saying it.
TEST_F(Bits, ConstantsGiveTheBitsOfColumns) {
  constexpr std::size_t kCount = 275;
  Table in = inputs(kCount, 8, false);
  on_every_isa([&] {
    for (unsigned constants = 0; constants < 32; ++constants)
      for (bool upright : {false, true}) {
        Table repeated = in;
        auto mixed = columns(in);
        for (std::size_t k = 0; k < 5; ++k) {
          float one = upright && (k == 2 || k == 3) ? 0.f : in[6 + k][constants];
          if ((constants >> k & 1) || one == 0.f) repeated[6 + k].assign(kCount, one);
          mixed[6 + k] = constants >> k & 1 ? Column(one) : Column(repeated[6 + k].data());
        }
        Table expected = evaluate(columns(repeated), kCount), actual = evaluate(mixed, kCount);
        for (std::size_t c = 0; c < kOutputs; ++c)  // but for the sign of zeros
          for (std::size_t i = 0; i < kCount; ++i) ASSERT_EQ(expected[c][i], actual[c][i]) << constants << " " << c;
      }
  });
}

TEST_F(Bits, OptionalOutputs) {
  constexpr std::size_t kCount = 300;
  Table in = inputs(kCount, 9, false);
  auto from = columns(in);
  Ellipsoid e({from[6], from[7]}, from[8], from[9], from[10]);
  Samples all(kCount), few(kCount);
  sample_reflection(Warp::polar, kCount, {from[0], from[1], from[2]}, e, {from[11], from[12]}, all.with_normals());
  sample_reflection(Warp::polar, kCount, {from[0], from[1], from[2]}, e, {from[11], from[12]}, few.reflection());
  EXPECT_EQ(all.wi.x, few.wi.x);
  EXPECT_EQ(all.pdf, few.pdf);
  EXPECT_EQ(all.weight, few.weight);
}

}  // namespace
}  // namespace vndf::ellipsoid
