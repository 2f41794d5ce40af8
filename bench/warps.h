// The warps by name: the one list that the programs of this folder go through.
#pragma once

#include <vndf/vndf.h>

namespace bench {

struct NamedWarp {
  vndf::Warp warp;
  const char* name;
};
constexpr NamedWarp kWarps[] = {
    {vndf::Warp::polar, "polar"}, {vndf::Warp::concentric, "concentric"}, {vndf::Warp::spherical_cap, "spherical_cap"}};

}  // namespace bench
