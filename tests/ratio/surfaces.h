// Plain GGX and ellipsoids by one interface: their name in the table of functions, their inputs, and the exact surface.
#pragma once

#include "reference/exact.h"
#include "reference/random.h"

namespace vndf::ratio {

using exact::Quad;
using reference::Random;

struct Plain {
  static constexpr const char* kName = "";
  static constexpr bool kByLunes = false;
  static constexpr std::size_t kInputs = 2;
  static exact::Surface exact(const Quad* in) { return exact::plain(in[0], in[1]); }
  static void add_angles(Random&, float*) {}
};

inline float any_angle(Random& random) {
  static const float special[] = {0, 0x1.921fb6p-1f, 0x1.921fb6p0f, 0x1.921fb6p1f};  // 0, pi/4, pi/2, pi
  float sign = random.below(2) ? -1.f : 1.f;
  switch (random.below(4)) {
    case 0:
      return sign * special[random.below(4)];
    case 1:
      return sign * float(random.log_uniform(1e-10, 3.14));
    default:
      return sign * float(random.uniform(0, 3.14159));
  }
}

/// theta_z alone.
struct Turned {
  static constexpr const char* kName = "_turned";
  static constexpr bool kByLunes = true;
  static constexpr std::size_t kInputs = 3;
  static exact::Surface exact(const Quad* in) { return exact::ellipsoid(in[0], in[1], 0, 0, in[2]); }
  static void add_angles(Random& random, float* in) { in[2] = any_angle(random); }
};

/// All angles: every other one leans by up to half a radian, the others any way.
struct Tilted {
  static constexpr const char* kName = "_tilted";
  static constexpr bool kByLunes = true;
  static constexpr std::size_t kInputs = 5;
  static exact::Surface exact(const Quad* in) { return exact::ellipsoid(in[0], in[1], in[2], in[3], in[4]); }
  static void add_angles(Random& random, float* in) {
    bool leans = random.below(2);
    for (int i = 2; i < 4; ++i) in[i] = leans ? float(random.uniform(-0.5, 0.5)) : any_angle(random);
    in[4] = any_angle(random);
  }
};

}  // namespace vndf::ratio
