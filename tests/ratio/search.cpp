// Climbs from random inputs to ones whose ratio is larger, which finds worse ones than any number of samples:
//   vndf_search [--function part_of_a_name] [--seconds n] [--starts n] [--seed n]
// Seconds or starts are those of each function; without a seed, a new one. Prints the worst inputs of every result, as
// floats in hexadecimal. It fails where a ratio is above its bound by half: bounds are what samples show.
#include <chrono>
#include <cstdlib>
#include <random>

#include "ratio/subjects.h"

namespace vndf::ratio {
namespace {

using Clock = std::chrono::steady_clock;
using reference::Random;

struct Limits {
  Clock::time_point end;
  std::uint64_t starts;
};

/// Changes one input: a bit of it, to its neighbour, by a factor, or to its opposite in [0, 1].
void change(Random& random, float& value) {
  switch (random.below(4)) {
    case 0: {
      std::uint32_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      bits ^= 1u << random.below(32);
      std::memcpy(&value, &bits, sizeof bits);
      break;
    }
    case 1:
      value = std::nextafter(value, random.below(2) ? INFINITY : -INFINITY);
      break;
    case 2:
      value *= float(1 + random.uniform(-1, 1) * random.log_uniform(1e-7, 0.5));
      break;
    default:
      value = random.below(2) ? 1 - value : float(value * random.log_uniform(1e-3, 1e3));
  }
}
void normalise(float* v) {
  const double length = std::hypot(double(v[0]), double(v[1]), double(v[2]));
  for (int i = 0; i < 3; ++i) v[i] = float(v[i] / length);
}

template <class Subject>
class Search {
 public:
  using Inputs = std::array<float, Subject::kInputs>;

  explicit Search(std::uint64_t seed) : seed_(seed), rows_(rows(Subject::kViews)) {}

  void run(const Limits& limits) {
    for (; starts_ < limits.starts && Clock::now() < limits.end; ++starts_) {
      Random random(seed_, starts_);
      const std::size_t result = random.below(Subject::kResults);
      if (Subject::bounds[result].max == 0) continue;
      Worst from;
      if (random.below(4) == 0)
        from = worst_[result];
      else if (Inputs in = start(random); in_domain(in))
        from = {ratio(in, result), in};
      if (from.ratio >= 0) climb(random, result, from, limits.end);
      if (from.ratio > worst_[result].ratio) worst_[result] = from;
    }
  }

  /// Whether all bounds hold, by the margin.
  bool report(const std::string& name) const {
    bool holds = true;
    std::printf("%s: %llu starts, %llu steps\n", name.c_str(), static_cast<unsigned long long>(starts_),
                static_cast<unsigned long long>(steps_));
    for (std::size_t r = 0; r < Subject::kResults; ++r) {
      if (worst_[r].ratio < 0) continue;
      const bool above = worst_[r].ratio > Subject::bounds[r].max;
      holds &= !(worst_[r].ratio > kMargin * Subject::bounds[r].max);
      std::printf("  %s %.2f of %.0f%s at {%s}\n", Subject::bounds[r].what, worst_[r].ratio, Subject::bounds[r].max,
                  above ? ", ABOVE THE BOUND," : "", describe(worst_[r].in).c_str());
    }
    std::fflush(stdout);
    return holds;
  }

 private:
  static constexpr int kPatience = 400;
  static constexpr double kMargin = 1.5;
  struct Worst {
    double ratio = -1;
    Inputs in{};
  };

  /// A sample of one of the rows.
  Inputs start(Random& random) const {
    seed() = random.bits();
    return inputs_at<Subject::kInputs>(Subject::inputs(rows_[random.below(std::uint32_t(rows_.size()))], 2),
                                       random.below(2));
  }
  static double ratio(const Inputs& in, std::size_t result) {
    Table columns;
    for (float value : in) columns.push_back({value});
    return ratios_of<Subject>(in, Subject::run(columns)[0])[result];
  }
  /// One to three changes; directions stay of unit length every other time.
  static Inputs mutated(Random& random, Inputs in) {
    for (std::uint32_t more = 1 + random.below(3); more; --more) change(random, in[random.below(Subject::kInputs)]);
    if (random.below(2))
      for (std::size_t d = 0; d < Subject::kDirections; ++d) normalise(&in[3 * d]);
    return in;
  }
  /// Directions have cosines from 2^-64, or 0: light and normals nearer to the horizon lose digits to underflow.
  static bool in_domain(const Inputs& in) {
    if (Subject::kViews != Views::any)
      for (std::size_t i = 0; i < 3 * Subject::kDirections; ++i)
        if (in[i] != 0 && std::fabs(in[i]) < 0x1p-64f) return false;
    return Subject::in_domain(in);
  }
  void climb(Random& random, std::size_t result, Worst& at, Clock::time_point end) {
    for (int idle = 0; idle < kPatience && Clock::now() < end; ++idle) {
      Inputs next = mutated(random, at.in);
      if (!in_domain(next)) continue;
      ++steps_;
      const double of_next = ratio(next, result);
      if (of_next < at.ratio) continue;
      if (of_next > at.ratio) idle = 0;
      at = {of_next, next};
    }
  }

  std::uint64_t seed_, starts_ = 0, steps_ = 0;
  std::vector<HardCase> rows_;
  std::array<Worst, Subject::kResults> worst_;
};

}  // namespace
}  // namespace vndf::ratio

int main(int argc, char** argv) {
  std::uint64_t seed = std::random_device()(), starts = UINT64_MAX, seconds = 10;
  std::string part;
  for (int i = 1; i < argc; i += 2) {
    const std::string option = argv[i];
    char* end = nullptr;
    const std::uint64_t value = i + 1 < argc ? std::strtoull(argv[i + 1], &end, 0) : 0;
    const bool is_number = end && end != argv[i + 1] && !*end;
    if (option == "--function" && i + 1 < argc) {
      part = argv[i + 1];
    } else if (is_number && option == "--seconds") {
      seconds = value;
    } else if (is_number && option == "--starts") {
      starts = value, seconds = 1u << 30;
    } else if (is_number && option == "--seed") {
      seed = value;
    } else {
      std::fprintf(stderr, "usage: vndf_search [--function part_of_a_name] [--seconds n] [--starts n] [--seed n]\n");
      return 2;
    }
  }
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  bool holds = true;
  vndf::ratio::for_each_subject([&](const std::string& name, auto subject) {
    if (name.find(part) == std::string::npos) return;
    vndf::ratio::Search<typename decltype(subject)::type> search(seed);
    search.run({vndf::ratio::Clock::now() + std::chrono::seconds(seconds), starts});
    holds &= search.report(name);
  });
  return holds ? 0 : 1;
}
