// What every function of the library should give, from the papers' formulas in quadruple precision and for inputs that
// are no floats: what a result moves by when an input moves by a fraction of its last place tells how well any
// computation could do. Nothing here is shared with the library or with the plain oracle of oracle.h.
//
// Formulas are taken as they stand, but where they cancel more than 113 bits bear: 1 + Vh.z of a view near -z, the
// height of a normal at the rim of the disk, and c + Vh where c is nearly -Vh. What is done there is said there, and
// exact_test.cpp compares it with the plain oracle.
#pragma once

#include <vndf/vndf.h>

#include "reference/vec.h"

namespace vndf::exact {

using reference::Quad;

using Vec = reference::Vec3<Quad>;

/// A, row by row, of the GGX ellipsoid, with A n = n, and |A|.
struct Surface {
  Vec row[3];
  Quad determinant;
  Quad smaller_alpha;  ///< for bounded sampling
  bool by_lunes;       ///< masked as Walter et al. 2015, eq. 5-6
};
Surface plain(Quad alpha_x, Quad alpha_y);
/// Walter et al. 2015, eq. 2-3. Of all Q A / |A n| the lower triangle for theta_z = 0, turned: its x axis is where the
/// azimuth of a view along A n begins.
Surface ellipsoid(Quad alpha_x, Quad alpha_y, Quad theta_x, Quad theta_y, Quad theta_z);

/// Two values, for height-correlated and for separable masking. Shapes have one kind only, and it stands in both.
struct Masked {
  Quad correlated, separable;
};

/// A visible normal. Where there is none, or every one is right (c = -Vh), `defined` is false.
struct Normal {
  Vec wm;
  Quad cos;  ///< wo.wm
  bool defined;
};
Normal sample_normal(Warp warp, const Vec& wo, const Surface& surface, Quad u1, Quad u2);

/// Density and weight are those of the formulas, whether wi is at the right side of the surface or not, so that they do
/// not jump; the weight of the wrong side is negative.
///
/// `slack` is what 2^-42 more of wi.z does to the weight, which counts where both directions are next to horizontal. Of
/// bounded sampling, the rim of whose cap pins wi to the horizon, and of ellipsoids it is half a unit of wi, 2^-25.
///
/// `pdf_slack` is what 2^-46 more of Vh.Nh and 2^-62 more of wo.wm do to the density, which falls with their squares at
/// the rim: lanes/hemisphere.h and lanes/dielectric.h keep them away from 0 by as much.
struct Sample {
  Normal normal;
  Vec wi;
  Quad pdf;
  Masked weight, slack;
  Quad pdf_slack = 0;
};
Sample sample_reflection(Warp warp, bool bounded, const Vec& wo, const Surface& surface, Quad u1, Quad u2);
/// What may be asked of a dielectric. Without a probability of reflection, that is Fresnel's share.
struct Lobes {
  AcrossMasking across = AcrossMasking::separable;
  bool radiance = false, given = false;
  Quad reflection = 0;
};
/// For the side that was chosen: what is left is continuous. Refraction, and the share of it, are for unit wo.
Sample sample_dielectric(Warp warp, bool reflects, const Vec& wo, const Surface& surface, Quad eta, Quad u1, Quad u2,
                         const Lobes& lobes = {});

struct Evaluation {
  Quad pdf;
  Masked f_cos;
};
/// For wo.z >= 0 and wi.z > 0.
Evaluation evaluate_reflection(bool bounded, const Vec& wo, const Vec& wi, const Surface& surface);
/// Across the surface Fresnel's equations take the cosines of both directions, which are on either side of Snell's law
/// by as much as they were rounded.
Evaluation evaluate_dielectric(const Vec& wo, const Vec& wi, const Surface& surface, Quad eta, const Lobes& lobes = {});
/// For the direction of wm, but with the cosine of the wm that is given.
Quad pdf_normals(const Vec& wo, const Vec& wm, const Surface& surface);

}  // namespace vndf::exact
