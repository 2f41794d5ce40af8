# find_package(vndf) for installed copies: vndf::vndf and vndf::lanes; pkg-config's vndf; a Debian package.
include(CMakePackageConfigHelpers)

set_target_properties(vndf PROPERTIES EXPORT_NAME vndf)
install(TARGETS vndf vndf_lanes EXPORT vndf-targets)
install(DIRECTORY include/vndf DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/vndf)
install(EXPORT vndf-targets NAMESPACE vndf:: DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/generated/vndf-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
# xsimd is a dependency of vndf::lanes alone: without it, vndf::vndf is still found and complete.
file(CONFIGURE OUTPUT generated/vndf-config.cmake @ONLY CONTENT [[
include("${CMAKE_CURRENT_LIST_DIR}/vndf-targets.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/xsimd.cmake")
vndf_find_xsimd(vndf_xsimd_include_dir vndf_xsimd_version)
if(vndf_xsimd_include_dir AND NOT vndf_xsimd_include_dir STREQUAL "/usr/include")
  target_include_directories(vndf::lanes SYSTEM INTERFACE ${vndf_xsimd_include_dir})
endif()
unset(vndf_xsimd_include_dir)
unset(vndf_xsimd_version)
]])
install(FILES ${PROJECT_BINARY_DIR}/generated/vndf-config.cmake ${PROJECT_BINARY_DIR}/generated/vndf-config-version.cmake
              ${CMAKE_CURRENT_LIST_DIR}/xsimd.cmake
        DESTINATION ${package})

# pkg-config finds the prefix from where its file lies, so that a package may move; directories outside it stay.
set(pc_includedir ${CMAKE_INSTALL_INCLUDEDIR})
set(pc_libdir ${CMAKE_INSTALL_LIBDIR})
foreach(directory pc_includedir pc_libdir)
  if(NOT IS_ABSOLUTE "${${directory}}")
    set(${directory} "\${prefix}/${${directory}}")
  endif()
endforeach()
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
  set(pc_prefix ${CMAKE_INSTALL_PREFIX})
else()
  file(RELATIVE_PATH pc_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  set(pc_prefix "\${pcfiledir}/${pc_prefix}")
endif()
file(CONFIGURE OUTPUT generated/vndf.pc @ONLY CONTENT [[
prefix=@pc_prefix@
includedir=@pc_includedir@
libdir=@pc_libdir@

Name: vndf
Description: @PROJECT_DESCRIPTION@
Version: @PROJECT_VERSION@
Cflags: -I${includedir}
Libs: -L${libdir} -lvndf
]])
install(FILES ${PROJECT_BINARY_DIR}/generated/vndf.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

# cpack -G DEB makes libvndf-dev, which has all of it.
if(PROJECT_IS_TOP_LEVEL)
  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_CONTACT "The vndf authors")
  set(CPACK_DEBIAN_PACKAGE_NAME libvndf-dev)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS libxsimd-dev)  # for vndf::lanes
  include(CPack)
endif()
