// vndf: GGX visible normals for wavefront renderers, in structure-of-arrays batches, with the same bits on every
// instruction set.
//
// Conventions. Directions are in the local shading frame: +z is the geometric normal, x and y the axes of alpha_x and
// alpha_y. wo points away from the surface, towards the viewer. All values are binary32.
//
// Guarantees, of every function that takes columns:
//  - Identical bits: scalar, SSE4.2, AVX2 and AVX-512 agree in every bit of every result that is not NaN, and have
//    NaN in the same places. Only + - * / sqrt, comparisons and bit operations are used, each rounded as IEEE 754 says,
//    so any other IEEE 754 machine agrees too. Neither the flags of the program reach the bits, -ffast-math among
//    them, nor the modes of the calling thread: rounding, FTZ, DAZ and traps are C++'s own for the call.
//  - Lanes are independent: a result depends on the inputs of its own index alone, not on how a batch is split, where
//    it starts, or what its neighbours are.
//  - noexcept, no allocation, no locks, and no global state but the choice of the instruction set: callable from any
//    number of threads at once. Both sides of a choice are computed, so the flags of floating-point exceptions may be
//    raised for good inputs too.
//  - Any count including 0, any alignment that a float may have (64 bytes is fastest), nothing written outside
//    [0, count) of an output.
//  - Aliasing: an output may be the same column as an input of the same call (in place), since every input of an index
//    is read before its outputs are written. Outputs must not overlap one another, nor an input at another offset.
//  - Every output is written. Outputs may be null pointers only for count 0, or where ReflectionSamples says. That,
//    enumerators in their range and count <= PTRDIFF_MAX / 4 are preconditions, which debug builds of the library
//    assert.
//  - Results are finite for finite inputs of the stated domains. A density is at most 2^60, the one of what is a delta,
//    roughness 0 or an index of 1, where it is sampled. Its square is finite too, so the weights of multiple importance
//    sampling are those of a delta.
//
// Accuracy is stated as a ratio, since some inputs are so steep that a distance says nothing: the error of a result
// over the sum of what the exact result moves by when each input moves by half a unit of its last place, and half a
// unit of the result's last place. A correctly rounded result has at most 1. The ratios are bounds that tests/ratio
// holds against the papers' plain formulas in quadruple precision, with a thousand and more samples of each of 43 rows:
// near-normal, grazing and horizontal views, views below the horizon, floors seen at 89 to 89.9999 degrees, views off
// unit length by up to 1e-3, alpha from 1e-6 to 100 and eight decades apart, and random numbers of any spacing from
// 2^-149, 0 and 1 included. A search for worse inputs finds 5.8 where 6 is stated, and 32 where 8 is, for alpha seven
// decades apart.
#pragma once

#include <cstddef>
#include <type_traits>

#include <vndf/version.h>

namespace VNDF_API vndf {

/// An input column: `count` floats, or one value for the whole batch (a material's alpha, a directional camera). The
/// two give the same bits as each other, but for the columns of an Ellipsoid, which choose how it is computed; a
/// constant saves the reads. The floats need to live until the call returns. A null pointer is the constant 0.
struct Column {
  const float* data;  ///< `count` floats, or a null pointer for a constant
  float value;        ///< the constant, where data is null

  constexpr Column(const float* column) noexcept : data(column), value(0.f) {}
  /// Any arithmetic type, so that {0, 0, 1} is a direction and 0 not a pointer.
  template <class T, class = std::enable_if_t<std::is_arithmetic<T>::value>>
  constexpr Column(T constant) noexcept : data(nullptr), value(static_cast<float>(constant)) {}
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
  spherical_cap,  ///< Dupuy and Benyoub 2023, Listing 3, with azimuths from the point opposite to the view
};

/// The two maps from the unit square to the unit disk.
enum class DiskMap { polar, concentric };

/// Samples the GGX distribution of visible normals, D_wo(wm) = G1(wo) max(0, wo.wm) D(wm) / wo.z.
///
/// wo     unit view directions; views below the horizon (z < 0) are sampled as Heitz 2018, section 4.2, extends the
///        distribution to them. Any other length gives the normal of the direction.
/// alpha  roughness along x and y, from 1e-30 to 2^24, isotropic or not; accuracy is promised from 1e-6 to 100.
/// u      uniform random numbers in [0, 1]; both ends are allowed.
/// wm     unit normals of the upper hemisphere, wm.z >= 0.
///
/// Ratio (see above): polar and concentric at most 6, p99.9 4; spherical_cap 8. The norm of every result is within 5
/// eps = 5 x 2^-24 of 1. As a distance in eps, over 2^20 samples of each of the hard cases of tests/accuracy_test.cpp
/// with alpha up to 1: mean at most 1.2, p99.9 8, largest 40, of caps 60, or twice what half a unit of wo and alpha
/// moves the exact normal by.
///
/// Special values, each confined to its own lane:
///  - wo = (0, 0, -1): no normal is visible; some unit normal of the upper hemisphere. So it is for
///    caps where the point is opposite to the view to within 2^-30: u2 = 1 and u1 = 0, 1 or below 2^-30, or any u1 for
///    views within 2^-30 of the normal.
///  - u = 0 and u = 1: the limit.
///  - wo = 0: some unit normal.
///  - the angle between A wo and z below 2^-46, 2^-56 for the cap: the former is taken as 2^-46, azimuths of the latter
///    as +x. So are azimuths of (alpha_x wo.x, alpha_y wo.y) below 2^-110 in both components.
///  - alpha = 0: (0, 0, 1).
///  - negative alpha: wo is mirrored in that axis, sampled for |alpha|, and the normal mirrored back.
///  - u outside [0, 1]: unspecified values or NaN.
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
/// Largest error of the point over 2^20 random points, in units of 2^-24: bound 4, measured
/// 3.2 and 2.5 (tests/disk_test.cpp). |t|^2 can exceed 1 by 7 x 2^-24.
///
/// u outside [0, 1], infinite or NaN: unspecified values or NaN in that lane.
void sample_disk(DiskMap map, std::size_t count, const Columns2& u, const Out2& t) noexcept;

/// How masking of the view and shadowing of the light, Smith's both, go together: G2.
enum class Masking {
  height_correlated,  ///< 1 / (1 + Lambda(wo) + Lambda(wi)), Heitz 2014, eq. 99
  separable,          ///< G1(wo) G1(wi)
};

struct ReflectionOptions {
  Masking masking = Masking::height_correlated;
  /// Leaves out normals that can only reflect below the surface (Eto and Tokuyoshi 2023; Tokuyoshi and Eto 2024), where
  /// the smaller alpha and the view let it tell. The less alpha_x and alpha_y differ, the more it leaves out: rejected
  /// samples go from 49 % to 0 (alpha 1, near-normal view), from 26 % to 4 % (0.6), from 23 % to 21 % (0.2 and 0.8).
  /// Samples, density and weight are those of the smaller set; evaluation must be told the same.
  bool bounded = false;
};

/// Where sample_reflection writes. wi, pdf and weight are written always; of wm and wo_dot_wm those that are not null
/// pointers.
struct ReflectionSamples {
  Out3 wi;
  float* pdf;
  float* weight;
  Out3 wm = {nullptr, nullptr, nullptr};
  float* wo_dot_wm = nullptr;
};

/// Samples reflection of the view at a visible normal, with density and weight: one pass of a material's queue.
///
/// warp       as for sample_normals. Bounded sampling is defined on the spherical cap: `polar` and `concentric` lay
///            their disk point on it by Lambert's equal-area map.
/// wo         unit view directions with z >= 0. Below the horizon nothing is reflected: pdf and weight are 0, and wi is
///            of no use.
/// alpha      roughness along x and y, from 1e-6 to 100.
/// u          uniform random numbers in [0, 1].
/// wi         2 (wo.wm) wm - wo, eq. 16, as long as wo is. Where it lies below the horizon or on it, it is written
///            all the same, and pdf and weight are 0.
/// pdf        density of wi over solid angle, eq. 17: D(wm) G1(wo) / (4 wo.z), more if bounded.
/// weight     f(wo, wi) wi.z / pdf without Fresnel's factor, in [0, 1]: G2(wo, wi) / G1(wo), eq. 19, less if bounded.
/// wm         the normal; unless bounded, bit for bit that of sample_normals.
/// wo_dot_wm  its cosine to the view, for Fresnel's factor; not above 1 for unit views, and neither is wi.z.
///
/// Ratio: wi, pdf and weight at most 16, wm as for sample_normals, bounded 8. |wi| is within 12 eps of |wo|. The weight
/// is that of a wi whose z may be 2^-42 off, bounded 2^-25.
///
/// pdf agrees with evaluate_reflection for the rounded wi within 4 eps (4 + 2 / alpha) / (wo.wm), alpha being the
/// smaller one and at most 1; for alpha above 1 within twice that.
///
/// Special values, each confined to its own lane:
///  - alpha_x = 0 or alpha_y = 0, or both: finite, pdf at most 2^60, and of both that.
///  - wo = 0: pdf and weight 0.
///  - negative alpha: as its absolute value, with the normals that sample_normals gives.
///  - wo of another length: wi has that length too, pdf is off by it; bounded, the samples are others.
///  - u outside [0, 1], NaN or infinity in any input of a lane: unspecified values or NaN in that lane.
///
/// Source: Heitz 2018, appendix B, in the forms without division by cosines of lanes/ggx.h and lanes/reflection.h.
void sample_reflection(Warp warp, std::size_t count, const Columns3& wo, const Columns2& alpha, const Columns2& u,
                       const ReflectionSamples& out, const ReflectionOptions& options = {}) noexcept;

/// Where the evaluations write.
struct Evaluations {
  float* f_cos;
  float* pdf;
};

/// The BRDF of a pair of directions and the density that sample_reflection has for it: for light that was sampled
/// otherwise, and for multiple importance sampling.
///
/// wo, wi  unit directions.
/// alpha   roughness along x and y, from 1e-6 to 100; below 2^-60 it is taken as 2^-60.
/// f_cos   f(wo, wi) wi.z without Fresnel's factor: D(h) G2(wo, wi) / (4 wo.z), eq. 15.
/// pdf     density of wi given wo, under the same options as sample_reflection.
///
/// Both are 0 where the pair is impossible: wo.z < 0, wi.z <= 0, or wo = 0. Where |wo + wi| is
/// below 2^-70 they are finite, and may be 0.
///
/// Ratio at most 8; relative error at most 25 eps for either: nothing cancels, h = wo + wi is taken as it is.
///
/// Special values: alpha = 0 and h = +z: up to 2^60; NaN or infinity in any input of a lane, or directions far from
/// unit length: unspecified values or NaN in that lane.
///
/// Source: Heitz 2018, eq. 15 and 17; Eto and Tokuyoshi 2023, eq. 8.
void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const Columns2& alpha,
                         const Evaluations& out, const ReflectionOptions& options = {}) noexcept;

/// The density of visible normals that sample_normals has: D_wo(wm) = G1(wo) max(0, wo.wm) D(wm) / wo.z, Heitz 2018,
/// eq. 3, for views above and below the horizon.
///
/// wo, wm  unit directions.
/// alpha   roughness along x and y, from 1e-6 to 100; D takes alpha below 2^-60 as 2^-60.
/// pdf     density of wm over solid angle; 0 where wm.z < 0 or wo.wm <= 0, and for wo = 0.
///
/// Ratio at most 8; relative error 25 eps / (wo.wm), wo.wm being a sum of products of what is given. The integral over
/// all wm is 1 within 1e-5.
///
/// NaN or infinity in any input of a lane: unspecified values or NaN in that lane.
void pdf_normals(std::size_t count, const Columns3& wo, const Columns3& wm, const Columns2& alpha, float* pdf) noexcept;

/// Where sample_dielectric writes.
struct DielectricSamples {
  Out3 wi;
  float* pdf;
  float* weight;
  float* side;
};

/// Samples reflection or refraction at a visible normal of a rough dielectric.
///
/// Convention: eta is the index of refraction below the surface (z < 0) over the index above it. Views with z >= 0 are
/// outside. Views with z < 0 are inside, see the surface from below and refract by 1 / eta.
///
/// warp    as for sample_normals.
/// wo      unit view directions, above or below.
/// alpha   roughness along x and y, from 1e-6 to 100.
/// eta     a column or a constant, from 0.1 to 10.
/// u       three uniform random numbers in [0, 1]: two for the normal, and a third: reflection is chosen where it is
///         less than Fresnel's reflectance for unpolarised light.
/// wi      unit, on wo's side or across; written in any case.
/// pdf     density of wi over solid angle: the choice's probability, the density of the normal, and the Jacobian of the
///         half vector, Walter et al. 2007, eq. 14 and 17.
/// weight  f(wo, wi) |wi.z| / pdf, in [0, 1]: G2 / G1(wo) for reflection, G1(wi) for refraction, across which the two
///         maskings are independent (Walter et al. 2007, eq. 23). Fresnel's factor is in the choice. It counts energy,
///         or light over the square of the index where it is: a renderer that carries radiance multiplies refracted
///         light by the square of the index at wo over the one at wi.
/// side    1 where wi is a reflection, -1 where it is a refraction.
///
/// pdf and weight are 0 where wi comes out at the wrong side of the surface.
///
/// Ratio: wi, pdf and weight at most 16, for eta from 0.1 to 10 with |eta - 1| from 1e-4, and views within 8 eps of
/// unit length; off by up to 1e-3, reflected wi and the weight alone. pdf is to 2^-62 absolute too, the weight that of
/// a wi whose z may be 2^-42 off.
///
/// Special values: |eta - 1| < 2^-16 counts as index-matched: wi = -wo, side -1, weight 1, pdf 2^60,
/// both 0 for a horizontal view; from below it is 1 / eta that is compared. eta that is 0,
/// negative, NaN, or not between 2^-20 and 2^20: pdf and weight 0. wo = 0: pdf and weight 0. NaN or infinity in any
/// other input of a lane: unspecified values or NaN in that lane.
///
/// Source: Walter, Marschner, Li and Torrance, Microfacet Models for Refraction through Rough Surfaces, EGSR 2007, with
/// the normals of Heitz 2018.
void sample_dielectric(Warp warp, std::size_t count, const Columns3& wo, const Columns2& alpha, const Column& eta,
                       const Columns3& u, const DielectricSamples& out,
                       Masking masking = Masking::height_correlated) noexcept;

/// The BSDF of a pair of directions and the density that sample_dielectric has for it.
///
/// wo, wi, alpha, eta  as for sample_dielectric; wi on either side.
/// f_cos               f(wo, wi) |wi.z|, Fresnel's factor included, for energy as the weight of sample_dielectric:
///                     f / eta^2 of the side of wi is symmetric.
/// pdf                 density of wi given wo.
///
/// Both are 0 where no normal of the upper hemisphere takes the one to the other, by more than rounding, and for
/// indices that are matched or impossible.
///
/// Ratio at most 8. Fresnel's transmittance is that of both cosines: f / eta^2 is symmetric to 1e-5 relative where
/// neither cosine to the normal is under 0.01. What sample_dielectric returns with a density has one when
/// evaluated too, the same but for the rounding of wi; index-matched samples, which evaluate to 0, are the exception.
/// NaN or infinity in any input of a lane: unspecified values or NaN in that lane.
///
/// Source: Walter et al. 2007, eq. 20 and 21.
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
/// set_isa() chose another. VNDF_ISA is read at most once, when the first batch or
/// active_isa() has to choose; a name that is unknown or not supported is
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
