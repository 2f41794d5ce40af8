// vndf: GGX visible normals for wavefront renderers, in structure-of-arrays batches, with the same bits on every
// instruction set.
//
// Conventions. Directions are in the local shading frame: +z is the geometric normal, x and y the axes of alpha_x and
// alpha_y. wo points away from the surface, towards the viewer. All values are binary32.
//
// Guarantees, of every function that takes columns:
//  - Identical bits: scalar, SSE4.2, AVX2, AVX-512, NEON agree in every bit of every result that is not NaN, and have
//    NaN in the same places. Only + - * / sqrt, comparisons and bit operations are used, each rounded as IEEE 754 says,
//    so any other IEEE 754 machine agrees too. Neither the program's compiler flags, -ffast-math among them, nor the
//    modes of the calling thread change them: during a call, rounding, FTZ, DAZ and traps are as C++ begins with.
//  - Lanes are independent: a result depends on the inputs of its own index alone, not on how a batch is split, where
//    it starts, or what its neighbours are.
//  - noexcept, no allocation, no locks, and no global state but the choice of the instruction set: callable from any
//    number of threads at once. Both sides of a choice are computed, so the flags of floating-point exceptions may be
//    raised for good inputs too.
//  - Any count including 0, any alignment that a float may have (64 bytes is fastest). Nothing is written outside
//    [0, count) of an output.
//  - In place: an output may be the same column as an input of the same call, since every input of an index is read
//    before its outputs are written. Outputs must not overlap one another, nor an input at another offset.
//  - Every output is written. A pointer may be null only where count is 0 or the output is said to be optional.
//  - Preconditions, which debug builds of the library assert: such pointers, enumerators in their range, and count <=
//    PTRDIFF_MAX / 4.
//  - Results are finite for finite inputs of the stated domains. Densities are at most 2^60, which stands for a delta
//    (alpha 0, an index of 1). Its square is finite too, so multiple importance sampling weighs it as a delta.
//  - NaN or infinity in any input, and inputs outside the stated domain, give unspecified values or NaN in that lane
//    alone, unless a function says otherwise.
//
// Accuracy is stated as a ratio, since some problems are so steep that a distance says nothing. The ratio is the error
// of a result over the sum of two things: what the exact result moves by when each input moves by half a unit of its
// last place, all moves added up; and 2^-25 of the result. A correctly rounded result has at most 2. tests/ratio
// measures it against the papers' plain formulas in quadruple precision, for alpha from 1e-6 to 100 and up to eight
// decades apart, views off unit length by up to 1e-3, random numbers of any spacing from 2^-149, 0 and 1 included. The
// bounds below are those of these tests. Searches find 6.2 where 6 is stated, 10.7 where 8 is for normals from caps, 17
// where 8 is for densities, and 77 where 16 is for leaning ellipsoids; next to the critical angle of a dielectric a
// ratio says nothing: see tests/README.md. eps is 2^-24.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#include <vndf/version.h>

namespace VNDF_API vndf {

/// An input column: `count` floats, or one value for the whole batch (a material's alpha, a directional camera), which
/// saves the reads. Both give the same bits, except for the columns of an Ellipsoid, which choose how it is computed.
/// The floats must live until the call returns.
struct Column {
  const float* data;       ///< `count` floats, or a null pointer for a constant
  float value;             ///< the constant
  std::uint32_t constant;  ///< 1 or 0; as wide as the value beside it, so that both are one store of a small call

  /// `count` floats. A null pointer, unless for count 0, is an error of the caller's: debug builds of the library
  /// assert it, others read the constant 0.
  constexpr Column(const float* column) noexcept : data(column), value(0.f), constant(0) {}
  /// A constant of any arithmetic type, so that {0, 0, 1} is a direction and 0 not a pointer.
  template <class T, class = std::enable_if_t<std::is_arithmetic<T>::value>>
  constexpr Column(T constant_) noexcept : data(nullptr), value(static_cast<float>(constant_)), constant(1) {}
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

/// How two random numbers become a visible normal. The density is the same for all three. `concentric` keeps the strata
/// of stratified points best; `spherical_cap` costs least.
enum class Warp {
  polar,          ///< Heitz 2018, eq. 9-10
  concentric,     ///< Shirley and Chiu 1997; Walter et al. 2015, eq. 34-37
  spherical_cap,  ///< Dupuy and Benyoub 2023, Listing 3, with azimuths from the point opposite to the view
};

/// The two maps from the unit square to the unit disk.
enum class DiskMap { polar, concentric };

/// Samples the GGX distribution of visible normals, D_wo(wm) = G1(wo) max(0, wo.wm) D(wm) / wo.z.
///
/// wo     view directions of any length. Views below the horizon (z < 0) are sampled as well.
/// alpha  GGX's parameter along x and y, isotropic or not. It is not the roughness r of material formats (glTF, Disney,
///        OpenPBR), whose alpha is r^2.
/// u      uniform random numbers in [0, 1], both ends included.
/// wm     unit normals of the upper hemisphere, wm.z >= 0.
///
/// Domain   alpha from 1e-30 to 2^24, |alpha wo| < 2^126. Accuracy is promised for alpha from 1e-6 to 100.
/// Error    ratio at most 6 for polar and concentric (p99.9 4), 8 for spherical_cap; |wm| within 5 eps of 1.
/// Special  u = 0 and 1: the limit. alpha = 0: (0, 0, 1), within 2 eps. Negative alpha: wo is mirrored in that axis,
///          and the normal mirrored back. wo = 0, and wo = (0, 0, -1), which sees no normal: some unit normal of the
///          upper hemisphere.
/// Source   Heitz, Sampling the GGX Distribution of Visible Normals, JCGT 7(4), 2018, sections 3 and 4, in the forms
///          without cancellation that lanes/hemisphere.h derives. include/README.md has the fine print.
void sample_normals(Warp warp, std::size_t count, const Columns3& wo, const Columns2& alpha, const Columns2& u,
                    const Out3& wm) noexcept;

/// Maps random numbers to points uniformly distributed on the unit disk.
///
/// u        uniform random numbers in [0, 1].
/// t        points (t1, t2). |t|^2 can exceed 1 by 7 eps.
///
/// Error    4 eps; measured over 2^20 random points: 3.2 for polar, 2.5 for concentric (tests/disk_test.cpp).
/// Source   polar: sqrt(u1) (cos, sin)(2 pi u2), Heitz 2018, eq. 9-10; concentric: Walter et al. 2015, eq. 34-37.
void sample_disk(DiskMap map, std::size_t count, const Columns2& u, const Out2& t) noexcept;

/// Smith's G2: how the masking of the view and the shadowing of the light go together.
enum class Masking {
  height_correlated,  ///< 1 / (1 + Lambda(wo) + Lambda(wi)), Heitz 2014, eq. 99
  separable,          ///< G1(wo) G1(wi)
};

struct ReflectionOptions {
  Masking masking = Masking::height_correlated;
  /// Leaves out normals that can only reflect below the surface, as far as the view and the smaller alpha tell them
  /// (Eto and Tokuyoshi 2023; Tokuyoshi and Eto 2024). The less alpha_x and alpha_y differ, the more it leaves out: for
  /// wo.z = 0.95, rejected samples go from 49 % to 0 (alpha 1), 26 % to 4 % (0.6), 23 % to 21 % (0.2 and 0.8).
  /// Samples, density and weight are those of the smaller set of normals, so evaluation must be told the same.
  bool bounded = false;
  /// Views from below (wo.z < 0, or -0) see the surface from above, mirrored: wo.z changes its sign, and so do wi.z and
  /// wm.z. Sheets that are seen from both sides need it, and so do shading normals that turn away from the view: normal
  /// maps and interpolated normals make such views, whose pdf and weight of 0 are black pixels otherwise.
  bool two_sided = false;
};

/// Where sample_reflection writes: wi, pdf and weight always; wm.x, wm.y, wm.z and wo_dot_wm are optional, each where
/// its pointer is not null.
struct ReflectionSamples {
  Out3 wi;
  float* pdf;
  float* weight;
  Out3 wm = {nullptr, nullptr, nullptr};
  float* wo_dot_wm = nullptr;
};

/// Samples reflection of the view at a visible normal, with density and weight, in one pass.
///
/// warp       as for sample_normals. Bounded, polar and concentric lay their disk point on the cap by Lambert's map.
/// wo         unit view directions. Unless two-sided, pdf and weight are 0 for z < 0, and wi is of no use.
/// alpha, u   as for sample_normals.
/// wi         2 (wo.wm) wm - wo, eq. 16. For wi.z <= 0 it is written all the same, and pdf and weight are 0.
/// pdf        density of wi over solid angle, eq. 17: D(wm) G1(wo) / (4 wo.z), more if bounded.
/// weight     f(wo, wi) wi.z / pdf without Fresnel's factor, in [0, 1]: G2(wo, wi) / G1(wo), eq. 19, less if bounded.
/// wm         the normal; unless bounded, bit for bit that of sample_normals.
/// wo_dot_wm  its cosine to the view, for Fresnel's factor. Neither it nor wi.z is above 1 for unit views.
///
/// Domain   alpha from 1e-6 to 100.
/// Error    ratio at most 16 for wi, pdf and weight; for wm that of sample_normals, or 8 if bounded. |wi| is within 16
///          eps of |wo| where that is within 8 eps of 1, else within 24. For the weight, wi.z may be 2^-42 off besides,
///          2^-25 if bounded. pdf agrees with evaluate_reflection of the rounded wi within 4 eps (4 + 2 / alpha) /
///          (wo.wm), where alpha is the smaller one and at most 1; within twice that for alpha above 1.
/// Special  alpha_x or alpha_y = 0: pdf at most 2^60, and exactly that where both are 0. wo = 0: pdf and weight 0.
///          Negative alpha: pdf and weight of |alpha|, normals of sample_normals. wo not of unit length: wi is as long,
///          and pdf is that of the unit view over |wo|; if bounded, the samples are others.
/// Source   Heitz 2018, appendix B, in the forms without division by cosines of lanes/ndf.h and lanes/reflection.h.
void sample_reflection(Warp warp, std::size_t count, const Columns3& wo, const Columns2& alpha, const Columns2& u,
                       const ReflectionSamples& out, const ReflectionOptions& options = {}) noexcept;

/// Where the evaluations write: f_cos and pdf always. wo_dot_wm is optional for evaluate_reflection, and must be null
/// for evaluate_dielectric, which has Fresnel's factor in its f_cos.
struct Evaluations {
  float* f_cos;
  float* pdf;
  float* wo_dot_wm = nullptr;
};

/// The BRDF of a pair of directions, and the density that sample_reflection has for it: for light that was sampled
/// otherwise, and for multiple importance sampling.
///
/// wo, wi     unit directions.
/// alpha      as for sample_normals; below 2^-60 it is taken as 2^-60.
/// f_cos      f(wo, wi) wi.z without Fresnel's factor: D(h) G2(wo, wi) / (4 wo.z), eq. 15.
/// pdf        density of wi given wo, under the same options as sample_reflection.
/// wo_dot_wm  the cosine of either direction to the normal between them, for Fresnel's factor: |wo + wi| / 2, at most 1
///            and within 4 eps, relatively.
///
/// Domain   alpha from 1e-6 to 100, lengths near 1.
/// Error    ratio at most 8; relative at most 25 eps. Nothing cancels: h = wo + wi is taken as it is.
/// Special  wo.z < 0 (unless two-sided), wi.z <= 0 or wo = 0: f_cos and pdf 0. |wo + wi| < 2^-70: finite, perhaps 0.
///          alpha = 0 and h = +z: up to 2^60.
/// Source   Heitz 2018, eq. 15 and 17; Eto and Tokuyoshi 2023, eq. 8.
void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const Columns2& alpha,
                         const Evaluations& out, const ReflectionOptions& options = {}) noexcept;

/// The density that sample_normals has: D_wo(wm) = G1(wo) max(0, wo.wm) D(wm) / wo.z, for views above and below the
/// horizon.
///
/// wo, wm   unit directions.
/// alpha    as for sample_normals; D takes alpha below 2^-60 as 2^-60.
/// pdf      density of wm over solid angle; 0 where wm.z < 0 or wo.wm <= 0, and for wo = 0.
///
/// Domain   alpha from 1e-6 to 100.
/// Error    ratio at most 8; relative at most 25 eps / (wo.wm), since wo.wm is a sum of products of what is given. The
///          integral over all wm is 1 within 1e-5.
/// Source   Heitz 2018, eq. 3.
void pdf_normals(std::size_t count, const Columns3& wo, const Columns3& wm, const Columns2& alpha, float* pdf) noexcept;

/// Smith's G2 of a refraction, where wo and wi are on different sides of the surface. Renderers differ here, and so do
/// their pictures: of light at 85 degrees, 61, 75 and 45 % pass a surface of alpha 0.5 and eta 1.5, in this order
/// (tests/shading/options_test.cpp).
enum class AcrossMasking {
  separable,          ///< G1(wo) G1(wi), Walter et al. 2007, eq. 23: between the others
  as_reflection,      ///< 1 / (1 + Lambda(wo) + Lambda(wi)), as pbrt and Cycles have it: what wo sees, wi sees too
  height_correlated,  ///< B(1 + Lambda(wo), 1 + Lambda(wi)), Euler's beta function: exact for Smith's surfaces, where
                      ///< what is high for the one is deep for the other (Heitz, Hanika, d'Eon, Dachsbacher 2016)
};

struct DielectricOptions {
  Masking masking;  ///< of reflections
  AcrossMasking across = AcrossMasking::separable;
  /// Weight and f_cos of refracted light count radiance, not energy: they have the factor (index at wo / index at
  /// wi)^2. Paths from the camera carry radiance, paths from lights energy.
  bool radiance = false;
  /// The probability of reflection, in [0, 1], in place of Fresnel's reflectance: 1 asks for reflection alone, 0 for
  /// refraction alone. pdf and weight follow; probabilities below 2^-60 can make weights that are infinite.
  std::optional<Column> reflection_probability = std::nullopt;

  constexpr DielectricOptions(Masking masking_ = Masking::height_correlated) noexcept : masking(masking_) {}
};

/// Where sample_dielectric writes: wi, pdf, weight and side always; the others are optional, each where its pointer is
/// not null.
struct DielectricSamples {
  Out3 wi;
  float* pdf;
  float* weight;
  float* side;
  Out3 wm = {nullptr, nullptr, nullptr};
  float* wo_dot_wm = nullptr;
  float* wi_dot_wm = nullptr;
  float* reflectance = nullptr;
};

/// Samples reflection or refraction at a visible normal of a rough dielectric.
///
/// wo      unit view directions. z >= 0 is outside. Views with z < 0 are inside: they see the surface from below.
/// alpha   as for sample_reflection.
/// eta     index of refraction below the surface (z < 0) over the index above it.
/// u       three uniform random numbers in [0, 1]: two for the normal. The third chooses reflection where it is less
///         than Fresnel's reflectance for unpolarised light, or than the probability given.
/// wi      unit, on wo's side or across; written in any case. Where a given probability chose refraction and reflection
///         is total, it is the reflected direction, with pdf 0.
/// pdf     density of wi over solid angle, with the probability of the choice and the Jacobian of the half vector,
///         eq. 14 and 17. Like the weight, it is 0 where wi comes out at the wrong side of the surface, and where light
///         cannot take the side that was chosen.
/// weight  f(wo, wi) |wi.z| / pdf: G2(wo, wi) / G1(wo), in [0, 1], since Fresnel's factor is in the choice. Where the
///         probability of the choice was given, times Fresnel's factor over that probability.
/// side    1 where reflection was chosen, -1 where refraction was.
/// wm           the unit normal, on the side of the view.
/// wo_dot_wm    its cosine to the view, in [0, 1].
/// wi_dot_wm    its cosine to wi: as wo_dot_wm for a reflection, negative for a refraction.
/// reflectance  Fresnel's, at most 1 + 12 eps; 0 where the surface is index-matched.
///
/// Domain   alpha from 1e-6 to 100, eta from 0.1 to 10.
/// Error    ratio at most 16 for wi, pdf and weight, where |eta - 1| >= 1e-4 and |wo| is within 8 eps of 1; |wi| is
///          then within 96 eps of 1. For |wo| off by up to 1e-3 the ratio holds for reflected wi and the weight alone.
///          For the pdf, Vh.Nh of eq. 13 may be 2^-46 more and wo.wm 2^-62; for the weight, wi.z 2^-42 off. Where the
///          probability was given, this is for wo.wm from 2^-20 and pdf up to 2^50. Height-correlated masking across
///          may be another 30 eps (1 - ln w) off of w = G2 / G1, for |wo.z|, |wi.z| from 1e-6, and is at least 2^-118.
/// Special  |eta - 1| < 2^-16 (seen from below, |1 / eta - 1|) counts as index-matched: wi = -wo, side -1, weight 1 and
///          pdf 2^60, or both 0 for a horizontal view. eta 0, negative, NaN or not between 2^-20 and 2^20: pdf and
///          weight 0. wo = 0: the same.
/// Source   Walter, Marschner, Li and Torrance, Microfacet Models for Refraction through Rough Surfaces, EGSR 2007,
///          with the normals of Heitz 2018.
void sample_dielectric(Warp warp, std::size_t count, const Columns3& wo, const Columns2& alpha, const Column& eta,
                       const Columns3& u, const DielectricSamples& out, const DielectricOptions& options = {}) noexcept;

/// The BSDF of a pair of directions, and the density that sample_dielectric has for it.
///
/// wo, wi, alpha, eta  as for sample_dielectric; wi on either side.
/// f_cos               f(wo, wi) |wi.z|, Fresnel's factor included. It counts energy unless options.radiance is set, as
///                     the weight of sample_dielectric does: f / eta^2 of the side of wi is symmetric.
/// pdf                 density of wi given wo, under the same options as sample_dielectric.
///
/// Error    ratio at most 8, with what sample_dielectric says of options. Fresnel's transmittance is that of both
///          cosines: f / eta^2 is symmetric to 1e-5 relative where neither cosine to the normal is under 0.01.
/// Special  f_cos and pdf are 0 where the normal that would take wo to wi is not one of the upper hemisphere, by more
///          than rounding, and where indices are matched or impossible. So a pair that was sampled with pdf > 0 has a
///          pdf > 0 here too, the same but for the rounding of wi, unless it is index-matched.
/// Source   Walter et al. 2007, eq. 20 and 21.
void evaluate_dielectric(std::size_t count, const Columns3& wo, const Columns3& wi, const Columns2& alpha,
                         const Column& eta, const Evaluations& out, const DielectricOptions& options = {}) noexcept;

/// An instruction set that the library was compiled for.
struct Isa {
  const char* name;  ///< "scalar", "sse42", "avx2", "avx512", "neon"
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
/// set_isa() chose another. VNDF_ISA is read at most once, when the first batch or active_isa() has to choose. A name
/// that is unknown or not supported is reported on stderr once, and ignored.
const char* active_isa() noexcept;

enum class IsaError { none, unknown, unsupported };

/// Chooses the instruction set by name. One that is unknown or not supported, or a null pointer, changes nothing; the
/// answer is the reason. Calls under way in other threads finish on the set they began with: results are the same.
[[nodiscard]] IsaError set_isa(const char* name) noexcept;

/// One line for people: what was wrong, and which names are accepted here.
const char* message(IsaError error) noexcept;

}  // namespace vndf
