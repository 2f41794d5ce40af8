// Lanes of zeros: no view, no light, no normal.
#include "edges/edges.h"
#include "support/inputs.h"

namespace vndf::edges {
namespace {

using testing::Kind;
using testing::Operation;
using testing::Result;
using testing::Table;

// What a padded queue holds: no view, no light and no normal, alone or with everything else 0 too, eta among it.
TEST(Zeros, HaveNoDensityAndNoWeight) {
  constexpr std::size_t kCount = 200;
  const std::vector<Kind> directions = {Kind::view, Kind::light, Kind::normal},
                          all = {Kind::view, Kind::light, Kind::normal, Kind::alpha, Kind::theta, Kind::u, Kind::eta};
  for (const Operation& operation : testing::operations())
    for (const auto& kinds : {std::vector<Kind>{Kind::view}, {Kind::light}, {Kind::normal}, directions, all})
      for (float zero : {0.f, -0.f}) {
        if (!operation.takes(kinds[0])) continue;
        Table in = testing::good_inputs(operation, kCount, 1);
        for (std::size_t c = 0; c < in.size(); ++c)
          if (std::find(kinds.begin(), kinds.end(), operation.inputs[c].kind) != kinds.end())
            in[c].assign(kCount, zero);
        bool in_domain = operation.in_domain && !(kinds == all && operation.takes(Kind::eta));
        on_every_isa([&] {
          Table out = testing::evaluate(operation, in);
          for (std::size_t c = 0; c < out.size(); ++c) {
            Result result = operation.outputs[c].result;
            for (std::size_t i = 0; i < kCount; ++i) {
              SCOPED_TRACE(operation.name);
              if (result == Result::density || result == Result::weight || result == Result::f_cos) {
                ASSERT_EQ(out[c][i], 0) << operation.outputs[c].name << " for " << describe(operation, in, i);
              }
              ASSERT_TRUE(std::isfinite(out[c][i]) || !in_domain)
                  << operation.outputs[c].name << " for " << describe(operation, in, i);
            }
            if (result != Result::normal || operation.outputs[c].name != "wm.x" || !in_domain) continue;
            for (std::size_t i = 0; i < kCount; ++i)
              ASSERT_TRUE(is_unit({out[c][i], out[c + 1][i], out[c + 2][i]}))
                  << operation.name << " for " << describe(operation, in, i);
          }
        });
      }
}

}  // namespace
}  // namespace vndf::edges
