// The rough dielectric: directions, densities, energy, masking, from outside and from inside, for plain GGX and for
// ellipsoids, against the formulas of Walter et al. 2007 and 2015.
//
// Significance: 0.01 for all chi-square tests of the file together, by Sidak's correction; seeds are fixed.
#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "ellipsoid/model.h"
#include "reference/errors.h"
#include "shading/grids.h"

namespace vndf::ellipsoid {
namespace {

using reference::keep_larger;
using reference::kEps;
using reference::Random;
using R = long double;

constexpr float kSomeEtas[] = {1.5f, 1 / 1.5f, 1.05f, 2.4f}, kEtas[] = {1.5f, 1 / 1.5f, 1.05f, 2.4f, 0.1f, 0.3f, 4, 10};
struct View {
  float x, y, z;
  Columns3 in() const { return {x, y, z}; }
};
constexpr View kViews[] = {{0.f, 0.f, 1.f},
                           {0.6f, -0.36f, 0.71442284f},
                           {-0.8f, 0.5723635f, 0.18f},
                           {0.6f, -0.36f, -0.71442284f},
                           {-0.8f, 0.5723635f, -0.18f}};
constexpr Parameters kEllipsoids[] = {
    {0.15f, 0.5f, 0, 0, 0.7f},     {0.3f, 0.6f, 0.3f, -0.2f, 0.5f}, {0.8f, 0.2f, 0.5f, 0.4f, -3.f},
    {0.3f, 0.2f, 1.f, -0.8f, 1.f}, {0.01f, 0.03f, 0.2f, 0.1f, 2.f},
};

/// Plain GGX, with a masking of its own, or an ellipsoid.
struct Surface {
  Parameters p;
  bool plain;
  Masking masking;

  void sample(Warp warp, std::size_t n, const Columns3& wo, float eta, const Columns3& u, Samples& out) const {
    if (plain)
      sample_dielectric(warp, n, wo, {p.alpha_x, p.alpha_y}, eta, u, out.dielectric(), masking);
    else
      sample_dielectric(warp, n, wo, p.ellipsoid(), eta, u, out.dielectric());
  }
  void evaluate(std::size_t n, const Columns3& wo, const Columns3& wi, float eta, Values& out) const {
    if (plain)
      evaluate_dielectric(n, wo, wi, {p.alpha_x, p.alpha_y}, eta, out.out(), masking);
    else
      evaluate_dielectric(n, wo, wi, p.ellipsoid(), eta, out.out());
  }
};
std::ostream& operator<<(std::ostream& out, const Surface& s) {
  return out << (s.plain ? "plain " : "ellipsoid ") << s.p.alpha_x << " " << s.p.alpha_y << " " << s.p.theta_x << " "
             << int(s.masking);
}
std::vector<Surface> surfaces() {
  std::vector<Surface> all;
  for (const Parameters& p : kEllipsoids) all.push_back({p, false, Masking::separable});
  for (const auto& a : {Alpha<float>{0.3f, 0.3f}, {0.7f, 0.7f}, {0.2f, 0.6f}, {0.5f, 0.3f}, {1e-2f, 1e-2f}})
    for (Masking masking : {Masking::height_correlated, Masking::separable})
      all.push_back({{a.x, a.y, 0, 0, 0}, true, masking});
  return all;
}

/// Eq. 7's sgn(v.n) v.
template <class T>
Vec3<T> turned(const Vec3<T>& v) {
  return v.z < 0 ? T(-1) * v : v;
}

/// View i and light o as the papers have them: neither is mirrored, and each product has the sign that it has.
struct Pair {
  Vec3<R> i, o, h;  // h is unit, of the upper hemisphere
  R eta, n_i, n_o, length;
  bool refracts, possible;

  Pair(const Vec3<R>& wo, const Vec3<R>& wi, R eta_) : i(wo), o(wi), eta(eta_) {
    n_i = i.z < 0 ? eta : 1;
    n_o = o.z < 0 ? eta : 1;
    refracts = (i.z < 0) != (o.z < 0);
    h = refracts ? n_i * i + n_o * o : i + o;  // Walter et al. 2007, eq. 13 and 16
    length = std::sqrt(dot(h, h));
    h = turned((1 / length) * h);
    length /= n_i;
    // What is above sees the normal's front, what is below its back.
    possible = dot(i, h) * i.z > 0 && dot(o, h) * o.z > 0;
  }
  /// g^2, in proportion to the squared cosine of refraction.
  R g2() const {
    R n = i.z < 0 ? 1 / eta : eta, c = dot(i, h);
    return n * n - 1 + c * c;
  }
  /// The share of light that goes this way.
  R share() const {
    R f = fresnel(std::fabs(dot(i, h)), i.z < 0 ? 1 / eta : eta);
    return refracts ? 1 - f : f;
  }
  /// |d h / d o|, eq. 14 and 17.
  R jacobian() const {
    if (!refracts) return 1 / (4 * std::fabs(dot(o, h)));
    R sum = n_i * dot(i, h) + n_o * dot(o, h);
    return n_o * n_o * std::fabs(dot(o, h)) / (sum * sum);
  }
  R pdf(const M3<R>& a) const { return possible ? share() * normal_pdf(turned(i), h, a) * jacobian() : R(0); }
  /// f |o.n|, eq. 20 and 21, with G of Walter et al. 2015, eq. 7.
  R f_cos(const M3<R>& a) const {
    if (!possible) return 0;
    R g = g1(turned(i), a) * g1(turned(o), a);
    if (!refracts) return share() * g * ndf(h, a) / (4 * std::fabs(i.z));
    R ih = dot(i, h), oh = dot(o, h), sum = n_i * ih + n_o * oh;
    return std::fabs(ih) * std::fabs(oh) / std::fabs(i.z) * n_o * n_o * share() * g * ndf(h, a) / (sum * sum);
  }
  /// How much rounding the directions moves the density: wm by 1 / |h|, which D magnifies by 2 / alpha, the cosines by
  /// their own reciprocals, and Fresnel's shares by 1 / g near total reflection.
  R conditioning(const Parameters& p) const {
    R c = std::fabs(dot(i, h) * dot(o, h)), g = std::sqrt(std::fmax(R(1e-12L), std::fabs(g2())));
    R quotient = std::fmax(eta, 1 / eta), contrast = std::fmax(R(1), quotient * quotient / 6);
    return (4 + 2 / R(std::min(p.alpha_x, p.alpha_y))) * (1 + contrast / g) / (std::fmin(R(1), length) * c);
  }
};

/// Directions above and below.
struct Views {
  Directions wo;

  explicit Views(std::size_t count, std::uint64_t seed, double least_cos = 0) : wo(count) {
    for (std::size_t i = 0; i < count; ++i) {
      Random random(seed, i);
      double z = random.below(2) ? random.uniform(least_cos, 1) : random.uniform(-1, -least_cos);
      wo.set(i, random_direction(random, z));
    }
  }
};

// Directions are the papers' for the normal of the same random numbers, the shares as Fresnel says; what is at the
// wrong side counts nothing.
TEST(Dielectric, DirectionsAndSides) {
  constexpr std::size_t kCount = 1 << 15;
  Numbers u(kCount, 42);
  double worst[2] = {}, worst_unit = 0;
  for (const View& v : kViews)
    for (float eta : kEtas)
      for (const auto& alpha : {Alpha<float>{1e-3f, 1e-3f}, {0.7f, 0.7f}, {0.2f, 0.6f}})
        for (Warp warp : kWarps) {
          Samples sample(kCount);
          sample_dielectric(warp, kCount, {v.x, v.y, v.z}, {alpha.x, alpha.y}, eta, u.in(), sample.dielectric());
          float flip = v.z < 0 ? -1.f : 1.f;
          Directions wm(kCount);
          sample_normals(warp, kCount, {flip * v.x, flip * v.y, flip * v.z}, {alpha.x, alpha.y}, u.pairs(), wm.out());
          Vec3<R> wo{flip * v.x, flip * v.y, flip * v.z};
          R n = v.z < 0 ? 1 / R(eta) : R(eta);
          double flipped = 0;
          for (std::size_t i = 0; i < kCount; ++i) {
            Vec3<R> m = unit(wm.at<R>(i));
            R c = dot(wo, m), f = fresnel(c, n);
            bool reflects = sample.side[i] > 0;
            ASSERT_TRUE(std::fabs(sample.side[i]) == 1);
            if (std::fabs(f - u.c[i]) > 1e-4L) {
              ASSERT_EQ(reflects, R(u.c[i]) < f);
            }
            flipped += reflects != (R(u.c[i]) < f);
            R sin2 = (1 - c * c) / (n * n);
            Vec3<R> exact =
                reflects ? reflect(wo, m) : (1 / n) * (R(-1) * wo) + (c / n - std::sqrt(std::max(R(0), 1 - sin2))) * m;
            exact = R(flip) * exact;
            Vec3<R> wi = sample.wi.at<R>(i), off = wi + R(-1) * exact;
            // Refraction near total reflection is as ill-conditioned as the root of 1 - sin^2.
            R conditioning = reflects ? R(1) : 1 + 1 / std::sqrt(std::max(R(1e-12L), 1 - sin2));
            keep_larger(worst[reflects], double(std::sqrt(dot(off, off)) / conditioning / kEps));
            keep_larger(worst_unit, double(std::fabs(std::sqrt(dot(wi, wi)) - 1) / conditioning / kEps));
            bool possible = (wi.z * v.z > 0) == reflects && wi.z != 0;
            if (!possible) {
              ASSERT_EQ(sample.pdf[i], 0);
              ASSERT_EQ(sample.weight[i], 0);
            }
            ASSERT_LE(sample.weight[i], 1);
          }
          EXPECT_LE(flipped, kCount * 1e-4);
        }
  std::printf("wi given wm: reflected within %.1f, refracted within %.1f eps; length within %.1f eps\n", worst[1],
              worst[0], worst_unit);
  EXPECT_LE(worst[1], 25);
  EXPECT_LE(worst[0], 25);
}

// sample's density is evaluate's, its weight the quotient of f cos and it, at most 1; what comes out at the wrong side
// counts nothing.
TEST(Dielectric, SampleAgreesWithEvaluate) {
  constexpr std::size_t kCount = 1 << 15;
  Numbers u(kCount, 9);
  double worst[2] = {}, worst_weight[2] = {};
  for (const Surface& surface : surfaces())
    for (const View& v : kViews)
      for (float eta : kEtas)
        for (Warp warp : kWarps) {
          Samples sample(kCount);
          Values value(kCount);
          surface.sample(warp, kCount, v.in(), eta, u.in(), sample);
          surface.evaluate(kCount, v.in(), sample.wi.in(), eta, value);
          for (std::size_t i = 0; i < kCount; ++i) {
            ASSERT_EQ(std::fabs(sample.side[i]), 1);
            ASSERT_TRUE(sample.weight[i] >= 0 && sample.weight[i] <= 1) << surface;
            if ((sample.wi.z[i] * v.z > 0) != (sample.side[i] > 0)) {
              ASSERT_TRUE(sample.pdf[i] == 0 && sample.weight[i] == 0);
            }
            if (sample.pdf[i] <= 0) continue;
            Pair pair({v.x, v.y, v.z}, sample.wi.at<R>(i), eta);
            // The normals of the cap lose digits where they are nearly perpendicular to the view.
            if (warp == Warp::spherical_cap && std::fabs(dot(pair.i, pair.h)) < 0.05L) continue;
            double scale = double(pair.conditioning(surface.p)) * kEps;
            keep_larger(worst[surface.plain], std::fabs(double(sample.pdf[i]) / value.pdf[i] - 1) / scale);
            keep_larger(worst_weight[surface.plain],
                        std::fabs(double(value.f_cos[i]) / (double(sample.weight[i]) * value.pdf[i]) - 1) / kEps);
          }
        }
  for (bool plain : {false, true}) {
    std::printf("%s: densities agree within %.2f eps times conditioning, weights within %.1f eps\n",
                plain ? "plain" : "ellipsoids", worst[plain], worst_weight[plain]);
    EXPECT_LE(worst[plain], plain ? 8 : 16);
    EXPECT_LE(worst_weight[plain], plain ? 20 : 24);  // a sample's weight takes A wi with A as floats
  }
}

// wi on both sides, and the share that is lost, against the density that evaluate_dielectric states; and the mean
// weight against the integral of f cos: energy is kept but for what masking loses.
TEST(Dielectric, HasTheDensityAndTheEnergyThatItStates) {
  constexpr std::size_t kSamples = std::size_t(1) << 18;
  const Numbers u(kSamples, 10);
  Sphere sphere;
  std::vector<Surface> rough;  // not too sharp for the sphere's grid
  for (const Surface& s : surfaces())
    if (s.p.alpha_x > 0.1f && (s.p.alpha_x == 0.7f || !s.plain) == (s.masking == Masking::separable))
      rough.push_back(s);
  double tests = double(std::size(kViews) * rough.size() * 3 * 3), least = 1;
  for (const Surface& surface : rough)
    for (const View& v : kViews)
      for (float eta : {1.5f, 1 / 1.5f, surface.plain ? 2.4f : 1 / 2.4f}) {
        surface.evaluate(Sphere::kCount, v.in(), sphere.wi.in(), eta, sphere.value);
        Sphere::Stated stated = sphere.stated(kSamples);
        EXPECT_LE(stated.all, 1 + 1e-3);
        EXPECT_LE(stated.energy, 1 + 1e-3);
        for (Warp warp : kWarps) {
          Samples sample(kSamples);
          surface.sample(warp, kSamples, v.in(), eta, u.in(), sample);
          Sphere::Found found = Sphere::found(sample);
          double probability = p_value(found.counts, stated.expected);
          least = std::min(least, probability);
          EXPECT_GE(probability, least_p_value(tests))
              << kWarpNames[int(warp)] << " " << v.z << " eta " << eta << " " << surface;
          EXPECT_NEAR(found.weight, stated.energy, 4.7 * found.sigma + 1e-3);
        }
      }
  std::printf("least p of %g tests: %.3g\n", tests, least);
}

// Seen smooth, the surface splits light as Fresnel says and keeps all of it.
TEST(Dielectric, SmoothLimit) {
  constexpr std::size_t kCount = 1 << 18;
  Numbers u(kCount, 45);
  for (const View& v : kViews)
    for (float eta : kEtas) {
      Samples sample(kCount);
      sample_dielectric(Warp::polar, kCount, {v.x, v.y, v.z}, {1e-5f, 1e-5f}, eta, u.in(), sample.dielectric());
      double reflected = 0, weight = 0;
      for (std::size_t i = 0; i < kCount; ++i) {
        reflected += sample.side[i] > 0;
        weight += sample.weight[i];
      }
      double f = fresnel<double>(std::fabs(v.z), v.z < 0 ? 1 / double(eta) : double(eta));
      EXPECT_NEAR(reflected / kCount, f, 5 * std::sqrt(f * (1 - f) / kCount) + 1e-4);
      EXPECT_NEAR(weight / kCount, 1, 1e-4);
    }
}

// The papers' formulas in long double, for pairs that are sampled and for any; and what is impossible is 0.
TEST(Dielectric, EvaluatesThePapersFormulas) {
  constexpr std::size_t kCount = 1 << 15;
  Directions wo = Views(kCount, 4, 0.02).wo, any = Views(kCount, 5, 0.02).wo;
  Numbers u(kCount, 6);
  double worst[2][2] = {};
  std::size_t pairs[2][2] = {}, impossible = 0;
  for (const Parameters& p : kEllipsoids)
    for (float eta : kSomeEtas) {
      Samples sample(kCount);
      sample_dielectric(Warp::concentric, kCount, wo.in(), p.ellipsoid(), eta, u.in(), sample.dielectric());
      for (std::size_t i = 0; i < kCount; i += 2) sample.wi.set(i, any.at(i));
      Values value(kCount);
      evaluate_dielectric(kCount, wo.in(), sample.wi.in(), p.ellipsoid(), eta, value.out());
      M3<R> a = matrix<R>(p);
      for (std::size_t i = 0; i < kCount; ++i) {
        Pair pair(wo.at<R>(i), sample.wi.at<R>(i), eta);
        // On the borders of what is possible rounding decides.
        R border = std::min({std::fabs(dot(pair.i, pair.h)), std::fabs(dot(pair.o, pair.h)), std::fabs(pair.h.z),
                             std::fabs(pair.o.z), std::fabs(pair.g2()), pair.length});
        if (border < 1e-4L) continue;
        R pdf = pair.pdf(a), f_cos = pair.f_cos(a), scale = pair.conditioning(p) * kEps;
        if (!(pdf > 1e-20L)) {
          ASSERT_LE(value.pdf[i], 1e-19f) << i;
          ASSERT_LE(value.f_cos[i], 1e-19f) << i;
          ++impossible;
          continue;
        }
        bool below = pair.i.z < 0;
        for (R ratio : {value.pdf[i] / pdf, value.f_cos[i] / f_cos})
          keep_larger(worst[below][pair.refracts], double(std::fabs(ratio - 1) / scale));
        ++pairs[below][pair.refracts];
      }
    }
  for (bool below : {false, true})
    for (bool refracts : {false, true}) {
      std::printf("%s, %s: within %.2f eps of the formulas, times conditioning, %zu pairs\n", below ? "below" : "above",
                  refracts ? "refracted" : "reflected", worst[below][refracts], pairs[below][refracts]);
      EXPECT_LE(worst[below][refracts], 4);
      EXPECT_GT(pairs[below][refracts], kCount / 4);
    }
  EXPECT_GT(impossible, kCount / 4);
}

// A Shape of a general matrix, by the same formulas.
TEST(Dielectric, TakesShapesOfMatrices) {
  constexpr std::size_t kCount = 1 << 12;
  const float rows[9] = {0.4f, 0.1f, 0.3f, -0.2f, 0.5f, -0.1f, 0.05f, 0.1f, 1.2f};
  M3<R> a{{rows[0], rows[3], rows[6]}, {rows[1], rows[4], rows[7]}, {rows[2], rows[5], rows[8]}};
  Shape shape;
  ASSERT_EQ(make_shape(rows, shape), ShapeError::none);
  Directions wo = Views(kCount, 7, 0.1).wo;
  Numbers u(kCount, 8);
  for (Warp warp : kWarps) {
    Samples sample(kCount);
    Values value(kCount);
    sample_dielectric(warp, kCount, wo.in(), shape, 1.5f, u.in(), sample.dielectric());
    evaluate_dielectric(kCount, wo.in(), sample.wi.in(), shape, 1.5f, value.out());
    std::size_t compared = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
      Pair pair(wo.at<R>(i), sample.wi.at<R>(i), 1.5L);
      if (sample.pdf[i] <= 0 || std::fabs(dot(pair.i, pair.h)) < 0.1L || std::fabs(pair.g2()) < 0.01L) continue;
      ++compared;
      ASSERT_NEAR(value.pdf[i] / pair.pdf(a), 1, 1e-4) << i;
      ASSERT_NEAR(value.f_cos[i] / pair.f_cos(a), 1, 1e-4) << i;
      ASSERT_NEAR(sample.pdf[i] / pair.pdf(a), 1, 1e-3) << i;
      ASSERT_NEAR(sample.weight[i] * pair.pdf(a) / pair.f_cos(a), 1, 1e-3) << i;
    }
    EXPECT_GT(compared, kCount / 2);
  }
}

// Eq. 7: masking is that of directions turned to the upper hemisphere. The weight of a direction across is the one that
// reflection has for its mirror image in the origin, not in the surface; a view from below is its mirror image in the
// origin with the indices exchanged, but for rounding: the normal of a pair is summed for the lower direction's side,
// so that the pair exchanged has the same.
TEST(Dielectric, MaskingOfTurnedDirections) {
  constexpr std::size_t kCount = 1 << 14;
  Directions wo = Views(kCount, 11, 0.02).wo;
  Numbers u(kCount, 12);
  double worst = 0;
  std::size_t across = 0, tell_apart = 0;
  auto mirrored = [](const Vec3<double>& v) { return -1. * v; };
  for (const Parameters& p : kEllipsoids) {
    Samples sample(kCount);
    Values value(kCount), other(kCount), upper(kCount), reflected(kCount);
    Directions wo_2(kCount), wi_2(kCount), wo_up(kCount), wi_up(kCount), wi_flat(kCount);
    sample_dielectric(Warp::polar, kCount, wo.in(), p.ellipsoid(), 2.f, u.in(), sample.dielectric());
    for (std::size_t i = 0; i < kCount; ++i) {
      Vec3<double> wi = sample.wi.at(i);
      wo_2.set(i, mirrored(wo.at(i)));
      wi_2.set(i, mirrored(wi));
      wo_up.set(i, turned(wo.at(i)));
      wi_up.set(i, turned(wi));
      wi_flat.set(i, Vec3<double>{wi.x, wi.y, std::fabs(wi.z)});
    }
    evaluate_dielectric(kCount, wo.in(), sample.wi.in(), p.ellipsoid(), 2.f, value.out());
    evaluate_dielectric(kCount, wo_2.in(), wi_2.in(), p.ellipsoid(), 0.5f, other.out());
    evaluate_reflection(kCount, wo_up.in(), wi_up.in(), p.ellipsoid(), upper.out());
    evaluate_reflection(kCount, wo_up.in(), wi_flat.in(), p.ellipsoid(), reflected.out());
    for (std::size_t i = 0; i < kCount; ++i) {
      ASSERT_NEAR(value.f_cos[i], other.f_cos[i], 1e-3 * value.f_cos[i]) << i;
      ASSERT_NEAR(value.pdf[i], other.pdf[i], 1e-3 * value.pdf[i]) << i;
      if (!(value.pdf[i] > 0) || sample.side[i] > 0) continue;
      ++across;
      double weight = double(value.f_cos[i]) / value.pdf[i], exact = double(upper.f_cos[i]) / upper.pdf[i];
      keep_larger(worst, std::fabs(weight / exact - 1) / kEps);
      tell_apart += std::fabs(double(reflected.f_cos[i]) / reflected.pdf[i] / exact - 1) > 0.01;
    }
  }
  std::printf("weights across within %.1f eps of those of reflection; %zu of %zu pairs tell mirror images apart\n",
              worst, tell_apart, across);
  EXPECT_LE(worst, 8);
  EXPECT_GT(across, kCount);
  EXPECT_GT(tell_apart, across / 4);
}

// f / eta^2 of the side that light comes from is symmetric, for reflection and across.
TEST(Dielectric, IsReciprocal) {
  constexpr std::size_t kCount = 1 << 16;
  Directions a = Views(kCount, 13, 0.05).wo, b = Views(kCount, 14, 0.05).wo;
  double worst[2] = {};
  std::size_t pairs[2] = {};
  for (const Surface& surface : surfaces())
    for (float eta : kEtas) {
      Values there(kCount), back(kCount);
      surface.evaluate(kCount, a.in(), b.in(), eta, there);
      surface.evaluate(kCount, b.in(), a.in(), eta, back);
      for (std::size_t i = 0; i < kCount; ++i) {
        Pair pair(a.at<R>(i), b.at<R>(i), eta), reverse(b.at<R>(i), a.at<R>(i), eta);
        R border = std::min({std::fabs(dot(pair.i, pair.h)), std::fabs(dot(pair.o, pair.h)), std::fabs(pair.h.z),
                             std::fabs(pair.g2()), std::fabs(reverse.g2())});
        if (!pair.possible || border < 1e-3L) continue;
        R f = there.f_cos[i] / std::fabs(pair.o.z) / (pair.n_o * pair.n_o);
        R g = back.f_cos[i] / std::fabs(pair.i.z) / (pair.n_i * pair.n_i);
        if (f == 0 && g == 0) continue;
        R scale = std::fmax(pair.conditioning(surface.p), reverse.conditioning(surface.p)) * kEps;
        keep_larger(worst[pair.refracts], double(std::fabs(f / g - 1) / scale));
        ++pairs[pair.refracts];
      }
    }
  std::printf("reciprocity within %.2f eps times conditioning reflected, %.2f across; %zu and %zu pairs\n", worst[0],
              worst[1], pairs[0], pairs[1]);
  for (int k : {0, 1}) {
    EXPECT_LE(worst[k], 4);
    EXPECT_GT(pairs[k], kCount / 4);
  }
}

}  // namespace
}  // namespace vndf::ellipsoid
