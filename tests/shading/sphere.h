// Light that leaves a surface on either side: the sphere as a grid.
#pragma once

#include <algorithm>

#include "shading/statistics.h"

namespace vndf::shading {

/// The sphere in equal angles, with room for what evaluate_dielectric gives. The density of refraction jumps where wm
/// is horizontal, close to the horizon: the polar angle is what needs a fine grid.
struct Sphere {
  static constexpr int kBands = 24, kTurns = 24, kSubBands = 256, kSubTurns = 16;
  static constexpr std::size_t kCount = std::size_t(kBands) * kSubBands * kTurns * kSubTurns;
  Directions wi{kCount};
  Values value{kCount};
  std::vector<double> solid_angle = std::vector<double>(kCount);

  Sphere() {
    for (int i = 0; i < kBands * kSubBands; ++i)
      for (int j = 0; j < kTurns * kSubTurns; ++j) {
        double theta = kPi<double> * (i + 0.5) / (kBands * kSubBands);
        double phi = 2 * kPi<double> * (j + 0.5) / (kTurns * kSubTurns), s = std::sin(theta);
        auto at = std::size_t(i) * kTurns * kSubTurns + std::size_t(j);
        wi.set(at, Vec3<double>{s * std::cos(phi), s * std::sin(phi), std::cos(theta)});
        solid_angle[at] = s * kPi<double> / (kBands * kSubBands) * 2 * kPi<double> / (kTurns * kSubTurns);
      }
  }

  /// What `value` says of `samples` samples: how many fall into each bin, and last how many are lost.
  struct Stated {
    std::vector<double> expected;
    double all, energy;
  };
  Stated stated(double samples) const {
    Stated s{std::vector<double>(kBands * kTurns + 1), 0, 0};
    for (std::size_t i = 0; i < kCount; ++i) {
      s.expected[bin(i)] += value.pdf[i] * solid_angle[i] * samples;
      s.all += value.pdf[i] * solid_angle[i];
      s.energy += value.f_cos[i] * solid_angle[i];
    }
    s.expected.back() = std::max(0., 1 - s.all) * samples;
    return s;
  }

  /// The same of samples: their bins, the mean weight and its standard deviation.
  struct Found {
    std::vector<double> counts;
    double weight, sigma;
  };
  static Found found(const Samples& sample) {
    Found f{std::vector<double>(kBands * kTurns + 1), 0, 0};
    double squares = 0, n = double(sample.pdf.size());
    for (std::size_t i = 0; i < sample.pdf.size(); ++i) {
      ++f.counts[sample.pdf[i] > 0 ? bin(sample.wi.at(i)) : f.counts.size() - 1];
      f.weight += sample.weight[i] / n;
      squares += double(sample.weight[i]) * sample.weight[i] / n;
    }
    f.sigma = std::sqrt(std::max(0., squares - f.weight * f.weight) / n);
    return f;
  }

 private:
  static std::size_t bin(std::size_t at) {
    return at / (kTurns * kSubTurns) / kSubBands * kTurns + at % (kTurns * kSubTurns) / kSubTurns;
  }
  static std::size_t bin(const Vec3<double>& d) {
    double phi = std::atan2(d.y, d.x);
    if (phi < 0) phi += 2 * kPi<double>;
    int band = std::min(kBands - 1, int(std::atan2(std::hypot(d.x, d.y), d.z) / kPi<double> * kBands));
    return std::size_t(band * kTurns + std::min(kTurns - 1, int(phi / (2 * kPi<double>)*kTurns)));
  }
};

}  // namespace vndf::shading
