# xsimd is needed by everything.
include(${CMAKE_CURRENT_LIST_DIR}/xsimd.cmake)
vndf_find_xsimd(vndf_xsimd_include_dir vndf_xsimd_version)
if(NOT vndf_xsimd_include_dir)
  message(FATAL_ERROR "xsimd (8.1 or newer) was not found. Run 'sh cmake/deps.sh', which installs it on Debian and Ubuntu "
                      "and says what to install elsewhere, or set xsimd_DIR, or XSIMD_INCLUDE_DIR to where xsimd/ lies, "
                      "or make a target xsimd before vndf is added.")
endif()
if(vndf_xsimd_version VERSION_LESS 8.1)
  message(FATAL_ERROR "xsimd ${vndf_xsimd_version} was found in ${vndf_xsimd_include_dir}; 8.1 or newer is needed.")
endif()
set(vndf_xsimd_found_in ${vndf_xsimd_include_dir})
# A directory the compiler searches anyway must not be named: it would go before the C library's own.
if(vndf_xsimd_include_dir STREQUAL "/usr/include")
  set(vndf_xsimd_include_dir "")
endif()

if(VNDF_BUILD_TESTS)
  set(googletest_source /usr/src/googletest)  # Debian's libgtest-dev, for compilers that its library is not for
  if(CMAKE_CROSSCOMPILING AND EXISTS ${googletest_source}/CMakeLists.txt)
    add_subdirectory(${googletest_source} ${PROJECT_BINARY_DIR}/googletest EXCLUDE_FROM_ALL)
    set(GTest_FOUND TRUE)
  else()
    find_package(GTest QUIET)
  endif()
  find_package(Boost QUIET)
  foreach(package GTest Boost)
    if(NOT ${package}_FOUND)
      message(FATAL_ERROR "${package} was not found, which the tests need. Run 'sh cmake/deps.sh', or configure with "
                          "-DVNDF_BUILD_TESTS=OFF.")
    endif()
  endforeach()
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
