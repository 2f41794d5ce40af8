// The warps from the unit square to visible normals. A warp takes a pair of random numbers to a point of the disk of
// Heitz 2018, to a point of a spherical cap, or to both. kOnDisk says which of the two its visible normals are made
// from; kBounded, that the cap is the smaller one of Bounded.
#pragma once

#include <vndf/lanes/disk.h>
#include <vndf/lanes/spherical_cap.h>

namespace vndf::lanes {
inline namespace VNDF_LANES_BUILD {

/// Heitz 2018, eq. 9-10. On a cap, its point of the disk by Lambert's equal-area map.
struct Polar {
  static constexpr bool kOnDisk = true, kBounded = false;
  template <class F>
  static VNDF_INLINE DiskPoint<F> disk_point(Vec2<F> u) {
    return polar_map(u);
  }
  template <class F>
  static VNDF_INLINE CapPoint<F> cap_point(Vec2<F> u) {
    return polar_cap_map(u);
  }
};

/// Shirley and Chiu 1997; Walter et al. 2015, eq. 34-37. On a cap, by Lambert's map too.
struct Concentric {
  static constexpr bool kOnDisk = true, kBounded = false;
  template <class F>
  static VNDF_INLINE DiskPoint<F> disk_point(Vec2<F> u) {
    return concentric_map(u);
  }
  template <class F>
  static VNDF_INLINE CapPoint<F> cap_point(Vec2<F> u) {
    return concentric_cap_map(wedge_of(u));
  }
};

/// Dupuy and Benyoub 2023, Listing 3.
struct SphericalCap {
  static constexpr bool kOnDisk = false, kBounded = false;
  template <class F>
  static VNDF_INLINE CapPoint<F> cap_point(Vec2<F> u) {
    return cap_map(u);
  }
};

/// A warp onto the smaller cap of Eto and Tokuyoshi 2023, for reflection at plain GGX.
template <class Warp>
struct Bounded : Warp {
  static constexpr bool kOnDisk = false, kBounded = true;
};

}  // namespace VNDF_LANES_BUILD
}  // namespace vndf::lanes
