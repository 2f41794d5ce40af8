# Hosts compile with warnings of their own: the headers give none of Clang's, but for what they cannot be without.
set(clang ${CMAKE_CXX_COMPILER})
if(NOT CMAKE_CXX_COMPILER_ID MATCHES Clang)
  set(clang ${VNDF_OTHER_COMPILER})
endif()
find_program(VNDF_CLANG NAMES ${clang})
set(xsimd "")
if(vndf_xsimd_include_dir)
  set(xsimd -isystem ${vndf_xsimd_include_dir})
endif()
add_test(NAME hosts.warnings
         COMMAND ${VNDF_CLANG} -std=c++17 -fsyntax-only -Weverything -Wno-unknown-warning-option -Wno-c++98-compat
                 -Wno-c++98-compat-pedantic -Wno-padded -Wno-float-equal -Wno-unsafe-buffer-usage
                 -I ${PROJECT_SOURCE_DIR}/include -isystem ${PROJECT_SOURCE_DIR}/tests ${xsimd}
                 -D VNDF_LANES=xsimd::batch<float> ${PROJECT_SOURCE_DIR}/tests/lanes_test.cpp)
set_tests_properties(hosts.warnings PROPERTIES FAIL_REGULAR_EXPRESSION "include/vndf/[a-z_/]*\\.h:[0-9:]* warning"
                     DISABLED $<NOT:$<BOOL:${VNDF_CLANG}>>)
