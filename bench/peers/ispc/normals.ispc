#include "ggx.isph"

static inline void sample(const uniform bool by_cap, COLUMNS) {
  const Input wo_x = from[0], wo_y = from[1], wo_z = from[2], alpha_x = from[3], alpha_y = from[4], u1 = from[5], u2 = from[6];
  const Output wm_x = to[0], wm_y = to[1], wm_z = to[2];
  foreach (i = 0 ... count) {
    const Vec3 wo = {wo_x[i], wo_y[i], wo_z[i]};
    const Vec3 wm = normal(by_cap, wo, alpha_x[i], alpha_y[i], u1[i], u2[i]);
    wm_x[i] = wm.x;
    wm_y[i] = wm.y;
    wm_z[i] = wm.z;
  }
}

export void EXPORTED(listing)(COLUMNS) {
  sample(false, count, from, to);
}
export void EXPORTED(caps)(COLUMNS) {
  sample(true, count, from, to);
}
