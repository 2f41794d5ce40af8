// The whole step of a rough mirror: direction, density, weight G2 / G1 with height-correlated masking. And its evaluation
// for a given light, and the density of normals.
#include "ggx.isph"

static inline void sample(const uniform bool by_cap, COLUMNS) {
  const Input wo_x = from[0], wo_y = from[1], wo_z = from[2], alpha_x = from[3], alpha_y = from[4], u1 = from[5], u2 = from[6];
  const Output wi_x = to[3], wi_y = to[4], wi_z = to[5], pdf = to[6], weight = to[7];
  foreach (i = 0 ... count) {
    const Vec3 wo = {wo_x[i], wo_y[i], wo_z[i]};
    const float ax = alpha_x[i], ay = alpha_y[i];
    const Vec3 wm = normal(by_cap, wo, ax, ay, u1[i], u2[i]);
    const Vec3 wi = reflected(wo, wm);
    const float above = 1.0f + lambda(wo, ax, ay);
    wi_x[i] = wi.x;
    wi_y[i] = wi.y;
    wi_z[i] = wi.z;
    pdf[i] = wi.z > 0 ? ndf(wm, ax, ay) / (above * 4.0f * wo.z) : 0.0f;
    weight[i] = wi.z > 0 ? above / (above + lambda(wi, ax, ay)) : 0.0f;
  }
}

export void EXPORTED(reflection)(COLUMNS) {
  sample(false, count, from, to);
}
export void EXPORTED(reflection_caps)(COLUMNS) {
  sample(true, count, from, to);
}

export void EXPORTED(evaluation)(COLUMNS) {
  const Input wo_x = from[0], wo_y = from[1], wo_z = from[2], alpha_x = from[3], alpha_y = from[4];
  const Input wi_x = from[11], wi_y = from[12], wi_z = from[13];
  const Output f_cos = to[6], pdf = to[7];
  foreach (i = 0 ... count) {
    const Vec3 wo = {wo_x[i], wo_y[i], wo_z[i]}, wi = {wi_x[i], wi_y[i], wi_z[i]};
    const float ax = alpha_x[i], ay = alpha_y[i];
    const Vec3 half = {wo.x + wi.x, wo.y + wi.y, wo.z + wi.z};
    const float d = ndf(normalized(half), ax, ay) / (4.0f * wo.z);
    const float above = 1.0f + lambda(wo, ax, ay);
    f_cos[i] = wi.z > 0 ? d / (above + lambda(wi, ax, ay)) : 0.0f;
    pdf[i] = wi.z > 0 ? d / above : 0.0f;
  }
}

export void EXPORTED(pdf)(COLUMNS) {
  const Input wo_x = from[0], wo_y = from[1], wo_z = from[2], alpha_x = from[3], alpha_y = from[4];
  const Input wm_x = from[11], wm_y = from[12], wm_z = from[13];
  const Output pdf = to[6];
  foreach (i = 0 ... count) {
    const Vec3 wo = {wo_x[i], wo_y[i], wo_z[i]}, wm = {wm_x[i], wm_y[i], wm_z[i]};
    const float ax = alpha_x[i], ay = alpha_y[i];
    pdf[i] = ndf(wm, ax, ay) * max(0.0f, dot(wo, wm)) / ((1.0f + lambda(wo, ax, ay)) * wo.z);
  }
}
