// Inputs that once went wrong, as they were reported. What is right was computed apart from the library, with sixty
// digits from the papers' plain formulas.
#include <gtest/gtest.h>

#include "reference/errors.h"
#include "shading/inputs.h"
#include "support/bits.h"

namespace vndf::shading {
namespace {

using reference::kEps;
using testing::on_every_isa;

struct Sample {
  Vec3<double> wi, wm;
  float pdf, weight, cos;
};
Sample sample_one(Warp warp, const Vec3<float>& wo, const Alpha<float>& alpha, const float (&u)[2],
                  bool bounded = false) {
  Samples s(1);
  sample_reflection(warp, 1, {wo.x, wo.y, wo.z}, {alpha.x, alpha.y}, {u[0], u[1]}, s.with_normals(),
                    {Masking::height_correlated, bounded});
  return {s.wi.at(0), s.wm.at(0), s.pdf[0], s.weight[0], s.cos[0]};
}
Vec3<double> normal_of(Warp warp, const Vec3<float>& wo, const Alpha<float>& alpha, const float (&u)[2]) {
  Directions wm(1);
  sample_normals(warp, 1, {wo.x, wo.y, wo.z}, {alpha.x, alpha.y}, {u[0], u[1]}, wm.out());
  return wm.at(0);
}

// None of these problems is steep: half units of the last place of all inputs but an end of u, which is taken as it is,
// move the normals by 0.1 to 2.3 eps altogether.
TEST(Literals, Normals) {
  const Vec3<float> slanted{0x1.333334p-1f, 0, 0x1.99999ap-1f};
  const struct {
    const char* what;
    Warp warp;
    Vec3<float> wo;
    Alpha<float> alpha;
    float u[2];
    Vec3<double> wm;
    double bound;
  } rows[] = {
      {"fine random numbers",
       Warp::concentric,
       slanted,
       {0x1.0624dep-10f, 0x1.0624dep-10f},
       {0x1.331158p-8f, 0x1.0764p-18f},
       {0.19756471995466851, -0.19467945548123516, 0.96076432648322408},
       6},
      {"the rim",
       Warp::polar,
       slanted,
       {0x1.a36e2ep-14f, 0x1.a36e2ep-14f},
       {1, 0x1.333334p-2f},
       {-0.77427009879522147, -0.25157567012682353, 0.58070258851832033},
       16},
      {"azimuth from the view",
       Warp::spherical_cap,
       {0x1.97840ap-3f, 0x1.f5c2f8p-1f, 0x1.164fd8p-17f},
       {1, 0x1.f2753cp-8f},
       {0x1.030d16p-1f, 0x1.fffffep-1f},
       {0.99999990857025235, 0.00042762072686478804, 2.9855859970178016e-8},
       6},
      {"opposite to the view",
       Warp::spherical_cap,
       {0x1.97840ap-3f, 0x1.f5c2f8p-1f, 0x1.164fd8p-17f},
       {1, 0x1.f2753cp-8f},
       {0x1.2c7bcep-23f, 0x1.fffffep-1f},
       {0.48100536090034835, -0.09767076670137671, 0.87126015868802980},
       12},
      {"the cap's rim",
       Warp::spherical_cap,
       {0x1.ea121cp-1f, -0x1.281b9ap-2f, 0x1.d96da6p-7f},
       {0x1.0624dep-10f, 0x1.0624dep-10f},
       {0x1.8p-1f, 1},
       {0.88138546768972845, 0.47239777449238544, 0},
       20},
  };
  on_every_isa([&] {
    for (const auto& row : rows) {
      Vec3<double> wm = normal_of(row.warp, row.wo, row.alpha, row.u);
      EXPECT_LE(distance(wm, row.wm), row.bound * kEps) << row.what << ": " << wm.x << " " << wm.y << " " << wm.z;
      Vec3<double> same = sample_one(row.warp, row.wo, row.alpha, row.u).wm;
      EXPECT_EQ(distance(wm, same), 0) << row.what << ", by sample_reflection";
    }
  });
}

// u.y = 1 leaves no height: not 2^-43, and the same from both functions.
TEST(Literals, HeightAtTheCapsRim) {
  const Vec3<float> wo{0x1.ea121cp-1f, -0x1.281b9ap-2f, 0x1.d96da6p-7f};
  const Alpha<float> alpha{0x1.0624dep-10f, 0x1.0624dep-10f};
  on_every_isa([&] {
    for (float u : {0.125f, 0.25f, 0.5f, 0.75f, 0.9f}) {
      EXPECT_EQ(normal_of(Warp::spherical_cap, wo, alpha, {u, 1}).z, 0) << u;
      EXPECT_EQ(sample_one(Warp::spherical_cap, wo, alpha, {u, 1}).wm.z, 0) << u;
    }
  });
}

// Half units of the last place of the directions move the first density by 0.28 of it.
TEST(Literals, Dielectric) {
  const float eta = 0x1.028f5cp+0f;
  on_every_isa([&] {
    Values value(1);
    evaluate_dielectric(1, {0x1.ffcf14p-1f, -0x1.702988p-7f, -0x1.981158p-6f},
                        {-0x1.fa4358p-1f, 0x1.31b95cp-3f, 0x1.d5f776p-13f}, {0x1.67fbd6p-2f, 0x1.ae495cp-5f}, eta,
                        value.out());
    EXPECT_LE(std::fabs(value.pdf[0] - 5.04837991e-9), 8 * 0.284 * 5.04837991e-9);
    EXPECT_GT(value.pdf[0], 1e-10f);

    const Columns3 wo{-0x1.fc31a6p-5f, 0x1.21a3d6p-1f, 0x1.a500dep-1f};
    const Columns2 alpha{0x1.3e1cfcp-1f, 0x1.3e1cfcp-1f};
    Samples s(1);
    sample_dielectric(Warp::concentric, 1, wo, alpha, eta, {0x1.4p-1f, 0x1p-24f, 0x1.c2bf0ep-1f}, s.dielectric());
    evaluate_dielectric(1, wo, s.wi.in(), alpha, eta, value.out());
    EXPECT_EQ(s.side[0], -1);
    EXPECT_NEAR(s.pdf[0], 147.866281881, 16 * 201 * kEps * 147.9);
    EXPECT_NEAR(value.pdf[0], s.pdf[0], 16 * 201 * kEps * 147.9);
  });
}

TEST(Literals, IndexMatchedSurfacesHaveNoDensityAcross) {
  on_every_isa([] {
    Values value(1);
    evaluate_dielectric(1, {0.6f, 0.f, 0.8f}, {-0.60008f, 0.f, -0.79994f}, {0.3f, 0.3f}, 1.f, value.out());
    EXPECT_EQ(value.f_cos[0], 0);
    EXPECT_EQ(value.pdf[0], 0);
  });
}

TEST(Literals, CosinesAreAtMostOne) {
  on_every_isa([] {
    Sample s = sample_one(Warp::polar, {0, 0, 1}, {0.5f, 0.5f}, {0x1.6p-21f, 0x1.7fdf3p-2f});
    EXPECT_LE(s.cos, 1);
    EXPECT_LE(s.wi.z, 1);
  });
}

// The second is the corner of the disk, where the view is horizontal and one alpha decades below the other.
TEST(Literals, LightIsAsLongAsTheView) {
  const struct {
    Vec3<float> wo;
    Alpha<float> alpha;
    float u[2];
  } rows[] = {
      {{-0.982114136f, 0.188286632f, 0}, {0.219113275f, 8.26670002e-05f}, {0x1.fffffep-1f, 0x1.ffe5c4p-1f}},
      {{-0x1.cfef68p-1f, -0x1.b12a74p-2f, 0}, {100, 0x1.0c6f7cp-20f}, {1, 0x1.fffff8p-1f}},
  };
  on_every_isa([&] {
    for (const auto& row : rows)
      for (Warp warp : kWarps)
        for (bool bounded : {false, true}) {
          Sample s = sample_one(warp, row.wo, row.alpha, row.u, bounded);
          double view = length(Vec3<double>{row.wo.x, row.wo.y, row.wo.z});
          EXPECT_LE(std::fabs(length(s.wi) - view), 8 * kEps) << kWarpNames[int(warp)] << " " << bounded;
          EXPECT_LE(s.cos, 1);
          EXPECT_GE(s.cos, 0);
          EXPECT_TRUE(s.pdf >= 0 && s.pdf <= 0x1p60f && s.weight >= 0 && s.weight <= 1) << s.pdf << " " << s.weight;
        }
  });
}

// Azimuth components of 1e-32 are an azimuth.
TEST(Literals, ShortViews) {
  const Alpha<float> alpha{0.02f, 0.01f};
  on_every_isa([&] {
    for (Warp warp : kWarps) {
      Vec3<double> wm = normal_of(warp, {0, 0x1p-100f, 0x1p-100f}, alpha, {0.3f, 0.6f});
      EXPECT_LE(distance(wm, normal_of(warp, {0, 1, 1}, alpha, {0.3f, 0.6f})), 8 * kEps) << int(warp);
    }
  });
}

}  // namespace
}  // namespace vndf::shading
