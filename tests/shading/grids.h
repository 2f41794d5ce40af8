// The hemisphere of normals and the sphere of directions as grids, for integrals and for histograms.
#pragma once

#include <algorithm>

#include "ellipsoid/model.h"
#include "support/statistics.h"

namespace vndf::shading {

using testing::least_p_value;
using testing::p_value;
using testing::two_sample_p_value;

constexpr int kRings = 16, kSectors = 24;

/// The bin of a normal, as Nh of any length.
inline std::size_t bin_of(const Vec3<double>& nh) {
  double theta = std::atan2(std::hypot(nh.x, nh.y), nh.z), phi = std::atan2(nh.y, nh.x);
  if (phi < 0) phi += 2 * kPi<double>;
  int ring = std::min(kRings - 1, int(theta / (kPi<double> / 2) * kRings));
  int sector = std::min(kSectors - 1, int(phi / (2 * kPi<double>)*kSectors));
  return std::size_t(ring * kSectors + sector);
}

/// Midpoints of a grid of the hemisphere configuration, with the normals they stand for and the solid angle of those:
/// d m = |A| / |A^T Nh|^3 d Nh, where A n = n.
struct NormalGrid {
  int sectors, fine, fine_turns;
  Directions m;
  std::vector<double> solid_angle;

  /// Each bin divided into so many rings and sectors.
  NormalGrid(const ellipsoid::M3<double>& a, int fine_, int fine_turns_)
      : NormalGrid(a, 0, kRings * fine_, kSectors * fine_turns_) {
    fine = fine_;
    fine_turns = fine_turns_;
  }
  /// For views below the horizon the grid covers only the polar angles where some normals are visible.
  NormalGrid(const Vec3<double>& wo, const Alpha<double>& alpha, int rings, int sectors_)
      : NormalGrid({{alpha.x, 0, 0}, {0, alpha.y, 0}, {0, 0, 1}}, least_angle(stretch(wo, alpha)), rings, sectors_) {}
  std::size_t size() const { return m.size(); }
  std::size_t bin(std::size_t at) const {
    return at / std::size_t(sectors) / std::size_t(fine) * kSectors +
           at % std::size_t(sectors) / std::size_t(fine_turns);
  }

 private:
  static double least_angle(const Vec3<double>& vh) { return vh.z < 0 ? std::atan2(-vh.z, std::hypot(vh.x, vh.y)) : 0; }
  NormalGrid(const ellipsoid::M3<double>& a, double from, int rings, int sectors_)
      : sectors(sectors_), fine(1), fine_turns(1), m(std::size_t(rings) * std::size_t(sectors)), solid_angle(m.size()) {
    double d_theta = (kPi<double> / 2 - from) / rings, d_phi = 2 * kPi<double> / sectors;
    for (std::size_t at = 0; at < size(); ++at) {
      double theta = from + (double(at / std::size_t(sectors)) + 0.5) * d_theta;
      double phi = (double(at % std::size_t(sectors)) + 0.5) * d_phi;
      Vec3<double> ne = transposed_times(a, direction_of(theta, phi));
      double n = length(ne);
      m.set(at, unit(ne));
      solid_angle[at] = std::fabs(determinant(a)) / (n * n * n) * std::sin(theta) * d_theta * d_phi;
    }
  }
};

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
        double phi = 2 * kPi<double> * (j + 0.5) / (kTurns * kSubTurns);
        auto at = std::size_t(i) * kTurns * kSubTurns + std::size_t(j);
        wi.set(at, direction_of(theta, phi));
        solid_angle[at] = std::sin(theta) * kPi<double> / (kBands * kSubBands) * 2 * kPi<double> / (kTurns * kSubTurns);
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
