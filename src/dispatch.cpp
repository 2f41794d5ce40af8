// Picks the instruction set at run time and forwards the public functions to its kernels. Sees no SIMD type.
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "kernel_table.h"

namespace vndf {

// One line per row of cmake/isa.cmake: VNDF_ISA(name, supported).
#define VNDF_ISA(name, supported) extern const KernelTable kernels_##name;
#include "isa_rows.h"
#undef VNDF_ISA

namespace {

struct Implementation {
  const char* name;
  bool (*supported)();
  const KernelTable* kernels;
};

#define VNDF_ISA(name, supported) {#name, +[]() -> bool { return supported; }, &kernels_##name},
constexpr Implementation kImplementations[] = {
#include "isa_rows.h"
};
#undef VNDF_ISA

constexpr std::size_t kCount = sizeof kImplementations / sizeof kImplementations[0];

std::atomic<const Implementation*> chosen{nullptr};

IsaError find(const char* name, const Implementation*& found) noexcept {
  for (const Implementation& candidate : kImplementations)
    if (name && std::strcmp(name, candidate.name) == 0) {
      if (!candidate.supported()) return IsaError::unsupported;
      found = &candidate;
      return IsaError::none;
    }
  return IsaError::unknown;
}

/// Out of line, so that a batch pays for one load, one test and one indirect call.
__attribute__((noinline, cold)) const Implementation* choose() noexcept {
  const Implementation* best = &kImplementations[0];
  for (const Implementation& candidate : kImplementations)
    if (candidate.supported()) best = &candidate;
  bool complain = false;
  IsaError error = IsaError::none;
  const char* name = std::getenv("VNDF_ISA");
  if (name && *name) {
    error = find(name, best);
    complain = error != IsaError::none;
  }
  // Threads that come here together agree on one choice, and the one that made it speaks.
  const Implementation* expected = nullptr;
  if (!chosen.compare_exchange_strong(expected, best, std::memory_order_acq_rel)) return expected;
  if (complain) std::fprintf(stderr, "vndf: VNDF_ISA=%s ignored, using %s: %s\n", name, best->name, message(error));
  return best;
}

const Implementation& active() noexcept {
  const Implementation* implementation = chosen.load(std::memory_order_acquire);
  return implementation ? *implementation : *choose();
}

}  // namespace

namespace {

const SurfaceKernels<Columns2>& plain(ReflectionOptions options = {}) {
  const KernelTable& kernels = *active().kernels;
  return (options.bounded ? kernels.bounded : kernels.plain)[static_cast<int>(options.masking)];
}

}  // namespace

void sample_normals(Warp warp, std::size_t count, const Columns3& wo, const Columns2& alpha, const Columns2& u,
                    const Out3& wm) noexcept {
  plain().sample_normals[static_cast<int>(warp)](count, wo, alpha, u, wm);
}

void sample_disk(DiskMap map, std::size_t count, const Columns2& u, const Out2& t) noexcept {
  active().kernels->sample_disk[static_cast<int>(map)](count, u, t);
}

void sample_reflection(Warp warp, std::size_t count, const Columns3& wo, const Columns2& alpha, const Columns2& u,
                       const ReflectionSamples& out, const ReflectionOptions& options) noexcept {
  plain(options).sample_reflection[static_cast<int>(warp)](count, wo, alpha, u, out);
}

void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const Columns2& alpha,
                         const Evaluations& out, const ReflectionOptions& options) noexcept {
  plain(options).evaluate_reflection(count, wo, wi, alpha, out);
}

void pdf_normals(std::size_t count, const Columns3& wo, const Columns3& wm, const Columns2& alpha,
                 float* pdf) noexcept {
  plain().pdf_normals(count, wo, wm, alpha, pdf);
}

void sample_dielectric(Warp warp, std::size_t count, const Columns3& wo, const Columns2& alpha, const Column& eta,
                       const Columns3& u, const DielectricSamples& out, Masking masking) noexcept {
  plain({masking}).sample_dielectric[static_cast<int>(warp)](count, wo, alpha, eta, u, out);
}

void evaluate_dielectric(std::size_t count, const Columns3& wo, const Columns3& wi, const Columns2& alpha,
                         const Column& eta, const Evaluations& out, Masking masking) noexcept {
  plain({masking}).evaluate_dielectric(count, wo, wi, alpha, eta, out);
}

namespace {

bool constant(const Column& column) {
  return !column.data;
}
bool zero(const Column& column) {
  return constant(column) && column.value == 0;
}

/// Calls f(kernels, shape) with the cheapest kernels for the ellipsoid.
template <class F>
void with_cheapest(const Ellipsoid& e, F f) {
  const KernelTable& kernels = *active().kernels;
  bool turned = zero(e.theta_x) && zero(e.theta_y);
  if (turned && zero(e.theta_z))
    f(kernels.plain[static_cast<int>(Masking::separable)], e.alpha);  // what eq. 6 becomes without theta_x and theta_y
  else if (constant(e.alpha.x) && constant(e.alpha.y) && constant(e.theta_x) && constant(e.theta_y) &&
           constant(e.theta_z))
    f(kernels.one_shape, shape_of(e));
  else if (turned)
    f(kernels.turned, e);
  else
    f(kernels.tilted, e);
}

}  // namespace

void sample_normals(Warp warp, std::size_t count, const Columns3& wo, const Shape& shape, const Columns2& u,
                    const Out3& wm) noexcept {
  active().kernels->one_shape.sample_normals[static_cast<int>(warp)](count, wo, shape, u, wm);
}
void sample_normals(Warp warp, std::size_t count, const Columns3& wo, const Ellipsoid& ellipsoid, const Columns2& u,
                    const Out3& wm) noexcept {
  with_cheapest(ellipsoid, [&](const auto& kernels, const auto& shape) {
    kernels.sample_normals[static_cast<int>(warp)](count, wo, shape, u, wm);
  });
}

void sample_reflection(Warp warp, std::size_t count, const Columns3& wo, const Shape& shape, const Columns2& u,
                       const ReflectionSamples& out) noexcept {
  active().kernels->one_shape.sample_reflection[static_cast<int>(warp)](count, wo, shape, u, out);
}
void sample_reflection(Warp warp, std::size_t count, const Columns3& wo, const Ellipsoid& ellipsoid, const Columns2& u,
                       const ReflectionSamples& out) noexcept {
  with_cheapest(ellipsoid, [&](const auto& kernels, const auto& shape) {
    kernels.sample_reflection[static_cast<int>(warp)](count, wo, shape, u, out);
  });
}

void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const Shape& shape,
                         const Evaluations& out) noexcept {
  active().kernels->one_shape.evaluate_reflection(count, wo, wi, shape, out);
}
void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const Ellipsoid& ellipsoid,
                         const Evaluations& out) noexcept {
  with_cheapest(ellipsoid, [&](const auto& kernels, const auto& shape) {
    kernels.evaluate_reflection(count, wo, wi, shape, out);
  });
}

void pdf_normals(std::size_t count, const Columns3& wo, const Columns3& wm, const Shape& shape, float* pdf) noexcept {
  active().kernels->one_shape.pdf_normals(count, wo, wm, shape, pdf);
}
void pdf_normals(std::size_t count, const Columns3& wo, const Columns3& wm, const Ellipsoid& ellipsoid,
                 float* pdf) noexcept {
  with_cheapest(ellipsoid,
                [&](const auto& kernels, const auto& shape) { kernels.pdf_normals(count, wo, wm, shape, pdf); });
}

void sample_dielectric(Warp warp, std::size_t count, const Columns3& wo, const Shape& shape, const Column& eta,
                       const Columns3& u, const DielectricSamples& out) noexcept {
  active().kernels->one_shape.sample_dielectric[static_cast<int>(warp)](count, wo, shape, eta, u, out);
}
void sample_dielectric(Warp warp, std::size_t count, const Columns3& wo, const Ellipsoid& ellipsoid, const Column& eta,
                       const Columns3& u, const DielectricSamples& out) noexcept {
  with_cheapest(ellipsoid, [&](const auto& kernels, const auto& shape) {
    kernels.sample_dielectric[static_cast<int>(warp)](count, wo, shape, eta, u, out);
  });
}

void evaluate_dielectric(std::size_t count, const Columns3& wo, const Columns3& wi, const Shape& shape,
                         const Column& eta, const Evaluations& out) noexcept {
  active().kernels->one_shape.evaluate_dielectric(count, wo, wi, shape, eta, out);
}
void evaluate_dielectric(std::size_t count, const Columns3& wo, const Columns3& wi, const Ellipsoid& ellipsoid,
                         const Column& eta, const Evaluations& out) noexcept {
  with_cheapest(ellipsoid, [&](const auto& kernels, const auto& shape) {
    kernels.evaluate_dielectric(count, wo, wi, shape, eta, out);
  });
}

Isas isas() noexcept {
  struct List {
    Isa rows[kCount];
    List() {
      for (std::size_t i = 0; i < kCount; ++i) rows[i] = {kImplementations[i].name, kImplementations[i].supported()};
    }
  };
  static const List list;
  return {list.rows, list.rows + kCount};
}

const char* active_isa() noexcept {
  return active().name;
}

IsaError set_isa(const char* name) noexcept {
  const Implementation* found = nullptr;
  IsaError error = find(name, found);
  if (error == IsaError::none) chosen.store(found, std::memory_order_release);
  return error;
}

const char* message(IsaError error) noexcept {
  switch (error) {
    case IsaError::none:
      return "no error";
    case IsaError::unknown:
      return "no such instruction set; compiled in:" VNDF_ISA_NAMES;
    case IsaError::unsupported:
      return "this processor or operating system does not support it; vndf::isas() lists what they support";
  }
  return "not an error of this library";
}

}  // namespace vndf
