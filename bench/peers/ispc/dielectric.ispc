// The whole step of rough glass, Walter et al. 2007: one lobe by Fresnel's share, its direction, density, weight and which
// it was; and its evaluation for a given light.
#include "ggx.isph"

static const uniform float kEta = 1.5f;

static inline void sample(const uniform bool by_cap, COLUMNS) {
  const Input wo_x = from[0], wo_y = from[1], wo_z = from[2], alpha_x = from[3], alpha_y = from[4];
  const Input u1 = from[5], u2 = from[6], u3 = from[7];
  const Output wi_x = to[3], wi_y = to[4], wi_z = to[5], pdf = to[6], weight = to[7], side = to[0];
  foreach (i = 0 ... count) {
    const float sign = wo_z[i] < 0 ? -1.0f : 1.0f;
    const float eta = wo_z[i] < 0 ? 1.0f / kEta : kEta;
    const Vec3 wo = {sign * wo_x[i], sign * wo_y[i], sign * wo_z[i]};
    const float ax = alpha_x[i], ay = alpha_y[i];
    const Vec3 wm = normal(by_cap, wo, ax, ay, u1[i], u2[i]);
    const float cos_o = dot(wo, wm);
    const float share = fresnel(cos_o, eta);
    const bool reflects = u3[i] < share;
    const float cos_t = sqrt(max(0.0f, 1.0f - (1.0f - cos_o * cos_o) / (eta * eta)));
    const float along = cos_o / eta - cos_t;
    const Vec3 across = {along * wm.x - wo.x / eta, along * wm.y - wo.y / eta, along * wm.z - wo.z / eta};
    const Vec3 mirrored = reflected(wo, wm);
    const Vec3 wi = {reflects ? mirrored.x : across.x, reflects ? mirrored.y : across.y,
                     reflects ? mirrored.z : across.z};
    const float above = 1.0f + lambda(wo, ax, ay);
    const float visible = ndf(wm, ax, ay) * cos_o / (above * wo.z);
    const float mirror_pdf = share * visible / (4.0f * cos_o);
    const float across_pdf = (1.0f - share) * visible * cos_t / sqr(cos_t - cos_o / eta);
    const bool valid = reflects ? wi.z > 0 : wi.z < 0;
    const float masked = lambda(wi, ax, ay);
    wi_x[i] = sign * wi.x;
    wi_y[i] = sign * wi.y;
    wi_z[i] = sign * wi.z;
    pdf[i] = valid ? (reflects ? mirror_pdf : across_pdf) : 0.0f;
    weight[i] = valid ? (reflects ? above / (above + masked) : 1.0f / (1.0f + masked)) : 0.0f;
    side[i] = reflects ? 1.0f : -1.0f;
  }
}

export void EXPORTED(dielectric)(COLUMNS) {
  sample(false, count, from, to);
}
export void EXPORTED(dielectric_caps)(COLUMNS) {
  sample(true, count, from, to);
}

export void EXPORTED(dielectric_evaluation)(COLUMNS) {
  const Input wo_x = from[0], wo_y = from[1], wo_z = from[2], alpha_x = from[3], alpha_y = from[4];
  const Input wi_x = from[11], wi_y = from[12], wi_z = from[13];
  const Output f_cos = to[6], pdf = to[7];
  foreach (i = 0 ... count) {
    const float sign = wo_z[i] < 0 ? -1.0f : 1.0f;
    const float eta = wo_z[i] < 0 ? 1.0f / kEta : kEta;
    const Vec3 wo = {sign * wo_x[i], sign * wo_y[i], sign * wo_z[i]};
    const Vec3 wi = {sign * wi_x[i], sign * wi_y[i], sign * wi_z[i]};
    const float ax = alpha_x[i], ay = alpha_y[i];
    const bool reflects = wi.z > 0;
    const float index = reflects ? 1.0f : eta;
    const Vec3 half = {wo.x + index * wi.x, wo.y + index * wi.y, wo.z + index * wi.z};
    Vec3 wm = normalized(half);
    const float up = wm.z < 0 ? -1.0f : 1.0f;
    wm.x *= up;
    wm.y *= up;
    wm.z *= up;
    const float cos_o = dot(wo, wm), cos_i = dot(wi, wm);
    const float share = fresnel(cos_o, eta);
    const float above = 1.0f + lambda(wo, ax, ay);
    const float masked = lambda(wi, ax, ay);
    const float visible = ndf(wm, ax, ay) * cos_o / (above * wo.z);
    const float density =
        reflects ? share * visible / (4.0f * cos_o) : (1.0f - share) * visible * -cos_i / sqr(cos_i + cos_o / eta);
    const bool valid = cos_o > 0 && (reflects ? cos_i > 0 : cos_i < 0);
    pdf[i] = valid ? density : 0.0f;
    f_cos[i] = valid ? density * (reflects ? above / (above + masked) : 1.0f / (1.0f + masked)) : 0.0f;
  }
}
