// vndf: GGX visible normals for wavefront renderers, in structure-of-arrays batches, with the same bits on every
// instruction set.
//
// Conventions. Directions are in the local shading frame: +z is the geometric normal, x and y the axes of alpha_x and
// alpha_y. wo points away from the surface, towards the viewer. All values are binary32.
//
// Guarantees, of every function that takes columns:
//  - Identical bits: scalar, SSE4.2, AVX2 and AVX-512 agree in every bit of every result that is not NaN, and have
//    NaN in the same places. Only + - * / sqrt, comparisons and bit operations are used, each rounded as IEEE 754 says,
//    so any other IEEE 754 machine agrees too. The caller's rounding mode must be to-nearest; with FTZ or DAZ set, the
//    sets still agree with each other.
//  - Lanes are independent: a result depends on the inputs of its own index alone, not on how a batch is split, where
//    it starts, or what its neighbours are.
//  - noexcept, no allocation, no locks, and no global state but the choice of the instruction set: callable from any
//    number of threads at once. Floating-point exceptions must be masked, as they are unless a program asks for traps:
//    both sides of a choice are computed, so their flags may be raised for good inputs too.
//  - Any count including 0, any alignment that a float may have (64 bytes is fastest), nothing written outside
//    [0, count) of an output.
//  - Aliasing: an output may be the same column as an input of the same call (in place), since every input of an index
//    is read before its outputs are written. Outputs must not overlap one another, nor an input at another offset.
//  - Every output is written, and none may be a null pointer but those that ReflectionSamples says.
#pragma once

#include <cstddef>
#include <type_traits>

namespace vndf {

/// An input column: `count` floats, or one value for the whole batch (a material's alpha, a directional camera). The
/// two give the same bits as each other, but for the angles of an Ellipsoid; a constant saves the reads. The floats
/// must outlive the call only. A null pointer is the constant 0.
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
  spherical_cap,  ///< Dupuy and Benyoub 2023, Listing 3
};

/// The two maps from the unit square to the unit disk.
enum class DiskMap { polar, concentric };

/// Samples the GGX distribution of visible normals, D_wo(wm) = G1(wo) max(0, wo.wm) D(wm) / wo.z.
///
/// wo     unit view directions; views below the horizon (z < 0) are sampled as Heitz 2018, section 4.2, extends the
///        distribution to them. Any other length from 1e-30 to 1e30 gives the normal of the direction.
/// alpha  roughness along x and y, from 1e-30 to 1e4, isotropic or not.
/// u      uniform random numbers in [0, 1]; both ends are allowed.
/// wm     unit normals of the upper hemisphere, wm.z >= 0.
///
/// Largest error: the Euclidean distance from the exact normal of the same inputs, in units of 2^-24, over 2^20 samples
/// of each of 25 hard cases (tests/accuracy_test.cpp): near-normal, grazing and horizontal views, views below the
/// horizon, the rim of the disk, alpha from 1e-6 to 1 and up to four decades apart, wo from 1e-20 to 1e20 long.
///  - polar, concentric: bound 40, measured 32; p99.9 bound 8, measured 4.7; mean bound 1.2, measured 0.98. The one
///    exception is a view below the horizon along the axis of an alpha that is decades below the other, where rounding
///    wo and alpha alone moves the exact normal by hundreds; the bound there is twice what it moves it. The slope
///    wm.xy / wm.z is within 1e-3 alpha up to slopes of 1000 alpha, beyond that relatively. For alpha from 1 to 100
///    the bound is 200, measured 103.
///  - spherical_cap: mean 0.2 to 1.2 and p99.9 up to 22 in most cases, but single samples reach 1e4, for u2 within
///    64 x 2^-24 of 1 even 3e5 (p99.9 440): the half vector is a sum, which cancels where the sampled direction is
///    nearly opposite to the view.
///  - the norm of every result is within 5 of 1, measured 3.0.
///
/// Special values, each confined to its own lane:
///  - wo = (0, 0, -1): no normal is visible; some unit normal of the upper hemisphere.
///  - wo = 0: as a horizontal view along x.
///  - the tangent of A wo below 2^-32 (polar, concentric): taken as 2^-32, which moves no normal by more than that.
///  - azimuth (alpha_x wo.x, alpha_y wo.y) below 2^-100 in both components (polar, concentric): taken as +x.
///  - alpha = 0: the limit of a mirror, (0, 0, 1), unless wo is horizontal.
///  - negative alpha: as its absolute value, with the normal mirrored in that axis.
///  - alpha above 1e4: where its square leaves the range of float, a vector shorter than 1; above 1e20, or NaN.
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
/// Largest error of the point over 2^20 random points, in units of 2^-24: polar 3.2, concentric 2.3
/// (tests/disk_test.cpp).
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
/// wm         the normal: for wo.z >= 0 and alpha >= 1e-4 and not bounded the bits of sample_normals.
/// wo_dot_wm  its cosine to the view, for Fresnel's factor.
///
/// Error, in eps = 2^-24, measured on 2^18 samples of each hard case of the tests with alpha <= 1, against their
/// papers' plain formulas in long double and quadruple precision, polar and concentric: wi 34 (Euclidean), 10 for
/// wo.wm; pdf 35 relative, times 1 + max(alpha) |A^-1 wm|; weight 7 relative, times 1 plus the quotient of the terms
/// of wi.z and wi.z itself. p99.9 of pdf is 21. For spherical_cap: wi 320, pdf 680, p99.9 17: it loses digits where wm
/// is nearly perpendicular to wo. pdf agrees with evaluate_reflection for the rounded wi within 16 eps (4 + 2 / alpha)
/// where wo.wm >= 1/4, and 4 eps (4 + 2 / alpha) / (wo.wm) anywhere.
///
/// Special values, each confined to its own lane:
///  - alpha below 1e-6: pdf and weight lose accuracy where view and light graze, since squares leave the range of
///    float; alpha_x = alpha_y = 0: pdf is infinite, wi and weight are a mirror's, or NaN for a horizontal view, and
///    unspecified for u on the rim of the warp (polar u1 = 1, cap u2 = 1, concentric a 0 or 1).
///  - negative alpha: as its absolute value.
///  - wo of another length: wi has that length too, pdf is off by it; bounded, the samples are others.
///  - u outside [0, 1], NaN or infinity in any input of a lane: unspecified values or NaN in that lane.
///
/// Aliasing as for every function: an output may lie over an input.
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
/// Both are 0 where the pair is impossible: wo.z < 0 or wi.z <= 0.
///
/// Error: relative 16 eps for either, on the hard cases with alpha from 1e-6 to 100, measured as for sample_reflection:
/// nothing cancels, h = wo + wi is taken as it is.
///
/// Special values: alpha = 0 and h = +z: a large value, infinite for wo.z below 3e-4; NaN or infinity in any input of a
/// lane, or directions far from unit length: unspecified values or NaN in that lane.
///
/// Source: Heitz 2018, eq. 15 and 17; Eto and Tokuyoshi 2023, eq. 8.
void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const Columns2& alpha,
                         const Evaluations& out, const ReflectionOptions& options = {}) noexcept;

/// The density of visible normals that sample_normals has: D_wo(wm) = G1(wo) max(0, wo.wm) D(wm) / wo.z, Heitz 2018,
/// eq. 3, for views above and below the horizon.
///
/// wo, wm  unit directions.
/// alpha   roughness along x and y, from 1e-6 to 100; D takes alpha below 2^-60 as 2^-60.
/// pdf     density of wm over solid angle; 0 where wm.z < 0 or wo.wm <= 0.
///
/// Error: relative 25 eps / (wo.wm), measured 12 on the hard cases, wo.wm being a sum of products of what is given. The
/// integral over all wm is 1 within 1e-5.
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
/// Error: wi 14 eps for a given normal if reflected, and 25 eps times 1 + 1 / |cos of refraction| if refracted (cap:
/// 320 and 25); Fresnel's shares 7 and 4 eps relative, eta near 1 included, times what the angle of total reflection
/// does to them; pdf agrees with evaluate_dielectric within 16 eps (4 + 2 / alpha) (1 + 1 / g) / (|h| |wo.wm| |wi.wm|),
/// with h = wo + wi or wo + eta wi and g^2 = eta^2 - 1 + (wo.wm)^2. Refracted wi, and that agreement, times
/// max(eta, 1 / eta)^2 / 6 where eta is outside [0.4, 2.5].
///
/// Special values: eta = 1: all is refracted straight on, weight as ever, pdf infinite, or 0 for a horizontal view. NaN
/// or infinity in any input of a lane: unspecified values or NaN in that lane.
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
/// Both are 0 where no normal of the upper hemisphere takes the one to the other, and across for eta = 1.
///
/// Error: that of sample_dielectric's agreement with it. NaN or infinity in any input of a lane: unspecified values or
/// NaN in that lane.
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
