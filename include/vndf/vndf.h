// vndf: GGX visible normals for wavefront renderers, in structure-of-arrays batches, with the same bits on every
// instruction set.
//
// Conventions. Directions are in the local shading frame: +z is the geometric normal, x and y the axes of alpha_x and
// alpha_y. wo points away from the surface, towards the viewer. All values are binary32.
//
// Guarantees, of every function that takes columns:
//  - Identical bits: scalar, SSE4.2, AVX2 and AVX-512 agree in every bit of every result that is not NaN, and have NaN
//  in
//    the same places. Only + - * / sqrt, comparisons and bit operations are used, each rounded as IEEE 754 says, so any
//    other IEEE 754 machine agrees too. The caller's rounding mode must be to-nearest; with FTZ or DAZ set, the sets
//    still agree with each other.
//  - Lanes are independent: a result depends on the inputs of its own index alone, not on how a batch is split, where
//    it starts, or what its neighbours are.
//  - noexcept, no allocation, no locks, no floating-point exceptions trapped, and no global state but the choice of the
//    instruction set: callable from any number of threads at once.
//  - Any count including 0, any alignment that a float may have (64 bytes is fastest), nothing written outside
//    [0, count) of an output.
//  - Aliasing: an output may be the same column as an input of the same call (in place), since every input of an index
//  is
//    read before its outputs are written. Outputs must not overlap one another, nor an input at another offset.
#pragma once

#include <cstddef>

namespace vndf {

/// An input column: `count` floats, or one value for the whole batch (a material's alpha, a directional camera). The
/// two give the same bits as each other; a constant saves the reads. The floats must outlive the call only.
struct Column {
  const float* data;  ///< `count` floats, or a null pointer for a constant
  float value;        ///< the constant, where data is null

  constexpr Column(const float* column) noexcept : data(column), value(0.f) {}
  constexpr Column(float constant) noexcept : data(nullptr), value(constant) {}
};

/// Two columns: a pair of random numbers, or alpha_x and alpha_y.
struct Columns2 {
  Column x, y;
};

/// Three columns: directions.
struct Columns3 {
  Column x, y, z;
};

/// Two output columns.
struct Out2 {
  float *x, *y;
};

/// Three output columns.
struct Out3 {
  float *x, *y, *z;
};

/// How two random numbers become a visible normal. The density is the same for all three; stratified points keep their
/// strata best through `concentric`, and `spherical_cap` costs least.
enum class Warp {
  polar,          ///< Heitz 2018, eq. 9-10
  concentric,     ///< Shirley and Chiu 1997; Walter et al. 2015, eq. 34-37
  spherical_cap,  ///< Dupuy and Benyoub 2023, Listing 3
};

/// The two maps from the unit square to the unit disk.
enum class DiskMap { polar, concentric };

/// Samples the GGX distribution of visible normals, D_wo(wm) = G1(wo) max(0, wo.wm) D(wm) / wo.z.
///
/// wo     unit view directions; views below the horizon (z < 0) are sampled as Heitz 2018, section 4.2, extends the
///        distribution to them. Any other length from 1e-30 to 1e30 gives the normal of the direction.
/// alpha  roughness along x and y, from 1e-30 to 100 (up to 1e6 for views in the upper hemisphere), isotropic or not.
/// u      uniform random numbers in [0, 1]; both ends are allowed.
/// wm     unit normals of the upper hemisphere, wm.z >= 0.
///
/// ERR1
///
/// Special values, each confined to its own lane:
///  - wo = (0, 0, -1): no normal is visible; some unit normal of the upper hemisphere.
///  - wo = 0: as a horizontal view along x.
///  - azimuth (alpha_x wo.x, alpha_y wo.y) below 2^-100 in both components (polar, concentric): taken as +x.
///  - alpha = 0: the limit of a mirror, (0, 0, 1), unless wo is horizontal.
///  - negative alpha: as its absolute value, with the normal mirrored in that axis.
///  - u outside [0, 1]: a unit normal of no particular distribution, or NaN.
///  - NaN or infinity in any input of a lane, or |alpha wo| >= 2^126: unspecified values or NaN in that lane.
///
/// Source: Heitz, Sampling the GGX Distribution of Visible Normals, JCGT 7(4), 2018, sections 3 and 4, in the forms
/// without cancellation that lanes/hemisphere.h derives.
void sample_normals(Warp warp, std::size_t count, const Columns3& wo, const Columns2& alpha, const Columns2& u,
                    const Out3& wm) noexcept;

/// Maps random numbers to points uniformly distributed on the unit disk.
///
/// u      uniform random numbers in [0, 1].
/// t      points (t1, t2). Polar: sqrt(u1) (cos, sin)(2 pi u2), Heitz 2018, eq. 9-10. Concentric: Walter et al. 2015,
///        eq. 34-37.
///
/// ERR2
///
/// u outside [0, 1], infinite or NaN: unspecified values or NaN in that lane.
void sample_disk(DiskMap map, std::size_t count, const Columns2& u, const Out2& t) noexcept;

/// How masking of the view and shadowing of the light go together: G2, Smith's.
enum class Masking {
  height_correlated,  ///< 1 / (1 + Lambda(wo) + Lambda(wi)), Heitz 2014, eq. 99
  separable,          ///< G1(wo) G1(wi)
};

struct ReflectionOptions {
  Masking masking = Masking::height_correlated;
  bool bounded = false;
};

struct ReflectionSamples {
  Out3 wi;
  float* pdf;
  float* weight;
  Out3 wm = {nullptr, nullptr, nullptr};
  float* wo_dot_wm = nullptr;
};

void sample_reflection(Warp warp, std::size_t count, const Columns3& wo, const Columns2& alpha, const Columns2& u,
                       const ReflectionSamples& out, const ReflectionOptions& options = {}) noexcept;

struct Evaluations {
  float* f_cos;
  float* pdf;
};

void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const Columns2& alpha,
                         const Evaluations& out, const ReflectionOptions& options = {}) noexcept;

void pdf_normals(std::size_t count, const Columns3& wo, const Columns3& wm, const Columns2& alpha,
                 float* pdf) noexcept;

struct DielectricSamples {
  Out3 wi;
  float* pdf;
  float* weight;
  float* side;
};

void sample_dielectric(Warp warp, std::size_t count, const Columns3& wo, const Columns2& alpha, const Column& eta,
                       const Columns3& u, const DielectricSamples& out,
                       Masking masking = Masking::height_correlated) noexcept;

void evaluate_dielectric(std::size_t count, const Columns3& wo, const Columns3& wi, const Columns2& alpha,
                         const Column& eta, const Evaluations& out,
                         Masking masking = Masking::height_correlated) noexcept;

/// An instruction set that the library was compiled for.
struct Isa {
  const char* name;  ///< "scalar", "sse42", "avx2", "avx512"
  bool supported;    ///< by this processor and its operating system
};

/// The instruction sets compiled in, slowest first.
struct Isas {
  const Isa* first;
  const Isa* last;
  const Isa* begin() const noexcept { return first; }
  const Isa* end() const noexcept { return last; }
};
Isas isas() noexcept;

/// The name of the set in use: the last one of isas() that is supported, unless the environment variable VNDF_ISA or
/// set_isa() chose another. VNDF_ISA is read once, before the first batch; a name that is unknown or not supported is
/// reported on stderr once, and ignored.
const char* active_isa() noexcept;

enum class IsaError { none, unknown, unsupported };

/// Chooses the instruction set by name. An unknown or unsupported name (or a null pointer) changes nothing and is
/// answered with the reason. Calls under way in other threads finish on the set they began with; their results are the
/// same.
[[nodiscard]] IsaError set_isa(const char* name) noexcept;

/// One line for people: what was wrong, and which names are accepted here.
const char* message(IsaError error) noexcept;

}  // namespace vndf
