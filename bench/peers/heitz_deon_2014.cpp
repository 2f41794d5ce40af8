// Heitz and d'Eon 2014, supplemental material: visible slopes at unit roughness, slope_x by inversion and slope_y by a
// fitted curve. For views above the horizon only. The view's angles are had in two ways, which differ in speed.
#include "table.h"
#include "vector.h"

namespace peers {
namespace {

/// The fit's stand-in for exact_inverse, below.
template <class T>
T fitted_inverse(T u) {
  return u * (u * (u * T(0.27385L) - T(0.73369L)) + T(0.46341L)) /
         (u * (u * (u * T(0.093073L) + T(0.309420L)) - T(1)) + T(0.597999L));
}

template <class T>
struct Slopes {
  T x, y;
};

/// Slopes visible from a view at an angle with this tangent and at azimuth 0, at unit roughness.
template <class T>
Slopes<T> sample_slopes(bool normal_incidence, T tan_theta, T u1, T u2) {
  if (normal_incidence) {
    T r = std::sqrt(u1 / (T(1) - u1));
    T phi = T(2) * kPi<T> * u2;
    return {r * std::cos(phi), r * std::sin(phi)};
  }
  T g1 = T(2) / (T(1) + std::sqrt(T(1) + tan_theta * tan_theta));

  // slope_x: a root of the quadratic equation that the marginal's distribution function leads to.
  T a = T(2) * u1 / g1 - T(1);
  T inverse = T(1) / (a * a - T(1));
  T b = tan_theta;
  T root = std::sqrt(std::fmax(b * b * inverse * inverse - (a * a - b * b) * inverse, T(0)));
  T first = b * inverse - root;
  T second = b * inverse + root;
  T x = a < T(0) || second > T(1) / b ? first : second;

  // slope_y / sqrt(1 + slope_x^2) has the same symmetric distribution for every slope_x.
  bool above = u2 > T(0.5);
  T z = fitted_inverse(above ? T(2) * (u2 - T(0.5)) : T(2) * (T(0.5) - u2));
  return {x, (above ? z : -z) * std::sqrt(T(1) + x * x)};
}

/// The azimuth of the view, and the tangent of its polar angle.
template <class T>
struct ViewAngles {
  T tan_theta, cos_phi, sin_phi;
};

/// By way of the angles themselves, as the supplemental material has it.
template <class T>
ViewAngles<T> by_angles(Vec3<T> v) {
  T phi = std::atan2(v.y, v.x);
  return {std::tan(std::acos(v.z)), std::cos(phi), std::sin(phi)};
}

/// By square roots, as renderers have it that adopted the routine.
template <class T>
ViewAngles<T> by_roots(Vec3<T> v) {
  T sin_theta = std::sqrt(std::fmax(T(0), T(1) - v.z * v.z));
  T radius = std::sqrt(v.x * v.x + v.y * v.y);
  return {sin_theta / v.z, v.x / radius, v.y / radius};
}

template <class T, ViewAngles<T> angles_of(Vec3<T>)>
Vec3<T> slope_space(Vec3<T> wo, T alpha_x, T alpha_y, T u1, T u2) {
  Vec3<T> v = normalize(Vec3<T>{alpha_x * wo.x, alpha_y * wo.y, wo.z});
  bool normal_incidence = float_stretched_z(wo, alpha_x, alpha_y) >= 0.99999f;
  ViewAngles<T> view = normal_incidence ? ViewAngles<T>{T(0), T(1), T(0)} : angles_of(v);
  Slopes<T> slope = sample_slopes(normal_incidence, view.tan_theta, u1, u2);
  T x = alpha_x * (view.cos_phi * slope.x - view.sin_phi * slope.y);
  T y = alpha_y * (view.sin_phi * slope.x + view.cos_phi * slope.y);
  return normalize(Vec3<T>{-x, -y, T(1)});
}

/// The z below which |slope_y| lies with probability u, at slope_x = 0, where its density is (4 / pi) / (1 + z^2)^2.
///
/// In theta = atan z the distribution function is (2 theta + sin 2 theta) / pi; Newton's method inverts it, with a step
/// of bisection where that leaves the bracket.
double exact_inverse(double u) {
  double low = 0, high = kPi<double> / 2;
  double theta = u * high / 2;
  for (int step = 0; step < 100; ++step) {
    double excess = (2 * theta + std::sin(2 * theta)) / kPi<double> - u;
    (excess > 0 ? high : low) = theta;
    double cosine = std::cos(theta);
    double next = theta - excess * kPi<double> / (4 * cosine * cosine);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::fabs(next - theta) <= 1e-15 * theta) break;
    theta = next;
  }
  return std::tan(theta);
}

}  // namespace

void heitz_deon_2014(std::size_t count, const float* const in[7], float* const out[3]) {
  sample_columns<float, slope_space<float, by_angles<float>>>(count, in, out);
}

void heitz_deon_2014_roots(std::size_t count, const float* const in[7], float* const out[3]) {
  sample_columns<float, slope_space<float, by_roots<float>>>(count, in, out);
}

void heitz_deon_2014_exact(std::size_t count, const float* const in[7], long double* const out[3]) {
  sample_columns<long double, slope_space<long double, by_roots<long double>>>(count, in, out);
}

FitError heitz_deon_2014_fit_error() {
  constexpr int kSteps = 1 << 20;
  FitError error{};
  for (int i = 0; i < kSteps; ++i) {
    double u = (i + 0.5) / kSteps;
    double exact = exact_inverse(u);
    double fitted = fitted_inverse(u);
    double slope = std::fabs(fitted / exact - 1);
    // Two unit normals in one plane: the chord of the angle between them.
    double normal = 2 * std::fabs(std::sin(0.5 * (std::atan(fitted) - std::atan(exact))));
    error.max_slope = std::fmax(error.max_slope, slope);
    error.max_normal = std::fmax(error.max_normal, normal);
    error.mean_slope += slope / kSteps;
    error.mean_normal += normal / kSteps;
  }
  return error;
}

}  // namespace peers
