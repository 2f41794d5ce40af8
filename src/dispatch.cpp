// Picks the instruction set at run time and forwards the public functions to its kernels. Sees no SIMD type.
#include <atomic>
#include <cassert>
#include <cstdint>
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

/// The kernel of an enumerator, which must be one.
template <class Kernel, std::size_t N, class Enum>
const Kernel& of(const Kernel (&kernels)[N], Enum which) noexcept {
  assert(static_cast<std::size_t>(which) < N);
  return kernels[static_cast<std::size_t>(which)];
}

/// A count that columns of floats can have, and columns to write it to.
template <class... Columns>
void expect_written([[maybe_unused]] std::size_t count, [[maybe_unused]] Columns... columns) noexcept {
  assert(count <= PTRDIFF_MAX / sizeof(float));
  assert(count == 0 || (columns && ...));
}
void expect_written(std::size_t count, const Out3& out) noexcept {
  expect_written(count, out.x, out.y, out.z);
}
void expect_written(std::size_t count, const ReflectionSamples& out) noexcept {
  expect_written(count, out.wi.x, out.wi.y, out.wi.z, out.pdf, out.weight);
}
void expect_written(std::size_t count, const Evaluations& out) noexcept {
  expect_written(count, out.f_cos, out.pdf);
}
void expect_written(std::size_t count, const DielectricSamples& out) noexcept {
  expect_written(count, out.wi.x, out.wi.y, out.wi.z, out.pdf, out.weight, out.side);
}

const SurfaceKernels<Columns2>& plain(ReflectionOptions options = {}) {
  const KernelTable& kernels = *active().kernels;
  return of(options.bounded ? kernels.bounded : kernels.plain, options.masking);
}

}  // namespace

void sample_normals(Warp warp, std::size_t count, const Columns3& wo, const Columns2& alpha, const Columns2& u,
                    const Out3& wm) noexcept {
  expect_written(count, wm);
  of(plain().sample_normals, warp)(count, wo, alpha, u, wm);
}

void sample_disk(DiskMap map, std::size_t count, const Columns2& u, const Out2& t) noexcept {
  expect_written(count, t.x, t.y);
  of(active().kernels->sample_disk, map)(count, u, t);
}

void sample_reflection(Warp warp, std::size_t count, const Columns3& wo, const Columns2& alpha, const Columns2& u,
                       const ReflectionSamples& out, const ReflectionOptions& options) noexcept {
  expect_written(count, out);
  of(plain(options).sample_reflection, warp)(count, wo, alpha, u, out);
}

void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const Columns2& alpha,
                         const Evaluations& out, const ReflectionOptions& options) noexcept {
  expect_written(count, out);
  plain(options).evaluate_reflection(count, wo, wi, alpha, out);
}

void pdf_normals(std::size_t count, const Columns3& wo, const Columns3& wm, const Columns2& alpha,
                 float* pdf) noexcept {
  expect_written(count, pdf);
  plain().pdf_normals(count, wo, wm, alpha, pdf);
}

void sample_dielectric(Warp warp, std::size_t count, const Columns3& wo, const Columns2& alpha, const Column& eta,
                       const Columns3& u, const DielectricSamples& out, Masking masking) noexcept {
  expect_written(count, out);
  of(plain({masking}).sample_dielectric, warp)(count, wo, alpha, eta, u, out);
}

void evaluate_dielectric(std::size_t count, const Columns3& wo, const Columns3& wi, const Columns2& alpha,
                         const Column& eta, const Evaluations& out, Masking masking) noexcept {
  expect_written(count, out);
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
    f(of(kernels.plain, Masking::separable), e.alpha);  // what eq. 6 becomes without theta_x and theta_y
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
  expect_written(count, wm);
  of(active().kernels->one_shape.sample_normals, warp)(count, wo, shape, u, wm);
}
void sample_normals(Warp warp, std::size_t count, const Columns3& wo, const Ellipsoid& ellipsoid, const Columns2& u,
                    const Out3& wm) noexcept {
  expect_written(count, wm);
  with_cheapest(ellipsoid, [&](const auto& kernels, const auto& shape) {
    of(kernels.sample_normals, warp)(count, wo, shape, u, wm);
  });
}

void sample_reflection(Warp warp, std::size_t count, const Columns3& wo, const Shape& shape, const Columns2& u,
                       const ReflectionSamples& out) noexcept {
  expect_written(count, out);
  of(active().kernels->one_shape.sample_reflection, warp)(count, wo, shape, u, out);
}
void sample_reflection(Warp warp, std::size_t count, const Columns3& wo, const Ellipsoid& ellipsoid, const Columns2& u,
                       const ReflectionSamples& out) noexcept {
  expect_written(count, out);
  with_cheapest(ellipsoid, [&](const auto& kernels, const auto& shape) {
    of(kernels.sample_reflection, warp)(count, wo, shape, u, out);
  });
}

void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const Shape& shape,
                         const Evaluations& out) noexcept {
  expect_written(count, out);
  active().kernels->one_shape.evaluate_reflection(count, wo, wi, shape, out);
}
void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const Ellipsoid& ellipsoid,
                         const Evaluations& out) noexcept {
  expect_written(count, out);
  with_cheapest(ellipsoid, [&](const auto& kernels, const auto& shape) {
    kernels.evaluate_reflection(count, wo, wi, shape, out);
  });
}

void pdf_normals(std::size_t count, const Columns3& wo, const Columns3& wm, const Shape& shape, float* pdf) noexcept {
  expect_written(count, pdf);
  active().kernels->one_shape.pdf_normals(count, wo, wm, shape, pdf);
}
void pdf_normals(std::size_t count, const Columns3& wo, const Columns3& wm, const Ellipsoid& ellipsoid,
                 float* pdf) noexcept {
  expect_written(count, pdf);
  with_cheapest(ellipsoid,
                [&](const auto& kernels, const auto& shape) { kernels.pdf_normals(count, wo, wm, shape, pdf); });
}

void sample_dielectric(Warp warp, std::size_t count, const Columns3& wo, const Shape& shape, const Column& eta,
                       const Columns3& u, const DielectricSamples& out) noexcept {
  expect_written(count, out);
  of(active().kernels->one_shape.sample_dielectric, warp)(count, wo, shape, eta, u, out);
}
void sample_dielectric(Warp warp, std::size_t count, const Columns3& wo, const Ellipsoid& ellipsoid, const Column& eta,
                       const Columns3& u, const DielectricSamples& out) noexcept {
  expect_written(count, out);
  with_cheapest(ellipsoid, [&](const auto& kernels, const auto& shape) {
    of(kernels.sample_dielectric, warp)(count, wo, shape, eta, u, out);
  });
}

void evaluate_dielectric(std::size_t count, const Columns3& wo, const Columns3& wi, const Shape& shape,
                         const Column& eta, const Evaluations& out) noexcept {
  expect_written(count, out);
  active().kernels->one_shape.evaluate_dielectric(count, wo, wi, shape, eta, out);
}
void evaluate_dielectric(std::size_t count, const Columns3& wo, const Columns3& wi, const Ellipsoid& ellipsoid,
                         const Column& eta, const Evaluations& out) noexcept {
  expect_written(count, out);
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
