// Surfaces between equal indices or next to equal ones, and indices that are none.
#include <limits>

#include "edges/edges.h"

namespace vndf::edges {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t kCount = 1 << 12;

/// Every way, with roughness from the smallest to the largest, whatever the angles.
template <class F>
void for_each_surface(std::size_t count, F f) {
  for (const Alpha<float>& alpha : {Alpha<float>{1e-6f, 1e-6f}, {0.3f, 0.7f}, {1e-3f, 0.5f}, {100, 2}})
    for (Way way : kWays) {
      SCOPED_TRACE("way " + std::to_string(int(way)) + " alpha " + std::to_string(alpha.x));
      with_surface(way, {alpha.x, alpha.y, 0.3f, -0.2f, 1}, count, f);
    }
}

/// Calls check(samples, what they evaluate to) for every instruction set, kind of surface and warp.
template <class Check>
void for_each_sample(const Batch& batch, float eta, Check check) {
  on_every_isa([&] {
    for_each_surface(kCount, [&](const auto& surface) {
      for (Warp warp : kWarps) {
        Samples s(kCount);
        Values value(kCount);
        sample_dielectric(warp, kCount, batch.wo.in(), surface, eta, batch.u.in(), s.dielectric());
        evaluate_dielectric(kCount, batch.wo.in(), s.wi.in(), surface, eta, value.out());
        check(s, value);
      }
    });
  });
}

// Within 2^-16 of 1 there is no surface: light goes straight on and counts whole, whatever the random numbers say.
TEST(IndexMatched, LightGoesStraightOn) {
  const Batch batch(kCount, true);
  for (float eta : {1.f, 1 + 0x1p-20f, 1 - 0x1p-20f, 1 + 0x1p-17f, 1 - 0x1p-17f})
    for_each_sample(batch, eta, [&](const Samples& s, const Values& value) {
      for (std::size_t i = 0; i < kCount; ++i) {
        ASSERT_EQ(distance(s.wi.at(i), -1. * batch.wo.at(i)), 0) << batch.at(i) << " eta " << eta;
        ASSERT_EQ(s.side[i], -1);
        if (batch.wo.z[i] != 0) {
          ASSERT_EQ(s.weight[i], 1) << batch.at(i) << " eta " << eta;
          ASSERT_EQ(s.pdf[i], kLargestPdf) << batch.at(i) << " eta " << eta;
        }
        ASSERT_TRUE(bounded_result(s.pdf[i], s.weight[i]) && survives_mis(s.pdf[i]));
        ASSERT_EQ(value.f_cos[i], 0) << batch.at(i) << " eta " << eta;
        ASSERT_EQ(value.pdf[i], 0);
      }
    });
}

// Light from anywhere, close to straight on or not: a delta is not evaluated.
TEST(IndexMatched, EvaluatesToZero) {
  const Batch batch(kCount, true);
  Directions wi(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    Random random(3, i);
    V3<double> off = direction_at(random, random.uniform(-1, 1)), straight = -1. * batch.wo.at(i);
    double scale = random.below(4) ? random.log_uniform(1e-8, 1) : 1e6;
    wi.set(i, unit(straight + scale * off));
  }
  for (float eta : {1.f, 1 + 0x1p-20f, 1 - 0x1p-20f, 1 + 0x1p-17f, 1 - 0x1p-17f})
    on_every_isa([&] {
      for_each_surface(kCount, [&](const auto& surface) {
        Values value(kCount);
        evaluate_dielectric(kCount, batch.wo.in(), wi.in(), surface, eta, value.out());
        for (std::size_t i = 0; i < kCount; ++i) {
          ASSERT_EQ(value.f_cos[i], 0) << batch.at(i) << " wi " << wi.x[i] << " " << wi.y[i] << " " << wi.z[i];
          ASSERT_EQ(value.pdf[i], 0) << batch.at(i) << " wi " << wi.x[i] << " " << wi.y[i] << " " << wi.z[i];
        }
      });
    });
}

// Just outside, everything is finite.
TEST(IndexMatched, NextToItNothingIsInfinite) {
  const Batch batch(kCount, true);
  for (float eta : {1 + 0x1p-16f, 1 - 0x1p-16f, 1 + 0x1p-15f, 1 - 0x1p-15f, 1.0001f, 1 / 1.0001f})
    for_each_sample(batch, eta, [&](const Samples& s, const Values& value) {
      expect_finite(s, value, batch, "eta " + std::to_string(eta));
    });
}

// No index of refraction: no light.
TEST(Eta, ThatIsNoneGivesNothing) {
  const Batch batch(kCount, true);
  Directions wi(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    Random random(4, i);
    wi.set(i, direction_at(random, random.uniform(-1, 1)));
  }
  for (float eta : {0.f, -0.f, -1e-30f, -0.5f, -1.f, -1.5f, -1e30f, kNan, kInf, -kInf})
    on_every_isa([&] {
      for_each_surface(kCount, [&](const auto& surface) {
        Values value(kCount);
        for (Warp warp : kWarps) {
          Samples s(kCount);
          sample_dielectric(warp, kCount, batch.wo.in(), surface, eta, batch.u.in(), s.dielectric());
          for (std::size_t i = 0; i < kCount; ++i) {
            ASSERT_EQ(s.pdf[i], 0) << batch.at(i) << " eta " << eta;
            ASSERT_EQ(s.weight[i], 0) << batch.at(i) << " eta " << eta;
          }
        }
        evaluate_dielectric(kCount, batch.wo.in(), wi.in(), surface, eta, value.out());
        for (std::size_t i = 0; i < kCount; ++i) {
          ASSERT_EQ(value.f_cos[i], 0) << batch.at(i) << " eta " << eta;
          ASSERT_EQ(value.pdf[i], 0) << batch.at(i) << " eta " << eta;
        }
      });
    });
}

}  // namespace
}  // namespace vndf::edges
