// Good inputs give finite results, for shapes.
#include <gtest/gtest.h>

#include "ellipsoid/model.h"
#include "support/bits.h"

namespace vndf::ellipsoid {
namespace {

// Good inputs give finite results: unit views, alpha from 1e-6 to 100, any angles, u in [0, 1] with
// both ends.
TEST(GoodInputs, GiveFiniteResults) {
  const float views[][3] = {{0, 0, 1},        {0, 0, -1},     {1, 0, 0},           {0, -1, 0},     {0.6f, 0, 0.8f},
                            {0.6f, 0, -0.8f}, {1, 0, 1e-30f}, {1, 1e-20f, 1e-10f}, {1e-20f, 0, 1}, {1e-40f, 0, 1},
                            {0.8f, 0.6f, 0},  {1, 0, -0.f},   {1e-6f, 1e-6f, 1},   {1e-6f, 0, -1}, {1, 0, -1e-30f}};
  const float alphas[][2] = {{1e-6f, 1e-6f}, {1e-6f, 1.f}, {100.f, 1e-6f}, {0.01f, 0.5f},
                             {0.5f, 0.5f},   {1.f, 1.f},   {3.f, 1e-4f},   {100.f, 100.f}};
  const float right = 1.5707964f;
  const float thetas[][3] = {{0, 0, 0},      {0, 0, 0.7f},     {0.5f, -0.5f, 1.f},
                             {1e-20f, 0, 0}, {right, 0, 0},    {0, right, 0.2f},
                             {3.1f, 0, 1.f}, {2.f, -2.f, 3.f}, {1e-3f, 1e-3f, -3.14159274f}};
  const float us[] = {0.f, 0x1p-24f, 0.25f, 0.3f, 0.5f, 0.75f, 1 - 0x1p-24f, 1.f};
  const float etas[] = {0.4f, 1 / 1.5f, 0.99999f, 1.00001f, 1.5f, 2.5f};
  testing::Table u(4);  // three random numbers, eta
  for (float u1 : us)
    for (float u2 : us)
      for (float u3 : {0.f, 0.5f, 1.f})
        for (float eta : etas) {
          u[0].push_back(u1);
          u[1].push_back(u2);
          u[2].push_back(u3);
          u[3].push_back(eta);
        }
  std::size_t n = u[0].size();
  Samples s(n), d(n);
  Directions wm(n);
  Values e(n), across(n);
  std::vector<float> pdf(n);
  for (const auto& v : views) {
    for (const auto& a : alphas)
      for (const auto& t : thetas)
        for (Warp warp : kWarps) {
          Columns3 wo{v[0], v[1], v[2]};
          Ellipsoid shape({a[0], a[1]}, t[0], t[1], t[2]);
          sample_normals(warp, n, wo, shape, {u[0].data(), u[1].data()}, wm.out());
          sample_reflection(warp, n, wo, shape, {u[0].data(), u[1].data()}, s.with_normals());
          evaluate_reflection(n, wo, s.wi.in(), shape, e.out());
          pdf_normals(n, wo, wm.in(), shape, pdf.data());
          sample_dielectric(warp, n, wo, shape, u[3].data(), {u[0].data(), u[1].data(), u[2].data()}, d.dielectric());
          evaluate_dielectric(n, wo, d.wi.in(), shape, u[3].data(), across.out());
          for (std::size_t i = 0; i < n; ++i) {
            const float values[] = {wm.x[i],  wm.y[i],     wm.z[i],   s.wi.x[i],       s.wi.y[i],    s.wi.z[i],
                                    s.pdf[i], s.weight[i], s.wm.x[i], s.wm.y[i],       s.wm.z[i],    s.cos[i],
                                    e.pdf[i], e.f_cos[i],  pdf[i],    d.wi.x[i],       d.wi.y[i],    d.wi.z[i],
                                    d.pdf[i], d.weight[i], d.side[i], across.f_cos[i], across.pdf[i]};
            for (std::size_t c = 0; c < std::size(values); ++c)
              ASSERT_TRUE(std::isfinite(values[c]))
                  << "value " << c << " of view " << v[0] << " " << v[1] << " " << v[2] << " alpha " << a[0] << " "
                  << a[1] << " theta " << t[0] << " " << t[1] << " " << t[2] << " u " << u[0][i] << " " << u[1][i]
                  << " " << u[2][i] << " eta " << u[3][i] << " " << int(warp);
            ASSERT_TRUE(s.weight[i] >= 0 && s.weight[i] <= 1 && d.weight[i] >= 0 && d.weight[i] <= 1);
            for (float density : {s.pdf[i], d.pdf[i], e.pdf[i], across.pdf[i], pdf[i]})
              ASSERT_TRUE(density >= 0 && density <= 0x1p60f) << density;
          }
        }
  }
}

}  // namespace
}  // namespace vndf::ellipsoid
