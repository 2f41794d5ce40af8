// The warps in the order of vndf::Warp, from which every table is filled.
#pragma once

#include <vndf/lanes/warps.h>

namespace {

template <class... Warp>
struct List {};
using Warps = List<vndf::lanes::Polar, vndf::lanes::Concentric, vndf::lanes::SphericalCap>;

}  // namespace
