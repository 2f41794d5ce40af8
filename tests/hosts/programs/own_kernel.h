// A fused shading kernel, once for each instruction set.
#pragma once

#include <cstddef>

/// World-space hits on one rough conductor, as columns; a multiple of 16 of them.
struct Hits {
  std::size_t count;
  const float *x[3], *y[3], *z[3];  // the frame: the axes of alpha_x and alpha_y, and the normal
  const float* wo[3];               // towards the viewer
  const float* u[2];
  float alpha_x, alpha_y, eta, k;
  float *wi[3], *weight, *pdf;  // where the path goes on, f cos / pdf with Fresnel's factor, and its density
};

void shade_scalar(const Hits& hits);
void shade_sse42(const Hits& hits);
void shade_avx2(const Hits& hits);
