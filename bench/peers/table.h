// What each peer's file gives peers.cpp.
#pragma once

#include "peers.h"

namespace peers {

Sample paper_listing, spherical_cap, heitz_2017, heitz_deon_2014, heitz_deon_2014_roots, ndf_walter_2007;
Oracle paper_listing_exact, spherical_cap_exact, heitz_2017_exact, heitz_deon_2014_exact, ndf_walter_2007_exact;

// One copy per instruction set: VNDF_PEER_ISA(name, supported).
#define VNDF_PEER_ISA(name, supported) Sample paper_listing_fast_##name;
#include "peer_isas.h"
#undef VNDF_PEER_ISA

}  // namespace peers
