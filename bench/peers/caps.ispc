// Dupuy and Benyoub 2023, Listing 3, in ISPC, with its approximate rsqrt(). VNDF_PEER is the name that this target's
// copy exports.
struct Vec3 {
  float x, y, z;
};

static inline Vec3 normalized(const Vec3 a) {
  const float inverse = rsqrt(a.x * a.x + a.y * a.y + a.z * a.z);
  Vec3 n = {a.x * inverse, a.y * inverse, a.z * inverse};
  return n;
}

export void VNDF_PEER(uniform int count, const uniform float wo_x[], const uniform float wo_y[],
                      const uniform float wo_z[], const uniform float alpha_x[], const uniform float alpha_y[],
                      const uniform float u1[], const uniform float u2[], uniform float wm_x[], uniform float wm_y[],
                      uniform float wm_z[]) {
  foreach (i = 0 ... count) {
    const float ax = alpha_x[i], ay = alpha_y[i];
    const Vec3 stretched = {ax * wo_x[i], ay * wo_y[i], wo_z[i]};
    const Vec3 vh = normalized(stretched);
    const float z = (1.0f - u2[i]) * (1.0f + vh.z) - vh.z;
    const float sin_theta = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
    float sin_phi, cos_phi;
    sincos(6.28318530718f * u1[i], &sin_phi, &cos_phi);
    const Vec3 ne = {ax * (sin_theta * cos_phi + vh.x), ay * (sin_theta * sin_phi + vh.y), z + vh.z};
    const Vec3 wm = normalized(ne);
    wm_x[i] = wm.x;
    wm_y[i] = wm.y;
    wm_z[i] = wm.z;
  }
}
