// The mathematics of vndf as templates over float, xsimd::batch<float, Arch>, and Many<batch, K>: K vectors at once.
// For kernels of one's own, with the bits of the batch functions of vndf.h.
#pragma once

#include <vndf/lanes/dielectric.h>
#include <vndf/lanes/frame.h>
#include <vndf/lanes/many.h>
#include <vndf/lanes/normals.h>
#include <vndf/lanes/tilted_shape.h>
