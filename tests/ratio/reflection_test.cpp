// The ratio (reference/ratio.h) of sample_reflection: plain GGX, bounded or not, and ellipsoids. Of each sample the
// direction, the density, the weight with either masking, the normal and its cosine.
#include "ratio/reflection.h"

namespace vndf::ratio {
namespace {

using Case = std::tuple<int, HardCase>;
std::string name_of(const ::testing::TestParamInfo<Case>& info) {
  return std::string(kWarpNames[std::get<0>(info.param)]) + "_" + std::get<1>(info.param).name;
}

template <class Surface, bool bounded>
void measure_case(const char* what, const Case& of) {
  auto [w, row] = of;
  std::string name = std::string(what) + " " + kWarpNames[w] + " " + row.name;
  const std::size_t count = sample_count(Surface::kByLunes ? 10 : 11);
  if (w == 0) measure<Reflection<Surface, Warp::polar, bounded>>(name, row, count);
  if (w == 1) measure<Reflection<Surface, Warp::concentric, bounded>>(name, row, count);
  if (w == 2) measure<Reflection<Surface, Warp::spherical_cap, bounded>>(name, row, count);
}

class Ggx : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(, Ggx,
                         ::testing::Combine(::testing::Range(0, 3), ::testing::ValuesIn(rows(Views::unit_above))),
                         name_of);
TEST_P(Ggx, Reflection) {
  measure_case<Plain, false>("reflection", GetParam());
}
TEST_P(Ggx, Bounded) {
  measure_case<Plain, true>("bounded reflection", GetParam());
}

class OfEllipsoid : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(, OfEllipsoid,
                         ::testing::Combine(::testing::Range(0, 3), ::testing::ValuesIn(rows(Views::unit))), name_of);
TEST_P(OfEllipsoid, Turned) {
  measure_case<Turned, false>("turned reflection", GetParam());
}
TEST_P(OfEllipsoid, Tilted) {
  measure_case<Tilted, false>("tilted reflection", GetParam());
}

}  // namespace
}  // namespace vndf::ratio
