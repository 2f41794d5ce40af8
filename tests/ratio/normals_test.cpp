// The ratio (reference/ratio.h) of sample_normals, one test per warp and hard case: views of any direction and length,
// any u in [0, 1], alpha from 1e-6 to 100.
#include "ratio/measure.h"
#include "ratio/surfaces.h"

namespace vndf::ratio {
namespace {

template <Warp warp>
struct Normals {
  static constexpr std::size_t kInputs = 7, kResults = 1;
  using Founds = std::array<Found, kResults>;
  static constexpr Bound kDisk = {"wm", 6, 4}, kCap = {"wm", 8, 8};
  static constexpr std::array<Bound, kResults> bounds = {warp == Warp::spherical_cap ? kCap : kDisk};

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

class Ratio : public ::testing::TestWithParam<std::tuple<int, HardCase>> {};
INSTANTIATE_TEST_SUITE_P(, Ratio, ::testing::Combine(::testing::Range(0, 3), ::testing::ValuesIn(rows(Views::any))),
                         [](const auto& info) {
                           return std::string(kWarpNames[std::get<0>(info.param)]) + "_" + std::get<1>(info.param).name;
                         });

TEST_P(Ratio, Normals) {
  auto [w, row] = GetParam();
  std::string name = std::string("normals ") + kWarpNames[w] + " " + row.name;
  Table in = sampling_inputs<Plain>(row, kWarps[w], Views::any, sample_count(12));
  if (w == 0) measure<Normals<Warp::polar>>(name, in);
  if (w == 1) measure<Normals<Warp::concentric>>(name, in);
  if (w == 2) measure<Normals<Warp::spherical_cap>>(name, in);
}

}  // namespace
}  // namespace vndf::ratio
