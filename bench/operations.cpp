#include "operations.h"

#include <utility>

#include <vndf/ellipsoid.h>
#include <vndf/vndf.h>

#include "warps.h"

namespace bench {
namespace {

vndf::Columns3 wo(const Batch& b) {
  return {b.in[0], b.in[1], b.in[2]};
}
vndf::Columns2 alpha(const Batch& b) {
  return {b.in[3], b.in[4]};
}
vndf::Columns2 u(const Batch& b) {
  return {b.in[5], b.in[6]};
}
vndf::Columns3 light(const Batch& b) {
  return {b.in[11], b.in[12], b.in[13]};
}
vndf::Columns3 light_on_both_sides(const Batch& b) {
  return {b.in[11], b.in[12], b.in[14]};
}
vndf::Out3 wm(const Batch& b) {
  return {b.out[0], b.out[1], b.out[2]};
}
vndf::Out3 wi(const Batch& b) {
  return {b.out[3], b.out[4], b.out[5]};
}

Call sample_normals(vndf::Warp warp) {
  return [warp](const Batch& b) { vndf::sample_normals(warp, b.count, wo(b), alpha(b), u(b), wm(b)); };
}

// Ellipsoids: five constants, theta_z per lane, five columns.
struct EllipsoidKind {
  const char* name;
  int columns;  // read
  vndf::Ellipsoid (*of)(const Batch&);
};
constexpr EllipsoidKind kEllipsoids[] = {
    {"one_shape", 0,
     [](const Batch&) {
       return vndf::Ellipsoid({0.2f, 0.5f}, 0.3f, -0.2f, 0.5f);
     }},
    {"turned", 3, [](const Batch& b) { return vndf::Ellipsoid(alpha(b), 0.f, 0.f, b.in[10]); }},
    {"tilted", 5, [](const Batch& b) { return vndf::Ellipsoid(alpha(b), b.in[8], b.in[9], b.in[10]); }},
};
Call sample_normals(vndf::Warp warp, const EllipsoidKind& kind) {
  return [=](const Batch& b) { vndf::sample_normals(warp, b.count, wo(b), kind.of(b), u(b), wm(b)); };
}
Call sample_reflection(vndf::Warp warp, const EllipsoidKind& kind) {
  return [=](const Batch& b) {
    vndf::sample_reflection(warp, b.count, wo(b), kind.of(b), u(b), {wi(b), b.out[6], b.out[7]});
  };
}

Call sample_disk(vndf::DiskMap map) {
  return [map](const Batch& b) { vndf::sample_disk(map, b.count, u(b), {b.out[0], b.out[1]}); };
}

Call sample_reflection(vndf::Warp warp, bool bounded = false) {
  vndf::ReflectionOptions options;
  options.bounded = bounded;
  return [=](const Batch& b) {
    vndf::sample_reflection(warp, b.count, wo(b), alpha(b), u(b), {wi(b), b.out[6], b.out[7]}, options);
  };
}

/// What sample_reflection does, in three passes: normals, reflected directions, their density and weight. The loops of
/// this file are compiled for the baseline of the processor's architecture.
Call separate_reflection(vndf::Warp warp) {
  return [warp](const Batch& b) {
    vndf::sample_normals(warp, b.count, wo(b), alpha(b), u(b), wm(b));
    for (std::size_t i = 0; i < b.count; ++i) {
      float twice_cos = 2 * (b.in[0][i] * b.out[0][i] + b.in[1][i] * b.out[1][i] + b.in[2][i] * b.out[2][i]);
      for (int c = 0; c < 3; ++c) b.out[3 + c][i] = twice_cos * b.out[c][i] - b.in[c][i];
    }
    vndf::evaluate_reflection(b.count, wo(b), {b.out[3], b.out[4], b.out[5]}, alpha(b), {b.out[7], b.out[6]});
    for (std::size_t i = 0; i < b.count; ++i) b.out[7][i] = b.out[6][i] > 0 ? b.out[7][i] / b.out[6][i] : 0;
  };
}

Call evaluate_reflection() {
  return [](const Batch& b) { vndf::evaluate_reflection(b.count, wo(b), light(b), alpha(b), {b.out[6], b.out[7]}); };
}
Call evaluate_reflection(const EllipsoidKind& kind) {
  return [=](const Batch& b) { vndf::evaluate_reflection(b.count, wo(b), light(b), kind.of(b), {b.out[6], b.out[7]}); };
}
Call pdf_normals() {
  return [](const Batch& b) { vndf::pdf_normals(b.count, wo(b), light(b), alpha(b), b.out[6]); };
}

constexpr float kEta = 1.5f;
Call sample_dielectric(vndf::Warp warp) {
  return [warp](const Batch& b) {
    vndf::sample_dielectric(warp, b.count, wo(b), alpha(b), kEta, {b.in[5], b.in[6], b.in[7]},
                            {wi(b), b.out[6], b.out[7], b.out[0]});
  };
}
Call evaluate_dielectric() {
  return [](const Batch& b) {
    vndf::evaluate_dielectric(b.count, wo(b), light(b), alpha(b), kEta, {b.out[6], b.out[7]});
  };
}

// Options, of the concentric warp and for the evaluations; those of dielectrics with lights on both sides.
Call sample_reflection(const vndf::ReflectionOptions& options) {
  return [=](const Batch& b) {
    vndf::sample_reflection(vndf::Warp::concentric, b.count, wo(b), alpha(b), u(b), {wi(b), b.out[6], b.out[7]},
                            options);
  };
}
Call sample_reflection_all_outputs() {
  return [](const Batch& b) {
    vndf::sample_reflection(vndf::Warp::concentric, b.count, wo(b), alpha(b), u(b),
                            {wi(b), b.out[6], b.out[7], wm(b), b.out[9]});
  };
}
Call evaluate_reflection_all_outputs() {
  return [](const Batch& b) {
    vndf::evaluate_reflection(b.count, wo(b), light(b), alpha(b), {b.out[6], b.out[7], b.out[9]});
  };
}
struct DielectricKind {
  const char* name;
  vndf::AcrossMasking across;
  bool radiance;
  bool given;  // the probability of reflection, one value
};
constexpr DielectricKind kDielectrics[] = {
    {"_as_reflection", vndf::AcrossMasking::as_reflection, false, false},
    {"_correlated_across", vndf::AcrossMasking::height_correlated, false, false},
    {"_radiance", vndf::AcrossMasking::separable, true, false},
    {"_probability", vndf::AcrossMasking::separable, false, true},
};
vndf::DielectricOptions options_of(const DielectricKind& kind) {
  vndf::DielectricOptions options;
  options.across = kind.across;
  options.radiance = kind.radiance;
  if (kind.given) options.reflection_probability = 0.5f;
  return options;
}
Call sample_dielectric(const DielectricKind& kind) {
  return [options = options_of(kind)](const Batch& b) {
    vndf::sample_dielectric(vndf::Warp::concentric, b.count, wo(b), alpha(b), kEta, {b.in[5], b.in[6], b.in[7]},
                            {wi(b), b.out[6], b.out[7], b.out[8]}, options);
  };
}
Call sample_dielectric_all_outputs() {
  return [](const Batch& b) {
    vndf::sample_dielectric(vndf::Warp::concentric, b.count, wo(b), alpha(b), kEta, {b.in[5], b.in[6], b.in[7]},
                            {wi(b), b.out[6], b.out[7], b.out[8], wm(b), b.out[9], b.out[10], b.out[11]});
  };
}
Call evaluate_dielectric(const vndf::DielectricOptions& options) {
  return [=](const Batch& b) {
    vndf::evaluate_dielectric(b.count, wo(b), light_on_both_sides(b), alpha(b), kEta, {b.out[6], b.out[7]}, options);
  };
}

}  // namespace

std::vector<Operation> operations() {
  std::vector<Operation> all;
  for (const vndf::Isa& isa : vndf::isas()) {
    if (!isa.supported) continue;
    auto add = [&](const std::string& name, int columns, Call call) {
      all.push_back({name + "/" + isa.name, isa.name, columns, std::move(call)});
    };
    for (auto [warp, name] : kWarps) add(std::string("sample_normals/") + name, 10, sample_normals(warp));
    for (const EllipsoidKind& kind : kEllipsoids) {
      std::string suffix = std::string("_") + kind.name + "/";
      for (auto [warp, name] : kWarps) {
        add("sample_normals" + suffix + name, 8 + kind.columns, sample_normals(warp, kind));
        add("sample_reflection" + suffix + name, 10 + kind.columns, sample_reflection(warp, kind));
      }
      add("evaluate_reflection" + suffix + "none", 8 + kind.columns, evaluate_reflection(kind));
    }
    add("sample_disk/polar", 4, sample_disk(vndf::DiskMap::polar));
    add("sample_disk/concentric", 4, sample_disk(vndf::DiskMap::concentric));
    for (auto [warp, name] : kWarps) add(std::string("sample_reflection/") + name, 12, sample_reflection(warp));
    add("sample_reflection_bounded/spherical_cap", 12, sample_reflection(vndf::Warp::spherical_cap, true));
    add("separate_reflection/polar", 12, separate_reflection(vndf::Warp::polar));
    add("evaluate_reflection/none", 10, evaluate_reflection());
    add("pdf_normals/none", 9, pdf_normals());
    for (auto [warp, name] : kWarps) add(std::string("sample_dielectric/") + name, 14, sample_dielectric(warp));
    add("evaluate_dielectric/none", 10, evaluate_dielectric());

    auto add_option = [&](const std::string& name, int columns, Call call) {
      add(name, columns, std::move(call));
      all.back().once = true;
    };
    add_option("sample_reflection_two_sided/concentric", 12, sample_reflection({{}, false, true}));
    add_option("sample_reflection_all_outputs/concentric", 16, sample_reflection_all_outputs());
    add_option("evaluate_reflection_all_outputs/none", 11, evaluate_reflection_all_outputs());
    for (const DielectricKind& kind : kDielectrics) {
      add_option(std::string("sample_dielectric") + kind.name + "/concentric", 14, sample_dielectric(kind));
      add_option(std::string("evaluate_dielectric") + kind.name + "/none", 10, evaluate_dielectric(options_of(kind)));
    }
    add_option("evaluate_dielectric_both_sides/none", 10, evaluate_dielectric(vndf::DielectricOptions{}));
    add_option("sample_dielectric_all_outputs/concentric", 20, sample_dielectric_all_outputs());
  }
  return all;
}

bool set_isa(const Operation& operation) {
  return !operation.isa || vndf::set_isa(operation.isa) == vndf::IsaError::none;
}

}  // namespace bench

const bench::Module vndf_module{bench::operations, bench::set_isa};
