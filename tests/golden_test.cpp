// One hash per function and warp that every build must reproduce: each instruction set, compiler and optimisation
// level, today and after any change that is not meant to change results. The inputs are made with integers alone.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <vector>

#include <vndf/ellipsoid.h>

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
      if (value != value) bits = 0x7fc00000;  // one NaN is as good as another
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

TEST_P(GoldenBits, ShadingStep) {
  const Golden& in = inputs();
  std::vector<float> x(kCount), y(kCount), z(kCount), pdf(kCount), weight(kCount), other(kCount);
  const vndf::Columns3 wo{in.wo_x.data(), in.wo_y.data(), in.wo_z.data()};
  const vndf::Columns2 alpha{in.alpha_x.data(), in.alpha_y.data()};
  const vndf::Columns3 wi{in.wo_y.data(), in.wo_z.data(), in.wo_x.data()};
  const vndf::Out3 out{x.data(), y.data(), z.data()};
  auto expect = [&](const char* what, std::uint64_t golden, std::uint64_t found) {
    EXPECT_EQ(found, golden) << std::hex << std::showbase << what << " gives " << found << ", set " << GetParam();
  };

  vndf::sample_reflection(vndf::Warp::polar, kCount, wo, alpha, {in.u_x.data(), in.u_y.data()},
                          {out, pdf.data(), weight.data()});
  expect("sample_reflection", 0xb7e0fe949b450aa9u, hash({&x, &y, &z, &pdf, &weight}));
  vndf::ReflectionOptions bounded;
  bounded.bounded = true;
  vndf::sample_reflection(vndf::Warp::spherical_cap, kCount, wo, alpha, {in.u_x.data(), in.u_y.data()},
                          {out, pdf.data(), weight.data()}, bounded);
  expect("bounded", 0x7e65f8134ac445c8u, hash({&x, &y, &z, &pdf, &weight}));
  vndf::evaluate_reflection(kCount, wo, wi, alpha, {weight.data(), pdf.data()});
  expect("evaluate_reflection", 0x1f9724c1add10314u, hash({&weight, &pdf}));
  vndf::pdf_normals(kCount, wo, wi, alpha, pdf.data());
  expect("pdf_normals", 0x430111124b26f8c0u, hash({&pdf}));
  vndf::sample_dielectric(vndf::Warp::concentric, kCount, wo, alpha, 1.5f,
                          {in.u_x.data(), in.u_y.data(), in.alpha_x.data()},
                          {out, pdf.data(), weight.data(), other.data()});
  expect("sample_dielectric", 0x2db44ad55e76903cu, hash({&x, &y, &z, &pdf, &weight, &other}));
  vndf::evaluate_dielectric(kCount, wo, wi, alpha, 1.5f, {weight.data(), pdf.data()});
  expect("evaluate_dielectric", 0x660ebc474da21c2fu, hash({&weight, &pdf}));
}

TEST_P(GoldenBits, Ellipsoid) {
  const Golden& in = inputs();
  std::vector<float> x(kCount), y(kCount), z(kCount), pdf(kCount), weight(kCount), side(kCount);
  const vndf::Columns3 wo{in.wo_x.data(), in.wo_y.data(), in.wo_z.data()}, wi{wo.y, wo.z, wo.x};
  const vndf::Columns2 alpha{in.alpha_x.data(), in.alpha_y.data()}, u{in.u_x.data(), in.u_y.data()};
  const vndf::Out3 out{x.data(), y.data(), z.data()};
  const vndf::Ellipsoid constants({0.25f, 0.0625f}, 0.5f, -0.375f, 2.f), turned(alpha, 0.f, 0.f, wo.y),
      tilted(alpha, wo.y, wo.z, wo.x);
  auto expect = [&](const char* what, std::uint64_t golden, std::uint64_t found) {
    EXPECT_EQ(found, golden) << std::hex << std::showbase << what << " gives " << found << ", set " << GetParam();
  };
  vndf::sample_normals(vndf::Warp::polar, kCount, wo, constants, u, out);
  expect("constants", 0x261e0145653b793fu, hash({&x, &y, &z}));
  vndf::sample_reflection(vndf::Warp::concentric, kCount, wo, turned, u, {out, pdf.data(), weight.data()});
  expect("turned", 0xd7ac0e8791ef8a39u, hash({&x, &y, &z, &pdf, &weight}));
  vndf::sample_reflection(vndf::Warp::spherical_cap, kCount, wo, tilted, u, {out, pdf.data(), weight.data()});
  expect("tilted", 0x424405dbf8914febu, hash({&x, &y, &z, &pdf, &weight}));
  vndf::evaluate_reflection(kCount, wo, wi, tilted, {weight.data(), pdf.data()});
  expect("evaluate_reflection", 0xf3796b6a5c11a531u, hash({&weight, &pdf}));
  vndf::sample_dielectric(vndf::Warp::polar, kCount, wo, tilted, 1.5f, {u.x, u.y, alpha.x},
                          {out, pdf.data(), weight.data(), side.data()});
  expect("sample_dielectric", 0xb92c971771b3a453u, hash({&x, &y, &z, &pdf, &weight, &side}));
}

std::vector<const char*> names() {
  std::vector<const char*> names;
  for (vndf::Isa isa : vndf::isas()) names.push_back(isa.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(EverySet, GoldenBits, testing::ValuesIn(names()),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
