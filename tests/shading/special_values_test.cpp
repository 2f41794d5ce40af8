// What the headers say of the shading step at the edge of its domain and beyond it. On every instruction set, for every
// warp and option, and random numbers that are on no warp's rim.
#include <limits>

#include <vndf/ellipsoid.h>

#include "reference/errors.h"
#include "shading/sphere.h"
#include "support/bits.h"

namespace vndf::shading {
namespace {

using reference::kEps;
using testing::on_every_isa;
using testing::same_bits;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kLargestPdf = 0x1p60f;
constexpr std::size_t kCount = 256;
const Numbers kNumbers(kCount, 61);

using View = V3<float>;
Columns3 columns(const View& v) {
  return {v.x, v.y, v.z};
}
Columns2 random_pairs() {
  return {kNumbers.a.data(), kNumbers.b.data()};
}
double distance(const V3<double>& a, const V3<double>& b) {
  V3<double> off = a + -1. * b;
  return std::sqrt(dot(off, off));
}

template <class F>
void for_each_masking(F f) {
  on_every_isa([&] {
    for (Masking masking : {Masking::height_correlated, Masking::separable}) f(masking);
  });
}

/// A way of sampling reflections.
struct Way {
  Warp warp;
  ReflectionOptions options;

  Samples sample(const View& wo, const Alpha<float>& alpha) const {
    Samples s(kCount);
    sample_reflection(warp, kCount, columns(wo), {alpha.x, alpha.y}, random_pairs(), s.reflection(), options);
    return s;
  }
};
template <class F>
void for_each_way(F f) {
  for_each_masking([&](Masking masking) {
    for (Warp warp : kWarps)
      for (bool bounded : {false, true}) {
        SCOPED_TRACE(std::string(kWarpNames[int(warp)]) + (bounded ? " bounded" : ""));
        f(Way{warp, {masking, bounded}});
      }
  });
}

TEST(Reflection, OfAlphaZeroIsAMirror) {
  for_each_way([](const Way& way) {
    for (const View& wo : {View{0, 0, 1}, {0.6f, 0, 0.8f}, {-0.36f, 0.48f, 0.8f}, {0.8f, 0.6f, 1e-3f}}) {
      Samples s = way.sample(wo, {0, 0});
      for (std::size_t i = 0; i < kCount; ++i) {
        ASSERT_LE(distance(s.wi.at(i), {-wo.x, -wo.y, wo.z}), 40 * kEps);
        ASSERT_GT(s.pdf[i], 1e15f);
        ASSERT_LE(s.pdf[i], kLargestPdf);
        ASSERT_NEAR(s.weight[i], 1, 8 * kEps);
      }
    }
  });
}

// The signs go to the view in the hemisphere configuration, so the reference is the mirrored view's sample.
TEST(Reflection, OfNegativeAlphaHasItsAbsoluteValue) {
  for_each_way([](const Way& way) {
    for (float x : {1.f, -1.f})
      for (float y : {1.f, -1.f}) {
        Samples s = way.sample({0.5f, 0.3f, 0.81240386f}, {x * 0.4f, y * 0.7f});
        Samples mirrored = way.sample({x * 0.5f, y * 0.3f, 0.81240386f}, {0.4f, 0.7f});
        for (std::size_t i = 0; i < kCount; ++i) {
          V3<double> wi = mirrored.wi.at(i);
          ASSERT_LE(distance(s.wi.at(i), {x * wi.x, y * wi.y, wi.z}), 40 * kEps);
          ASSERT_NEAR(s.pdf[i], mirrored.pdf[i], 40 * kEps * mirrored.pdf[i]);
          ASSERT_NEAR(s.weight[i], mirrored.weight[i], 40 * kEps);
        }
      }
  });
}

// Bounded, the samples are others: the bound takes the view as a unit vector.
TEST(Reflection, OfViewsOfAnotherLength) {
  for_each_way([](const Way& way) {
    const View wo{0.5f, 0.3f, 0.81240386f};
    const Alpha<float> alpha{0.4f, 0.7f};
    Samples unit = way.sample(wo, alpha);
    for (float length : {1e-3f, 0.3f, 7.f, 1e3f}) {
      Samples s = way.sample({length * wo.x, length * wo.y, length * wo.z}, alpha);
      for (std::size_t i = 0; i < kCount; ++i) {
        V3<double> wi = (1. / length) * s.wi.at(i);
        ASSERT_NEAR(std::sqrt(dot(wi, wi)), 1, 40 * kEps);
        if (way.options.bounded) continue;
        ASSERT_LE(distance(wi, unit.wi.at(i)), 1e-4);
        ASSERT_NEAR(double(s.pdf[i]) * length, unit.pdf[i], 1e-4 * unit.pdf[i]);
        ASSERT_NEAR(s.weight[i], unit.weight[i], 1e-4);
      }
    }
  });
}

// A view on the horizon has reflections like any other; one below it, however little, has none.
TEST(Reflection, IsNoneBelowTheHorizon) {
  std::size_t lost = 0;
  for_each_way([&](const Way& way) {
    for (float z : {0.8f, 1e-3f, 0.f, -0.f, -1e-30f, -1e-3f, -0.8f}) {
      float side = std::sqrt(1 - z * z);
      Samples s = way.sample({side * 0.8f, side * 0.6f, z}, {0.9f, 0.6f});
      for (std::size_t i = 0; i < kCount; ++i) {
        bool possible = z >= 0 && s.wi.z[i] > 0;
        lost += z >= 0 && !possible;
        ASSERT_TRUE(possible ? s.pdf[i] > 0 && s.weight[i] > 0 : s.pdf[i] == 0 && s.weight[i] == 0) << z;
      }
    }
  });
  EXPECT_GT(lost, 0u);
}

template <class F>
void for_each_evaluation(F f) {
  for_each_masking([&](Masking masking) {
    for (bool bounded : {false, true})
      f([=](const View& wo, const View& wi, float alpha) {
        struct {
          float f_cos, pdf;
        } value;
        evaluate_reflection(1, columns(wo), columns(wi), {alpha, alpha}, {&value.f_cos, &value.pdf},
                            {masking, bounded});
        return value;
      });
  });
}
float normal_pdf(const View& wo, const View& wm, float alpha) {
  float pdf;
  pdf_normals(1, columns(wo), columns(wm), {alpha, alpha}, &pdf);
  return pdf;
}

TEST(Evaluation, OfAlphaZero) {
  const View wi{-0.6f, 0, 0.8f};
  for_each_evaluation([&](auto evaluate) {
    auto peak = evaluate({0.6f, 0, 0.8f}, wi, 0);
    EXPECT_TRUE(peak.f_cos > 1e15f && peak.f_cos < kInf) << peak.f_cos;
    EXPECT_TRUE(peak.pdf > 1e15f && peak.pdf <= kLargestPdf) << peak.pdf;
    for (const View& wo : {View{0.6f, 0, 0.8f}, {0, 0, 1}, {0.6f, 1e-15f, 0.8f}})
      for (float alpha : {0.f, 1e-30f}) {
        EXPECT_TRUE(same_bits(evaluate(wo, wi, alpha).f_cos, evaluate(wo, wi, 0x1p-60f).f_cos));
        EXPECT_TRUE(same_bits(evaluate(wo, wi, alpha).pdf, evaluate(wo, wi, 0x1p-60f).pdf));
      }
  });
  on_every_isa([] {
    for (const View& wm : {View{0, 0, 1}, {1e-15f, 0, 1}, {0.6f, 0, 0.8f}})
      for (float alpha : {0.f, 1e-30f})
        EXPECT_TRUE(same_bits(normal_pdf({0.6f, 0, 0.8f}, wm, alpha), normal_pdf({0.6f, 0, 0.8f}, wm, 0x1p-60f)));
  });
}

TEST(Evaluation, OfImpossiblePairsIsZero) {
  const struct {
    View wo, wi;
    bool possible;
  } rows[] = {
      {{0.6f, 0, 0.8f}, {0, 0.6f, 0.8f}, true},    {{1, 0, 0}, {0, 0.6f, 0.8f}, true},
      {{1, 0, -0.f}, {0, 0.6f, 0.8f}, true},       {{1, 0, -1e-30f}, {0, 0.6f, 0.8f}, false},
      {{0.6f, 0, -0.8f}, {0, 0.6f, 0.8f}, false},  {{0.6f, 0, 0.8f}, {0, 1, 1e-30f}, true},
      {{0.6f, 0, 0.8f}, {0, 1, 0}, false},         {{0.6f, 0, 0.8f}, {0, 1, -0.f}, false},
      {{0.6f, 0, 0.8f}, {0, 1, -1e-30f}, false},   {{0.6f, 0, 0.8f}, {0, 0.6f, -0.8f}, false},
      {{0.6f, 0, -0.8f}, {0, 0.6f, -0.8f}, false},
  };
  for_each_evaluation([&](auto evaluate) {
    for (const auto& row : rows) {
      auto value = evaluate(row.wo, row.wi, 0.5f);
      EXPECT_TRUE(row.possible ? value.f_cos > 0 && value.pdf > 0 : value.f_cos == 0 && value.pdf == 0)
          << row.wo.z << " " << row.wi.z << ": " << value.f_cos << " " << value.pdf;
    }
  });
}

TEST(Evaluation, OfInvisibleNormalsIsZero) {
  const struct {
    View wo, wm;
    bool visible;
  } rows[] = {
      {{0.6f, 0, 0.8f}, {0, 0, 1}, true},   {{0.6f, 0, -0.8f}, {0.96f, 0, 0.28f}, true},
      {{1, 0, 0}, {0.6f, 0, 0.8f}, true},   {{0.6f, 0, 0.8f}, {1, 0, -1e-30f}, false},
      {{1, 0, 0}, {0, 0, 1}, false},        {{0.6f, 0, -0.8f}, {0, 0, 1}, false},
      {{1, 0, 0}, {0.8f, 0, -0.6f}, false}, {{1, 0, 0}, {-0.6f, 0, 0.8f}, false},
  };
  on_every_isa([&] {
    for (const auto& row : rows) {
      float pdf = normal_pdf(row.wo, row.wm, 0.5f);
      EXPECT_TRUE(row.visible ? pdf > 0 : pdf == 0) << row.wo.z << " " << row.wm.x << " " << row.wm.z << ": " << pdf;
    }
  });
}

// There is no surface: light goes straight on.
TEST(Dielectric, EqualIndices) {
  for_each_masking([](Masking masking) {
    for (const View& wo : {View{0, 0, 1}, {0.6f, 0, 0.8f}, {0.6f, 0, -0.8f}, {0.8f, 0.6f, 1e-3f}})
      for (const Alpha<float>& alpha : {Alpha<float>{1e-3f, 1e-3f}, {0.3f, 0.7f}, {50, 2}})
        for (Warp warp : kWarps) {
          Samples s(kCount);
          Values value(kCount);
          sample_dielectric(warp, kCount, columns(wo), {alpha.x, alpha.y}, 1.f, kNumbers.in(), s.dielectric(), masking);
          evaluate_dielectric(kCount, columns(wo), s.wi.in(), {alpha.x, alpha.y}, 1.f, value.out(), masking);
          for (std::size_t i = 0; i < kCount; ++i) {
            ASSERT_EQ(distance(s.wi.at(i), {-wo.x, -wo.y, -wo.z}), 0);
            ASSERT_EQ(s.side[i], -1);
            ASSERT_EQ(s.pdf[i], kLargestPdf);
            ASSERT_EQ(s.weight[i], 1);
            ASSERT_EQ(value.f_cos[i], 0);
            ASSERT_EQ(value.pdf[i], 0);
          }
        }
  });
}

// Unset, a shape is the unit sphere.
TEST(Shape, DefaultHasTheBitsOfAlphaOne) {
  on_every_isa([] {
    const Columns2 alpha{1.f, 1.f};
    for (const View& wo : {View{0, 0, 1}, {0.6f, 0, 0.8f}, {-0.48f, 0.36f, 0.8f}})
      for (Warp warp : kWarps) {
        Directions wm(kCount), wm_of_shape(kCount);
        sample_normals(warp, kCount, columns(wo), alpha, random_pairs(), wm.out());
        sample_normals(warp, kCount, columns(wo), Shape(), random_pairs(), wm_of_shape.out());
        EXPECT_TRUE(same_bits({wm.x, wm.y, wm.z}, {wm_of_shape.x, wm_of_shape.y, wm_of_shape.z}));

        Samples s(kCount), of_shape(kCount);
        sample_reflection(warp, kCount, columns(wo), alpha, random_pairs(), s.reflection(),
                          {Masking::separable, false});
        sample_reflection(warp, kCount, columns(wo), Shape(), random_pairs(), of_shape.reflection());
        EXPECT_TRUE(same_bits({s.wi.x, s.wi.y, s.wi.z, s.pdf, s.weight},
                              {of_shape.wi.x, of_shape.wi.y, of_shape.wi.z, of_shape.pdf, of_shape.weight}));
      }
  });
}

}  // namespace
}  // namespace vndf::shading
