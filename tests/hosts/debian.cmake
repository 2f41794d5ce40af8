# The Debian package, where there is a bare Debian to try it on; see debian.sh.
set(VNDF_DEBIAN_ROOT "" CACHE PATH "The root folder of a minimal Debian 12 for the test of the package; needs root")
add_test(NAME hosts.debian.package CONFIGURATIONS slow
         COMMAND ${CMAKE_CPACK_COMMAND} -G DEB -B ${CMAKE_CURRENT_BINARY_DIR}/debian WORKING_DIRECTORY ${PROJECT_BINARY_DIR})
set_tests_properties(hosts.debian.package PROPERTIES FIXTURES_SETUP vndf_deb)
add_test(NAME hosts.debian CONFIGURATIONS slow
         COMMAND sh -c "sh '${CMAKE_CURRENT_SOURCE_DIR}/debian.sh' '${VNDF_DEBIAN_ROOT}' '${CMAKE_CURRENT_BINARY_DIR}/debian'/libvndf-dev_${PROJECT_VERSION}_*.deb '${CMAKE_CURRENT_SOURCE_DIR}' '${expected}'")
set_tests_properties(hosts.debian PROPERTIES FIXTURES_REQUIRED "vndf_deb;vndf_expected")
if(NOT VNDF_DEBIAN_ROOT)
  set_tests_properties(hosts.debian PROPERTIES DISABLED TRUE)
endif()
