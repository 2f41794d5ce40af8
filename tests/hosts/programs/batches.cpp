// What every host runs: the bits of every function, on every set that the processor has and in any floating-point mode
// of the thread, are those of the file that the library's own build wrote. With --write, writes that file.
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <sstream>

#include "every_function.h"

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#if VNDF_VERSION < 100 || VNDF_VERSION != VNDF_VERSION_MAJOR * 10000 + VNDF_VERSION_MINOR * 100 + VNDF_VERSION_PATCH
#error "no version"
#endif

static std::string bits() {
  std::ostringstream lines;
  EveryFunction all(1000);
  for (const auto& call : all.calls) {
    for (std::size_t c = 0; c < all.out.size(); ++c) std::memset(all.output(c), 0, all.count * sizeof(float));
    call.run();
    std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a
    for (std::size_t c = 0; c < all.out.size(); ++c)
      for (std::size_t i = 0; i < all.count; ++i) {
        std::uint32_t word;
        std::memcpy(&word, all.output(c) + i, sizeof word);
        if ((word & 0x7fffffff) > 0x7f800000) word = 0x7fc00000;  // one NaN is as good as another
        hash = (hash ^ word) * 0x100000001b3u;
      }
    lines << call.name << ' ' << std::hex << hash << '\n';
  }
  return lines.str();
}

static bool same(const std::string& found, const std::string& expected, const std::string& where) {
  std::istringstream a(found), b(expected);
  bool good = true;
  for (std::string left, right; std::getline(a, left) || std::getline(b, right);) {
    if (right.empty()) std::getline(b, right);
    if (left != right) std::cout << where << ": " << left << " instead of " << right << '\n';
    good &= left == right;
    left.clear(), right.clear();
  }
  return good;
}

int main(int argc, char** argv) {
  if (argc == 3) return (std::ofstream(argv[2]) << bits()).good() ? 0 : 1;
  if (argc != 2) return 2;
  std::ostringstream expected;
  expected << std::ifstream(argv[1]).rdbuf();
  bool good = !expected.str().empty() && vndf::version() == VNDF_VERSION;
  if (!good) std::cout << "no file " << argv[1] << ", or a library of another version\n";
  for (const vndf::Isa& isa : vndf::isas()) {
    if (!isa.supported) continue;
    good &= vndf::set_isa(isa.name) == vndf::IsaError::none;
    good &= same(bits(), expected.str(), isa.name);
#if defined(__SSE__)
    const unsigned mode = _mm_getcsr();
    _mm_setcsr(0x1f80 | 0x8040 | 0x4000);  // FTZ and DAZ, as -ffast-math links them into a program; upwards
    std::string found = bits();
    good &= _mm_getcsr() >> 13 == (0x1f80 | 0x8040 | 0x4000) >> 13;  // given back
    _mm_setcsr(mode);
    good &= same(found, expected.str(), isa.name + std::string(" in another mode"));
#endif
    std::printf("%s ", isa.name);
  }
  std::printf(good ? "good\n" : "bad\n");
  return good ? 0 : 1;
}
