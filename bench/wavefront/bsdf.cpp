#include "bsdf.h"

namespace wavefront {
namespace {

vndf::Columns3 in(Columns3& c) {
  return {c.x.data(), c.y.data(), c.z.data()};
}
vndf::Out3 out(Columns3& c) {
  return {c.x.data(), c.y.data(), c.z.data()};
}

/// Normals by their own distribution, as before Heitz and d'Eon 2014. They are the visible ones of a view along n, for
/// which G1 is 1 and wo.wm is wm.z.
template <class Shape, class... Options>
void shade_by_ndf(const Shape& shape, const Sampling& sampling, Batch& b, const Options&... options) {
  const vndf::Columns3 along_n{0.f, 0.f, 1.f};
  vndf::sample_normals(sampling.warp, b.count, along_n, shape, {b.u.x.data(), b.u.y.data()}, out(b.normal));
  for (std::uint32_t i = 0; i < b.count; ++i) {
    Vec3 wo = b.wo.get(i), wm = b.normal.get(i);
    b.cosine[i] = dot(wo, wm);
    b.wi.set(i, 2.f * b.cosine[i] * wm - wo);
  }
  vndf::evaluate_reflection(b.count, in(b.wo), in(b.wi), shape, {b.weight.data(), b.pdf.data()}, options...);
  vndf::pdf_normals(b.count, along_n, in(b.normal), shape, b.pdf.data());
  for (std::uint32_t i = 0; i < b.count; ++i) {
    b.pdf[i] = b.cosine[i] > 0.f ? b.pdf[i] / (4.f * b.cosine[i]) : 0.f;
    b.weight[i] = b.pdf[i] > 0.f ? b.weight[i] / b.pdf[i] : 0.f;
  }
  // The same density for the light's direction.
  vndf::evaluate_reflection(b.count, in(b.wo), in(b.light), shape, {b.light_f_cos.data(), b.light_pdf.data()},
                            options...);
  for (std::uint32_t i = 0; i < b.count; ++i) {
    Vec3 h = b.wo.get(i) + b.light.get(i);
    b.normal.set(i, (1.f / std::sqrt(std::max(dot(h, h), 1e-30f))) * h);
    b.light_cosine[i] = 0.5f * std::sqrt(dot(h, h));
  }
  vndf::pdf_normals(b.count, along_n, in(b.normal), shape, b.spare.data());
  for (std::uint32_t i = 0; i < b.count; ++i)
    b.light_pdf[i] = b.light_pdf[i] > 0.f ? b.spare[i] / (4.f * std::max(b.light_cosine[i], 1e-15f)) : 0.f;
}

/// Paths from the camera carry radiance.
vndf::DielectricOptions of_radiance() {
  vndf::DielectricOptions options;
  options.radiance = true;
  return options;
}
vndf::ReflectionOptions options_of(const Sampling& sampling) {
  vndf::ReflectionOptions options;
  options.bounded = sampling.sampler == Sampler::bounded;
  return options;
}

}  // namespace

void shade_batch(Kind kind, const vndf::Ellipsoid& leaning, const Sampling& sampling, Batch& b) {
  const vndf::Columns2 alpha{b.alpha_x.data(), b.alpha_y.data()}, u{b.u.x.data(), b.u.y.data()};
  const vndf::Ellipsoid shape = kind == Kind::leaning ? leaning : vndf::Ellipsoid(alpha, 0.f, 0.f, b.theta_z.data());
  const bool ndf = sampling.sampler == Sampler::ndf;
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
      if (ndf) return shade_by_ndf(shape, sampling, b);
      vndf::sample_reflection(sampling.warp, b.count, in(b.wo), shape, u, samples);
      vndf::evaluate_reflection(b.count, in(b.wo), in(b.light), shape, lights);
      break;
    case Kind::conductor:
    case Kind::plastic:
      if (ndf) return shade_by_ndf(alpha, sampling, b, options_of(sampling));
      vndf::sample_reflection(sampling.warp, b.count, in(b.wo), alpha, u, samples, options_of(sampling));
      vndf::evaluate_reflection(b.count, in(b.wo), in(b.light), alpha, lights, options_of(sampling));
  }
}

void evaluate_batch(const Sampling& sampling, Batch& b) {
  const vndf::Columns2 alpha{b.alpha_x.data(), b.alpha_y.data()};
  vndf::evaluate_reflection(b.count, in(b.wo), in(b.wi), alpha, {b.weight.data(), b.pdf.data()}, options_of(sampling));
  if (sampling.sampler != Sampler::ndf) return;
  for (std::uint32_t i = 0; i < b.count; ++i) {
    Vec3 h = b.wo.get(i) + b.wi.get(i);
    b.cosine[i] = 0.5f * std::sqrt(dot(h, h));
    b.normal.set(i, (1.f / std::sqrt(std::max(dot(h, h), 1e-30f))) * h);
  }
  vndf::pdf_normals(b.count, {0.f, 0.f, 1.f}, in(b.normal), alpha, b.spare.data());
  for (std::uint32_t i = 0; i < b.count; ++i)
    if (b.pdf[i] > 0.f) b.pdf[i] = b.spare[i] / (4.f * std::max(b.cosine[i], 1e-15f));
}

}  // namespace wavefront
