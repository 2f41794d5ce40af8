// The inputs on which sampling the GGX visible normals loses its digits, one row per case.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <vndf/vndf.h>

#include "reference/random.h"

namespace vndf::reference {

/// Input columns.
struct Inputs {
  std::vector<float> wo_x, wo_y, wo_z, alpha_x, alpha_y, u_x, u_y;

  explicit Inputs(std::size_t count)
      : wo_x(count), wo_y(count), wo_z(count), alpha_x(count), alpha_y(count), u_x(count), u_y(count) {}
  std::size_t size() const { return wo_x.size(); }
  Columns3 wo() const { return {wo_x.data(), wo_y.data(), wo_z.data()}; }
  Columns2 alpha() const { return {alpha_x.data(), alpha_y.data()}; }
  Columns2 u() const { return {u_x.data(), u_y.data()}; }
};

/// A case is a distribution of views, one of roughness and one of random numbers.
struct HardCase {
  const char* name;
  const char* description;
  std::array<double, 3> (*wo)(Random&);
  std::array<double, 2> (*alpha)(Random&);
  std::array<float, 2> (*u)(Random&, Warp);

  /// The side conditions under which bounds are promised.
  bool alpha_above_1 = false;
  bool small_alpha = false;        ///< below 0.01: the error of the slope counts as well
  bool no_visible_normal = false;  ///< any unit normal of the upper hemisphere is right, there is no oracle
};

const std::vector<HardCase>& hard_cases();

/// The inputs that renderers make: random numbers of every spacing, views of real geometry, alpha as sliders give it.
/// Each row has one of the three from its name and any of these kinds for the others. What a forward error can say of
/// these inputs is little; their bounds are ratios, see ratio.h.
const std::vector<HardCase>& renderer_cases();

/// An index of refraction below the surface over the one above it.
struct Refraction {
  const char* name;
  const char* description;
  double (*eta)(Random&);
};
const std::vector<Refraction>& refractions();

/// The same columns for the same arguments, and a prefix of them for a smaller count.
Inputs generate(const HardCase& hard_case, Warp warp, std::size_t count, std::uint64_t seed);

}  // namespace vndf::reference
