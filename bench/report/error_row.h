// One line of the report's errors.
#pragma once

#include "output.h"
#include "reference/errors.h"
#include "reference/hard_cases.h"

namespace report {

/// What every line tells. Errors that are infinite become null: JSON has no word for that.
inline Json error_row(const char* implementation, const char* warp, const vndf::reference::HardCase& hard_case,
                      std::size_t samples, const vndf::reference::NormalErrors& errors) {
  return {{"implementation", implementation},
          {"warp", warp},
          {"row", hard_case.name},
          {"samples", samples},
          {"mean_eps", errors.mean},
          {"p999_eps", errors.p999},
          {"max_eps", errors.max},
          {"norm_eps", errors.max_norm}};
}

}  // namespace report
