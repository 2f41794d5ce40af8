// The table of peers.
#include "peers.h"

#include "table.h"

#ifdef VNDF_PEERS_ISPC
// ispc compiles one function per source and instruction set, with a C name. peers.h's signature, taken apart.
#define VNDF_PEER_ISA(name, supported)                                                                                 \
  extern "C" void ispc_listing_##name(int, const float*, const float*, const float*, const float*, const float*,       \
                                      const float*, const float*, float*, float*, float*);                             \
  extern "C" void ispc_caps_##name(int, const float*, const float*, const float*, const float*, const float*,          \
                                   const float*, const float*, float*, float*, float*);                                \
  namespace peers {                                                                                                    \
  static void listing_##name(std::size_t n, const float* const in[7], float* const out[3]) {                           \
    ispc_listing_##name(static_cast<int>(n), in[0], in[1], in[2], in[3], in[4], in[5], in[6], out[0], out[1], out[2]); \
  }                                                                                                                    \
  static void caps_##name(std::size_t n, const float* const in[7], float* const out[3]) {                              \
    ispc_caps_##name(static_cast<int>(n), in[0], in[1], in[2], in[3], in[4], in[5], in[6], out[0], out[1], out[2]);    \
  }                                                                                                                    \
  }
#include "peer_isas.h"
#undef VNDF_PEER_ISA
#endif

namespace peers {

Peers peers() {
  static const Peer table[] = {
      {"paper_listing", "sample_normals", "polar", "scalar", true, paper_listing, paper_listing_exact},
      {"spherical_cap_listing", "sample_normals", "spherical_cap", "scalar", true, spherical_cap, spherical_cap_exact},
      {"heitz_2017", "sample_normals", "own", "scalar", true, heitz_2017, heitz_2017_exact},
      {"heitz_deon_2014", "sample_normals", "own", "scalar", true, heitz_deon_2014, heitz_deon_2014_exact},
      {"heitz_deon_2014_roots", "sample_normals", "own", "scalar", true, heitz_deon_2014_roots, heitz_deon_2014_exact},
      {"ndf_walter_2007", "sample_ndf", "own", "scalar", true, ndf_walter_2007, ndf_walter_2007_exact},
#define VNDF_PEER_ISA(name, supported) \
  {"paper_listing_fast", "sample_normals", "polar", #name, supported, paper_listing_fast_##name, paper_listing_exact},
#include "peer_isas.h"
#undef VNDF_PEER_ISA
#ifdef VNDF_PEERS_ISPC
#define VNDF_PEER_ISA(name, supported)                                                                \
  {"ispc_listing", "sample_normals", "polar", #name, supported, listing_##name, paper_listing_exact}, \
      {"ispc_caps", "sample_normals", "spherical_cap", #name, supported, caps_##name, spherical_cap_exact},
#include "peer_isas.h"
#undef VNDF_PEER_ISA
#endif
  };
  return {table, table + sizeof table / sizeof table[0]};
}

}  // namespace peers
