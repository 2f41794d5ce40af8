// Heitz 2018, Listing 1, in ISPC, with its approximate rsqrt(). VNDF_PEER is the name that this target's copy exports.
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
    const float lensq = vh.x * vh.x + vh.y * vh.y;
    const float inverse = rsqrt(lensq);
    const float t1x = lensq > 0 ? -vh.y * inverse : 1.0f;
    const float t1y = lensq > 0 ? vh.x * inverse : 0.0f;
    const float t2x = -vh.z * t1y, t2y = vh.z * t1x, t2z = vh.x * t1y - vh.y * t1x;
    const float r = sqrt(u1[i]);
    float sin_phi, cos_phi;
    sincos(6.28318530718f * u2[i], &sin_phi, &cos_phi);
    const float p1 = r * cos_phi;
    float p2 = r * sin_phi;
    const float s = 0.5f * (1.0f + vh.z);
    p2 = (1.0f - s) * sqrt(1.0f - p1 * p1) + s * p2;
    const float height = sqrt(max(0.0f, 1.0f - p1 * p1 - p2 * p2));
    const Vec3 ne = {ax * (p1 * t1x + p2 * t2x + height * vh.x), ay * (p1 * t1y + p2 * t2y + height * vh.y),
                     max(0.0f, p2 * t2z + height * vh.z)};
    const Vec3 wm = normalized(ne);
    wm_x[i] = wm.x;
    wm_y[i] = wm.y;
    wm_z[i] = wm.z;
  }
}
