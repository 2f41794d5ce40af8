#include "bsdf.h"

namespace wavefront {
namespace {

vndf::Columns3 in(Columns3& c) {
  return {c.x.data(), c.y.data(), c.z.data()};
}
vndf::Out3 out(Columns3& c) {
  return {c.x.data(), c.y.data(), c.z.data()};
}

/// Sheets are seen from both sides, and normal maps turn normals away from the view.
vndf::ReflectionOptions two_sided(bool bounded) {
  vndf::ReflectionOptions options;
  options.bounded = bounded, options.two_sided = true;
  return options;
}

const vndf::Columns3 kAlongN{0.f, 0.f, 1.f};

/// Normals by their own distribution, as before Heitz and d'Eon 2014. They are the visible ones of a view along n, for
/// which G1 is 1 and wo.wm is wm.z.
template <class Shape>
void evaluate_by_ndf(const Shape& shape, Batch& b, Columns3& wi, const vndf::Evaluations& to) {
  vndf::evaluate_reflection(b.count, in(b.wo), in(wi), shape, to, two_sided(false));
  for (std::uint32_t i = 0; i < b.count; ++i) {
    Vec3 h = b.wo.get(i) + wi.get(i);
    h.z = std::abs(h.z);  // seen from below, all is mirrored
    b.normal.set(i, (1.f / std::max(length(h), 1e-15f)) * h);
  }
  vndf::pdf_normals(b.count, kAlongN, in(b.normal), shape, b.spare.data());
  for (std::uint32_t i = 0; i < b.count; ++i)
    if (to.pdf[i] > 0.f) to.pdf[i] = b.spare[i] / (4.f * std::max(to.wo_dot_wm[i], 1e-15f));
}
template <class Shape>
void shade_by_ndf(const Shape& shape, const Sampling& sampling, Batch& b, const vndf::Evaluations& lights) {
  vndf::sample_normals(sampling.warp, b.count, kAlongN, shape, {b.u.x.data(), b.u.y.data()}, out(b.normal));
  for (std::uint32_t i = 0; i < b.count; ++i) {
    Vec3 wo = b.wo.get(i), wm = b.normal.get(i);
    wm.z = std::copysign(wm.z, wo.z);
    b.wi.set(i, 2.f * dot(wo, wm) * wm - wo);
  }
  evaluate_by_ndf(shape, b, b.wi, {b.weight.data(), b.pdf.data(), b.cosine.data()});
  for (std::uint32_t i = 0; i < b.count; ++i) b.weight[i] = b.pdf[i] > 0.f ? b.weight[i] / b.pdf[i] : 0.f;
  evaluate_by_ndf(shape, b, b.light, lights);
}

/// Paths from the camera carry radiance.
vndf::DielectricOptions of_radiance() {
  vndf::DielectricOptions options;
  options.radiance = true;
  return options;
}

}  // namespace

void shade_batch(Kind kind, const vndf::Ellipsoid& leaning, const Sampling& sampling, Batch& b) {
  const vndf::Columns2 alpha{b.alpha_x.data(), b.alpha_y.data()}, u{b.u.x.data(), b.u.y.data()};
  const vndf::Ellipsoid shape = kind == Kind::leaning ? leaning : vndf::Ellipsoid(alpha, 0.f, 0.f, b.theta_z.data());
  const bool ndf = sampling.sampler == Sampler::ndf, bounded = sampling.sampler == Sampler::bounded;
  vndf::ReflectionSamples samples{out(b.wi), b.pdf.data(), b.weight.data()};
  samples.wo_dot_wm = b.cosine.data();
  const vndf::Evaluations lights{b.light_f_cos.data(), b.light_pdf.data(), b.light_cosine.data()};
  switch (kind) {
    case Kind::diffuse:  // needs no normals
      break;
    case Kind::dielectric:
      vndf::sample_dielectric(sampling.warp, b.count, in(b.wo), alpha, b.eta.data(),
                              {b.u.x.data(), b.u.y.data(), b.u.z.data()},
                              {out(b.wi), b.pdf.data(), b.weight.data(), b.side.data()}, of_radiance());
      vndf::evaluate_dielectric(b.count, in(b.wo), in(b.light), alpha, b.eta.data(),
                                {b.light_f_cos.data(), b.light_pdf.data()}, of_radiance());
      break;
    case Kind::brushed:
    case Kind::leaning:
      if (ndf) return shade_by_ndf(shape, sampling, b, lights);
      vndf::sample_reflection(sampling.warp, b.count, in(b.wo), shape, u, samples, two_sided(false));
      vndf::evaluate_reflection(b.count, in(b.wo), in(b.light), shape, lights, two_sided(false));
      break;
    case Kind::conductor:
    case Kind::plastic:
      if (ndf) return shade_by_ndf(alpha, sampling, b, lights);
      vndf::sample_reflection(sampling.warp, b.count, in(b.wo), alpha, u, samples, two_sided(bounded));
      vndf::evaluate_reflection(b.count, in(b.wo), in(b.light), alpha, lights, two_sided(bounded));
  }
}

void evaluate_batch(const Sampling& sampling, Batch& b) {
  const vndf::Columns2 alpha{b.alpha_x.data(), b.alpha_y.data()};
  const vndf::Evaluations to{b.weight.data(), b.pdf.data(), b.cosine.data()};
  if (sampling.sampler == Sampler::ndf) return evaluate_by_ndf(alpha, b, b.wi, to);
  vndf::evaluate_reflection(b.count, in(b.wo), in(b.wi), alpha, to, two_sided(sampling.sampler == Sampler::bounded));
}

}  // namespace wavefront
