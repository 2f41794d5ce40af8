// What is measured of the library, as one list.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "inputs.h"

namespace bench {

/// One call on all of a batch.
using Call = std::function<void(const Batch&)>;

struct Operation {
  std::string name;  // <operation>/<warp>/<isa>
  const char* isa;   // to set in the library, or null
  int columns;       // read and written
  Call call;
  bool once = false;  // with camera/4096 alone
};

/// Of all functions, on the instruction sets that this processor has.
std::vector<Operation> operations();
/// Chooses the operation's instruction set. Answers whether the library has it.
bool set_isa(const Operation& operation);

/// The two, of a library that vndf_compare loads.
struct Module {
  std::vector<Operation> (*operations)();
  bool (*set_isa)(const Operation&);
};

}  // namespace bench

extern "C" __attribute__((visibility("default"))) const bench::Module vndf_module;
