// The ratio (reference/ratio.h) of sample_normals, one test per warp and hard case: views of any direction and length,
// any u in [0, 1], alpha from 1e-6 to 100.
#include "ratio/normals.h"

namespace vndf::ratio {
namespace {

class Ratio : public ::testing::TestWithParam<std::tuple<int, HardCase>> {};
INSTANTIATE_TEST_SUITE_P(, Ratio, ::testing::Combine(::testing::Range(0, 3), ::testing::ValuesIn(rows(Views::any))),
                         [](const auto& info) {
                           return std::string(kWarpNames[std::get<0>(info.param)]) + "_" + std::get<1>(info.param).name;
                         });

TEST_P(Ratio, Normals) {
  auto [w, row] = GetParam();
  std::string name = std::string("normals ") + kWarpNames[w] + " " + row.name;
  if (w == 0) measure<Normals<Warp::polar>>(name, row, sample_count(12));
  if (w == 1) measure<Normals<Warp::concentric>>(name, row, sample_count(12));
  if (w == 2) measure<Normals<Warp::spherical_cap>>(name, row, sample_count(12));
}

}  // namespace
}  // namespace vndf::ratio
