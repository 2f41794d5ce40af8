# The golden bits without optimisation, and from the other compiler where there is one.
function(vndf_other_build name)
  set(build ${CMAKE_CURRENT_BINARY_DIR}/other_builds/${name})
  add_test(NAME golden_bits.${name}
           COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test ${PROJECT_SOURCE_DIR} ${build}
                   --build-generator ${CMAKE_GENERATOR} --build-target golden_test
                   --build-options -DVNDF_BUILD_TESTS=ON -DVNDF_BUILD_BENCH=OFF -Dxsimd_DIR=${xsimd_DIR}
                                   -DGTest_DIR=${GTest_DIR} ${ARGN}
                   --test-command ${build}/tests/golden_test)
  set_tests_properties(golden_bits.${name} PROPERTIES TIMEOUT 900)
endfunction()

vndf_other_build(unoptimised -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} -DCMAKE_BUILD_TYPE=Debug)

if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(other clang++)
else()
  set(other g++)
endif()
find_program(VNDF_OTHER_COMPILER ${other})
vndf_other_build(${other} -DCMAKE_CXX_COMPILER=${VNDF_OTHER_COMPILER} -DCMAKE_BUILD_TYPE=Release)
if(NOT VNDF_OTHER_COMPILER)
  set_tests_properties(golden_bits.${other} PROPERTIES DISABLED TRUE)
endif()
