// The shading step of metals and coats as one kernel of the renderer's own, from the library's lane functions: sampling
// and evaluation share what they load and what they know of the view. The rest is left to the library.
#include <vndf/lanes.h>

#include "bsdf.h"

namespace wavefront {

void library_shade_batch(Kind kind, const Sampling& sampling, Batch& batch);
void library_evaluate_coat(const Sampling& sampling, Batch& batch);

void shade_batch(Kind kind, const Sampling& sampling, Batch& b) {
  if (kind != Kind::conductor && kind != Kind::plastic) return library_shade_batch(kind, sampling, b);
  namespace lanes = vndf::lanes;
  using F = xsimd::batch<float>;
  static_assert(kBatch % lanes::kWidth<F> == 0, "columns are as long as a batch, so the last vector may run on");
  for (std::uint32_t i = 0; i < b.count; i += lanes::kWidth<F>) {
    auto load = [i](auto& column) { return F::load_unaligned(column + i); };
    auto load3 = [&](auto& c) { return lanes::Vec3<F>{load(c.x), load(c.y), load(c.z)}; };
    auto wo = load3(b.wo), light = load3(b.light.w);
    F mirror = xsimd::bitofsign(wo.z);  // two-sided
    wo.z ^= mirror, light.z ^= mirror;
    lanes::Vec2<F> alpha{load(b.alpha_x), load(b.alpha_y)}, u{load(b.u.x), load(b.u.y)};
    auto sample = lanes::sample_reflection<lanes::Concentric>(wo, alpha, u, lanes::kHeightCorrelated);
    auto lit = lanes::evaluate_reflection(wo, light, alpha, lanes::kHeightCorrelated);
    auto store = [i](F value, auto& column) { value.store_unaligned(column + i); };
    store(sample.wi.x, b.next.w.x), store(sample.wi.y, b.next.w.y), store(sample.wi.z ^ mirror, b.next.w.z);
    store(sample.pdf, b.next.pdf), store(sample.weight, b.next.value);
    store(lanes::unit_normal(sample.normal).cos, b.next.cosine);
    store(lit.f_cos, b.light.value), store(lit.pdf, b.light.pdf);
    store(lanes::half_cosine(wo, light), b.light.cosine);
  }
}

void evaluate_coat(const Sampling& sampling, Batch& b) {
  library_evaluate_coat(sampling, b);
}

}  // namespace wavefront
