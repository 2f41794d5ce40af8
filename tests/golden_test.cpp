// One hash per function and warp that every build must reproduce: each instruction set, compiler and optimisation
// level, today and after any change that is not meant to change results. The inputs are made with integers alone.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <vector>

#include <vndf/vndf.h>

#include "reference/random.h"

namespace {

constexpr std::size_t kCount = 1 << 16;

struct Golden {
  std::vector<float> wo_x, wo_y, wo_z, alpha_x, alpha_y, u_x, u_y;

  Golden() {
    vndf::reference::Random random(2018);
    auto fraction = [&] { return random.unit(); };
    // Views of any direction and length up to 1.7, alpha in four binades: exactly the same floats everywhere.
    for (std::size_t i = 0; i < kCount; ++i) {
      wo_x.push_back(2 * fraction() - 1);
      wo_y.push_back(2 * fraction() - 1);
      wo_z.push_back(2 * fraction() - 1);
      const float scale[] = {1.f, 0x1p-3f, 0x1p-6f, 0x1p-9f};
      alpha_x.push_back((fraction() + 0x1p-24f) * scale[random.below(4)]);
      alpha_y.push_back((fraction() + 0x1p-24f) * scale[random.below(4)]);
      u_x.push_back(fraction());
      u_y.push_back(fraction());
    }
  }
};

/// FNV-1a over the bits.
std::uint64_t hash(std::initializer_list<const std::vector<float>*> columns) {
  std::uint64_t h = 0xcbf29ce484222325u;
  for (const auto* column : columns)
    for (float value : *column) {
      std::uint32_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      h = (h ^ bits) * 0x100000001b3u;
    }
  return h;
}

class GoldenBits : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (vndf::set_isa(GetParam()) != vndf::IsaError::none) GTEST_SKIP() << "not supported by this processor";
  }
  static const Golden& inputs() {
    static const Golden golden;
    return golden;
  }
};

TEST_P(GoldenBits, SampleNormals) {
  const Golden& in = inputs();
  const struct {
    vndf::Warp warp;
    std::uint64_t hash;
  } rows[] = {{vndf::Warp::polar, 0x88ba893dcd6eaf59u},
              {vndf::Warp::concentric, 0xd0b208d357b06beau},
              {vndf::Warp::spherical_cap, 0x27b91041867f7au}};
  for (const auto& row : rows) {
    std::vector<float> x(kCount), y(kCount), z(kCount);
    vndf::sample_normals(row.warp, kCount, {in.wo_x.data(), in.wo_y.data(), in.wo_z.data()},
                         {in.alpha_x.data(), in.alpha_y.data()}, {in.u_x.data(), in.u_y.data()},
                         {x.data(), y.data(), z.data()});
    EXPECT_EQ(hash({&x, &y, &z}), row.hash)
        << std::hex << std::showbase << "warp " << static_cast<int>(row.warp) << " gives " << hash({&x, &y, &z});
  }
}

TEST_P(GoldenBits, SampleDisk) {
  const Golden& in = inputs();
  const struct {
    vndf::DiskMap map;
    std::uint64_t hash;
  } rows[] = {{vndf::DiskMap::polar, 0xa97693e70590ffd1u}, {vndf::DiskMap::concentric, 0xe94380873dc9e10du}};
  for (const auto& row : rows) {
    std::vector<float> x(kCount), y(kCount);
    vndf::sample_disk(row.map, kCount, {in.u_x.data(), in.u_y.data()}, {x.data(), y.data()});
    EXPECT_EQ(hash({&x, &y}), row.hash) << std::hex << std::showbase << "map " << static_cast<int>(row.map) << " gives "
                                        << hash({&x, &y});
  }
}

std::vector<const char*> names() {
  std::vector<const char*> names;
  for (vndf::Isa isa : vndf::isas()) names.push_back(isa.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(EverySet, GoldenBits, testing::ValuesIn(names()),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
