// sample_normals as a subject of measure.h: views of any direction and length, any u in [0, 1], alpha from 1e-6 to 100.
#pragma once

#include "ratio/measure.h"
#include "ratio/surfaces.h"

namespace vndf::ratio {

template <Warp warp>
struct Normals {
  static constexpr std::size_t kInputs = 7, kDirections = 1, kResults = 1;
  using Founds = std::array<Found, kResults>;
  static constexpr Bound kDisk = {"wm", 6, 4}, kCap = {"wm", 8, 8};
  static constexpr std::array<Bound, kResults> bounds = {warp == Warp::spherical_cap ? kCap : kDisk};

  static constexpr Views kViews = Views::any;
  static Table inputs(const HardCase& row, std::size_t count) {
    return sampling_inputs<Plain>(row, warp, kViews, count);
  }
  static auto moves() { return moves_of<kInputs>(5); }
  static bool in_domain(const std::array<float, kInputs>& in) {
    double length = std::hypot(in[0], in[1], in[2]);
    return length >= 1e-30 && length <= 1e30 && has_azimuth(in.data()) && is_surface<Plain>(&in[3]) &&
           in_unit_interval(in, 5);
  }
  static std::vector<Founds> run(const Table& in) {
    Results of(std::string("normals_") + kWarpNames[int(warp)], in);
    std::vector<Founds> found;
    for (std::size_t i = 0; i < of.size(); ++i) found.push_back({Found{of.vector("wm", i)}});
    return found;
  }
  static std::array<Exact, kResults> exact(const std::array<Quad, kInputs>& in, const Founds&) {
    exact::Surface surface = exact::plain(in[3], in[4]);
    exact::Normal normal = exact::sample_normal(warp, {in[0], in[1], in[2]}, surface, in[5], in[6]);
    return {reference::exact_vector(normal.wm, normal.defined)};
  }
};

}  // namespace vndf::ratio
