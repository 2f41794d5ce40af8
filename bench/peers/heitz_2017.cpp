// Heitz 2017, A Simpler and Exact Sampling Routine for the GGX Distribution of Visible Normals: the two half disks of
// the projected hemisphere sampled apart. For views above the horizon only.
#include "table.h"
#include "vector.h"

namespace peers {
namespace {

template <class T>
Vec3<T> two_half_disks(Vec3<T> wo, T alpha_x, T alpha_y, T u1, T u2) {
  Vec3<T> v = normalize(Vec3<T>{alpha_x * wo.x, alpha_y * wo.y, wo.z});
  bool near_normal = float_stretched_z(wo, alpha_x, alpha_y) >= 0.9999f;
  Vec3<T> t1 = near_normal ? Vec3<T>{T(1), T(0), T(0)} : normalize(cross(v, Vec3<T>{T(0), T(0), T(1)}));
  Vec3<T> t2 = cross(t1, v);
  // The half disk facing the view has area 1, the one in the tangent plane v.z.
  T a = T(1) / (T(1) + v.z);
  T r = std::sqrt(u1);
  T phi = u2 < a ? u2 / a * kPi<T> : kPi<T> + (u2 - a) / (T(1) - a) * kPi<T>;
  T p1 = r * std::cos(phi);
  T p2 = r * std::sin(phi) * (u2 < a ? T(1) : v.z);
  Vec3<T> n = p1 * t1 + p2 * t2 + std::sqrt(std::fmax(T(0), T(1) - p1 * p1 - p2 * p2)) * v;
  return normalize(Vec3<T>{alpha_x * n.x, alpha_y * n.y, std::fmax(T(0), n.z)});
}

}  // namespace

void heitz_2017(std::size_t count, const float* const in[7], float* const out[3]) {
  sample_columns<float, two_half_disks<float>>(count, in, out);
}

void heitz_2017_exact(std::size_t count, const float* const in[7], long double* const out[3]) {
  sample_columns<long double, two_half_disks<long double>>(count, in, out);
}

}  // namespace peers
