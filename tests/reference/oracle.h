// What the papers' plain formulas give, evaluated with enough digits that their cancellation does not matter. Written
// from the papers in their order, and on purpose not in the forms that the library derives.
#pragma once

#include <vector>

#include "reference/hard_cases.h"

namespace vndf::reference {

struct OracleNormal {
  double x, y, z;
  double uncertainty;  ///< a bound of the oracle's own error, Euclidean
};

/// The visible normal for the same float inputs: Heitz 2018, Listing 1, with the disk point of eq. 9-10 or of Walter et
/// al. 2015, eq. 34-37; or Dupuy and Benyoub 2023, Listing 3, where the azimuth of c is 2 pi u1 from the one opposite
/// to the view's.
///
/// The view may have any length but 0. Where (alpha_x wo.x, alpha_y wo.y) is exactly 0, the azimuth is +x, the limit of
/// a view that leans that way: T1 = (0, 1, 0), T2 = Vh x T1. (Listing 1 takes T1 = (1, 0, 0) there: the same
/// distribution, turned.)
///
/// Evaluated in long double; where the formulas cancel too many of its digits, in __float128 where there is one.
OracleNormal oracle_normal(Warp warp, const float wo[3], const float alpha[2], const float u[2]);

/// How far the exact normal moves, Euclidean, when inputs move by half a unit of their last place, summed over the
/// inputs. A computation in float cannot be expected to do much better than `view`: the products alpha wo, with which
/// eq. 5 begins, are rounded already.
struct Conditioning {
  double view;  ///< wo and alpha
  double u;
};

Conditioning conditioning(Warp warp, const float wo[3], const float alpha[2], const float u[2]);

struct OracleNormals {
  std::vector<double> x, y, z;
  double uncertainty = 0;  ///< the largest
};

OracleNormals oracle_normals(Warp warp, const Inputs& in);

struct OracleDisk {
  double t1, t2;
  double r;  ///< distance from the centre
  double e;  ///< 1 - r^2
};

OracleDisk oracle_disk(DiskMap map, const float u[2]);

/// The one or the other arithmetic, to compare them.
OracleNormal oracle_normal_long_double(Warp warp, const float wo[3], const float alpha[2], const float u[2]);
OracleNormal oracle_normal_quad(Warp warp, const float wo[3], const float alpha[2], const float u[2]);

}  // namespace vndf::reference
