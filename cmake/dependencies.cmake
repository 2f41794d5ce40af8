# xsimd is needed by everything, by its include directory: the target that Debian's package exports also asks for a
# library xtl, which does not exist.
find_package(xsimd QUIET)
if(xsimd_FOUND)
  get_target_property(XSIMD_INCLUDE_DIR xsimd INTERFACE_INCLUDE_DIRECTORIES)
endif()
if(NOT XSIMD_INCLUDE_DIR)
  message(FATAL_ERROR "xsimd (8.1 or newer) was not found. Run 'sh cmake/deps.sh', which installs it on Debian and Ubuntu "
                      "and says what to install elsewhere, or set xsimd_DIR.")
endif()
if(xsimd_VERSION VERSION_LESS 8.1)
  message(FATAL_ERROR "xsimd ${xsimd_VERSION} was found in ${xsimd_DIR}; 8.1 or newer is needed.")
endif()
# A directory the compiler searches anyway must not be named: it would go before the C library's own.
if(XSIMD_INCLUDE_DIR STREQUAL "/usr/include")
  set(XSIMD_INCLUDE_DIR "")
endif()

if(VNDF_BUILD_TESTS)
  find_package(GTest QUIET)
  if(NOT GTest_FOUND)
    message(FATAL_ERROR "GoogleTest was not found. Run 'sh cmake/deps.sh', or configure with -DVNDF_BUILD_TESTS=OFF.")
  endif()
endif()
if(VNDF_BUILD_BENCH)
  foreach(package benchmark CLI11 nlohmann_json)
    find_package(${package} QUIET)
    if(NOT ${package}_FOUND)
      message(FATAL_ERROR "${package} was not found, which the benchmarks need. Run 'sh cmake/deps.sh', or configure with "
                          "-DVNDF_BUILD_BENCH=OFF.")
    endif()
  endforeach()
endif()
