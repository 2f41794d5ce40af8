// The ratio (reference/ratio.h) of sample_dielectric and evaluate_dielectric with options, one at a time and together:
// masking across the surface, radiance, a probability of reflection. And of reflection on both sides, by its mirror.
#include "ratio/measure.h"
#include "ratio/surfaces.h"

namespace vndf::ratio {
namespace {

/// A row of the table of operations, by the end of its name, and its options.
struct Options {
  const char* name;
  AcrossMasking across;
  bool radiance, given;
};
constexpr Options kOptions[] = {
    {"_as_reflection", AcrossMasking::as_reflection, false, false},
    {"_correlated_across", AcrossMasking::height_correlated, false, false},
    {"_radiance", AcrossMasking::separable, true, false},
    {"_probability", AcrossMasking::separable, false, true},
    {"_radiance_probability_separable", AcrossMasking::separable, true, true},
};
constexpr bool is_separable(const Options& options) {
  return options.radiance && options.given;
}

/// The last input of both functions is the probability.
constexpr std::size_t kInputs = 10, kProbability = 9;

Table columns_of(const Options& options, Table in) {
  if (!options.given) in.pop_back();
  return in;
}
exact::Lobes lobes_of(const Options& options, Quad probability) {
  return {options.across, options.radiance, options.given, probability};
}
/// The beta function is compared where its arguments are below 2^30.
bool is_comparable(const Options& options, Quad z) {
  return options.across != AcrossMasking::height_correlated || z > Quad(1e-6) || z < Quad(-1e-6);
}
/// A probability that is given takes the place of Fresnel's share: where that vanishes, at the rim, and where the
/// density is cut off, at 2^60, digits are lost.
bool has_digits(const Options& options, Quad pdf, Quad cos) {
  return !options.given || (pdf < Quad(0x1p50) && cos > Quad(0x1p-20));
}
/// With the beta function a weight w is within 30 eps (1 - ln w) besides, of which a ratio of `bound` makes this.
Exact with_beta(const Options& options, Quad bound, Quad slack, Quad w, Quad value, bool compared) {
  if (options.across == AcrossMasking::height_correlated)
    slack += value * Quad(30 * 0x1p-24 * (1 - std::log(std::max(double(w), 1e-300)))) / bound;
  return exact_with(slack, value, compared && w > Quad(1e-30));
}

/// Inputs are wo, alpha, eta, u and the probability.
template <std::size_t option>
struct Sampled {
  static constexpr std::size_t kInputs = ratio::kInputs, kEta = 5, kU = 6, kDirections = 1, kResults = 4;
  static constexpr const Options& kOf = kOptions[option];
  using Founds = std::array<Found, kResults>;
  static constexpr std::array<Bound, kResults> bounds = {
      {{"wi", 16, 16}, {"pdf", 16, 16}, {"weight", 16, 16}, {"side", 0, 0}}};

  static auto moves() { return moves_of<kInputs>(kU); }
  static bool in_domain(const std::array<float, kInputs>& in) {
    return is_unit(in.data()) && has_azimuth(in.data()) && is_surface<Plain>(&in[3]) && is_index(in[kEta]) &&
           in_unit_interval(in, kU);
  }
  static std::vector<Founds> run(const Table& in) {
    Results of(std::string("dielectric_concentric") + kOf.name, columns_of(kOf, in));
    std::vector<Founds> found;
    for (std::size_t i = 0; i < of.size(); ++i) {
      auto wi = of.vector("wi", i);
      const bool below = in[2][i]<0, leaves = (below ? -wi[2] : wi[2]) * of("side", i)> 0;
      found.push_back({Found{wi, leaves}, Found{{of("pdf", i)}, leaves}, Found{{of("weight", i)}, leaves},
                       Found{{of("side", i)}, false}});
    }
    return found;
  }
  static std::array<Exact, kResults> exact(const std::array<Quad, kInputs>& in, const Founds& found) {
    const float side = found[3].value[0];
    exact::Sample s = exact::sample_dielectric(Warp::concentric, side > 0, {in[0], in[1], in[2]}, Plain::exact(&in[3]),
                                               in[kEta], in[kU], in[kU + 1], lobes_of(kOf, in[kProbability]));
    const bool leaves = s.normal.defined && (in[2] < 0 ? -s.wi.z : s.wi.z) * Quad(side) > 0 && s.pdf > 0;
    const bool digits = leaves && has_digits(kOf, s.pdf, s.normal.cos);
    const bool separable = is_separable(kOf);
    const Quad w = separable ? s.weight.separable : s.weight.correlated,
               slack = separable ? s.slack.separable : s.slack.correlated;
    return {reference::exact_vector(at_most_one(found[0].value, s.wi), leaves), exact_with(s.pdf_slack, s.pdf, digits),
            with_beta(kOf, 16, slack, w, w, digits && is_comparable(kOf, in[2]) && is_comparable(kOf, s.wi.z)),
            reference::exact_number(side)};
  }
};

/// Inputs are wo, wi, alpha, eta and the probability.
template <std::size_t option>
struct Evaluated {
  static constexpr std::size_t kInputs = ratio::kInputs, kEta = 8, kDirections = 2, kResults = 2;
  static constexpr const Options& kOf = kOptions[option];
  using Founds = std::array<Found, kResults>;
  static constexpr std::array<Bound, kResults> bounds = {{{"pdf", 8, 8}, {"f_cos", 8, 8}}};

  static auto moves() { return moves_of<kInputs>(kProbability); }
  static bool in_domain(const std::array<float, kInputs>& in) {
    return is_unit(&in[0]) && is_unit(&in[3]) && in[5] != 0 && is_surface<Plain>(&in[6]) && is_index(in[kEta]) &&
           in_unit_interval(in, kProbability);
  }
  static std::vector<Founds> run(const Table& in) {
    Results of(std::string("evaluate_dielectric") + kOf.name, columns_of(kOf, in));
    std::vector<Founds> found;
    for (std::size_t i = 0; i < of.size(); ++i) found.push_back({Found{{of("pdf", i)}}, Found{{of("f_cos", i)}}});
    return found;
  }
  static std::array<Exact, kResults> exact(const std::array<Quad, kInputs>& in, const Founds& found) {
    const Vec wo{in[0], in[1], in[2]}, wi{in[3], in[4], in[5]};
    const exact::Surface surface = Plain::exact(&in[6]);
    exact::Evaluation of = exact::evaluate_dielectric(wo, wi, surface, in[kEta], lobes_of(kOf, in[kProbability]));
    const Quad f = is_separable(kOf) ? of.f_cos.separable : of.f_cos.correlated;
    // Whether a pair is possible is for evaluation_test.cpp. An f_cos that is 0 by masking alone leaves it to the pdf.
    const bool found_f = found[1].value[0] > 0, found_possible = found_f || found[0].value[0] > 0;
    const bool both = found_f == (f > 0) && found_possible == (f > 0 || of.pdf > 0) && is_comparable(kOf, wo.z) &&
                      is_comparable(kOf, wi.z);
    const bool across = (wo.z < 0) != (wi.z < 0);
    return {
        reference::exact_number(of.pdf, both && has_digits(kOf, of.pdf, 1)),
        across ? with_beta(kOf, 8, 0, of.pdf > 0 ? f / of.pdf : Quad(1), f, both) : reference::exact_number(f, both)};
  }
};

/// Unit views on both sides, a surface, eta, random numbers and a probability: the ends among them.
Table inputs(const HardCase& row) {
  Table in = sampling_inputs<Plain>(row, Warp::concentric, Views::unit, sample_count(9));
  const std::size_t count = in[0].size();
  std::vector<float> eta(count), choice(count), probability(count);
  for (std::size_t i = 0; i < count; ++i) {
    reference::Random random(seed() + 5, i);
    eta[i] = float(reference::refractions()[random.below(3)].eta(random));
    choice[i] = random.below(4) ? random.unit() : float(random.below(2));
    probability[i] = random.below(4) ? random.unit() : float(random.below(2));
  }
  in.insert(in.end() - 2, eta);
  in.push_back(choice);
  in.push_back(probability);
  return in;
}

/// The pairs of samples.
Table pairs(const Options& options, const Table& in) {
  Results sampled(std::string("dielectric_concentric") + options.name, columns_of(options, in));
  Table pairs(in.begin(), in.begin() + 3);
  for (const char* component : {"wi.x", "wi.y", "wi.z"}) pairs.push_back(sampled.column(component));
  for (std::size_t c : {3, 4, 5, 9}) pairs.push_back(in[c]);
  return pairs;
}

template <std::size_t option>
void measure_option(const HardCase& row) {
  const Table in = inputs(row);
  const std::string name = kOptions[option].name + std::string(" ") + row.name;
  measure_table<Sampled<option>>("dielectric" + name, in);
  measure_table<Evaluated<option>>("evaluate_dielectric" + name, pairs(kOptions[option], in));
}

class OfOptions : public ::testing::TestWithParam<HardCase> {};
INSTANTIATE_TEST_SUITE_P(, OfOptions, ::testing::ValuesIn(rows(Views::unit)),
                         [](const auto& info) { return std::string(info.param.name); });
TEST_P(OfOptions, MaskingAsReflection) {
  measure_option<0>(GetParam());
}
TEST_P(OfOptions, MaskingCorrelatedAcross) {
  measure_option<1>(GetParam());
}
TEST_P(OfOptions, Radiance) {
  measure_option<2>(GetParam());
}
TEST_P(OfOptions, Probability) {
  measure_option<3>(GetParam());
}
TEST_P(OfOptions, RadianceAndProbability) {
  measure_option<4>(GetParam());
}

// What a two-sided surface gives is to the bit what the upper side gives, mirrored, and so are its ratios.
TEST_P(OfOptions, TwoSidedReflectionIsThatOfTheUpperSide) {
  Table in = sampling_inputs<Plain>(GetParam(), Warp::concentric, Views::unit, sample_count(11)), up = in;
  for (float& z : up[2]) z = std::fabs(z);
  const struct {
    const char *two_sided, *upper;
  } kRows[] = {{"reflection_concentric_two_sided_separable", "reflection_concentric_separable"},
               {"reflection_concentric_bounded_two_sided", "reflection_concentric_bounded"},
               {"reflection_turned_concentric_two_sided", "reflection_turned_concentric"},
               {"reflection_tilted_concentric_two_sided", "reflection_tilted_concentric"}};
  for (const auto& row : kRows) {
    Table there = in, here = up;
    while (there.size() < testing::operation(row.upper).inputs.size()) {
      there.insert(there.end() - 2, std::vector<float>(in[0].size(), 0.3f));
      here.insert(here.end() - 2, there[there.size() - 3]);
    }
    Results mirrored(row.two_sided, there), upper(row.upper, here);
    for (const char* column : {"wi.x", "wi.y", "wi.z", "pdf", "weight", "wm.x", "wm.y", "wm.z", "wo_dot_wm"})
      for (std::size_t i = 0; i < upper.size(); ++i) {
        const bool turns = std::signbit(in[2][i]) && column[std::strlen(column) - 1] == 'z';
        ASSERT_EQ(mirrored(column, i), turns ? -upper(column, i) : upper(column, i)) << row.two_sided << " " << column;
      }
  }
}

}  // namespace
}  // namespace vndf::ratio
