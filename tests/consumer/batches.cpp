// The batch functions through an installed header and library.
#include <cmath>
#include <cstdio>
#include <vector>

#include <vndf/vndf.h>

int main() {
  std::vector<float> u1, u2;
  for (int i = 0; i < 100; ++i) {
    u1.push_back((float(i) + 0.5f) / 100);
    u2.push_back(float(i * 37 % 100) / 100);
  }
  std::vector<float> x(u1.size()), y(u1.size()), z(u1.size());
  vndf::sample_normals(vndf::Warp::polar, u1.size(), {0.6f, 0.f, 0.8f}, {0.3f, 0.3f}, {u1.data(), u2.data()},
                       {x.data(), y.data(), z.data()});
  for (std::size_t i = 0; i < u1.size(); ++i)
    if (!(std::fabs(x[i] * x[i] + y[i] * y[i] + z[i] * z[i] - 1) < 1e-6f && z[i] >= 0)) return 1;
  std::printf("%s\n", vndf::active_isa());
  return 0;
}
