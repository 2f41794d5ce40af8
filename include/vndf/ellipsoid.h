// The ellipsoid NDF: GGX that is turned about the normal and leans (Walter, Dong, Marschner, Greenberg, The Ellipsoid
// Normal Distribution Function, supplement to Predicting Surface Appearance from Measured Microgeometry of Metal
// Surfaces, 2014, revised 2016; cited as Walter et al. 2015). The functions of vndf.h with a shape in place of alpha;
// conventions and guarantees are those stated there.
#pragma once

#include <vndf/vndf.h>

namespace VNDF_API vndf {

/// A = S R, eq. 2-3: S = diag(alpha_x, alpha_y, 1), R = Rx(theta_x) Ry(theta_y) Rz(theta_z). Which of the five are
/// constants decides how it is computed, and how many times the cost of plain GGX it has:
///  1. all angles the constant 0: plain GGX with separable masking, its bits and its speed.
///  2. all five constants: one matrix for the batch. Sampling 1.1 to 1.4, evaluate_reflection up to 1.7.
///  3. theta_x and theta_y the constant 0: axes that a texture turns. Sampling 1.2 to 1.55, evaluating 1.8 to 2.1.
///  4. else a matrix for each lane. Sampling 4 to 9, evaluating 10 to 13.
/// 2 and 4 have the same bits; 3 rounds differently. bench/README.md says where this was measured.
///
/// alpha             from 1e-6 to 100. In 2 and 4 it is taken as at least 2^-60, without its sign. Below 1e-6, 0 among
///                   it, directions, pdf and weight are numbers; cosines can be NaN where it leans by a right angle.
/// theta_z           turns the axes of alpha about n: alpha_x is along (cos theta_z, -sin theta_z, 0).
/// theta_x, theta_y  lean the distribution.
///
/// Angles are in radians, modulo 2 pi. A direction that one of them turns is off by at most 2.5 eps up to pi either
/// way, beyond that by theta eps. Beyond 1e6 either way results are unspecified.
struct Ellipsoid {
  Columns2 alpha;
  Column theta_x, theta_y, theta_z;

  constexpr Ellipsoid(const Columns2& alpha_, const Column& theta_x_ = 0.f, const Column& theta_y_ = 0.f,
                      const Column& theta_z_ = 0.f) noexcept
      : alpha(alpha_), theta_x(theta_x_), theta_y(theta_y_), theta_z(theta_z_) {}
};

/// One ellipsoid for a whole batch, ready for use: a matrix, and what is computed from it. By default the unit sphere,
/// alpha = 1.
class Shape {
 public:
  constexpr Shape() noexcept = default;

 private:
  friend struct ShapeAccess;
  // lanes::Triangle: xx, then yx, yy, zx, zy of ((xx, 0, 0), (yx, yy, 0), (zx, zy, 1)) in two parts, then the azimuth.
  float a_[11] = {1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 0.f, 1.f, 0.f};
};

enum class ShapeError { none, not_finite, not_positive, out_of_range };

/// The shape of a general matrix A, row by row: eq. 1 with n = +z. A positive factor of A, or a rotation on its left,
/// changes nothing but roundings: what is kept is the lower triangle with A n = n, which is the same for all of them.
///
/// Domain   |A| > 2^-40 |a1| |a2| |a3|, with the lengths of the columns; of the triangle, the diagonal from 2^-26 to
///          2^26 and the rest at most 2^26. For any other A `shape` is unchanged, and the answer is the reason.
[[nodiscard]] ShapeError make_shape(const float (&a)[9], Shape& shape) noexcept;

/// One line for people.
const char* message(ShapeError error) noexcept;

/// sample_normals of vndf.h. Views for which A wo points away from A n are sampled as well. wm.z >= 0, and wo.wm >= 0
/// but for rounding, which small alpha magnifies: -0.07 was seen for alpha 1e-6 and 100.
///
/// Azimuths count from that of A wo; on the cap from the one opposite. Where A wo is along A n, they count from the x
/// axis that the triangle has for theta_z = 0; for shapes of make_shape, from the normal of A y and A n.
///
/// Domain   views up to 2^98 long.
/// Error    ratio at most 16 for any angles and alpha up to 1; |wm| within 5 eps of 1. For alpha above 1, A^T of
///          leaning ellipsoids cancels, and random numbers finer than 2^-24 show it: 72 measured.
/// Special  theta = 0: the bits of vndf.h. theta_x = theta_y = 0: its samples, in a frame turned about n.
/// Source   Walter et al. 2015, version 3 of section 4.1, eq. 34-47, step by step, with A^T p / |A^T p| for the normal;
///          density of eq. 33.
void sample_normals(Warp warp, std::size_t count, const Columns3& wo, const Ellipsoid& ellipsoid, const Columns2& u,
                    const Out3& wm) noexcept;
void sample_normals(Warp warp, std::size_t count, const Columns3& wo, const Shape& shape, const Columns2& u,
                    const Out3& wm) noexcept;

/// sample_reflection of vndf.h: wi, eq. 47; pdf, eq. 48; weight, eq. 50 without Fresnel's factor, in [0, 1].
///
/// Masking is G = G1(wo) G1(wi), eq. 5, with the minimum of eq. 6. Height-correlated masking and bounded sampling are
/// not defined for ellipsoids: options.masking is not read, and bounded must be false.
///
/// Error    for alpha up to 1, ratio at most 16 for wi, wm, pdf and weight, but for u.y = 1 of the cap, and 20 for
///          wo_dot_wm. |wi| as in vndf.h where pdf > 0, else within 128 eps of |wo|.
/// Special  theta = 0: for views with z >= 0 the bits of vndf.h with separable masking.
void sample_reflection(Warp warp, std::size_t count, const Columns3& wo, const Ellipsoid& ellipsoid, const Columns2& u,
                       const ReflectionSamples& out, const ReflectionOptions& options = {}) noexcept;
void sample_reflection(Warp warp, std::size_t count, const Columns3& wo, const Shape& shape, const Columns2& u,
                       const ReflectionSamples& out, const ReflectionOptions& options = {}) noexcept;

/// evaluate_reflection of vndf.h: f_cos = D(h) G1(wo) G1(wi) / (4 wo.z), eq. 4, and the pdf of sample_reflection. Both
/// are 0 where wo.z < 0 or wi.z <= 0.
///
/// Error    for alpha up to 1, ratio at most 20 (p99.9 8); 8 for theta_z alone.
/// Special  theta = 0: as for sample_reflection.
void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const Ellipsoid& ellipsoid,
                         const Evaluations& out, const ReflectionOptions& options = {}) noexcept;
void evaluate_reflection(std::size_t count, const Columns3& wo, const Columns3& wi, const Shape& shape,
                         const Evaluations& out, const ReflectionOptions& options = {}) noexcept;

/// pdf_normals of vndf.h: eq. 33, for any view; 0 where wm.z < 0 or wo.wm <= 0. Ratio at most 8 for alpha up to 1.
void pdf_normals(std::size_t count, const Columns3& wo, const Columns3& wm, const Ellipsoid& ellipsoid,
                 float* pdf) noexcept;
void pdf_normals(std::size_t count, const Columns3& wo, const Columns3& wm, const Shape& shape, float* pdf) noexcept;

/// sample_dielectric of vndf.h, with the density of eq. 33 and the Jacobians of Walter et al. 2007, eq. 14 and 17.
///
/// Masking is G = G1(wo) G1(wi) for reflection and for refraction, each direction turned to the upper hemisphere,
/// eq. 7: views from below see the same ellipsoid, mirrored in the origin. The weight is that of eq. 50 for both, in
/// [0, 1]; options.masking and across are not read.
///
/// Error    ratios as in vndf.h, for alpha up to 1 and but for u.y = 1 of the cap; wi.z may be 2^-25 off for the
///          weight. |wi| within 2048 eps of 1: refraction takes the cosine of the exact normal, and where sharp shapes
///          graze the view wm is far from it. Where pdf is 0, reflectance can be above 1. pdf agrees with
///          evaluate_dielectric but for the rounding of wi.
/// Special  theta = 0: the bits of vndf.h with separable masking, with one exception: where theta_x or theta_y are
///          columns of zeros, weights of refraction are within 4 eps of those, 8 if the probability was given.
void sample_dielectric(Warp warp, std::size_t count, const Columns3& wo, const Ellipsoid& ellipsoid, const Column& eta,
                       const Columns3& u, const DielectricSamples& out, const DielectricOptions& options = {}) noexcept;
void sample_dielectric(Warp warp, std::size_t count, const Columns3& wo, const Shape& shape, const Column& eta,
                       const Columns3& u, const DielectricSamples& out, const DielectricOptions& options = {}) noexcept;

/// evaluate_dielectric of vndf.h: f(wo, wi) |wi.z| of Walter et al. 2007, eq. 20 and 21, with D of eq. 1 and G of
/// eq. 7, and the pdf of sample_dielectric. f / eta^2 of the side of wi is symmetric.
///
/// Error    for alpha up to 1, ratio at most 20 (p99.9 8).
/// Special  theta = 0: as for sample_dielectric, f_cos being as close as its weight.
void evaluate_dielectric(std::size_t count, const Columns3& wo, const Columns3& wi, const Ellipsoid& ellipsoid,
                         const Column& eta, const Evaluations& out, const DielectricOptions& options = {}) noexcept;
void evaluate_dielectric(std::size_t count, const Columns3& wo, const Columns3& wi, const Shape& shape,
                         const Column& eta, const Evaluations& out, const DielectricOptions& options = {}) noexcept;

}  // namespace vndf
