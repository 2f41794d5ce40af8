// Directions that come out, at the rims and ends where rounding decides: as long as the view, cosines of at most 1, and
// the same normal from every function.
#include "edges/edges.h"
#include "reference/hard_cases.h"

namespace vndf::edges {
namespace {

using reference::Inputs;

constexpr std::size_t kCount = std::size_t(1) << 16;

/// Any roughness of the domain, decades apart more often than not.
float any_alpha(Random& random) {
  static const float edges[] = {1e-6f, 1e-4f, 1.f, 100.f};
  return random.below(4) ? float(random.log_uniform(1e-6, 100)) : edges[random.below(std::size(edges))];
}
/// Views at the edges, alphas decades apart, random numbers at the rim and not.
Inputs hard_rims(std::uint64_t seed, bool isotropic = false) {
  Inputs in(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    Random random(seed, i);
    V3<double> wo = any_view(random);
    in.wo_x[i] = float(wo.x);
    in.wo_y[i] = float(wo.y);
    in.wo_z[i] = float(wo.z);
    in.alpha_x[i] = any_alpha(random);
    in.alpha_y[i] = isotropic ? in.alpha_x[i] : any_alpha(random);
    in.u_x[i] = any_number(random);
    in.u_y[i] = any_number(random);
  }
  return in;
}
/// The hard cases, and the above.
template <class F>
void for_each_batch(Warp warp, std::uint64_t seed, F f) {
  for (const auto& row : reference::hard_cases()) {
    SCOPED_TRACE(row.name);
    f(reference::generate(row, warp, kCount / 8, seed));
  }
  for (std::uint64_t k = 0; k < 4; ++k) {
    SCOPED_TRACE("hard rims");
    f(hard_rims(seed + k, k % 2));
  }
}
std::string at(const Inputs& in, std::size_t i) {
  char text[200];
  std::snprintf(text, sizeof text, "wo %a %a %a alpha %a %a u %a %a", in.wo_x[i], in.wo_y[i], in.wo_z[i], in.alpha_x[i],
                in.alpha_y[i], in.u_x[i], in.u_y[i]);
  return text;
}
V3<double> view(const Inputs& in, std::size_t i) {
  return {in.wo_x[i], in.wo_y[i], in.wo_z[i]};
}

/// f(in, samples, way) for all that sample_reflection can do with the hard cases, which are not all unit views.
template <class F>
void for_each_reflection(F f) {
  for (Warp warp : kWarps)
    for (bool bounded : {false, true})
      for_each_batch(warp, 1, [&](const Inputs& in) {
        Samples s(in.size());
        sample_reflection(warp, in.size(), in.wo(), in.alpha(), in.u(), s.with_normals(),
                          {Masking::height_correlated, bounded});
        f(in, s, std::string(kWarpNames[int(warp)]) + (bounded ? " bounded " : " "));
      });
}

// |wi| = |wo|, which a cosine that was computed apart from wm would not give.
TEST(Directions, ReflectedLightIsAsLongAsTheView) {
  on_every_isa([] {
    for_each_reflection([](const Inputs& in, const Samples& s, const std::string& way) {
      for (std::size_t i = 0; i < in.size(); ++i) {
        double wo = length(view(in, i));
        if (in.wo_z[i] < 0 || std::fabs(wo - 1) > 2e-3) continue;
        ASSERT_LE(std::fabs(length(s.wi.at(i)) / wo - 1), 12 * kEps) << way << at(in, i);
      }
    });
  });
}

// Callers take the root of 1 - cos^2; and nothing is infinite or NaN at the rims.
TEST(Directions, ReflectionsAreSound) {
  on_every_isa([] {
    for_each_reflection([](const Inputs& in, const Samples& s, const std::string& way) {
      for (std::size_t i = 0; i < in.size(); ++i) {
        if (in.wo_z[i] < 0 || std::fabs(length(view(in, i)) - 1) > 1e-6) continue;
        ASSERT_TRUE(is_unit(s.wm.at(i))) << way << at(in, i);
        ASSERT_TRUE(s.cos[i] >= 0 && s.cos[i] <= 1) << way << at(in, i) << ": " << s.cos[i];
        ASSERT_LE(s.wi.z[i], 1) << way << at(in, i);
        ASSERT_TRUE(bounded_result(s.pdf[i], s.weight[i]))
            << way << at(in, i) << ": " << s.pdf[i] << " " << s.weight[i];
      }
    });
  });
}

// Near-normal views and normals, where cosines are next to 1.
TEST(Directions, CosinesAreAtMostOne) {
  constexpr std::size_t kMany = std::size_t(1) << 19;
  Inputs in(kMany);
  std::vector<float> u3(kMany);
  for (std::size_t i = 0; i < kMany; ++i) {
    Random random(2, i);
    double s = random.below(3) ? random.log_uniform(1e-8, 1e-2) : 0;
    V3<double> wo = direction_at(random, std::sqrt(1 - s * s));
    in.wo_x[i] = float(wo.x);
    in.wo_y[i] = float(wo.y);
    in.wo_z[i] = float(wo.z);
    in.alpha_x[i] = float(random.log_uniform(1e-3, 1));
    in.alpha_y[i] = random.below(2) ? in.alpha_x[i] : float(random.log_uniform(1e-3, 1));
    // The middle of each warp, whose normals are close to the view.
    float small = float(random.log_uniform(1e-9, 1e-3));
    in.u_x[i] = random.below(2) ? small : random.unit();
    in.u_y[i] = random.below(2) ? small : random.unit();
    u3[i] = random.unit();
  }
  on_every_isa([&] {
    for (Warp warp : kWarps) {
      Samples s(kMany);
      for (bool bounded : {false, true}) {
        sample_reflection(warp, kMany, in.wo(), in.alpha(), in.u(), s.with_normals(),
                          {Masking::height_correlated, bounded});
        for (std::size_t i = 0; i < kMany; ++i) {
          ASSERT_LE(s.cos[i], 1) << kWarpNames[int(warp)] << bounded << " " << at(in, i);
          ASSERT_LE(s.wi.z[i], 1) << kWarpNames[int(warp)] << bounded << " " << at(in, i);
        }
      }
      for (float eta : {1.5f, 1.01f, 0.99f, 0.5f}) {
        sample_dielectric(warp, kMany, in.wo(), in.alpha(), eta, {in.u_x.data(), in.u_y.data(), u3.data()},
                          s.dielectric());
        for (std::size_t i = 0; i < kMany; ++i)
          ASSERT_LE(std::fabs(s.wi.z[i]), 1) << kWarpNames[int(warp)] << " eta " << eta << " " << at(in, i);
      }
      for (Way way : {Way::constants, Way::turned, Way::tilted})
        with_surface(way, {0.5f, 0.3f, 0.01f, 0.02f, 1}, kMany, [&](const auto& surface) {
          sample_reflection(warp, kMany, in.wo(), surface, in.u(), s.with_normals());
          for (std::size_t i = 0; i < kMany; ++i) {
            ASSERT_LE(s.cos[i], 1) << kWarpNames[int(warp)] << int(way) << " " << at(in, i);
            ASSERT_LE(s.wi.z[i], 1) << kWarpNames[int(warp)] << int(way) << " " << at(in, i);
          }
        });
    }
  });
}

// The normal of sample_reflection is that of sample_normals to the bit, for every view and alpha.
TEST(Directions, NormalIsThatOfSampleNormals) {
  on_every_isa([] {
    for (Warp warp : kWarps)
      for_each_batch(warp, 3, [&](const Inputs& in) {
        Directions wm(in.size());
        Samples s(in.size());
        auto compare = [&](const char* what) {
          for (std::size_t i = 0; i < in.size(); ++i)
            ASSERT_TRUE(testing::same_bits(wm.x[i], s.wm.x[i]) && testing::same_bits(wm.y[i], s.wm.y[i]) &&
                        testing::same_bits(wm.z[i], s.wm.z[i]))
                << what << " " << kWarpNames[int(warp)] << " " << at(in, i);
        };
        sample_normals(warp, in.size(), in.wo(), in.alpha(), in.u(), wm.out());
        sample_reflection(warp, in.size(), in.wo(), in.alpha(), in.u(), s.with_normals());
        compare("plain");
        for (Way way : {Way::constants, Way::turned, Way::tilted, Way::matrix})
          with_surface(way, {0.3f, 0.05f, 0.2f, -0.3f, 1}, in.size(), [&](const auto& surface) {
            sample_normals(warp, in.size(), in.wo(), surface, in.u(), wm.out());
            sample_reflection(warp, in.size(), in.wo(), surface, in.u(), s.with_normals());
            compare("ellipsoid");
          });
      });
  });
}

// Alpha up to 2^24, as far as squares of squares carry.
TEST(Directions, NormalsOfLargeAlphaAreUnit) {
  on_every_isa([] {
    for (Warp warp : kWarps)
      for (float alpha_x : {1e-6f, 1.f, 0x1p14f, 0x1p18f, 0x1p24f})
        for (float alpha_y : {1.f, 0x1p18f, 0x1p24f}) {
          Inputs in = hard_rims(4);
          Directions wm(in.size());
          sample_normals(warp, in.size(), in.wo(), {alpha_x, alpha_y}, in.u(), wm.out());
          for (std::size_t i = 0; i < in.size(); ++i)
            ASSERT_TRUE(is_unit(wm.at(i)) && wm.z[i] >= 0)
                << kWarpNames[int(warp)] << " alpha " << alpha_x << " " << alpha_y << ": " << at(in, i);
        }
  });
}

}  // namespace
}  // namespace vndf::edges
