// The shading step of metals and coats as one kernel of the renderer's own, from the library's lane functions: sampling
// and evaluation share what they load and what they know of the view. The rest is left to the library.
#include <vndf/lanes.h>

#include "bsdf.h"

namespace wavefront {

void library_shade_batch(Kind kind, const vndf::Ellipsoid& shape, const Sampling& sampling, Batch& batch);
void library_evaluate_batch(const Sampling& sampling, Batch& batch);

void shade_batch(Kind kind, const vndf::Ellipsoid& shape, const Sampling& sampling, Batch& b) {
  if (kind != Kind::conductor && kind != Kind::plastic) return library_shade_batch(kind, shape, sampling, b);
  namespace lanes = vndf::lanes;
  using F = xsimd::batch<float>;
  static_assert(kBatch % lanes::kWidth<F> == 0, "columns are as long as a batch, so the last vector may run on");
  for (std::uint32_t i = 0; i < b.count; i += lanes::kWidth<F>) {
    auto load = [i](auto& column) { return F::load_unaligned(column.data() + i); };
    auto load3 = [&](auto& c) { return lanes::Vec3<F>{load(c.x), load(c.y), load(c.z)}; };
    auto wo = load3(b.wo), light = load3(b.light);
    F mirror = xsimd::bitofsign(wo.z);  // two-sided
    wo.z ^= mirror, light.z ^= mirror;
    lanes::Vec2<F> alpha{load(b.alpha_x), load(b.alpha_y)}, u{load(b.u.x), load(b.u.y)};
    auto sample = lanes::sample_reflection<lanes::Concentric>(wo, alpha, u, lanes::kHeightCorrelated);
    auto lit = lanes::evaluate_reflection(wo, light, alpha, lanes::kHeightCorrelated);
    auto store = [i](F value, auto& column) { value.store_unaligned(column.data() + i); };
    store(sample.wi.x, b.wi.x), store(sample.wi.y, b.wi.y), store(sample.wi.z ^ mirror, b.wi.z);
    store(sample.pdf, b.pdf), store(sample.weight, b.weight);
    store(lanes::unit_normal(sample.normal).cos, b.cosine);
    store(lit.f_cos, b.light_f_cos), store(lit.pdf, b.light_pdf);
    store(lanes::half_cosine(wo, light), b.light_cosine);
  }
}

void evaluate_batch(const Sampling& sampling, Batch& b) {
  library_evaluate_batch(sampling, b);
}

}  // namespace wavefront
