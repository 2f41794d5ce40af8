// Every public function, warp and kind of surface, for hosts that need all of them. The inputs are made with integers
// and powers of two, so that a host's own flags cannot change them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <vndf/ellipsoid.h>

struct EveryFunction {
  struct Call {
    std::string name;
    std::function<void()> run;  ///< writes the columns of output()
  };
  std::size_t count;
  std::vector<std::vector<float>> in, out;
  /// On a line of the cache, where large batches are written past it.
  float* output(std::size_t c) {
    return out[c].data() + (64 - reinterpret_cast<std::uintptr_t>(out[c].data()) % 64) % 64 / sizeof(float);
  }
  vndf::Shape shape;
  std::vector<Call> calls;

  explicit EveryFunction(std::size_t count_) : count(count_), in(14), out(9, std::vector<float>(count + 16)) {
    std::uint32_t state = 1;
    auto unit = [&] {  // in [0, 1), 24 bits
      state = state * 1664525u + 1013904223u;
      return static_cast<float>(state >> 8) * 0x1p-24f;
    };
    for (std::size_t i = 0; i < count; ++i) {
      const float scale = i % 2 ? 1.f : 0x1p-6f;
      for (std::size_t c = 0; c < 6; ++c) in[c].push_back(2 * unit() - 1);               // two directions
      for (std::size_t c = 6; c < 8; ++c) in[c].push_back((unit() + 0x1p-24f) * scale);  // alpha
      for (std::size_t c = 8; c < 11; ++c) in[c].push_back(unit());                      // u
      for (std::size_t c = 11; c < 14; ++c) in[c].push_back(unit());                     // angles
    }
    const float a[9] = {0.5f, 0.125f, 0.25f, -0.125f, 0.25f, 0.5f, 0.25f, -0.25f, 1.f};
    (void)vndf::make_shape(a, shape);
    list();
  }

 private:
  vndf::Columns3 columns(std::size_t c) const { return {in[c].data(), in[c + 1].data(), in[c + 2].data()}; }

  void list() {
    const vndf::Columns3 wo = columns(0), wi = columns(3), u3 = columns(8);
    const vndf::Columns2 alpha{in[6].data(), in[7].data()}, u{in[8].data(), in[9].data()};
    auto p = [this](std::size_t c) { return output(c); };
    const vndf::Out3 first{p(0), p(1), p(2)};
    const vndf::Evaluations evaluations{p(0), p(1)};
    const vndf::ReflectionSamples reflections{first, p(3), p(4), {p(5), p(6), p(7)}, p(8)};
    const vndf::DielectricSamples dielectrics{first, p(3), p(4), p(5)};
    const std::size_t n = count;
    auto add = [this](const std::string& name, auto run) { calls.push_back({name, run}); };

    auto surface = [&](const std::string& kind, auto s) {
      for (vndf::Warp warp : {vndf::Warp::polar, vndf::Warp::concentric, vndf::Warp::spherical_cap}) {
        const std::string end = "_" + kind + "_" + std::to_string(static_cast<int>(warp));
        add("sample_normals" + end, [=] { vndf::sample_normals(warp, n, wo, s, u, first); });
        add("sample_reflection" + end, [=] { vndf::sample_reflection(warp, n, wo, s, u, reflections); });
        add("sample_dielectric" + end, [=] { vndf::sample_dielectric(warp, n, wo, s, 1.5f, u3, dielectrics); });
      }
      add("pdf_normals_" + kind, [=] { vndf::pdf_normals(n, wo, wi, s, evaluations.pdf); });
      add("evaluate_reflection_" + kind, [=] { vndf::evaluate_reflection(n, wo, wi, s, evaluations); });
      add("evaluate_dielectric_" + kind, [=] { vndf::evaluate_dielectric(n, wo, wi, s, 1.5f, evaluations); });
    };
    surface("alpha", alpha);
    surface("turned", vndf::Ellipsoid{alpha, 0.f, 0.f, in[11].data()});
    surface("leaning", vndf::Ellipsoid{alpha, in[11].data(), in[12].data(), in[13].data()});
    surface("one", vndf::Ellipsoid{{0.25f, 0.5f}, 0.125f, 0.25f, 0.5f});
    surface("shape", shape);
    for (int warp = 0; warp < 3; ++warp)
      add("sample_reflection_bounded_" + std::to_string(warp), [=] {
        vndf::ReflectionOptions options;
        options.bounded = true;
        vndf::sample_reflection(static_cast<vndf::Warp>(warp), n, wo, alpha, u, reflections, options);
      });
    for (vndf::DiskMap map : {vndf::DiskMap::polar, vndf::DiskMap::concentric})
      add("sample_disk_" + std::to_string(static_cast<int>(map)), [=] {
        vndf::sample_disk(map, n, u, {evaluations.f_cos, evaluations.pdf});
      });
  }
};
