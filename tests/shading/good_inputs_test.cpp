// Good inputs give finite results.
#include <cmath>

#include <gtest/gtest.h>

#include "shading/inputs.h"

namespace vndf::shading {
namespace {

// Good inputs give finite results: unit views, alpha from 1e-6 to 100, u in [0, 1] with both ends.
TEST(GoodInputs, GiveFiniteResults) {
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
                for (float density : {s.pdf[0], e.pdf[0], pdf})
                  ASSERT_TRUE(density >= 0 && density <= 0x1p60f) << density;
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
                    ASSERT_TRUE(std::isfinite(x))
                        << v[0] << " " << v[1] << " " << v[2] << " alpha " << ax << " " << ay << " u " << u1 << " "
                        << u2 << " " << u3 << " eta " << eta << " " << int(warp);
                  for (float density : {s.pdf[0], e.pdf[0]}) ASSERT_TRUE(density >= 0 && density <= 0x1p60f) << density;
                  ASSERT_GE(s.weight[0], 0);
                  ASSERT_LE(s.weight[0], 1);
                }
            }
}

}  // namespace
}  // namespace vndf::shading
