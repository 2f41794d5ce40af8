// Lanes of zeros: no view, no light, no normal.
#include <cstring>

#include "edges/edges.h"
#include "shading/operations.h"

namespace vndf::edges {
namespace {

using testing::Table;

/// Outputs of an operation of shading/operations.h by what they are.
bool is_density_or_weight(const Operation& operation, std::size_t c) {
  return operation.outputs <= 2 || (operation.outputs >= 6 && (c == 3 || c == 4));
}
void fill(const Operation& operation, Table& in, char kind, float value) {
  for (std::size_t c = 0; c < in.size(); ++c)
    if (operation.inputs[c] == kind) std::fill(in[c].begin(), in[c].end(), value);
}

// What a padded queue holds: no view, no light and no normal, alone or with everything else 0 too, eta among it.
TEST(Zeros, HaveNoDensityAndNoWeight) {
  constexpr std::size_t kCount = 200;
  for (const Operation& operation : operations())
    for (const char* kinds : {"w", "l", "m", "wlm", "wlmatue"})
      for (float zero : {0.f, -0.f}) {
        if (operation.inputs.find(kinds[0]) == std::string::npos) continue;
        Table in = inputs(operation, kCount, 1, true);
        for (const char* kind = kinds; *kind; ++kind) fill(operation, in, *kind, zero);
        bool in_domain = operation.name.find("bad_constants") == std::string::npos &&
                         (kinds[std::strlen(kinds) - 1] != 'e' || operation.inputs.find('e') == std::string::npos);
        on_every_isa([&] {
          Table out = evaluate(operation, in);
          for (std::size_t i = 0; i < kCount; ++i) {
            for (std::size_t c = 0; c < out.size(); ++c) {
              if (is_density_or_weight(operation, c)) {
                ASSERT_EQ(out[c][i], 0) << operation.name << ", zero " << kinds << ", output " << c << " at " << i;
              }
              ASSERT_TRUE(std::isfinite(out[c][i]) || !in_domain) << operation.name << ", zero " << kinds << ", " << c;
            }
            if (operation.outputs == 9 && in_domain) {
              ASSERT_TRUE(is_unit({out[5][i], out[6][i], out[7][i]})) << operation.name << ", zero " << kinds;
            }
          }
        });
      }
}

}  // namespace
}  // namespace vndf::edges
