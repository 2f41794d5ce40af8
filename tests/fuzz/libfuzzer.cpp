// A call made of the bytes that libFuzzer, which watches coverage, thinks of.
#include <cstdio>
#include <cstdlib>

#include "fuzz/call.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  vndf::fuzz::Source source(data, size);
  const auto outcome = vndf::fuzz::make_call(source);
  if (outcome.fault.empty()) return 0;
  std::fprintf(stderr, "%s\n", outcome.fault.c_str());
  std::abort();
}
