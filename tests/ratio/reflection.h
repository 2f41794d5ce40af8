// sample_reflection as a subject of measure.h: plain GGX, bounded or not, and ellipsoids. Of each sample the direction,
// the density, the weight with either masking, the normal and its cosine.
#pragma once

#include "ratio/measure.h"
#include "ratio/surfaces.h"

namespace vndf::ratio {

template <class Surface, Warp warp, bool bounded>
struct Reflection {
  static constexpr std::size_t kSurface = Surface::kInputs, kU = 3 + kSurface, kInputs = kU + 2, kDirections = 1,
                               kResults = 6;
  using Founds = std::array<Found, kResults>;
  static constexpr bool kDisk = !bounded && warp != Warp::spherical_cap;
  static constexpr double kNormal = Surface::kByLunes ? 16 : kDisk ? 6 : 8;
  static constexpr std::array<Bound, kResults> bounds = {{{"wi", 16, 16},
                                                          {"pdf", 16, 16},
                                                          {"weight", 16, 16},
                                                          {"separable weight", 16, 16},
                                                          {"wm", kNormal, kNormal},
                                                          {"cos", Surface::kByLunes ? 20 : 16, 16}}};

  static constexpr Views kViews = Surface::kByLunes ? Views::unit : Views::unit_above;
  static Table inputs(const HardCase& row, std::size_t count) {
    return sampling_inputs<Surface>(row, warp, kViews, count);
  }
  static auto moves() { return moves_of<kInputs>(kU); }
  static bool in_domain(const std::array<float, kInputs>& in) {
    return is_nearly_unit(in.data()) && has_azimuth(in.data()) && (Surface::kByLunes || in[2] >= 0) &&
           is_surface<Surface>(&in[3]) && in_unit_interval(in, kU) &&
           !(Surface::kByLunes && warp == Warp::spherical_cap && in[kU + 1] == 1);
  }

  static std::vector<Founds> run(const Table& in) {
    std::string name =
        std::string("reflection") + Surface::kName + "_" + kWarpNames[int(warp)] + (bounded ? "_bounded" : "");
    Results of(name, in), separable(Surface::kByLunes ? name : name + "_separable", in);
    std::vector<Founds> found;
    for (std::size_t i = 0; i < of.size(); ++i) {
      auto wi = of.vector("wi", i);
      bool above = in[2][i] >= 0, reflects = wi[2] > 0;
      // Where the sign of wi.z decides, the density jumps.
      float pdf = above && reflects && of("pdf", i) == 0 ? NAN : of("pdf", i);
      found.push_back({Found{wi, above}, Found{{pdf}, above && reflects}, Found{{of("weight", i)}, above && reflects},
                       Found{{separable("weight", i)}, above && reflects && !Surface::kByLunes},
                       Found{of.vector("wm", i)}, Found{{of("wo_dot_wm", i)}}});
    }
    return found;
  }

  static std::array<Exact, kResults> exact(const std::array<Quad, kInputs>& in, const Founds& found) {
    exact::Sample s =
        exact::sample_reflection(warp, bounded, {in[0], in[1], in[2]}, Surface::exact(&in[3]), in[kU], in[kU + 1]);
    bool defined = s.normal.defined, above = defined && s.wi.z > 0;
    return {reference::exact_vector(at_most_one(found[0].value, s.wi), defined),
            reference::exact_number(s.pdf, defined),
            exact_with(s.slack.correlated, s.weight.correlated, above),
            exact_with(s.slack.separable, s.weight.separable, above),
            reference::exact_vector(s.normal.wm, defined),
            reference::exact_cosine(at_most_one(found[5].value[0], s.normal.cos), defined)};
  }
};

}  // namespace vndf::ratio
