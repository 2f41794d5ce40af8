// The public functions sample_dielectric.
#include "dispatch.h"

namespace vndf {

#define VNDF_ISA(name, supported)                 \
  namespace name {                                \
  extern const DielectricTable sample_dielectric; \
  }
#include "isa_rows.h"

static const DielectricTable& table() noexcept {
#define VNDF_ISA(name, supported) &name::sample_dielectric,
  static constexpr const DielectricTable* kRows[] = {
#include "isa_rows.h"
  };
  return *kRows[active_row()];
}

template <class Surface>
static void sample(Warp warp, std::size_t count, const DielectricIn& in, const Surface& surface,
                   const DielectricSamples& out) noexcept {
  expect_written(count, out.wi.x, out.wi.y, out.wi.z, out.pdf, out.weight, out.side);
  expect_given(count, in.wo, in.eta, in.u, surface);
  call(of(table().warps, warp), count, in, surface, out);
}

void sample_dielectric(Warp warp, std::size_t count, const Columns3& wo, const Columns2& alpha, const Column& eta,
                       const Columns3& u, const DielectricSamples& out, const DielectricOptions& options) noexcept {
  sample(warp, count, {wo, eta, u, asked_of(count, options)}, alpha, out);
}
void sample_dielectric(Warp warp, std::size_t count, const Columns3& wo, const Ellipsoid& ellipsoid, const Column& eta,
                       const Columns3& u, const DielectricSamples& out, const DielectricOptions& options) noexcept {
  sample(warp, count, {wo, eta, u, asked_of_ellipsoid(count, options)}, ellipsoid, out);
}
void sample_dielectric(Warp warp, std::size_t count, const Columns3& wo, const Shape& shape, const Column& eta,
                       const Columns3& u, const DielectricSamples& out, const DielectricOptions& options) noexcept {
  sample(warp, count, {wo, eta, u, asked_of_ellipsoid(count, options)}, shape, out);
}

}  // namespace vndf
