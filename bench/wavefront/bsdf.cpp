#include "bsdf.h"

#include <vndf/ellipsoid.h>

namespace wavefront {
namespace {

/// Sheets are seen from both sides, and normal maps turn normals away from the view.
vndf::ReflectionOptions two_sided(bool bounded) {
  return {vndf::Masking::height_correlated, bounded, true};
}

/// Normals by their own distribution, as before Heitz and d'Eon 2014. They are the visible ones of a view along n, for
/// which G1 is 1 and wo.wm is wm.z.
const vndf::Columns3 kAlongN{0.f, 0.f, 1.f};

template <class Microfacets>
void evaluate_by_ndf(const Microfacets& surface, Batch& b, Directions& d) {
  vndf::evaluate_reflection(b.count, b.wo, d.w, surface, {d.value, d.pdf, d.cosine}, two_sided(false));
  for (std::uint32_t i = 0; i < b.count; ++i) {
    Vec3 h = b.wo.get(i) + d.w.get(i);
    h.z = std::abs(h.z);  // seen from below, all is mirrored
    b.scratch.set(i, (1.f / std::max(h.length(), 1e-15f)) * h);
  }
  vndf::pdf_normals(b.count, kAlongN, b.scratch, surface, b.spare);
  for (std::uint32_t i = 0; i < b.count; ++i)
    if (d.pdf[i] > 0.f) d.pdf[i] = b.spare[i] / (4.f * std::max(d.cosine[i], 1e-15f));
}
template <class Microfacets>
void shade_by_ndf(const Microfacets& surface, vndf::Warp warp, Batch& b) {
  Directions& next = b.next;
  vndf::sample_normals(warp, b.count, kAlongN, surface, {b.u.x, b.u.y}, b.scratch);
  for (std::uint32_t i = 0; i < b.count; ++i) {
    Vec3 wo = b.wo.get(i), wm = b.scratch.get(i);
    wm.z = std::copysign(wm.z, wo.z);
    next.w.set(i, 2.f * wo.dot(wm) * wm - wo);
  }
  evaluate_by_ndf(surface, b, next);
  for (std::uint32_t i = 0; i < b.count; ++i) next.value[i] = next.pdf[i] > 0.f ? next.value[i] / next.pdf[i] : 0.f;
  evaluate_by_ndf(surface, b, b.light);
}

}  // namespace

void shade_batch(Kind kind, const Sampling& sampling, Batch& b) {
  const vndf::Columns2 alpha{b.alpha_x, b.alpha_y};
  auto reflect = [&](const auto& surface, bool bounded) {
    if (sampling.sampler == Sampler::ndf) return shade_by_ndf(surface, sampling.warp, b);
    vndf::ReflectionSamples samples{b.next.w, b.next.pdf, b.next.value};
    samples.wo_dot_wm = b.next.cosine;
    vndf::sample_reflection(sampling.warp, b.count, b.wo, surface, {b.u.x, b.u.y}, samples, two_sided(bounded));
    vndf::evaluate_reflection(b.count, b.wo, b.light.w, surface, {b.light.value, b.light.pdf, b.light.cosine},
                              two_sided(bounded));
  };
  vndf::DielectricOptions radiance;
  radiance.radiance = true;  // which paths from the camera carry
  switch (kind) {
    case Kind::diffuse:  // needs no normals
      return;
    case Kind::conductor:
    case Kind::plastic:
      return reflect(alpha, sampling.sampler == Sampler::bounded);
    case Kind::brushed:
      return reflect(vndf::Ellipsoid(alpha, 0.f, 0.f, b.theta_z), false);
    case Kind::leaning:
      return reflect(vndf::Ellipsoid(alpha, b.theta_x, b.theta_y, b.theta_z), false);
    case Kind::dielectric:
      vndf::sample_dielectric(sampling.warp, b.count, b.wo, alpha, b.eta, b.u,
                              {b.next.w, b.next.pdf, b.next.value, b.spare}, radiance);
      vndf::evaluate_dielectric(b.count, b.wo, b.light.w, alpha, b.eta, {b.light.value, b.light.pdf}, radiance);
  }
}

void evaluate_coat(const Sampling& sampling, Batch& b) {
  const vndf::Columns2 alpha{b.alpha_x, b.alpha_y};
  if (sampling.sampler == Sampler::ndf) return evaluate_by_ndf(alpha, b, b.next);
  vndf::evaluate_reflection(b.count, b.wo, b.next.w, alpha, {b.next.value, b.next.pdf, b.next.cosine},
                            two_sided(sampling.sampler == Sampler::bounded));
}

}  // namespace wavefront
