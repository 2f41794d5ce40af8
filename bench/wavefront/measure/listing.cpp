// The shading step as renderers have it: one vertex after the other, by Heitz's listing (2018, Listing 1), the
// textbook's density and Walter's (2007) dielectric. In place of bsdf.cpp, with the same flags. What leans is left to
// the library, as there is no listing for it.
#include "bsdf.h"

namespace wavefront {

// bsdf.cpp under another name: see CMakeLists.txt.
void library_shade_batch(Kind kind, const Sampling& sampling, Batch& batch);

namespace {

struct Alpha {
  float x, y;
};

Vec3 sample_normal(Vec3 wo, Alpha alpha, float u1, float u2) {
  Vec3 vh = normalize({alpha.x * wo.x, alpha.y * wo.y, wo.z});
  float lensq = vh.x * vh.x + vh.y * vh.y;
  Vec3 t1_axis = lensq > 0.f ? (1.f / std::sqrt(lensq)) * Vec3{-vh.y, vh.x, 0.f} : Vec3{1.f, 0.f, 0.f};
  Vec3 t2_axis = vh.cross(t1_axis);
  float r = std::sqrt(u1), phi = 2.f * kPi * u2;
  float t1 = r * std::cos(phi), t2 = r * std::sin(phi), s = 0.5f * (1.f + vh.z);
  t2 = (1.f - s) * std::sqrt(1.f - t1 * t1) + s * t2;
  Vec3 nh = t1 * t1_axis + t2 * t2_axis + std::sqrt(std::max(0.f, 1.f - t1 * t1 - t2 * t2)) * vh;
  return normalize({alpha.x * nh.x, alpha.y * nh.y, std::max(0.f, nh.z)});
}

float distribution(Vec3 m, Alpha alpha) {
  float x = m.x / alpha.x, y = m.y / alpha.y, s = x * x + y * y + m.z * m.z;
  return 1.f / (kPi * alpha.x * alpha.y * s * s);
}
float lambda(Vec3 w, Alpha alpha) {
  float x = alpha.x * w.x, y = alpha.y * w.y;
  return 0.5f * (std::sqrt(1.f + (x * x + y * y) / (w.z * w.z)) - 1.f);
}
float visible_density(Vec3 wo, Vec3 m, Alpha alpha) {
  return std::max(0.f, wo.dot(m)) * distribution(m, alpha) / ((1.f + lambda(wo, alpha)) * wo.z);
}

struct Value {
  float f_cos, pdf;
};
Value reflected(Vec3 wo, Vec3 wi, Alpha alpha) {
  if (!(wo.z > 0.f) || !(wi.z > 0.f)) return {0.f, 0.f};
  Vec3 h = normalize(wo + wi);
  float d = distribution(h, alpha), lambda_o = lambda(wo, alpha);
  return {d / ((1.f + lambda_o + lambda(wi, alpha)) * 4.f * wo.z), d / ((1.f + lambda_o) * 4.f * wo.z)};
}

float reflectance(float c, float eta) {
  float g2 = eta * eta - 1.f + c * c;
  if (g2 <= 0.f) return 1.f;
  float g = std::sqrt(g2), s = (g - c) / (g + c), p = (c * (g + c) - 1.f) / (c * (g - c) + 1.f);
  return 0.5f * s * s * (1.f + p * p);
}
/// wo above; eta the index on the other side over the one on wo's. Counts radiance: 1 / eta^2 of what crosses.
Value through(Vec3 wo, Vec3 wi, Alpha alpha, float eta) {
  bool reflects = wi.z >= 0.f;
  Vec3 h = normalize(reflects ? wo + wi : wo + eta * wi);
  if (h.z < 0.f) h = -1.f * h;
  float c = wo.dot(h), ci = wi.dot(h);
  if (c <= 0.f || (ci < 0.f) == reflects) return {0.f, 0.f};
  float f = reflectance(c, eta), lambda_o = lambda(wo, alpha);
  float root = c + eta * ci, jacobian = reflects ? 1.f / (4.f * c) : eta * eta * std::abs(ci) / (root * root);
  float pdf = (reflects ? f : 1.f - f) * visible_density(wo, h, alpha) * jacobian;
  float lambda_i = lambda(wi, alpha);
  return {pdf * (reflects ? (1.f + lambda_o) / (1.f + lambda_o + lambda_i) : 1.f / ((1.f + lambda_i) * eta * eta)),
          pdf};
}

void metal(Kind kind, Batch& b, std::uint32_t i) {
  Alpha alpha{b.alpha_x[i], b.alpha_y[i]};
  float c = 1.f, s = 0.f;
  if (kind == Kind::brushed) c = std::cos(b.theta_z[i]), s = std::sin(b.theta_z[i]);
  float up = b.wo.z[i] < 0.f ? -1.f : 1.f;  // two-sided
  auto turned = [&](Vec3 v) { return Vec3{c * v.x - s * v.y, s * v.x + c * v.y, up * v.z}; };
  Vec3 wo = turned(b.wo.get(i)), wm = sample_normal(wo, alpha, b.u.x[i], b.u.y[i]);
  b.next.cosine[i] = wo.dot(wm);
  Vec3 wi = 2.f * b.next.cosine[i] * wm - wo;
  Value v = reflected(wo, wi, alpha);
  b.next.pdf[i] = v.pdf, b.next.value[i] = v.pdf > 0.f ? v.f_cos / v.pdf : 0.f;
  b.next.w.set(i, {c * wi.x + s * wi.y, c * wi.y - s * wi.x, up * wi.z});
  v = reflected(wo, turned(b.light.w.get(i)), alpha);
  b.light.value[i] = v.f_cos, b.light.pdf[i] = v.pdf;
}

void glass(Batch& b, std::uint32_t i) {
  Alpha alpha{b.alpha_x[i], b.alpha_y[i]};
  float up = b.wo.z[i] < 0.f ? -1.f : 1.f, eta = up < 0.f ? 1.f / b.eta[i] : b.eta[i];
  auto mirrored = [&](Vec3 v) { return Vec3{v.x, v.y, up * v.z}; };
  Vec3 wo = mirrored(b.wo.get(i)), wm = sample_normal(wo, alpha, b.u.x[i], b.u.y[i]);
  float c = wo.dot(wm);
  bool reflects = b.u.z[i] < reflectance(c, eta);
  float g = std::sqrt(std::max(0.f, eta * eta - 1.f + c * c));
  Vec3 wi = reflects ? 2.f * c * wm - wo : (1.f / eta) * ((c - g) * wm - wo);
  Value v = (wi.z > 0.f) == reflects ? through(wo, wi, alpha, eta) : Value{0.f, 0.f};
  b.next.pdf[i] = v.pdf, b.next.value[i] = v.pdf > 0.f ? v.f_cos / v.pdf : 0.f;
  b.next.w.set(i, mirrored(wi));
  v = through(wo, mirrored(b.light.w.get(i)), alpha, eta);
  b.light.value[i] = v.f_cos, b.light.pdf[i] = v.pdf;
}

}  // namespace

void shade_batch(Kind kind, const Sampling& sampling, Batch& b) {
  if (kind == Kind::diffuse) return;
  if (kind == Kind::leaning) return library_shade_batch(kind, sampling, b);
  for (std::uint32_t i = 0; i < b.count; ++i) {
    if (kind == Kind::dielectric)
      glass(b, i);
    else
      metal(kind, b, i);
    b.light.cosine[i] = std::min(1.f, 0.5f * (b.wo.get(i) + b.light.w.get(i)).length());
  }
}

void evaluate_coat(const Sampling&, Batch& b) {
  for (std::uint32_t i = 0; i < b.count; ++i) {
    float up = b.wo.z[i] < 0.f ? -1.f : 1.f;
    Vec3 wo = b.wo.get(i), wi = b.next.w.get(i);
    wo.z *= up, wi.z *= up;
    Value v = reflected(wo, wi, {b.alpha_x[i], b.alpha_y[i]});
    b.next.value[i] = v.f_cos, b.next.pdf[i] = v.pdf;
    b.next.cosine[i] = std::min(1.f, 0.5f * (wo + wi).length());
  }
}

}  // namespace wavefront
