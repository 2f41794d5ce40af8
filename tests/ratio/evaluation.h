// evaluate_reflection, evaluate_dielectric and pdf_normals as subjects of measure.h, for pairs that were sampled and
// for pairs that nobody sampled.
#pragma once

#include "ratio/dielectric.h"
#include "ratio/measure.h"
#include "ratio/surfaces.h"

namespace vndf::ratio {

template <std::size_t inputs>
Vec view(const std::array<Quad, inputs>& in) {
  return {in[0], in[1], in[2]};
}
template <std::size_t inputs>
Vec other(const std::array<Quad, inputs>& in) {
  return {in[3], in[4], in[5]};
}
template <class Surface>
std::vector<std::array<Found, 3>> evaluated(const std::string& function, const std::string& options, const Table& in) {
  std::string name = function + Surface::kName + options;
  Results of(name, in), separable(Surface::kByLunes ? name : name + "_separable", in);
  std::vector<std::array<Found, 3>> found;
  for (std::size_t i = 0; i < of.size(); ++i)
    found.push_back(
        {Found{{of("pdf", i)}}, Found{{of("f_cos", i)}}, Found{{separable("f_cos", i)}, !Surface::kByLunes}});
  return found;
}
inline std::array<Exact, 3> exact_of(const exact::Evaluation& value, bool compared = true) {
  return {reference::exact_number(value.pdf, compared), reference::exact_number(value.f_cos.correlated, compared),
          reference::exact_number(value.f_cos.separable, compared)};
}

/// Any direction, grazing ones and ones along axes among them.
inline std::array<float, 3> any_direction(Random& random) {
  double cos = random.below(3) ? random.uniform(-1, 1) : random.log_uniform(1e-6, 1) * (random.below(2) ? 1 : -1);
  double sin = std::sqrt(1 - cos * cos), phi = random.uniform(0, 6.2831853);
  if (random.below(8) == 0) phi = random.below(4) * 1.57079632679;
  return {float(sin * std::cos(phi)), float(sin * std::sin(phi)), float(cos)};
}

/// wo, another direction and the surface: sampled ones, `vector` of a row of this function, and every other one any.
/// eta, if there is any, goes to the sampling function and to the end.
template <class Surface>
Table pairs(const HardCase& row, Views views, const std::string& function, const std::string& vector, std::size_t count,
            const std::vector<float>& eta = {}) {
  Table in = sampling_inputs<Surface>(row, Warp::concentric, views, count);
  Table to_sample = in;
  if (!eta.empty()) {
    to_sample.insert(to_sample.end() - 2, eta);
    to_sample.push_back(in[in.size() - 2]);
  }
  Results sampled(function + Surface::kName + "_concentric", to_sample);
  Table others;
  for (const char* axis : {".x", ".y", ".z"}) others.push_back(sampled.column(vector + axis));
  for (std::size_t i = 0; i < sampled.size(); ++i) {
    Random random(seed() + 3, i);
    auto any = any_direction(random);
    for (std::size_t c = 0; c < 3 && i % 2; ++c) others[c][i] = any[c];
    if (eta.empty()) others[2][i] = std::fabs(others[2][i]);
  }
  in.resize(in.size() - 2);
  in.insert(in.begin() + 3, others.begin(), others.end());
  if (!eta.empty()) in.push_back(eta);
  return in;
}

/// Inputs are wo, wi, the surface.
template <class Surface, bool bounded>
struct EvaluatedReflection {
  static constexpr std::size_t kInputs = 6 + Surface::kInputs, kDirections = 2, kResults = 3;
  using Founds = std::array<Found, kResults>;
  static constexpr double kMax = Surface::kInputs == 5 ? 20 : 8;  // leaning: A^-T v and the lunes of grazing light
  static constexpr std::array<Bound, kResults> bounds = {
      {{"pdf", kMax, 8}, {"f_cos", kMax, 8}, {"separable f_cos", kMax, 8}}};

  static constexpr Views kViews = Views::unit_above;
  static Table inputs(const HardCase& row, std::size_t count) {
    return pairs<Surface>(row, kViews, "reflection", "wi", count);
  }
  static auto moves() { return moves_of<kInputs>(); }
  static bool in_domain(const std::array<float, kInputs>& in) {
    return is_nearly_unit(&in[0]) && is_nearly_unit(&in[3]) && in[2] >= 0 && in[5] > 0 && is_surface<Surface>(&in[6]);
  }
  static std::vector<Founds> run(const Table& in) {
    return evaluated<Surface>("evaluate_reflection", bounded ? "_bounded" : "", in);
  }
  static std::array<Exact, kResults> exact(const std::array<Quad, kInputs>& in, const Founds&) {
    return exact_of(exact::evaluate_reflection(bounded, view(in), other(in), Surface::exact(&in[6])));
  }
};

/// Inputs are wo, wm, the surface.
template <class Surface>
struct DensityOfNormals {
  static constexpr std::size_t kInputs = 6 + Surface::kInputs, kDirections = 2, kResults = 1;
  using Founds = std::array<Found, kResults>;
  static constexpr std::array<Bound, kResults> bounds = {{{"pdf", 8, 8}}};

  static constexpr Views kViews = Views::unit;
  static Table inputs(const HardCase& row, std::size_t count) {
    return pairs<Surface>(row, kViews, "normals", "wm", count);
  }
  static auto moves() { return moves_of<kInputs>(); }
  static bool in_domain(const std::array<float, kInputs>& in) {
    return is_nearly_unit(&in[0]) && is_nearly_unit(&in[3]) && in[5] >= 0 && is_surface<Surface>(&in[6]);
  }
  static std::vector<Founds> run(const Table& in) {
    Results of(std::string("pdf_normals") + Surface::kName, in);
    std::vector<Founds> found;
    for (float value : of.column("pdf")) found.push_back({Found{{value}}});
    return found;
  }
  static std::array<Exact, kResults> exact(const std::array<Quad, kInputs>& in, const Founds&) {
    Quad pdf = exact::pdf_normals(view(in), other(in), Surface::exact(&in[6]));
    return {reference::exact_number(pdf, pdf > 0)};
  }
};

/// Inputs are wo, wi, the surface, eta.
template <class Surface>
struct EvaluatedDielectric {
  static constexpr std::size_t kEta = 6 + Surface::kInputs, kInputs = kEta + 1, kDirections = 2, kResults = 3;
  using Founds = std::array<Found, kResults>;
  static constexpr auto bounds = EvaluatedReflection<Surface, false>::bounds;

  static constexpr Views kViews = Views::unit;
  static Table inputs(const HardCase& row, std::size_t count, const Refraction& refraction = kAnyEta) {
    std::vector<float> eta(count);
    for (std::size_t i = 0; i < count; ++i) {
      Random random(seed() + 2, i);
      eta[i] = float(refraction.eta(random));
    }
    return pairs<Surface>(row, kViews, "dielectric", "wi", count, eta);
  }
  static auto moves() { return moves_of<kInputs>(); }
  static bool in_domain(const std::array<float, kInputs>& in) {
    return is_unit(&in[0]) && is_unit(&in[3]) && in[5] != 0 && is_surface<Surface>(&in[6]) && is_index(in[kEta]);
  }
  static std::vector<Founds> run(const Table& in) { return evaluated<Surface>("evaluate_dielectric", "", in); }
  static exact::Evaluation value(const std::array<Quad, kInputs>& in) {
    return exact::evaluate_dielectric(view(in), other(in), Surface::exact(&in[6]), in[kEta]);
  }
  static std::array<Exact, kResults> exact(const std::array<Quad, kInputs>& in, const Founds& found) {
    exact::Evaluation of = value(in);
    bool differs = (found[0].value[0] > 0) != (of.pdf > 0);
    return exact_of(of, !differs || !next_to_border(in, of.pdf > 0));
  }
  /// Whether a pair is possible changes where components move by 2^-20: the library counts a pair that is impossible by
  /// rounding as one that was sampled.
  static bool next_to_border(const std::array<Quad, kInputs>& in, bool possible) {
    for (int signs = 0; signs < 64; ++signs) {
      auto moved = in;
      for (std::size_t i = 0; i < 6; ++i) moved[i] += Quad(signs >> i & 1 ? 0x1p-20 : -0x1p-20);
      if ((value(moved).pdf > 0) != possible) return true;
    }
    return false;
  }
};

}  // namespace vndf::ratio
