// sample_dielectric as a subject of measure.h, for plain GGX and for ellipsoids, from either side: the direction, the
// density and the weight of the side that the sample took. A view that is not a unit vector has two angles, by its
// cosine and by its sine: what depends on Snell's law is compared for views that are.
#pragma once

#include "ratio/measure.h"
#include "ratio/surfaces.h"

namespace vndf::ratio {

using reference::Refraction;

/// Any of the three kinds of eta.
inline double any_eta(reference::Random& random) {
  return reference::refractions()[random.below(3)].eta(random);
}

inline const Refraction kAnyEta{"any eta", "", any_eta};

/// Adds eta and the number that chooses the side: 0 for reflection, however little there is, or any.
template <class Surface>
Table dielectric_inputs(const HardCase& row, const Refraction& refraction, Warp warp, std::size_t count) {
  Table in = sampling_inputs<Surface>(row, warp, Views::unit, count);
  std::vector<float> eta(count), choice(count);
  for (std::size_t i = 0; i < count; ++i) {
    reference::Random random(seed() + 2, i);
    eta[i] = float(refraction.eta(random));
    choice[i] = random.below(4) ? random.unit() : float(random.below(2));
  }
  in.insert(in.end() - 2, eta);
  in.push_back(choice);
  return in;
}

template <class Surface, Warp warp>
struct Dielectric {
  static constexpr std::size_t kEta = 3 + Surface::kInputs, kU = kEta + 1, kInputs = kU + 3, kDirections = 1,
                               kResults = 5;
  using Founds = std::array<Found, kResults>;
  static constexpr std::array<Bound, kResults> bounds = {
      {{"wi", 16, 16}, {"pdf", 16, 16}, {"weight", 16, 16}, {"separable weight", 16, 16}, {"side", 0, 0}}};

  static constexpr Views kViews = Views::unit;
  static Table inputs(const HardCase& row, std::size_t count, const Refraction& refraction = kAnyEta) {
    return dielectric_inputs<Surface>(row, refraction, warp, count);
  }
  static auto moves() { return moves_of<kInputs>(kU); }
  static bool in_domain(const std::array<float, kInputs>& in) {
    return is_nearly_unit(in.data()) && has_azimuth(in.data()) && is_surface<Surface>(&in[3]) && is_index(in[kEta]) &&
           in_unit_interval(in, kU) && !(warp == Warp::spherical_cap && in[kU + 1] == 1);
  }

  static std::vector<Founds> run(const Table& in) {
    std::string name = std::string("dielectric") + Surface::kName + "_" + kWarpNames[int(warp)];
    Results of(name, in), separable(Surface::kByLunes ? name : name + "_separable", in);
    std::vector<Founds> found;
    for (std::size_t i = 0; i < of.size(); ++i) {
      auto wi = of.vector("wi", i);
      // Where the sign of wi.z decides, the density jumps.
      bool leaves = height(in[2][i], of("side", i), wi[2]) > 0;
      float pdf = leaves && of("pdf", i) == 0 ? NAN : of("pdf", i);
      found.push_back({Found{wi}, Found{{pdf}, leaves}, Found{{of("weight", i)}, leaves},
                       Found{{separable("weight", i)}, leaves && !Surface::kByLunes}, Found{{of("side", i)}, false}});
    }
    return found;
  }

  /// Of a direction over the side that it should be at.
  template <class T>
  static T height(T wo_z, float side, T wi_z) {
    return (wo_z < 0 ? -wi_z : wi_z) * T(side);
  }
  static std::array<Exact, kResults> exact(const std::array<Quad, kInputs>& in, const Founds& found) {
    const float wo[3] = {float(in[0]), float(in[1]), float(in[2])};
    float side = found[4].value[0];
    exact::Sample s = exact::sample_dielectric(warp, side > 0, {in[0], in[1], in[2]}, Surface::exact(&in[3]), in[kEta],
                                               in[kU], in[kU + 1]);
    // Where reflection is total by less than rounding, the library may still refract, along the facet.
    Quad eta = in[2] < 0 ? 1 / in[kEta] : in[kEta], total_by = (1 - s.normal.cos * s.normal.cos) - eta * eta;
    bool passes = side > 0 || s.pdf > 0 || total_by > eta * Quad(0x1p-16);
    bool defined = s.normal.defined && passes && (is_unit(wo) || side > 0);
    bool leaves = defined && height(in[2], side, s.wi.z) > 0;
    return {reference::exact_vector(at_most_one(found[0].value, s.wi), defined),
            exact_with(s.pdf_slack, s.pdf, defined && is_unit(wo)),
            exact_with(s.slack.correlated, s.weight.correlated, leaves),
            exact_with(s.slack.separable, s.weight.separable, leaves), reference::exact_number(side)};
  }
};

}  // namespace vndf::ratio
