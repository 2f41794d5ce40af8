// The public functions sample_reflection.
#include "dispatch.h"

namespace vndf {

#define VNDF_ISA(name, supported)                 \
  namespace name {                                \
  extern const ReflectionTable sample_reflection; \
  }
#include "isa_rows.h"

static const ReflectionTable& table() noexcept {
#define VNDF_ISA(name, supported) &name::sample_reflection,
  static constexpr const ReflectionTable* kRows[] = {
#include "isa_rows.h"
  };
  return *kRows[active_row()];
}

static void expect_written(std::size_t count, const ReflectionSamples& out) noexcept {
  expect_written(count, out.wi.x, out.wi.y, out.wi.z, out.pdf, out.weight);
}

template <class Surface, class... Masking>
static void sample(Warp warp, std::size_t count, const ReflectionIn& in, const Surface& surface,
                   const ReflectionSamples& out, Masking... masking) noexcept {
  expect_written(count, out);
  call(of(table().warps, warp), count, in, surface, out, masking...);
}

void sample_reflection(Warp warp, std::size_t count, const Columns3& wo, const Columns2& alpha, const Columns2& u,
                       const ReflectionSamples& out, const ReflectionOptions& options) noexcept {
  if (!options.bounded) return sample(warp, count, {wo, u}, alpha, out, options.masking);
  expect_written(count, out);
  FloatMode exact;
  of(of(table().bounded, warp), options.masking)(count, {wo, u}, alpha, out);
}
void sample_reflection(Warp warp, std::size_t count, const Columns3& wo, const Ellipsoid& ellipsoid, const Columns2& u,
                       const ReflectionSamples& out) noexcept {
  sample(warp, count, {wo, u}, ellipsoid, out);
}
void sample_reflection(Warp warp, std::size_t count, const Columns3& wo, const Shape& shape, const Columns2& u,
                       const ReflectionSamples& out) noexcept {
  sample(warp, count, {wo, u}, shape, out);
}

}  // namespace vndf
