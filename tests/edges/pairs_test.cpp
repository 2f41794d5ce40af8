// Pairs of directions: those that nobody sampled, and those that were.
#include <algorithm>
#include <cstdio>

#include "ellipsoid/model.h"
#include "reference/errors.h"
#include "shading/grids.h"
#include "support/bits.h"

namespace vndf::shading {
namespace {

using reference::keep_larger;
using reference::kEps;
using reference::Random;
using testing::on_every_isa;
using R = long double;

constexpr float kLargestPdf = 0x1p60f;

/// Directions whose heights are log-uniform from this one to 1, or uniform; on both sides if asked.
Directions random_directions(std::size_t count, std::uint64_t seed, double least, bool both_sides) {
  Directions d(count);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(seed, i);
    double z = random.below(2) ? random.uniform(least, 1) : random.log_uniform(least, 1);
    d.set(i, random_direction(random, both_sides && random.below(2) ? -z : z));
  }
  return d;
}

// Roughness at the corners of the domain, where squares leave the range of float on their way.
constexpr Alpha<float> kCorners[] = {{46.5f, 4.65e-6f}, {4.65e-6f, 46.5f}, {100, 1e-6f}, {1e-6f, 100},
                                     {1e-6f, 1e-6f},    {100, 100},        {1, 1e-6f},   {100, 1}};

/// Pairs above the surface.
struct Pairs {
  static constexpr std::size_t kCount = 1 << 12;
  Directions a = random_directions(kCount, 1, 1e-3, false), b = random_directions(kCount, 2, 1e-3, false);
};

TEST(Corners, EvaluationDoesNotUnderflow) {
  const Pairs pairs;
  on_every_isa([&] {
    for (const auto& alpha : kCorners)
      for (bool bounded : {false, true}) {
        Alpha<R> exactly{alpha.x, alpha.y};
        Values value(Pairs::kCount);
        evaluate_reflection(Pairs::kCount, pairs.a.in(), pairs.b.in(), {alpha.x, alpha.y}, value.out(),
                            {Masking::separable, bounded});
        for (std::size_t i = 0; i < Pairs::kCount; ++i) {
          Vec3<R> wo = pairs.a.at<R>(i), wi = pairs.b.at<R>(i), h = unit(wo + wi);
          R pdf = reflection_pdf(wo, h, exactly) / (bounded ? bounded_share(wo, exactly) : 1);
          R f_cos = brdf_cos(wo, wi, exactly, true);
          if (pdf >= 1e-30L && pdf < kLargestPdf) {
            ASSERT_NEAR(double(value.pdf[i] / pdf), 1, 25 * kEps) << alpha.x << " " << alpha.y;
          }
          if (f_cos >= 1e-30L && pdf < kLargestPdf) {
            ASSERT_NEAR(double(value.f_cos[i] / f_cos), 1, 25 * kEps) << alpha.x << " " << alpha.y;
          }
        }
      }
  });
}

TEST(Corners, DensityOfNormalsDoesNotUnderflow) {
  const Pairs pairs;
  on_every_isa([&] {
    for (const auto& alpha : kCorners) {
      std::vector<float> pdf(Pairs::kCount);
      pdf_normals(Pairs::kCount, pairs.a.in(), pairs.b.in(), {alpha.x, alpha.y}, pdf.data());
      for (std::size_t i = 0; i < Pairs::kCount; ++i) {
        Vec3<R> wo = pairs.a.at<R>(i), wm = pairs.b.at<R>(i);
        R exact = visible_normal_pdf(wo, wm, {alpha.x, alpha.y}), cos = dot(wo, wm);
        if (exact < 1e-30L || exact > kLargestPdf || cos < 0.01L) continue;
        ASSERT_NEAR(double(pdf[i] / exact), 1, 25 * kEps / double(cos)) << alpha.x << " " << alpha.y;
      }
    }
  });
}

// Turned axes, whatever rounding the directions does to so sharp a shape.
TEST(Corners, EvaluationOfEllipsoidsDoesNotUnderflow) {
  const Pairs pairs;
  const std::vector<float> none(Pairs::kCount), turned(Pairs::kCount, 0.7f);
  on_every_isa([&] {
    for (const auto& alpha : kCorners) {
      const ellipsoid::Parameters p{alpha.x, alpha.y, 0, 0, 0.7f};
      const Columns2 columns{alpha.x, alpha.y};
      for (const Ellipsoid& e : {p.ellipsoid(), Ellipsoid(columns, 0.f, 0.f, turned.data()),
                                 Ellipsoid(columns, none.data(), none.data(), turned.data())}) {
        auto shape = ellipsoid::matrix<R>(p);
        Values value(Pairs::kCount);
        evaluate_reflection(Pairs::kCount, pairs.a.in(), pairs.b.in(), e, value.out());
        for (std::size_t i = 0; i < Pairs::kCount; ++i) {
          Vec3<R> wo = pairs.a.at<R>(i), h = unit(wo + pairs.b.at<R>(i));
          R exact = ellipsoid::ndf(h, shape) * ellipsoid::ellipsoid_area({0, 0, 1}, shape) /
                    (4 * ellipsoid::lune_area(wo, shape));
          if (exact < 1e-30L || exact > kLargestPdf) continue;
          ASSERT_NEAR(double(value.pdf[i] / exact), 1, 0.1) << alpha.x << " " << alpha.y;
          ASSERT_GT(value.f_cos[i], 0) << alpha.x << " " << alpha.y;
        }
      }
    }
  });
}

// The density of a sample is that of its evaluation for alpha above 1 too.
TEST(Reflection, OfLargeAlphaHasTheDensityThatIsEvaluated) {
  constexpr std::size_t kCount = std::size_t(1) << 17;
  const Directions wo = random_directions(kCount, 8, 1e-3, false);
  const Numbers u(kCount, 9);
  std::vector<float> alpha_x(kCount), alpha_y(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    Random random(10, i);
    alpha_x[i] = float(random.log_uniform(1, 100));
    alpha_y[i] = random.below(2) ? alpha_x[i] : float(random.log_uniform(1, 100));
  }
  const Columns2 alpha{alpha_x.data(), alpha_y.data()};
  double worst = 0;
  on_every_isa([&] {
    for (Warp warp : kWarps)
      for (bool bounded : {false, true}) {
        ReflectionOptions options{Masking::height_correlated, bounded};
        Samples s(kCount);
        Values value(kCount);
        sample_reflection(warp, kCount, wo.in(), alpha, {u.a.data(), u.b.data()}, s.with_normals(), options);
        evaluate_reflection(kCount, wo.in(), s.wi.in(), alpha, value.out(), options);
        for (std::size_t i = 0; i < kCount; ++i) {
          if (s.pdf[i] == 0) continue;
          double error = std::fabs(double(s.pdf[i]) / value.pdf[i] - 1);
          error /= kEps * (4 + 2 / std::min(alpha_x[i], alpha_y[i])) / std::min(0.25f, s.cos[i]);
          keep_larger(worst, error);
          ASSERT_LE(error, 4) << kWarpNames[int(warp)] << bounded << " alpha " << alpha_x[i] << " " << alpha_y[i]
                              << " wo.z " << wo.z[i] << " cos " << s.cos[i] << " wi.z " << s.wi.z[i];
        }
      }
  });
  std::printf("densities agree within %.2f eps (4 + 2 / alpha) / min(1 / 4, wo.wm)\n", worst);
}

/// What light does between a pair of directions. n is the index of the other side over that of the view's.
struct Crossing {
  Vec3<R> h;
  R length, c, c_i, g2;

  Crossing(const Vec3<R>& wo, const Vec3<R>& wi, R n, bool reflects)
      : h(wo + (reflects ? R(1) : n) * wi), length(std::sqrt(dot(h, h))) {
    h = (1 / length) * h;
    c = std::fabs(dot(wo, h));
    c_i = std::fabs(dot(wi, h));
    g2 = std::fabs(n * n - 1 + c * c);
  }
};

// Whatever is sampled with a density has it when it is evaluated. How near depends on what rounding wi makes of the
// normal, by 1 / |h|, and D, the cosines and, near total reflection, Fresnel's shares of that.
TEST(Dielectric, SampledPairsAreNeverEvaluatedToZero) {
  constexpr std::size_t kCount = std::size_t(1) << 18;
  const Directions wo = random_directions(kCount, 3, 1e-3, true);
  const Numbers u(kCount, 4);
  std::vector<float> alpha_x(kCount), alpha_y(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    Random random(5, i);
    alpha_x[i] = float(random.log_uniform(0.01, 1));
    alpha_y[i] = random.below(2) ? alpha_x[i] : float(random.log_uniform(0.01, 1));
  }
  const Columns2 alpha{alpha_x.data(), alpha_y.data()};
  double worst = 0;
  for (float apart : {2e-5f, 1e-4f, 1e-3f, 1e-2f, 0.33f, 9.f})
    for (float eta : {1 + apart, 1 / (1 + apart)}) {
      const R contrast = std::fmax(R(1), (1 + R(apart)) * (1 + apart) / 6);
      on_every_isa([&] {
        for (Warp warp : kWarps) {
          Samples s(kCount);
          Values value(kCount);
          sample_dielectric(warp, kCount, wo.in(), alpha, eta, u.in(), s.dielectric());
          evaluate_dielectric(kCount, wo.in(), s.wi.in(), alpha, eta, value.out());
          std::size_t compared = 0;
          for (std::size_t i = 0; i < kCount; ++i) {
            if (s.pdf[i] == 0) continue;
            ASSERT_GT(value.pdf[i], 0) << kWarpNames[int(warp)] << " eta " << eta << " at " << i << ": " << s.pdf[i]
                                       << " side " << s.side[i];
            R n = wo.z[i] < 0 ? 1 / R(eta) : R(eta);
            Crossing at(wo.at<R>(i), s.wi.at<R>(i), n, s.side[i] > 0);
            R steep = (4 + 2 / R(std::min(alpha_x[i], alpha_y[i]))) / (std::fmin(R(1), at.length) * at.c * at.c_i);
            steep *= 1 + contrast / std::sqrt(std::fmax(R(1e-12L), at.g2));
            if (!(steep * kEps < 1e-3L)) continue;
            ++compared;
            double error = double(std::fabs(R(s.pdf[i]) / value.pdf[i] - 1) / steep / kEps);
            keep_larger(worst, error);
            ASSERT_LE(error, 4) << kWarpNames[int(warp)] << " eta " << eta << " at " << i;
          }
          ASSERT_TRUE(compared > kCount / 100 || apart < 1e-3f);
        }
      });
    }
  std::printf("densities agree within %.2f eps times what rounding wi does to them\n", worst);
}

// f / eta^2 of the side that light comes from is symmetric across, for pairs that nobody sampled.
TEST(Dielectric, TransmissionIsReciprocalForAnyPair) {
  constexpr std::size_t kCount = std::size_t(1) << 16;
  const Directions a = random_directions(kCount, 6, 1e-2, false);
  Directions b = random_directions(kCount, 7, 1e-2, false);
  for (float& z : b.z) z = -z;
  double worst = 0;
  std::size_t compared = 0;
  for (float larger : {1.0001f, 1.001f, 1.01f, 1.05f, 1.33f, 1.5f, 2.4f, 10.f})
    for (float eta : {larger, 1 / larger})
      for (const Alpha<float>& alpha : {Alpha<float>{0.3f, 0.3f}, {0.7f, 0.2f}, {1, 1}})
        for (Masking masking : {Masking::height_correlated, Masking::separable})
          on_every_isa([&] {
            Values there(kCount), back(kCount);
            evaluate_dielectric(kCount, a.in(), b.in(), {alpha.x, alpha.y}, eta, there.out(), masking);
            evaluate_dielectric(kCount, b.in(), a.in(), {alpha.x, alpha.y}, eta, back.out(), masking);
            for (std::size_t i = 0; i < kCount; ++i) {
              Crossing at(a.at<R>(i), b.at<R>(i), eta, false);
              // Whether a horizontal normal is one of the upper hemisphere is for rounding to decide.
              if (at.c < 0.01L || at.c_i < 0.01L || std::fabs(at.h.z) * at.length < 1e-6L) continue;
              double f = double(there.f_cos[i]) / std::fabs(b.z[i]) / (double(eta) * eta);
              double g = double(back.f_cos[i]) / a.z[i];
              if (f == 0 && g == 0) continue;
              ++compared;
              keep_larger(worst, std::fabs(f / g - 1));
              ASSERT_LE(std::fabs(f / g - 1), 1e-5)
                  << "eta " << eta << " alpha " << alpha.x << " wo " << a.x[i] << " " << a.y[i] << " " << a.z[i]
                  << " wi " << b.x[i] << " " << b.y[i] << " " << b.z[i] << ": " << f << " " << g << ", |h| "
                  << double(at.length) << " cosines " << double(at.c) << " " << double(at.c_i) << ", h.z "
                  << double(at.h.z);
            }
          });
  std::printf("reciprocal within %.1e, %zu pairs\n", worst, compared);
  EXPECT_GT(compared, std::size_t(100000));
}

}  // namespace
}  // namespace vndf::shading
