// Numbers as JSON has them.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>

namespace report {

/// A number, or null where it is infinite: JSON has no word for that.
inline std::string number(double value) {
  if (!std::isfinite(value)) return "null";
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

}  // namespace report
