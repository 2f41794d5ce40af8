// Dupuy and Benyoub 2023, Listing 3: spherical caps as published, in plain float.
#include "table.h"
#include "vector.h"

namespace peers {
namespace {

template <class T>
Vec3<T> cap(Vec3<T> wo, T alpha_x, T alpha_y, T u1, T u2) {
  Vec3<T> vh = normalize(Vec3<T>{alpha_x * wo.x, alpha_y * wo.y, wo.z});
  // A uniform point of the cap c.z >= -vh.z, and its half vector with the view.
  T phi = T(2) * kPi<T> * u1;
  T z = (T(1) - u2) * (T(1) + vh.z) - vh.z;
  T sin_theta = std::sqrt(std::fmin(std::fmax(T(1) - z * z, T(0)), T(1)));
  Vec3<T> nh = Vec3<T>{sin_theta * std::cos(phi), sin_theta * std::sin(phi), z} + vh;
  return normalize(Vec3<T>{alpha_x * nh.x, alpha_y * nh.y, nh.z});
}

}  // namespace

void spherical_cap(std::size_t count, const float* const in[7], float* const out[3]) {
  sample_columns<float, cap<float>>(count, in, out);
}

void spherical_cap_exact(std::size_t count, const float* const in[7], long double* const out[3]) {
  sample_columns<long double, cap<long double>>(count, in, out);
}

}  // namespace peers
