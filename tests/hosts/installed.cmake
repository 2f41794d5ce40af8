# Installed copies. The one of this build serves several projects.
set(prefix ${CMAKE_CURRENT_BINARY_DIR}/installed)
add_test(NAME hosts.install
         COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --config $<CONFIG> --prefix ${prefix})
set_tests_properties(hosts.install PROPERTIES FIXTURES_SETUP vndf_installed)
set(installed PROJECT package NEEDS vndf_installed)
vndf_host(package ${installed} OPTIONS -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_BUILD_TYPE=Debug)
vndf_host(package.c++20 ${installed} OPTIONS -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_STANDARD=20)
vndf_host(package.${other} ${installed} COMPILER ${VNDF_OTHER_COMPILER}
          OPTIONS -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_STANDARD=23 -DCMAKE_CXX_VISIBILITY_PRESET=hidden)
vndf_host(plugins PROJECT plugins NEEDS vndf_installed OPTIONS -DCMAKE_PREFIX_PATH=${prefix})

find_program(VNDF_PKG_CONFIG NAMES pkg-config pkgconf)
add_test(NAME hosts.pkg_config
         COMMAND ${CMAKE_COMMAND} -DPKG_CONFIG=${VNDF_PKG_CONFIG} -DCXX=${CMAKE_CXX_COMPILER} -DPREFIX=${prefix}
                 -DLIBDIR=${CMAKE_INSTALL_LIBDIR} -DPROGRAM=${CMAKE_CURRENT_SOURCE_DIR}/programs/batches.cpp
                 -DEXPECTED=${expected} -DWORK=${CMAKE_CURRENT_BINARY_DIR} -DVERSION=${PROJECT_VERSION}
                 -P ${CMAKE_CURRENT_SOURCE_DIR}/pkg_config.cmake)
set_tests_properties(hosts.pkg_config PROPERTIES FIXTURES_REQUIRED "vndf_installed;vndf_expected")
if(NOT VNDF_PKG_CONFIG)
  set_tests_properties(hosts.pkg_config PROPERTIES DISABLED TRUE)
endif()

# One build of the scalar set with all that a host may ask for, in a path with spaces, by Make: unity, link-time
# optimisation, C++20. Installed with include directories of three kinds, and then shared.
set(all_sorts "${CMAKE_CURRENT_BINARY_DIR}/all sorts")
set(asked -DCMAKE_UNITY_BUILD=ON -DCMAKE_INTERPROCEDURAL_OPTIMIZATION=ON -DCMAKE_CXX_STANDARD=20 -DVNDF_ISAS=scalar
    -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} -Dxsimd_DIR=${xsimd_DIR} -DXSIMD_INCLUDE_DIR=${XSIMD_INCLUDE_DIR})
set(previous "")
function(vndf_all_sorts name)
  add_test(NAME hosts.install.${name}
           COMMAND ${CMAKE_COMMAND} "-DSOURCE=${PROJECT_SOURCE_DIR}" "-DBUILD=${all_sorts}/build"
                   "-DPREFIX=${all_sorts}/${name}" -P ${CMAKE_CURRENT_SOURCE_DIR}/install.cmake -- ${asked} ${ARGN})
  # They share a build folder: one after the other.
  set_tests_properties(hosts.install.${name} PROPERTIES FIXTURES_SETUP vndf_${name} TIMEOUT 900 DEPENDS "${previous}"
                                                        RESOURCE_LOCK all_sorts)
  set(previous hosts.install.${name} PARENT_SCOPE)
  vndf_host(package.${name} PROJECT package NEEDS vndf_${name} COMPILER ${VNDF_OTHER_COMPILER}
            OPTIONS "-DCMAKE_PREFIX_PATH=${all_sorts}/${name}")
endfunction()
vndf_all_sorts(include_dir_of_a_version -DBUILD_SHARED_LIBS=OFF -DCMAKE_INSTALL_INCLUDEDIR=include/vndf-0.1)
vndf_all_sorts(absolute_include_dir -DBUILD_SHARED_LIBS=OFF 
               "-DCMAKE_INSTALL_INCLUDEDIR=${all_sorts}/absolute_include_dir/headers")
vndf_all_sorts(shared -DBUILD_SHARED_LIBS=ON -DCMAKE_INSTALL_INCLUDEDIR=include)
