# find_package(vndf) for installed copies: vndf::vndf and vndf::lanes.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set_target_properties(vndf PROPERTIES EXPORT_NAME vndf)
install(TARGETS vndf vndf_lanes EXPORT vndf-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/vndf DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT vndf-targets NAMESPACE vndf:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vndf)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/generated/vndf-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
# xsimd is a dependency of vndf::lanes alone: without it, vndf::vndf is still found and complete.
file(CONFIGURE OUTPUT generated/vndf-config.cmake @ONLY CONTENT [[
include("${CMAKE_CURRENT_LIST_DIR}/vndf-targets.cmake")
find_package(xsimd QUIET)
if(xsimd_FOUND)
  get_target_property(vndf_xsimd_include_dir xsimd INTERFACE_INCLUDE_DIRECTORIES)
  if(vndf_xsimd_include_dir AND NOT vndf_xsimd_include_dir STREQUAL "/usr/include")
    target_include_directories(vndf::lanes SYSTEM INTERFACE ${vndf_xsimd_include_dir})
  endif()
  unset(vndf_xsimd_include_dir)
endif()
]])
install(FILES ${PROJECT_BINARY_DIR}/generated/vndf-config.cmake ${PROJECT_BINARY_DIR}/generated/vndf-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vndf)
