// The version of these headers, and of the library that is linked.
#pragma once

#define VNDF_VERSION_MAJOR 0
#define VNDF_VERSION_MINOR 1
#define VNDF_VERSION_PATCH 0
/// As one number, 10203 for 1.2.3.
#define VNDF_VERSION (VNDF_VERSION_MAJOR * 10000 + VNDF_VERSION_MINOR * 100 + VNDF_VERSION_PATCH)

/// On the namespaces of the public functions: what a shared library exports. A static one exports nothing, so that a
/// program's shared objects can each have a version of their own. For a DLL, CMake lists all functions.
#if defined(VNDF_SHARED) && !defined(_WIN32)
#define VNDF_API [[gnu::visibility("default")]]
#else
#define VNDF_API
#endif

namespace VNDF_API vndf {

/// VNDF_VERSION of the library, where a program wants to know that it is the one of its headers.
int version() noexcept;

}  // namespace vndf
