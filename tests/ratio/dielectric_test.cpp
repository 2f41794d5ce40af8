// The ratio (reference/ratio.h) of sample_dielectric, for plain GGX and for ellipsoids, from either side: the
// direction, the density and the weight of the side that the sample took. A view that is not a unit vector has two
// angles, by its cosine and by its sine: what depends on Snell's law is compared for views that are.
#include "ratio/dielectric.h"

namespace vndf::ratio {
namespace {

template <class Surface>
void measure_case(const char* what, const HardCase& row, const Refraction& refraction, int w) {
  std::string name = std::string(what) + " " + refraction.name + " " + kWarpNames[w] + " " + row.name;
  const std::size_t count = sample_count(10);
  if (w == 0) measure<Dielectric<Surface, Warp::polar>>(name, row, count, refraction);
  if (w == 1) measure<Dielectric<Surface, Warp::concentric>>(name, row, count, refraction);
  if (w == 2) measure<Dielectric<Surface, Warp::spherical_cap>>(name, row, count, refraction);
}

using Case = std::tuple<int, HardCase>;
std::string name_of(const ::testing::TestParamInfo<Case>& info) {
  return std::string(kWarpNames[std::get<0>(info.param)]) + "_" + std::get<1>(info.param).name;
}
class Ratio : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(, Ratio, ::testing::Combine(::testing::Range(0, 3), ::testing::ValuesIn(rows(Views::unit))),
                         name_of);

TEST_P(Ratio, Dielectric) {
  auto [w, row] = GetParam();
  for (const Refraction& refraction : reference::refractions()) measure_case<Plain>("dielectric", row, refraction, w);
}
TEST_P(Ratio, OfEllipsoid) {
  auto [w, row] = GetParam();
  measure_case<Tilted>("tilted dielectric", row, kAnyEta, w);
}

}  // namespace
}  // namespace vndf::ratio
