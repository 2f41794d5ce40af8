// The ratio (reference/ratio.h) of evaluate_reflection, evaluate_dielectric and pdf_normals, for pairs that were
// sampled and for pairs that nobody sampled.
#include "ratio/measure.h"
#include "ratio/surfaces.h"

namespace vndf::ratio {
namespace {

using reference::Random;
using reference::Refraction;

template <class Columns>
std::vector<float*> pointers(Columns& columns) {
  std::vector<float*> result;
  for (auto& column : columns) result.push_back(column.data());
  return result;
}

/// The columns that evaluations write.
struct Outputs {
  std::vector<float> f_cos, pdf;

  explicit Outputs(std::size_t n) : f_cos(n), pdf(n) {}
  Evaluations out() { return {f_cos.data(), pdf.data()}; }
};

void evaluate(std::size_t n, const Columns3& wo, const Columns3& wi, const Columns2& alpha, const Evaluations& out,
              const ReflectionOptions& options) {
  evaluate_reflection(n, wo, wi, alpha, out, options);
}
void evaluate(std::size_t n, const Columns3& wo, const Columns3& wi, const Ellipsoid& ellipsoid, const Evaluations& out,
              const ReflectionOptions&) {
  evaluate_reflection(n, wo, wi, ellipsoid, out);
}
void evaluate_across(std::size_t n, const Columns3& wo, const Columns3& wi, const Columns2& alpha, const Column& eta,
                     const Evaluations& out, Masking masking) {
  evaluate_dielectric(n, wo, wi, alpha, eta, out, masking);
}
void evaluate_across(std::size_t n, const Columns3& wo, const Columns3& wi, const Ellipsoid& ellipsoid,
                     const Column& eta, const Evaluations& out, Masking) {
  evaluate_dielectric(n, wo, wi, ellipsoid, eta, out);
}

template <std::size_t inputs>
Vec view(const std::array<Quad, inputs>& in) {
  return {in[0], in[1], in[2]};
}
template <std::size_t inputs>
Vec other(const std::array<Quad, inputs>& in) {
  return {in[3], in[4], in[5]};
}
std::vector<std::array<Found, 3>> found_of(const Outputs& of, const Outputs& separable, bool both) {
  std::vector<std::array<Found, 3>> found;
  for (std::size_t i = 0; i < of.pdf.size(); ++i)
    found.push_back({Found{{of.pdf[i]}}, Found{{of.f_cos[i]}}, Found{{separable.f_cos[i]}, both}});
  return found;
}
std::array<Exact, 3> exact_of(const exact::Evaluation& value, bool compared = true) {
  return {reference::exact_number(value.pdf, compared), reference::exact_number(value.f_cos.correlated, compared),
          reference::exact_number(value.f_cos.separable, compared)};
}

/// Inputs are wo, wi, the surface.
template <class Surface, bool bounded>
struct Reflection {
  static constexpr std::size_t kInputs = 6 + Surface::kInputs, kResults = 3;
  using Founds = std::array<Found, kResults>;
  static constexpr double kMax = Surface::kInputs == 5 ? 20 : 8;  // leaning: A^-T v and the lunes of grazing light
  static constexpr std::array<Bound, kResults> bounds = {
      {{"pdf", kMax, 8}, {"f_cos", kMax, 8}, {"separable f_cos", kMax, 8}}};

  static auto moves() { return moves_of<kInputs>(); }
  static bool in_domain(const std::array<float, kInputs>& in) {
    return is_nearly_unit(&in[0]) && is_nearly_unit(&in[3]) && in[2] >= 0 && in[5] > 0 && is_surface<Surface>(&in[6]);
  }
  static std::vector<Founds> run(const Table& in) {
    std::size_t count = in[0].size();
    auto c = testing::columns(in);
    Outputs of(count), separable(count);
    for (Masking masking : {Masking::height_correlated, Masking::separable})
      evaluate(count, {c[0], c[1], c[2]}, {c[3], c[4], c[5]}, Surface::of(&c[6]),
               (masking == Masking::separable ? separable : of).out(), {masking, bounded});
    return found_of(of, separable, !Surface::kByLunes);
  }
  static std::array<Exact, kResults> exact(const std::array<Quad, kInputs>& in, const Founds&) {
    return exact_of(exact::evaluate_reflection(bounded, view(in), other(in), Surface::exact(&in[6])));
  }
};

/// Inputs are wo, wm, the surface.
template <class Surface>
struct Normals {
  static constexpr std::size_t kInputs = 6 + Surface::kInputs, kResults = 1;
  using Founds = std::array<Found, kResults>;
  static constexpr std::array<Bound, kResults> bounds = {{{"pdf", 8, 8}}};

  static auto moves() { return moves_of<kInputs>(); }
  static bool in_domain(const std::array<float, kInputs>& in) {
    return is_nearly_unit(&in[0]) && is_nearly_unit(&in[3]) && in[5] >= 0 && is_surface<Surface>(&in[6]);
  }
  static std::vector<Founds> run(const Table& in) {
    std::size_t count = in[0].size();
    auto c = testing::columns(in);
    std::vector<float> pdf(count);
    pdf_normals(count, {c[0], c[1], c[2]}, {c[3], c[4], c[5]}, Surface::of(&c[6]), pdf.data());
    std::vector<Founds> found;
    for (float value : pdf) found.push_back({Found{{value}}});
    return found;
  }
  static std::array<Exact, kResults> exact(const std::array<Quad, kInputs>& in, const Founds&) {
    Quad pdf = exact::pdf_normals(view(in), other(in), Surface::exact(&in[6]));
    return {reference::exact_number(pdf, pdf > 0)};
  }
};

/// Inputs are wo, wi, the surface, eta.
template <class Surface>
struct Dielectric {
  static constexpr std::size_t kEta = 6 + Surface::kInputs, kInputs = kEta + 1, kResults = 3;
  using Founds = std::array<Found, kResults>;
  static constexpr auto bounds = Reflection<Surface, false>::bounds;

  static auto moves() { return moves_of<kInputs>(); }
  static bool in_domain(const std::array<float, kInputs>& in) {
    return is_unit(&in[0]) && is_unit(&in[3]) && in[5] != 0 && is_surface<Surface>(&in[6]) && is_index(in[kEta]);
  }
  static std::vector<Founds> run(const Table& in) {
    std::size_t count = in[0].size();
    auto c = testing::columns(in);
    Outputs of(count), separable(count);
    for (Masking masking : {Masking::height_correlated, Masking::separable})
      evaluate_across(count, {c[0], c[1], c[2]}, {c[3], c[4], c[5]}, Surface::of(&c[6]), c[kEta],
                      (masking == Masking::separable ? separable : of).out(), masking);
    return found_of(of, separable, !Surface::kByLunes);
  }
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

/// Any direction, grazing ones and ones along axes among them.
std::array<float, 3> any_direction(Random& random) {
  double cos = random.below(3) ? random.uniform(-1, 1) : random.log_uniform(1e-6, 1) * (random.below(2) ? 1 : -1);
  double sin = std::sqrt(1 - cos * cos), phi = random.uniform(0, 6.2831853);
  if (random.below(8) == 0) phi = random.below(4) * 1.57079632679;
  return {float(sin * std::cos(phi)), float(sin * std::sin(phi)), float(cos)};
}

template <class Surface>
std::size_t pair_count() {
  return sample_count(Surface::kByLunes ? 10 : 11);
}

/// wo, another direction and the surface: sampled ones as `sample` writes them, which is given the columns of wo, of
/// the surface and of u; every other one any.
template <class Surface, class Sample>
Table pairs(const HardCase& row, Views views, bool either_side, Sample sample) {
  Table in = sampling_inputs<Surface>(row, Warp::concentric, views, pair_count<Surface>());
  std::size_t count = in[0].size();
  Table others(3, std::vector<float>(count));
  sample(count, testing::columns(in), pointers(others));
  for (std::size_t i = 0; i < count; ++i) {
    Random random(seed() + 3, i);
    auto any = any_direction(random);
    for (std::size_t c = 0; c < 3 && i % 2; ++c) others[c][i] = any[c];
    if (!either_side) others[2][i] = std::fabs(others[2][i]);
  }
  in.resize(in.size() - 2);
  in.insert(in.begin() + 3, others.begin(), others.end());
  return in;
}

template <class Surface, bool bounded>
void measure_reflection(const char* what, const HardCase& row) {
  auto sample = [](std::size_t n, const std::vector<Column>& c, const std::vector<float*>& wi) {
    constexpr std::size_t u = 3 + Surface::kInputs;
    std::vector<float> pdf(n), weight(n);
    ReflectionSamples out{{wi[0], wi[1], wi[2]}, pdf.data(), weight.data()};
    sample_reflection(Warp::concentric, n, {c[0], c[1], c[2]}, Surface::of(&c[3]), {c[u], c[u + 1]}, out);
  };
  Table in = pairs<Surface>(row, Views::unit_above, false, sample);
  measure<Reflection<Surface, bounded>>(std::string(what) + " " + row.name, in);
}

template <class Surface>
void measure_normals(const char* what, const HardCase& row) {
  auto sample = [](std::size_t n, const std::vector<Column>& c, const std::vector<float*>& wm) {
    constexpr std::size_t u = 3 + Surface::kInputs;
    sample_normals(Warp::concentric, n, {c[0], c[1], c[2]}, Surface::of(&c[3]), {c[u], c[u + 1]},
                   {wm[0], wm[1], wm[2]});
  };
  Table in = pairs<Surface>(row, Views::unit, false, sample);
  measure<Normals<Surface>>(std::string(what) + " " + row.name, in);
}

template <class Surface>
void measure_dielectric(const char* what, const HardCase& row, const Refraction& refraction) {
  std::vector<float> eta(pair_count<Surface>());
  for (std::size_t i = 0; i < eta.size(); ++i) {
    Random random(seed() + 2, i);
    eta[i] = float(refraction.eta(random));
  }
  auto sample = [&](std::size_t n, const std::vector<Column>& c, const std::vector<float*>& wi) {
    constexpr std::size_t u = 3 + Surface::kInputs;
    std::vector<float> pdf(n), weight(n), side(n);
    DielectricSamples out{{wi[0], wi[1], wi[2]}, pdf.data(), weight.data(), side.data()};
    sample_dielectric(Warp::concentric, n, {c[0], c[1], c[2]}, Surface::of(&c[3]), eta.data(), {c[u], c[u + 1], c[u]},
                      out);
  };
  Table in = pairs<Surface>(row, Views::unit, true, sample);
  in.push_back(eta);
  measure<Dielectric<Surface>>(std::string(what) + " " + refraction.name + " " + row.name, in);
}

std::string name_of(const ::testing::TestParamInfo<HardCase>& info) {
  return info.param.name;
}

class Above : public ::testing::TestWithParam<HardCase> {};
INSTANTIATE_TEST_SUITE_P(, Above, ::testing::ValuesIn(rows(Views::unit_above)), name_of);
TEST_P(Above, Reflection) {
  measure_reflection<Plain, false>("evaluate_reflection", GetParam());
}
TEST_P(Above, BoundedReflection) {
  measure_reflection<Plain, true>("bounded evaluate_reflection", GetParam());
}
TEST_P(Above, TurnedReflection) {
  measure_reflection<Turned, false>("turned evaluate_reflection", GetParam());
}
TEST_P(Above, TiltedReflection) {
  measure_reflection<Tilted, false>("tilted evaluate_reflection", GetParam());
}

class Anywhere : public ::testing::TestWithParam<HardCase> {};
INSTANTIATE_TEST_SUITE_P(, Anywhere, ::testing::ValuesIn(rows(Views::unit)), name_of);
TEST_P(Anywhere, Normals) {
  measure_normals<Plain>("pdf_normals", GetParam());
}
TEST_P(Anywhere, TurnedNormals) {
  measure_normals<Turned>("turned pdf_normals", GetParam());
}
TEST_P(Anywhere, TiltedNormals) {
  measure_normals<Tilted>("tilted pdf_normals", GetParam());
}

TEST_P(Anywhere, Dielectric) {
  for (const Refraction& refraction : reference::refractions())
    measure_dielectric<Plain>("evaluate_dielectric", GetParam(), refraction);
}
TEST_P(Anywhere, TiltedDielectric) {
  for (const Refraction& refraction : reference::refractions())
    measure_dielectric<Tilted>("tilted evaluate_dielectric", GetParam(), refraction);
}

}  // namespace
}  // namespace vndf::ratio
