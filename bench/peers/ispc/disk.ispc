// The polar map of the disk, and the concentric one of Shirley and Chiu 1997.
#include "ggx.isph"

export void EXPORTED(disk_polar)(COLUMNS) {
  const Input u1 = from[5], u2 = from[6];
  const Output x = to[0], y = to[1];
  foreach (i = 0 ... count) {
    const float r = sqrt(u1[i]);
    float sin_phi, cos_phi;
    sincos(6.28318530718f * u2[i], &sin_phi, &cos_phi);
    x[i] = r * cos_phi;
    y[i] = r * sin_phi;
  }
}

export void EXPORTED(disk_concentric)(COLUMNS) {
  const Input u1 = from[5], u2 = from[6];
  const Output x = to[0], y = to[1];
  foreach (i = 0 ... count) {
    const float a = 2.0f * u1[i] - 1.0f, b = 2.0f * u2[i] - 1.0f;
    const bool wide = abs(a) > abs(b);
    const float r = wide ? a : b;
    const float turn = 0.785398163397f * (wide ? b : a) / (r == 0 ? 1.0f : r);
    float sin_phi, cos_phi;
    sincos(wide ? turn : 1.57079632679f - turn, &sin_phi, &cos_phi);
    x[i] = r * cos_phi;
    y[i] = r * sin_phi;
  }
}
