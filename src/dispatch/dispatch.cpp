// Picks the instruction set at run time. Sees neither SIMD types nor kernels.
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <vndf/lanes/compiler.h>
#include <vndf/version.h>

#include "dispatch.h"
#include "processor.h"

namespace vndf {

int version() noexcept {
  return VNDF_VERSION;
}

namespace {

struct Row {
  const char* name;
  bool (*supported)();
};

// One line per row of cmake/isa.cmake: VNDF_ISA(name, supported).
#define VNDF_ISA(name, supported) {#name, +[]() -> bool { return supported; }},
constexpr Row kRows[] = {
#include "isa_rows.h"
};

constexpr std::size_t kCount = sizeof kRows / sizeof kRows[0];

std::atomic<const Row*> chosen{nullptr};

IsaError find(const char* name, const Row*& found) noexcept {
  for (const Row& candidate : kRows)
    if (name && std::strcmp(name, candidate.name) == 0) {
      if (!candidate.supported()) return IsaError::unsupported;
      found = &candidate;
      return IsaError::none;
    }
  return IsaError::unknown;
}

/// Out of line, so that a batch pays for one load, one test and one indirect call.
VNDF_NOINLINE const Row* choose() noexcept {
  const Row* best = &kRows[0];
  for (const Row& candidate : kRows)
    if (candidate.supported()) best = &candidate;
  bool complain = false;
  IsaError error = IsaError::none;
  const char* name = std::getenv("VNDF_ISA");
  if (name && *name) {
    error = find(name, best);
    complain = error != IsaError::none;
  }
  // Threads that come here together agree on one choice. Only the thread that made it reports a wrong name.
  const Row* expected = nullptr;
  if (!chosen.compare_exchange_strong(expected, best, std::memory_order_acq_rel)) return expected;
  if (complain) std::fprintf(stderr, "vndf: VNDF_ISA=%s ignored, using %s: %s\n", name, best->name, message(error));
  return best;
}

const Row& active() noexcept {
  const Row* row = chosen.load(std::memory_order_acquire);
  return row ? *row : *choose();
}

}  // namespace

std::size_t active_row() noexcept {
  return static_cast<std::size_t>(&active() - kRows);
}

Isas isas() noexcept {
  struct List {
    Isa rows[kCount];
    List() {
      for (std::size_t i = 0; i < kCount; ++i) rows[i] = {kRows[i].name, kRows[i].supported()};
    }
  };
  static const List list;
  return {list.rows, list.rows + kCount};
}

const char* active_isa() noexcept {
  return active().name;
}

IsaError set_isa(const char* name) noexcept {
  const Row* found = nullptr;
  IsaError error = find(name, found);
  if (error == IsaError::none) chosen.store(found, std::memory_order_release);
  return error;
}

const char* message(IsaError error) noexcept {
  switch (error) {
    case IsaError::none:
      return "no error";
    case IsaError::unknown:
      return "no such instruction set; compiled in:" VNDF_ISA_NAMES;
    case IsaError::unsupported:
      return "this processor or operating system does not support it; vndf::isas() lists what they support";
  }
  return "not an error of this library";
}

}  // namespace vndf
