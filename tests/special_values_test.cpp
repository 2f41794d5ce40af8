// What holds at the edges of the domain and beyond them, for all functions, on every set. What one function has for
// literal inputs is in edges/.
#include <algorithm>
#include <array>
#include <limits>

#include "support/edges.h"
#include "support/every_operation.h"

namespace vndf::testing {
namespace {

constexpr float kLargestPdf = 0x1p60f;

class SpecialValues : public EveryOperation {
 protected:
  void expect_sound_on_every_isa(const Table& in, Roughness roughness = Roughness::promised) const {
    on_every_isa([&] { expect_sound(operation(), in, columns(in), roughness); });
  }
  void set(Table& in, Kind kind, float value) const {
    for (std::size_t c = 0; c < in.size(); ++c)
      if (operation().inputs[c].kind == kind) in[c].assign(in[c].size(), value);
  }
  void expect(const Table& in, const Table& out, const char* column, float value) const {
    std::size_t c = operation().output(column);
    for (std::size_t i = 0; c < out.size() && i < out[c].size(); ++i)
      ASSERT_EQ(out[c][i], value) << operation().name << ": " << column << " for " << describe(operation(), in, i);
  }
};
VNDF_FOR_EVERY_OPERATION(SpecialValues, false);

TEST_P(SpecialValues, GridOfGoodInputs) {
  Table in = grid_inputs(operation());
  expect_sound(operation(), in, columns(in), Roughness::promised);
}

TEST_P(SpecialValues, EdgesOfTheDomain) {
  for (std::uint64_t seed = 0; seed < 4; ++seed)
    expect_sound_on_every_isa(edge_inputs(operation(), Roughness::promised, samples(15), seed));
}

TEST_P(SpecialValues, HardCases) {
  expect_sound_on_every_isa(good_inputs(operation(), samples(17), 1));
}

// alpha = 0 and what is next to it: densities stay finite, and so does what multiple importance sampling makes of them.
TEST_P(SpecialValues, AlphaZeroAndNextToIt) {
  expect_sound_on_every_isa(edge_inputs(operation(), Roughness::tiny, samples(16), 5), Roughness::tiny);
}

// One surface for the batch. Leaning by the float next to a right angle, one of small alpha is a disk seen from its
// edge.
TEST_P(SpecialValues, SurfacesOfConstants) {
  constexpr float kRight = 1.5707964f, x = 1e-6f;
  std::vector<std::array<float, 5>> surfaces = {{x, x, 0, kRight, 0},
                                                {1e-5f, 1e-5f, 0, kRight, 0},
                                                {3e-6f, 3e-6f, 0, -kRight, 0.82f},
                                                {x, 67.8f, -0.42f, kRight, 0.82f},
                                                {x, 1e-5f, -0.42f, kRight, 0.82f},
                                                {1e-5f, x, 1.2f, kRight, -2},
                                                {x, x, kRight, 0, 0},
                                                {67.8f, x, kRight, 0.3f, 0},
                                                {x, x, kRight, kRight, 0.3f},
                                                {x, 100, 0, kRight, 0},
                                                {100, x, 0, kRight, 0},
                                                {0.5f, x, 0.7f, kRight, 1}};
  reference::Random random(2);
  const float corners[] = {x, 1e-5f, 1e-3f, 1, 100}, angles[] = {0, 0.3f, kRight, -kRight, 3.1f, -2};
  for (int row = 0; row < 40; ++row) {
    auto corner = [&] { return corners[random.below(std::size(corners))]; };
    auto angle = [&] { return angles[random.below(std::size(angles))]; };
    surfaces.push_back({corner(), corner(), angle(), angle(), angle()});
  }
  Table in = edge_inputs(operation(), Roughness::promised, samples(12), 6);
  if (!operation().takes(Kind::alpha)) return;
  for (const auto& surface : surfaces) {
    std::vector<Column> constant = columns(in);
    const char* const names[] = {"alpha.x", "alpha.y", "theta.x", "theta.y", "theta.z"};
    for (std::size_t k = 0; k < 5; ++k)
      if (std::size_t c = operation().input(names[k]); c < in.size()) {
        in[c].assign(in[c].size(), surface[k]);
        constant[c] = surface[k];
      }
    on_every_isa([&] {
      expect_sound(operation(), in, constant, Roughness::promised);
      expect_sound(operation(), in, columns(in), Roughness::promised);
    });
  }
}

// Where cosines are next to 1: near-normal views, and the middle of each warp, whose normals are close to the view.
TEST_P(SpecialValues, CosinesAreAtMostOne) {
  if (operation().output("wi.x") == operation().outputs.size()) return;
  Table in = good_inputs(operation(), samples(18), 7);
  for (std::size_t i = 0; i < in[0].size(); ++i) {
    reference::Random random(8, i);
    double s = random.below(3) ? random.log_uniform(1e-8, 1e-2) : 0, phi = random.uniform(0, 6.2831853);
    const float wo[] = {float(s * std::cos(phi)), float(s * std::sin(phi)), float(std::sqrt(1 - s * s))};
    const float small = float(random.log_uniform(1e-9, 1e-3));
    const bool isotropic = random.below(2);
    float alpha = 0;
    for (std::size_t c = 0; c < in.size(); ++c) {
      const Input& input = operation().inputs[c];
      float& value = in[c][i];
      if (input.kind == Kind::view) value = wo[input.index];
      if (input.kind == Kind::alpha)
        value = alpha = isotropic && input.index ? alpha : float(random.log_uniform(1e-3, 1));
      if (input.kind == Kind::u) value = input.index < 2 && random.below(2) ? small : random.unit();
      if (input.kind == Kind::eta) value = std::array{1.5f, 1.01f, 0.99f, 0.5f}[random.below(4)];
    }
  }
  expect_sound_on_every_isa(in);
}

// What a padded queue holds: no view, no light and no normal, alone or with everything else 0 too, eta among it.
TEST_P(SpecialValues, ZerosHaveNoDensityAndNoWeight) {
  const std::vector<Kind> directions = {Kind::view, Kind::light, Kind::normal},
                          all = {Kind::view, Kind::light, Kind::normal, Kind::alpha, Kind::theta, Kind::u, Kind::eta};
  for (const auto& kinds : {std::vector<Kind>{Kind::view}, {Kind::light}, {Kind::normal}, directions, all})
    for (float zero : {0.f, -0.f}) {
      if (!operation().takes(kinds[0])) continue;
      Table in = good_inputs(operation(), 200, 1);
      for (Kind kind : kinds) set(in, kind, zero);
      if (kinds != all || !operation().takes(Kind::eta)) expect_sound_on_every_isa(in);
      on_every_isa([&] {
        Table out = evaluate(operation(), in);
        for (const char* column : {"pdf", "weight", "f_cos"}) expect(in, out, column, 0);
      });
    }
}

// The normal of a reflection is that of sample_normals to the bit, for every view and alpha.
TEST_P(SpecialValues, NormalsAreThoseOfSampleNormals) {
  const Operation* normals = normals_of(operation());
  if (!normals) return;
  for (const Table& in :
       {good_inputs(operation(), samples(18), 3), edge_inputs(operation(), Roughness::promised, samples(15), 9),
        mixed_inputs(operation(), samples(15), 4)})
    on_every_isa([&] {
      Table out = evaluate(operation(), in), wm;
      for (const char* column : {"wm.x", "wm.y", "wm.z"}) wm.push_back(out[operation().output(column)]);
      ASSERT_TRUE(same_bits(*normals, evaluate(*normals, in), wm, in));
    });
}

// Within 2^-16 of 1 there is no surface: light goes straight on and counts whole, whatever the random numbers say. As a
// delta it is not evaluated, neither close to straight on nor elsewhere.
TEST_P(SpecialValues, MatchedIndices) {
  if (!operation().takes(Kind::eta)) return;
  Table in = edge_inputs(operation(), Roughness::promised, samples(13), 10);
  if (operation().takes(Kind::light))
    for (std::size_t i = 0; i < in[0].size(); i += 2) {
      reference::Random random(3, i);
      double scale = random.log_uniform(1e-8, 1);
      for (std::size_t c = 0; c < 3; ++c) in[3 + c][i] = float(scale * random.uniform(-1, 1) - in[c][i]);
    }
  for (float eta : {1.f, 1 + 0x1p-20f, 1 - 0x1p-20f, 1 + 0x1p-17f, 1 - 0x1p-17f}) {
    set(in, Kind::eta, eta);
    expect_sound_on_every_isa(in);
    on_every_isa([&] {
      Table out = evaluate(operation(), in);
      if (operation().takes(Kind::light)) {
        for (const char* column : {"pdf", "f_cos"}) expect(in, out, column, 0);
        return;
      }
      expect(in, out, "side", -1);
      expect(in, out, "reflectance", 0);
      for (std::size_t i = 0; i < in[0].size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_EQ(out[operation().output("wi.x") + c][i], -in[c][i]) << describe(operation(), in, i);
        if (in[2][i] == 0) continue;
        ASSERT_EQ(out[operation().output("weight")][i], 1) << describe(operation(), in, i);
        ASSERT_EQ(out[operation().output("pdf")][i], kLargestPdf) << describe(operation(), in, i);
      }
    });
  }
}

// No index of refraction: no light.
TEST_P(SpecialValues, IndicesThatAreNone) {
  if (!operation().takes(Kind::eta)) return;
  constexpr float kInf = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
  Table in = edge_inputs(operation(), Roughness::promised, samples(13), 11);
  for (float eta : {0.f, -0.f, -1e-30f, -0.5f, -1.f, -1.5f, -1e30f, 0x1p-20f, 0x1p20f, kNan, kInf, -kInf}) {
    set(in, Kind::eta, eta);
    on_every_isa([&] {
      Table out = evaluate(operation(), in);
      for (const char* column : {"pdf", "weight", "f_cos"}) expect(in, out, column, 0);
    });
  }
}

}  // namespace
}  // namespace vndf::testing
