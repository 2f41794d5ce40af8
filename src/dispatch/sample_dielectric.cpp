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

template <class Surface, class... Masking>
static void sample(Warp warp, std::size_t count, const DielectricIn& in, const Surface& surface,
                   const DielectricSamples& out, Masking... masking) noexcept {
  expect_written(count, out.wi.x, out.wi.y, out.wi.z, out.pdf, out.weight, out.side);
  call(of(table().warps, warp), count, in, surface, out, masking...);
}

void sample_dielectric(Warp warp, std::size_t count, const Columns3& wo, const Columns2& alpha, const Column& eta,
                       const Columns3& u, const DielectricSamples& out, Masking masking) noexcept {
  sample(warp, count, {wo, eta, u}, alpha, out, masking);
}
void sample_dielectric(Warp warp, std::size_t count, const Columns3& wo, const Ellipsoid& ellipsoid, const Column& eta,
                       const Columns3& u, const DielectricSamples& out) noexcept {
  sample(warp, count, {wo, eta, u}, ellipsoid, out);
}
void sample_dielectric(Warp warp, std::size_t count, const Columns3& wo, const Shape& shape, const Column& eta,
                       const Columns3& u, const DielectricSamples& out) noexcept {
  sample(warp, count, {wo, eta, u}, shape, out);
}

}  // namespace vndf
