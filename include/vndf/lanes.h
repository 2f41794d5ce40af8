// The lane API: the mathematics of the library over float or xsimd::batch<float, Arch>, for renderers that fuse it into
// kernels of their own. Link vndf::lanes, which brings xsimd and -ffp-contract=off; a lane gives the bits of the batch
// API.
#pragma once

#include <vndf/lanes/dielectric.h>
#include <vndf/lanes/ellipsoid.h>
#include <vndf/lanes/normals.h>
