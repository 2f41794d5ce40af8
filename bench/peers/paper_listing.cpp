// Heitz 2018, Listing 1: the routine as printed, in plain float.
#include "table.h"
#include "vector.h"

namespace peers {
namespace {

template <class T>
Vec3<T> listing(Vec3<T> wo, T alpha_x, T alpha_y, T u1, T u2) {
  // Section 3.2
  Vec3<T> vh = normalize(Vec3<T>{alpha_x * wo.x, alpha_y * wo.y, wo.z});
  // Section 4.1
  T lensq = vh.x * vh.x + vh.y * vh.y;
  Vec3<T> t1_axis = lensq > 0 ? (T(1) / std::sqrt(lensq)) * Vec3<T>{-vh.y, vh.x, T(0)} : Vec3<T>{T(1), T(0), T(0)};
  Vec3<T> t2_axis = cross(vh, t1_axis);
  // Section 4.2
  T r = std::sqrt(u1);
  T phi = T(2) * kPi<T> * u2;
  T t1 = r * std::cos(phi);
  T t2 = r * std::sin(phi);
  T s = T(0.5) * (T(1) + vh.z);
  t2 = (T(1) - s) * std::sqrt(T(1) - t1 * t1) + s * t2;
  // Section 4.3
  Vec3<T> nh = t1 * t1_axis + t2 * t2_axis + std::sqrt(std::fmax(T(0), T(1) - t1 * t1 - t2 * t2)) * vh;
  // Section 3.4
  return normalize(Vec3<T>{alpha_x * nh.x, alpha_y * nh.y, std::fmax(T(0), nh.z)});
}

}  // namespace

void paper_listing(std::size_t count, const float* const in[7], float* const out[3]) {
  sample_columns<float, listing<float>>(count, in, out);
}

void paper_listing_exact(std::size_t count, const float* const in[7], long double* const out[3]) {
  sample_columns<long double, listing<long double>>(count, in, out);
}

}  // namespace peers
