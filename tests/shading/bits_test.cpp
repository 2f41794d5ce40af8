// Every instruction set gives the bits of the scalar one; counts, columns, constants, aliasing and wanted outputs do
// not matter; and no input, however bad, does harm.
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "reference/hard_cases.h"
#include "shading/inputs.h"

namespace vndf::shading {
namespace {

using Table = std::vector<std::vector<float>>;
using reference::Random;

struct Operation {
  std::string name;
  std::string inputs;  // a letter each: w view, l light, m normal, a alpha, u, e eta
  std::size_t outputs;
  std::function<void(std::size_t, const std::vector<Column>&, const std::vector<float*>&)> run;
};

const std::vector<Operation>& operations() {
  static const std::vector<Operation> all = [] {
    std::vector<Operation> rows;
    for (int w = 0; w < 3; ++w)
      for (bool bounded : {false, true})
        for (Masking masking : {Masking::height_correlated, Masking::separable}) {
          std::string name = std::string(kWarpNames[w]) + (bounded ? "_bounded" : "") +
                             (masking == Masking::separable ? "_separable" : "");
          ReflectionOptions options{masking, bounded};
          Warp warp = kWarps[w];
          rows.push_back({"reflection_" + name, "wwwaauu", 9, [=](std::size_t n, const auto& in, const auto& out) {
                            sample_reflection(
                                warp, n, {in[0], in[1], in[2]}, {in[3], in[4]}, {in[5], in[6]},
                                {{out[0], out[1], out[2]}, out[3], out[4], {out[5], out[6], out[7]}, out[8]}, options);
                          }});
          if (w == 0)
            rows.push_back({"evaluate_" + name, "wwwlllaa", 2, [=](std::size_t n, const auto& in, const auto& out) {
                              evaluate_reflection(n, {in[0], in[1], in[2]}, {in[3], in[4], in[5]}, {in[6], in[7]},
                                                  {out[0], out[1]}, options);
                            }});
          if (!bounded)
            rows.push_back({"dielectric_" + name, "wwwaaeuuu", 6, [=](std::size_t n, const auto& in, const auto& out) {
                              sample_dielectric(warp, n, {in[0], in[1], in[2]}, {in[3], in[4]}, in[5],
                                                {in[6], in[7], in[8]},
                                                {{out[0], out[1], out[2]}, out[3], out[4], out[5]}, masking);
                            }});
          if (w == 0 && !bounded)
            rows.push_back(
                {"evaluate_dielectric_" + name, "wwwlllaae", 2, [=](std::size_t n, const auto& in, const auto& out) {
                   evaluate_dielectric(n, {in[0], in[1], in[2]}, {in[3], in[4], in[5]}, {in[6], in[7]}, in[8],
                                       {out[0], out[1]}, masking);
                 }});
        }
    rows.push_back({"pdf_normals", "wwwmmmaa", 1, [](std::size_t n, const auto& in, const auto& out) {
                      pdf_normals(n, {in[0], in[1], in[2]}, {in[3], in[4], in[5]}, {in[6], in[7]}, out[0]);
                    }});
    return rows;
  }();
  return all;
}

float any_bits(Random& random) {
  auto bits = std::uint32_t(random.bits());
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

float bad_value(Random& random, char kind) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity(),
                  kMax = std::numeric_limits<float>::max();
  static const float values[] = {0.f,    -0.f,  1.f,   -1.f,  0x1p-149f, -1e-40f, 1e-38f,  1e-30f,
                                 1e-20f, 1e-6f, 1e6f,  1e20f, -1e30f,    0.5f,    2.f,     1 - 0x1p-24f,
                                 kNan,   kInf,  -kInf, kMax,  -kMax,     100.f,   0x1p75f, -0.3f};
  if (random.below(3) == 0) return values[random.below(sizeof values / sizeof *values)];
  if (random.below(8) == 0) return any_bits(random);
  switch (kind) {
    case 'a':
      return float(random.log_uniform(1e-4, 2));
    case 'u':
      return random.unit();
    case 'e':
      return float(random.uniform(0.4, 2.5));
    default:
      return float(random.uniform(-1, 1));
  }
}

/// Hard cases with what the operation asks for besides, bad values, any bits: dealt in turn. Directions of light are
/// sampled ones, or any.
Table inputs(const Operation& operation, std::size_t count, std::uint64_t seed, bool good_only = false) {
  Table table(operation.inputs.size(), std::vector<float>(count));
  const auto& cases = reference::hard_cases();
  for (std::size_t row = 0; row < cases.size() + 2; ++row) {
    bool hard = row < cases.size();
    std::size_t n = count / (cases.size() + 2) + 1;
    auto in = reference::generate(cases[hard ? row : 0], Warp::concentric, n, seed);
    Directions wm(n), wi(n);
    std::vector<float> pdf(n), weight(n), side(n);
    sample_normals(Warp::concentric, n, in.wo(), in.alpha(), in.u(), wm.out());
    std::vector<float> u3(n);
    for (std::size_t k = 0; k < n; ++k) u3[k] = Random(seed + 1, k).unit();
    sample_dielectric(Warp::concentric, n, in.wo(), in.alpha(), 1.5f, {in.u_x.data(), in.u_y.data(), u3.data()},
                      {wi.out(), pdf.data(), weight.data(), side.data()});
    for (std::size_t k = 0; k < n; ++k) {
      std::size_t i = k * (cases.size() + 2) + row;
      if (i >= count) break;
      Random random(seed, i);
      int w = 0, l = 0, m = 0, a = 0, u = 0;
      bool jitter = random.below(4) == 0;
      for (std::size_t c = 0; c < table.size(); ++c) {
        char kind = operation.inputs[c];
        float value = 0;
        switch (kind) {
          case 'w':
            value = std::array{in.wo_x[k], in.wo_y[k], in.wo_z[k]}[std::size_t(w++)];
            break;
          case 'l':
            value = std::array{wi.x[k], wi.y[k], wi.z[k]}[std::size_t(l++)];
            if (jitter) value = float(random.uniform(-1, 1));
            break;
          case 'm':
            value = std::array{wm.x[k], wm.y[k], wm.z[k]}[std::size_t(m++)];
            break;
          case 'a':
            value = std::array{in.alpha_x[k], in.alpha_y[k]}[std::size_t(a++)];
            break;
          case 'e':
            value = random.below(2) ? 1.5f : float(random.uniform(0.4, 2.5));
            break;
          default:
            value = u < 2 ? std::array{in.u_x[k], in.u_y[k]}[std::size_t(u)] : random.unit();
            ++u;
        }
        if (!hard && !good_only) value = row % 2 ? bad_value(random, kind) : any_bits(random);
        table[c][i] = value;
      }
    }
  }
  return table;
}

std::vector<Column> columns(const Table& table, std::size_t from = 0) {
  std::vector<Column> result;
  for (const auto& column : table) result.push_back(column.data() + from);
  return result;
}

Table evaluate(const Operation& operation, const Table& in) {
  Table out(operation.outputs, std::vector<float>(in[0].size()));
  std::vector<float*> to;
  for (auto& column : out) to.push_back(column.data());
  operation.run(in[0].size(), columns(in), to);
  return out;
}

bool same_bits(float a, float b) {
  return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
}
::testing::AssertionResult same_bits(const Table& expected, const Table& actual) {
  for (std::size_t c = 0; c < expected.size(); ++c)
    for (std::size_t i = 0; i < expected[c].size(); ++i)
      if (!same_bits(expected[c][i], actual[c][i]))
        return ::testing::AssertionFailure()
               << "output " << c << " at " << i << ": " << actual[c][i] << " instead of " << expected[c][i];
  return ::testing::AssertionSuccess();
}

class KeepIsa {
 public:
  KeepIsa() : name_(active_isa()) {}
  ~KeepIsa() { (void)set_isa(name_.c_str()); }

 private:
  std::string name_;
};

class Bits : public ::testing::TestWithParam<Operation> {
 protected:
  Table on_scalar(const Table& in) {
    EXPECT_EQ(set_isa("scalar"), IsaError::none);
    return evaluate(GetParam(), in);
  }
  template <class F>
  void on_every_isa(F f) {
    for (const Isa& isa : isas())
      if (isa.supported) {
        ASSERT_EQ(set_isa(isa.name), IsaError::none);
        SCOPED_TRACE(isa.name);
        f();
      }
  }
  KeepIsa keep_;
};
void PrintTo(const Operation& operation, std::ostream* out) {
  *out << operation.name;
}
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
        std::vector<float*> to;
        for (auto& column : out) to.push_back(column.data() + shift);
        GetParam().run(count, columns(in, shift), to);
        for (std::size_t c = 0; c < out.size(); ++c)
          for (std::size_t i = 0; i < out[c].size(); ++i) {
            bool inside = i >= shift && i < count + shift;
            ASSERT_TRUE(same_bits(out[c][i], inside ? expected[c][i - shift] : -7.f)) << count << " at " << i;
          }
      }
  });
}

TEST_P(Bits, ConstantsGiveTheBitsOfRepeatedValues) {
  Table in = inputs(GetParam(), 275, 40);
  on_every_isa([&] {
    for (std::size_t constants = 1; constants < std::size_t(1) << in.size(); constants += 1 + constants / 5) {
      Table repeated = in;
      std::vector<Column> mixed;
      for (std::size_t c = 0; c < in.size(); ++c) {
        bool constant = constants >> c & 1;
        float value = in[c][constants % 275];
        if (constant) repeated[c].assign(275, value);
        mixed.push_back(constant ? Column(value) : Column(repeated[c].data()));
      }
      Table out(GetParam().outputs, std::vector<float>(275));
      std::vector<float*> to;
      for (auto& column : out) to.push_back(column.data());
      GetParam().run(275, mixed, to);
      ASSERT_TRUE(same_bits(evaluate(GetParam(), repeated), out)) << constants;
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
        ASSERT_TRUE(same_bits({expected[c]}, {c < in.size() ? work[(c + turn) % in.size()] : spare[c]})) << c;
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

// Any of the optional outputs, or none: the others keep their bits.
TEST(WantedOutputs, DoNotChangeOneAnother) {
  KeepIsa keep;
  for (const Operation& operation : operations()) {
    if (operation.outputs != 9) continue;
    Table in = inputs(operation, 300, 70);
    for (const Isa& isa : isas()) {
      if (!isa.supported) continue;
      ASSERT_EQ(set_isa(isa.name), IsaError::none);
      Table expected = evaluate(operation, in);
      for (unsigned wanted = 0; wanted < 16; ++wanted) {
        Table out(9, std::vector<float>(300));
        std::vector<float*> to;
        for (std::size_t c = 0; c < 9; ++c) to.push_back(c < 5 || wanted >> (c - 5) & 1 ? out[c].data() : nullptr);
        operation.run(300, columns(in), to);
        for (std::size_t c = 0; c < 9; ++c)
          if (to[c]) {
            ASSERT_TRUE(same_bits({expected[c]}, {out[c]})) << c;
          }
      }
    }
  }
}

// The normal of sample_reflection is that of sample_normals: the same bits for views above the horizon and alpha of at
// least 1e-4, where the smallest of its roots and squares are in range.
TEST(WantedOutputs, NormalIsThatOfSampleNormals) {
  std::size_t count = std::size_t(1) << 16;
  for (const auto& row : reference::hard_cases()) {
    if (row.name == std::string("vanishing_cos_tiny_alpha")) continue;
    for (Warp warp : kWarps) {
      auto in = reference::generate(row, warp, count, 80);
      Directions wm(count);
      Samples sample(count);
      sample_normals(warp, count, in.wo(), in.alpha(), in.u(), wm.out());
      sample_reflection(warp, count, in.wo(), in.alpha(), in.u(), sample.with_normals());
      for (std::size_t i = 0; i < count; ++i) {
        double length = std::hypot(in.wo_x[i], in.wo_y[i], in.wo_z[i]);
        if (in.wo_z[i] < 0 || std::fabs(length - 1) > 1e-6) continue;
        ASSERT_TRUE(same_bits(wm.x[i], sample.wm.x[i]) && same_bits(wm.y[i], sample.wm.y[i]) &&
                    same_bits(wm.z[i], sample.wm.z[i]))
            << row.name << " " << int(warp) << " at " << i;
      }
    }
  }
}

// Finite inputs that are not degenerate give no NaN: unit views, alpha from 1e-6 to 100, u in [0, 1] with both ends.
TEST(BadInputs, NoNanFromGoodOnes) {
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
                ASSERT_GE(s.pdf[0], 0);
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
                    ASSERT_FALSE(std::isnan(x))
                        << v[0] << " " << v[1] << " " << v[2] << " alpha " << ax << " " << ay << " u " << u1 << " "
                        << u2 << " " << u3 << " eta " << eta << " " << int(warp);
                  ASSERT_LE(s.weight[0], 1);
                }
            }
}

}  // namespace
}  // namespace vndf::shading
