// Versions 1 and 2 of Walter et al. 2015, section 4: visible normals by rejection, which version 3 does without.
#pragma once

#include <algorithm>
#include <cmath>

#include "ellipsoid/model.h"
#include "reference/random.h"

namespace vndf::ellipsoid {

inline void basis(const Vec3<double>& z, Vec3<double>& x, Vec3<double>& y) {
  x = unit(cross(z, std::fabs(z.x) < 0.5 ? Vec3<double>{1, 0, 0} : Vec3<double>{0, 1, 0}));
  y = cross(z, x);
}

/// Rays along the view out of a bounding sphere's silhouette. A call is one try: false if it is rejected.
class Version1 {
 public:
  Version1(const Parameters& p, const Vec3<double>& psi) : a_(matrix<double>(p)), v_(unit(psi)), av_(a_ * v_) {
    basis(v_, x_, y_);
    // The half axes are 1 / alpha_x, 1 / alpha_y and 1.
    radius_ = std::max({1., 1. / p.alpha_x, 1. / p.alpha_y});
  }

  /// m has any length.
  bool operator()(reference::Random& random, Vec3<double>& m) const {
    double r = radius_ * std::sqrt(random.uniform(0, 1)), phi = random.uniform(0, 2 * kPi<double>);
    Vec3<double> o = (r * std::cos(phi)) * x_ + (r * std::sin(phi)) * y_;
    Vec3<double> ao = a_ * o;  // |A (o + s v)|^2 = 1, the hit nearest to the viewer
    double q = dot(av_, av_), p = dot(ao, av_) / q, c = (dot(ao, ao) - 1) / q;
    if (p * p < c) return false;
    Vec3<double> hit = o + (-p + std::sqrt(p * p - c)) * v_;
    m = transposed_times(a_, a_ * hit);
    return m.z >= 0 && dot(m, v_) >= 0;
  }

 private:
  M3<double> a_;
  Vec3<double> v_, av_, x_, y_;
  double radius_;
};

/// Points of the ellipsoid's own silhouette, projected onto it.
class Version2 {
 public:
  Version2(const Parameters& p, const Vec3<double>& psi) : a_(matrix<double>(p)), z_(unit(a_ * psi)) {
    basis(z_, x_, y_);
  }

  bool operator()(reference::Random& random, Vec3<double>& m) const {
    double r2 = random.uniform(0, 1), phi = random.uniform(0, 2 * kPi<double>), r = std::sqrt(r2);
    m = transposed_times(a_, (r * std::cos(phi)) * x_ + (r * std::sin(phi)) * y_ + std::sqrt(1 - r2) * z_);
    return m.z >= 0;
  }

 private:
  M3<double> a_;
  Vec3<double> z_, x_, y_;
};

struct Tries {
  double tried = 0, kept = 0;
  double rejected() const { return 1 - kept / tried; }
};

/// Tries until `wanted` normals were kept, each of which goes to use(m); gives up after 100 tries for each.
template <class Version, class Use>
Tries sample_by_rejection(const Version& version, reference::Random& random, double wanted, Use use) {
  Tries tries;
  Vec3<double> m;
  while (tries.kept < wanted && tries.tried < 100 * wanted) {
    ++tries.tried;
    if (!version(random, m)) continue;
    ++tries.kept;
    use(m);
  }
  return tries;
}

}  // namespace vndf::ellipsoid
