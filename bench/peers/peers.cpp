// The table of peers.
#include "peers.h"

#include "table.h"

#ifdef VNDF_PEERS_ISPC
// Functions that ispc compiled, of C names, for every instruction set.
using Ispc = void(int, const float* const in[], float* const out[]);
#define VNDF_PEER_ISA(isa, supported)                                                                                  \
  extern "C" Ispc ispc_listing_##isa, ispc_caps_##isa, ispc_disk_polar_##isa, ispc_disk_concentric_##isa,              \
      ispc_reflection_##isa, ispc_reflection_caps_##isa, ispc_evaluation_##isa, ispc_pdf_##isa, ispc_dielectric_##isa, \
      ispc_dielectric_caps_##isa, ispc_dielectric_evaluation_##isa;
#include "peer_isas.h"
#undef VNDF_PEER_ISA
#endif

namespace peers {

#ifdef VNDF_PEERS_ISPC
template <Ispc function>
static void in_ispc(std::size_t count, const float* const in[], float* const out[]) {
  function(static_cast<int>(count), in, out);
}
#endif

Peers peers() {
  static const Peer table[] = {
      {"paper_listing", "sample_normals", "polar", "scalar", true, 10, paper_listing, paper_listing_exact},
      {"spherical_cap_listing", "sample_normals", "spherical_cap", "scalar", true, 10, spherical_cap,
       spherical_cap_exact},
      {"heitz_2017", "sample_normals", "own", "scalar", true, 10, heitz_2017, heitz_2017_exact},
      {"heitz_deon_2014", "sample_normals", "own", "scalar", true, 10, heitz_deon_2014, heitz_deon_2014_exact},
      {"heitz_deon_2014_roots", "sample_normals", "own", "scalar", true, 10, heitz_deon_2014_roots,
       heitz_deon_2014_exact},
      {"ndf_walter_2007", "sample_ndf", "own", "scalar", true, 10, ndf_walter_2007, ndf_walter_2007_exact},
#define VNDF_PEER_ISA(isa, supported) \
  {"paper_listing_fast", "sample_normals", "polar", #isa, supported, 10, paper_listing_fast_##isa, paper_listing_exact},
#include "peer_isas.h"
#undef VNDF_PEER_ISA
#ifdef VNDF_PEERS_ISPC
#define VNDF_ISPC(name, function, isa, supported, operation, warp, columns, oracle) \
  {"ispc_" #name, operation, warp, #isa, supported, columns, in_ispc<ispc_##function##_##isa>, oracle},
#define VNDF_PEER_ISA(isa, supported)                                                                       \
  VNDF_ISPC(listing, listing, isa, supported, "sample_normals", "polar", 10, paper_listing_exact)           \
  VNDF_ISPC(caps, caps, isa, supported, "sample_normals", "spherical_cap", 10, spherical_cap_exact)         \
  VNDF_ISPC(disk, disk_polar, isa, supported, "sample_disk", "polar", 4, nullptr)                           \
  VNDF_ISPC(disk, disk_concentric, isa, supported, "sample_disk", "concentric", 4, nullptr)                 \
  VNDF_ISPC(reflection, reflection, isa, supported, "sample_reflection", "polar", 12, nullptr)              \
  VNDF_ISPC(reflection, reflection_caps, isa, supported, "sample_reflection", "spherical_cap", 12, nullptr) \
  VNDF_ISPC(evaluation, evaluation, isa, supported, "evaluate_reflection", "none", 10, nullptr)             \
  VNDF_ISPC(pdf, pdf, isa, supported, "pdf_normals", "none", 9, nullptr)                                    \
  VNDF_ISPC(dielectric, dielectric, isa, supported, "sample_dielectric", "polar", 14, nullptr)              \
  VNDF_ISPC(dielectric, dielectric_caps, isa, supported, "sample_dielectric", "spherical_cap", 14, nullptr) \
  VNDF_ISPC(dielectric_evaluation, dielectric_evaluation, isa, supported, "evaluate_dielectric", "none", 10, nullptr)
#include "peer_isas.h"
#undef VNDF_PEER_ISA
#endif
  };
  return {table, table + sizeof table / sizeof table[0]};
}

}  // namespace peers
