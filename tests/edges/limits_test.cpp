// What the headers say of values at the ends of the domain and beyond them, one function at a time: mirrors, negative
// alpha, views of any length, pairs that cannot be, surfaces of any proportions.
#include "reference/errors.h"
#include "reference/vec.h"
#include "support/inputs.h"

namespace vndf::testing {
namespace {

using reference::distance;
using reference::kEps;
using reference::length;
using Vec = reference::Vec3<double>;
using Group = std::vector<float>;

constexpr float kLargestPdf = 0x1p60f;

/// Pairs of random numbers, the ends of [0, 1] among them or not.
Table pairs(bool ends) {
  Table u(2);
  for (float x : {0.f, 0x1p-24f, 0.125f, 0.3f, 0.5f, 0.77f, 1 - 0x1p-24f, 1.f})
    for (float y : {0.f, 0x1p-24f, 0.125f, 0.3f, 0.5f, 0.77f, 1 - 0x1p-24f, 1.f}) {
      if (!ends) continue;
      u[0].push_back(x);
      u[1].push_back(y);
    }
  reference::Random random(61);
  for (int i = 0; i < 192; ++i)
    for (auto& column : u) column.push_back(random.unit());
  return u;
}

/// The results of a row of plain GGX for one view and surface, and many random numbers.
class Outputs : public Results {
 public:
  Outputs(const Operation& row, const Table& u, const Vec& wo, float alpha_x, float alpha_y)
      : Results(row, u, {wo.x, wo.y, wo.z, alpha_x, alpha_y, u[0].data(), u[1].data()}) {}
  double number(const char* name, std::size_t i) const { return column(name)[i]; }
  Vec vector(const char* name, std::size_t i) const {
    auto v = Results::vector(name, i);
    return {v[0], v[1], v[2]};
  }
};

/// f(row) for the rows of plain GGX of this function, on every set.
template <class F>
void for_each_row(const std::string& function, F f) {
  on_every_isa([&] {
    for (const Operation& row : operations()) {
      if (row.name.find(function) != 0 || row.takes(Kind::theta) || !row.takes(Kind::alpha)) continue;
      SCOPED_TRACE(row.name);
      f(row);
    }
  });
}

void expect_unit_and_upper(const Outputs& out) {
  for (std::size_t i = 0; i < out.size(); ++i) {
    ASSERT_NEAR(length(out.vector("wm", i)), 1, 5 * kEps) << i;
    ASSERT_GE(out.vector("wm", i).z, 0) << i;
  }
}

// Alpha from 1e-30 to 2^24, as far as |alpha wo| < 2^126, views of any length or none, below the horizon too.
TEST(Normals, AreUnitForAnyAlphaAndLength) {
  const Table u = pairs(true);
  const Vec directions[] = {{0, 0, 1},           {0, 0, -1},     {0.6f, 0, 0.8f},    {0.8f, 0.6f, 0},
                            {0.8f, 0.6f, -0.f},  {0, 1, 1e-6f},  {0.6f, 0, -0.8f},   {0, 1e-4f, -1},
                            {1e-12f, 0, 1},      {0, 1e-10f, 1}, {1, 0.1f, -1e-10f}, {-0.3f, 0.5f, 0.8f},
                            {0.3f, 0.5f, -0.8f}, {0, 1e-20f, 1}};
  const float alphas[] = {1e-30f, 1e-20f, 1e-10f, 1e-6f, 1e-4f, 0.05f, 0.3f, 1, 100, 1e4f, 0x1p18f, 0x1p24f};
  for_each_row("normals", [&](const Operation& row) {
    for (const Vec& wo : directions)
      for (float size : {0.f, 1e-30f, 1e-20f, 1.f, 1e17f, 1e30f})
        for (float x : alphas)
          for (float y : alphas) {
            if (size * std::fmax(x, y) >= 0x1p126) continue;
            SCOPED_TRACE(std::to_string(wo.z) + " " + std::to_string(size) + " alpha " + std::to_string(x));
            expect_unit_and_upper({row, u, double(size) * wo, x, y});
          }
  });
}

TEST(Normals, AreNumbersForAnyAlphaAtAll) {
  const Table u = pairs(true);
  for_each_row("normals", [&](const Operation& row) {
    for (const Vec& wo :
         {Vec{0, 0, 1}, {0, 0, -1}, {1, 0.1f, 0}, {-0.3f, 0.5f, 0.8f}, {0.3f, 0.5f, -0.8f}, {1e-42f, 0, -1}})
      for (double size : {0., 1e-42, 1e-20, 1., 1e17})
        for (float x : {0.f, 1e-45f, 1e-30f, 1e-10f, 0.3f, 100.f, 1e10f, 1e20f})
          for (float y : {0.f, 1e-45f, 1e-30f, 1e-10f, 0.3f, 100.f, 1e10f, 1e20f}) {
            Outputs out(row, u, size * wo, x, y);
            for (std::size_t i = 0; i < out.size(); ++i)
              ASSERT_FALSE(std::isnan(length(out.vector("wm", i)))) << wo.x << " alpha " << x << " " << y;
          }
  });
}

TEST(Normals, OfAlphaZeroAreThoseOfAMirror) {
  for_each_row("normals", [u = pairs(true)](const Operation& row) {
    for (float z : {0.8f, 1e-3f, 0.f, -0.8f}) {
      Outputs out(row, u, {std::sqrt(1 - z * z), 0, z}, 0, 0);
      for (std::size_t i = 0; i < out.size(); ++i) ASSERT_LE(distance(out.vector("wm", i), {0, 0, 1}), 2 * kEps) << z;
    }
  });
}

TEST(Normals, DoNotSeeTheSignOfAZeroCosine) {
  for_each_row("normals", [u = pairs(true)](const Operation& row) {
    Outputs up(row, u, {0.6f, 0.8f, 0}, 0.3f, 0.7f), down(row, u, {0.6f, 0.8f, -0.f}, 0.3f, 0.7f);
    for (std::size_t i = 0; i < up.size(); ++i)
      ASSERT_LE(distance(up.vector("wm", i), down.vector("wm", i)), 40 * kEps);
  });
}

// The azimuth of a vanishing tilt is that of the tilt; of none, +x.
TEST(Normals, OfNormalViewsBeginAtTheXAxis) {
  for_each_row("normals", [u = pairs(true)](const Operation& row) {
    const float tilt = row.warp == Warp::spherical_cap ? 1e-15f : 1e-25f;
    Outputs none(row, u, {0, 0, 1}, 0.5f, 0.5f), x(row, u, {tilt, 0, 1}, 0.5f, 0.5f),
        y(row, u, {0, tilt, 1}, 0.5f, 0.5f);
    for (std::size_t i = 0; i < none.size(); ++i) {
      Vec wm = none.vector("wm", i);
      ASSERT_LE(distance(x.vector("wm", i), wm), 40 * kEps);
      ASSERT_LE(distance(y.vector("wm", i), {-wm.y, wm.x, wm.z}), 40 * kEps);
    }
  });
}

// The view in the hemisphere configuration is mirrored, so the reference is the mirrored view's sample.
TEST(NegativeAlpha, MirrorsItsAxis) {
  for (const std::string function : {"normals", "reflection"})
    for_each_row(function, [&, u = pairs(function == "normals")](const Operation& row) {
      for (float x : {1.f, -1.f})
        for (float y : {1.f, -1.f}) {
          Outputs s(row, u, {0.5f, 0.3f, 0.81240386f}, x * 0.4f, y * 0.7f);
          Outputs mirrored(row, u, {x * 0.5f, y * 0.3f, 0.81240386f}, 0.4f, 0.7f);
          for (std::size_t i = 0; i < s.size(); ++i) {
            const char* name = function == "normals" ? "wm" : "wi";
            Vec v = mirrored.vector(name, i);
            ASSERT_LE(distance(s.vector(name, i), {x * v.x, y * v.y, v.z}), 40 * kEps);
            if (function == "normals") continue;
            ASSERT_NEAR(s.number("pdf", i), mirrored.number("pdf", i), 40 * kEps * mirrored.number("pdf", i));
            ASSERT_NEAR(s.number("weight", i), mirrored.number("weight", i), 40 * kEps);
          }
        }
    });
}

TEST(Reflection, OfAlphaZeroIsAMirror) {
  for_each_row("reflection", [u = pairs(false)](const Operation& row) {
    for (const Vec& wo : {Vec{0, 0, 1}, {0.6f, 0, 0.8f}, {-0.36f, 0.48f, 0.8f}, {0.8f, 0.6f, 1e-3f}}) {
      Outputs s(row, u, wo, 0, 0);
      for (std::size_t i = 0; i < s.size(); ++i) {
        ASSERT_LE(distance(s.vector("wi", i), {-wo.x, -wo.y, wo.z}), 40 * kEps);
        ASSERT_EQ(s.number("pdf", i), kLargestPdf);
        ASSERT_NEAR(s.number("weight", i), 1, 8 * kEps);
      }
    }
  });
}

// Bounded, the samples are others: the bound takes the view as a unit vector.
TEST(Reflection, OfViewsOfAnotherLength) {
  for_each_row("reflection", [u = pairs(false)](const Operation& row) {
    const Vec wo{0.5f, 0.3f, 0.81240386f};
    Outputs unit(row, u, wo, 0.4f, 0.7f);
    for (float size : {1e-3f, 0.3f, 7.f, 1e3f}) {
      Outputs s(row, u, double(size) * wo, 0.4f, 0.7f);
      for (std::size_t i = 0; i < s.size(); ++i) {
        Vec wi = (1. / size) * s.vector("wi", i);
        ASSERT_NEAR(length(wi), 1, 40 * kEps);
        if (row.name.find("_bounded") != std::string::npos) continue;
        ASSERT_LE(distance(wi, unit.vector("wi", i)), 1e-4);
        ASSERT_NEAR(s.number("pdf", i) * size, unit.number("pdf", i), 1e-4 * unit.number("pdf", i));
        ASSERT_NEAR(s.number("weight", i), unit.number("weight", i), 1e-4);
      }
    }
  });
}

// A view on the horizon has reflections like any other; one below it, however little, has none.
TEST(Reflection, IsNoneBelowTheHorizon) {
  std::size_t lost = 0;
  for_each_row("reflection", [&, u = pairs(false)](const Operation& row) {
    if (row.name.find("_two_sided") != std::string::npos) return;
    for (float z : {0.8f, 1e-3f, 0.f, -0.f, -1e-30f, -1e-3f, -0.8f}) {
      float side = std::sqrt(1 - z * z);
      Outputs s(row, u, {side * 0.8f, side * 0.6f, z}, 0.9f, 0.6f);
      for (std::size_t i = 0; i < s.size(); ++i) {
        double pdf = s.number("pdf", i), weight = s.number("weight", i);
        bool possible = z >= 0 && s.vector("wi", i).z > 0;
        lost += z >= 0 && !possible;
        ASSERT_TRUE(possible ? pdf > 0 && weight > 0 : pdf == 0 && weight == 0) << z;
      }
    }
  });
  EXPECT_GT(lost, 0u);
}

/// The outputs of a row of plain GGX for a pair of directions: wo and wi, or wo and wm.
std::vector<float> of_pair(const Operation& row, const Vec& a, const Vec& b, float alpha) {
  std::vector<float> out(row.outputs.size());
  std::vector<float*> to;
  for (float& value : out) to.push_back(&value);
  const Column in[] = {a.x, a.y, a.z, b.x, b.y, b.z, alpha, alpha};
  row.run(1, in, to.data());
  return out;
}

TEST(Evaluation, OfAlphaZeroIsThatOfNextToNothing) {
  const Vec wo{0.6f, 0, 0.8f}, wi{-0.6f, 0, 0.8f};
  for_each_row("evaluate_reflection", [&](const Operation& row) {
    for (const char* column : {"f_cos", "pdf"}) {
      float value = of_pair(row, wo, wi, 0)[row.output(column)];
      EXPECT_TRUE(value > 1e15f && std::isfinite(value)) << value;
    }
    EXPECT_LE(of_pair(row, wo, wi, 0)[row.output("pdf")], kLargestPdf);
    for (const Vec& view : {wo, {0, 0, 1}, {0.6f, 1e-15f, 0.8f}})
      for (float alpha : {0.f, 1e-30f})
        EXPECT_TRUE(same_bits({of_pair(row, view, wi, alpha)}, {of_pair(row, view, wi, 0x1p-60f)}));
  });
  for_each_row("pdf_normals", [&](const Operation& row) {
    for (const Vec& wm : {Vec{0, 0, 1}, {1e-15f, 0, 1}, {0.6f, 0, 0.8f}})
      for (float alpha : {0.f, 1e-30f})
        EXPECT_TRUE(same_bits({of_pair(row, wo, wm, alpha)}, {of_pair(row, wo, wm, 0x1p-60f)}));
  });
}

TEST(Evaluation, OfPairsThatCannotBeIsZero) {
  struct Pair {
    Vec wo, other;
    bool possible;
  };
  const Pair lights[] = {
      {{0.6f, 0, 0.8f}, {0, 0.6f, 0.8f}, true},    {{1, 0, 0}, {0, 0.6f, 0.8f}, true},
      {{1, 0, -0.f}, {0, 0.6f, 0.8f}, true},       {{1, 0, -1e-30f}, {0, 0.6f, 0.8f}, false},
      {{0.6f, 0, -0.8f}, {0, 0.6f, 0.8f}, false},  {{0.6f, 0, 0.8f}, {0, 1, 1e-30f}, true},
      {{0.6f, 0, 0.8f}, {0, 1, 0}, false},         {{0.6f, 0, 0.8f}, {0, 1, -0.f}, false},
      {{0.6f, 0, 0.8f}, {0, 1, -1e-30f}, false},   {{0.6f, 0, 0.8f}, {0, 0.6f, -0.8f}, false},
      {{0.6f, 0, -0.8f}, {0, 0.6f, -0.8f}, false},
  };
  const Pair normals[] = {
      {{0.6f, 0, 0.8f}, {0, 0, 1}, true},   {{0.6f, 0, -0.8f}, {0.96f, 0, 0.28f}, true},
      {{1, 0, 0}, {0.6f, 0, 0.8f}, true},   {{0.6f, 0, 0.8f}, {1, 0, -1e-30f}, false},
      {{1, 0, 0}, {0, 0, 1}, false},        {{0.6f, 0, -0.8f}, {0, 0, 1}, false},
      {{1, 0, 0}, {0.8f, 0, -0.6f}, false}, {{1, 0, 0}, {-0.6f, 0, 0.8f}, false},
  };
  auto expect = [](const Operation& row, const Pair& pair) {
    if (row.name.find("_two_sided") != std::string::npos) return;
    const std::vector<float> values = of_pair(row, pair.wo, pair.other, 0.5f);
    for (std::size_t c = 0; c < values.size(); ++c)
      if (!row.outputs[c].optional) {
        EXPECT_TRUE(pair.possible ? values[c] > 0 : values[c] == 0)
            << pair.wo.z << " " << pair.other.z << ": " << values[c];
      }
  };
  for_each_row("evaluate_reflection", [&](const Operation& row) {
    for (const Pair& pair : lights) expect(row, pair);
  });
  for_each_row("pdf_normals", [&](const Operation& row) {
    for (const Pair& pair : normals) expect(row, pair);
  });
}

// In the second and the fourth way alpha is taken as at least 2^-60, without its sign.
TEST(Ellipsoids, TakeAlphaFrom2ToTheMinus60) {
  for (const Operation& row : operations()) {
    if (row.name.find("_tilted") == std::string::npos) continue;
    Table in = good_inputs(row, 1 << 10, 14);
    for (const Group& pair :
         {Group{0, 0.3f, 0x1p-60f, 0.3f}, {-1e-30f, -0.f, 0x1p-60f, 0x1p-60f}, {-0.2f, 0.5f, 0.2f, 0.5f}})
      for (bool constants : {false, true}) {
        Table out[2];
        for (std::size_t k = 0; k < 2; ++k) {
          std::vector<Column> from = columns(in);
          for (std::size_t c = 0; c < in.size(); ++c) {
            if (row.inputs[c].kind == Kind::alpha) in[c].assign(in[c].size(), pair[2 * k + row.inputs[c].index]);
            if (row.inputs[c].kind == Kind::alpha && constants) from[c] = in[c][0];
            if (row.inputs[c].kind == Kind::theta && constants) from[c] = 0.25f;
          }
          out[k] = evaluate(row, in, from);
        }
        EXPECT_TRUE(same_bits(row, out[1], out[0], in)) << pair[0];
      }
  }
}

// The axis of alpha_x is along (cos theta_z, -sin theta_z, 0): normals spread along the other one.
TEST(Ellipsoids, ThetaZTurnsTheAxes) {
  const Table u = pairs(false);
  std::vector<float> x(u[0].size()), y = x, z = x;
  const float theta = 0.3f;
  sample_normals(Warp::polar, x.size(), {0, 0, 1}, Ellipsoid({1e-4f, 0.5f}, 0, 0, theta), {u[0].data(), u[1].data()},
                 {x.data(), y.data(), z.data()});
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_LE(std::fabs(x[i] * std::cos(theta) - y[i] * std::sin(theta)), 0.01) << x[i] << " " << y[i];
}

// What make_shape accepts can be computed with, and all roughness that is promised is accepted.
TEST(Shapes, OfAnyProportionsGiveUnitNormals) {
  constexpr std::size_t kCount = 1 << 9;
  const Operation& row = operation("normals_polar");
  const Table in = good_inputs(row, kCount, 12);
  std::size_t accepted = 0;
  on_every_isa([&] {
    for (int x = -40; x <= 40; x += 4)
      for (int y = -40; y <= 40; y += 4)
        for (float lean : {0.f, 0.5f, 0x1p12f, 0x1p24f, 0x1p36f}) {
          const float rows[9] = {std::ldexp(1.f, x), 0, 0, lean, std::ldexp(1.f, y), 0, -lean, lean, 1};
          Shape shape;
          if (make_shape(rows, shape) != ShapeError::none) continue;
          ++accepted;
          for (Warp warp : kWarps) {
            Table wm(3, std::vector<float>(kCount));
            sample_normals(warp, kCount, {in[0].data(), in[1].data(), in[2].data()}, shape,
                           {in[5].data(), in[6].data()}, {wm[0].data(), wm[1].data(), wm[2].data()});
            for (std::size_t i = 0; i < kCount; ++i)
              ASSERT_TRUE(std::fabs(length(Vec{wm[0][i], wm[1][i], wm[2][i]}) - 1) <= 5 * kEps && wm[2][i] >= 0)
                  << "diagonal 2^" << x << " 2^" << y << ", lean " << lean << ": " << describe(row, in, i);
          }
        }
  });
  EXPECT_GT(accepted, 100u);
  Shape shape;
  for (float x : {1e-6f, 1.f, 100.f})
    for (float y : {1e-6f, 1.f, 100.f}) EXPECT_EQ(make_shape({x, 0, 0, 0, y, 0, 0, 0, 1}, shape), ShapeError::none);
  EXPECT_EQ(make_shape({1, 0, 0, 0, 0x1p20f, 0, 0, 0, 1}, shape), ShapeError::none);
}

// Unset, a shape is the unit sphere.
TEST(Shapes, AreAlphaOneByDefault) {
  const Shape sphere;
  auto compare = [&](const Operation& row, auto call) {
    Operation of_shape = row;
    of_shape.call = call;
    Table in = good_inputs(row, 1 << 10, 13);
    for (std::size_t c : {3, 4}) in[c].assign(in[c].size(), 1.f);
    for (float& z : in[2]) z = std::fabs(z);
    EXPECT_TRUE(same_bits(row, evaluate(row, in), evaluate(of_shape, in), in));
  };
  for_each_row("normals", [&](const Operation& row) {
    compare(row, [&](std::size_t n, const In& in, const Out& out) {
      sample_normals(row.warp, n, in.wo, sphere, in.pair(), out.wm);
    });
  });
  for_each_row("reflection", [&](const Operation& row) {
    if (row.name != std::string("reflection_") + kWarpNames[int(row.warp)] + "_separable") return;
    compare(row, [&](std::size_t n, const In& in, const Out& out) {
      sample_reflection(row.warp, n, in.wo, sphere, in.pair(), {out.wi, out.pdf, out.weight, out.wm, out.wo_dot_wm});
    });
  });
}

}  // namespace
}  // namespace vndf::testing
