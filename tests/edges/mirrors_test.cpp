// alpha = 0 and what is next to it: densities stay finite, and so does what multiple importance sampling makes of them.
#include "edges/edges.h"

namespace vndf::edges {
namespace {

constexpr std::size_t kCount = 1 << 12;

/// alpha = 0 in one axis or in both, of plain GGX and of ellipsoids, upright and leaning: f(surface, warp, what).
template <class F>
void for_each_mirror(F f) {
  const float rough[][2] = {{0, 0}, {0, 0.3f}, {0.3f, 0}, {0, 100}, {1e-6f, 0}};
  const float angles[][3] = {
      {0, 0, 0}, {0, 0, 0.7f}, {0.3f, -0.2f, 1}, {0, 1.5707964f, 0}, {-0.42f, 1.5707964f, 0.82f}};
  for (const auto& alpha : rough)
    for (const auto& theta : angles)
      for (Way way : {Way::plain, Way::constants, Way::turned, Way::tilted})
        for (Warp warp : kWarps) {
          char what[100];
          std::snprintf(what, sizeof what, "%s, way %d, alpha %g %g theta %g %g", kWarpNames[int(warp)], int(way),
                        alpha[0], alpha[1], theta[0], theta[1]);
          Parameters p{alpha[0], alpha[1], theta[0], theta[1], theta[2]};
          with_surface(way, p, kCount, [&](const auto& surface) { f(surface, warp, what); });
        }
}
TEST(AlphaZero, ReflectionsAreFinite) {
  const Batch batch(kCount, false);
  on_every_isa([&] {
    for_each_mirror([&](const auto& surface, Warp warp, const std::string& what) {
      Samples s(kCount);
      Values value(kCount);
      sample_reflection(warp, kCount, batch.wo.in(), surface, batch.pairs(), s.with_normals());
      evaluate_reflection(kCount, batch.wo.in(), s.wi.in(), surface, value.out());
      expect_finite(s, value, batch, what);
    });
  });
}

TEST(AlphaZero, DielectricsAreFinite) {
  const Batch batch(kCount, true);
  on_every_isa([&] {
    for_each_mirror([&](const auto& surface, Warp warp, const std::string& what) {
      Samples s(kCount);
      Values value(kCount);
      for (float eta : {1.5f, 0.5f, 1.f}) {
        sample_dielectric(warp, kCount, batch.wo.in(), surface, eta, batch.u.in(), s.dielectric());
        evaluate_dielectric(kCount, batch.wo.in(), s.wi.in(), surface, eta, value.out());
        expect_finite(s, value, batch, what + " eta " + std::to_string(eta));
      }
    });
  });
}

// The same bounded, which plain GGX alone is.
TEST(AlphaZero, BoundedSamplesAreFinite) {
  const Batch batch(kCount, false);
  on_every_isa([&] {
    for (Warp warp : kWarps)
      for (float other : {0.f, 0.3f, 100.f}) {
        Samples s(kCount);
        sample_reflection(warp, kCount, batch.wo.in(), {0.f, other}, batch.pairs(), s.reflection(),
                          {Masking::height_correlated, true});
        for (std::size_t i = 0; i < kCount; ++i)
          ASSERT_TRUE(finite(s.wi.at(i)) && bounded_result(s.pdf[i], s.weight[i]) && survives_mis(s.pdf[i]))
              << kWarpNames[int(warp)] << " " << other << " " << batch.at(i) << ": " << s.pdf[i] << " " << s.weight[i];
      }
  });
}

// Next to alpha = 0 and within the domain, where densities are larger than any that counts.
TEST(SmallAlpha, DensitiesSurviveHeuristics) {
  const Batch batch(kCount, false);
  on_every_isa([&] {
    for (Warp warp : kWarps)
      for (float alpha : {1e-30f, 1e-20f, 1e-10f, 1e-8f, 1e-6f, 1e-5f})
        for (Way way : {Way::plain, Way::turned, Way::tilted})
          with_surface(way, {alpha, alpha, 0, 0, 0.7f}, kCount, [&](const auto& surface) {
            Samples s(kCount);
            Values value(kCount);
            std::vector<float> pdf(kCount);
            sample_reflection(warp, kCount, batch.wo.in(), surface, batch.pairs(), s.with_normals());
            evaluate_reflection(kCount, batch.wo.in(), s.wi.in(), surface, value.out());
            pdf_normals(kCount, batch.wo.in(), s.wm.in(), surface, pdf.data());
            for (std::size_t i = 0; i < kCount; ++i)
              ASSERT_TRUE(bounded_result(s.pdf[i], s.weight[i]) && survives_mis(s.pdf[i]) &&
                          survives_mis(value.pdf[i]) && value.pdf[i] <= kLargestPdf && std::isfinite(value.f_cos[i]) &&
                          pdf[i] >= 0 && pdf[i] <= kLargestPdf)
                  << kWarpNames[int(warp)] << " " << alpha << " " << batch.at(i) << ": " << s.pdf[i] << " "
                  << s.weight[i] << " " << value.pdf[i] << " " << pdf[i];
          });
  });
}

}  // namespace
}  // namespace vndf::edges
