// Walter et al. 2007, eq. 35-36, stretched to two roughnesses: normals of the whole distribution, visible or not.
#include "table.h"
#include "vector.h"

namespace peers {
namespace {

template <class T>
Vec3<T> ndf(Vec3<T>, T alpha_x, T alpha_y, T u1, T u2) {
  // tan^2 theta = alpha^2 u1 / (1 - u1)
  T slope = std::sqrt(u1 / (T(1) - u1));
  T phi = T(2) * kPi<T> * u2;
  return normalize(Vec3<T>{alpha_x * slope * std::cos(phi), alpha_y * slope * std::sin(phi), T(1)});
}

}  // namespace

void ndf_walter_2007(std::size_t count, const float* const in[7], float* const out[3]) {
  sample_columns<float, ndf<float>>(count, in, out);
}

void ndf_walter_2007_exact(std::size_t count, const float* const in[7], long double* const out[3]) {
  sample_columns<long double, ndf<long double>>(count, in, out);
}

}  // namespace peers
