# Flags of a host. They come before the library's own, which must take back what changes bits, speed or processors.

# All at once, and no build type: the library's own are those of every host.
vndf_host(flags PROJECT subdirectory
          OPTIONS "-DCMAKE_CXX_FLAGS=-march=native -Ofast -fno-finite-math-only -fno-math-errno -flto" -DCMAKE_BUILD_TYPE=Debug
                  "-DFLAGS_OF_THE_DIRECTORY=-ffast-math\\;-O0")
vndf_host(flags.${other} PROJECT subdirectory COMPILER ${VNDF_OTHER_COMPILER}
          OPTIONS "-DCMAKE_CXX_FLAGS=-march=native -funsafe-math-optimizations -fno-signed-zeros")

# One by one, with both compilers and vectors.
set(trials
    fast_math "-ffast-math"
    ofast "-Ofast"
    not_all_of_it "-ffast-math -fno-finite-math-only"
    unsafe "-funsafe-math-optimizations"
    associative "-fassociative-math -fno-signed-zeros -fno-trapping-math"
    reciprocal "-freciprocal-math"
    finite "-ffinite-math-only"
    fused "-ffp-contract=fast -mfma"
    native "-march=native"
    none "-O0")
add_test(NAME hosts.options
         COMMAND ${CMAKE_COMMAND} -DCXX=${CMAKE_CXX_COMPILER} -DID=${CMAKE_CXX_COMPILER_ID} "-DTRIALS=${trials}"
                 "-DOPTIONS=$<JOIN:$<TARGET_PROPERTY:vndf_scalar,COMPILE_OPTIONS>, >" -DWORK=${CMAKE_CURRENT_BINARY_DIR}
                 -P ${CMAKE_CURRENT_SOURCE_DIR}/options.cmake)
while(trials)
  list(POP_FRONT trials name flags)
  foreach(compiler ${CMAKE_CXX_COMPILER} ${VNDF_OTHER_COMPILER})
    get_filename_component(file ${compiler} NAME)
    vndf_host(flags.${name}.${file} SLOW PROJECT subdirectory COMPILER ${compiler}
              OPTIONS "-DCMAKE_CXX_FLAGS=${flags}" -DSETS=avx2)
  endforeach()
endwhile()
vndf_host(flags.single_constants SLOW PROJECT subdirectory OPTIONS -DCMAKE_CXX_FLAGS=-fsingle-precision-constant)
foreach(standard 20 23)
  vndf_host(flags.c++${standard} SLOW PROJECT subdirectory
            OPTIONS -DCMAKE_CXX_STANDARD=${standard} -DCMAKE_CXX_VISIBILITY_PRESET=hidden -DCMAKE_UNITY_BUILD=ON
                    -DCMAKE_INTERPROCEDURAL_OPTIMIZATION=ON)
endforeach()

# What can be seen of flags that nobody took back is refused.
set(xsimd "")
if(vndf_xsimd_include_dir)
  set(xsimd -isystem ${vndf_xsimd_include_dir})
endif()
foreach(flag -ffast-math -ffinite-math-only -fassociative-math\ -fno-signed-zeros\ -fno-trapping-math -freciprocal-math
        -fno-signed-zeros -fsingle-precision-constant)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" OR flag MATCHES "^-ff")
    separate_arguments(arguments UNIX_COMMAND "${flag}")
    string(REGEX REPLACE " .*" "" name "${flag}")
    add_test(NAME hosts.refused${name}
             COMMAND ${CMAKE_CXX_COMPILER} -std=c++17 ${arguments} -fsyntax-only -I${PROJECT_SOURCE_DIR}/include
                     ${xsimd} ${PROJECT_SOURCE_DIR}/include/vndf/lanes/simd.h)
    set_tests_properties(hosts.refused${name} PROPERTIES PASS_REGULAR_EXPRESSION "error.*vndf (promises|needs)")
  endif()
endforeach()

# The golden bits where the kernels are not optimised, and from the other compiler where there is one.
function(vndf_golden_build name)
  set(build ${CMAKE_CURRENT_BINARY_DIR}/golden/${name})
  add_test(NAME golden_bits.${name}
           COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test ${PROJECT_SOURCE_DIR} ${build}
                   --build-generator ${CMAKE_GENERATOR} --build-target golden_test
                   --build-options -DVNDF_BUILD_TESTS=ON -DVNDF_BUILD_BENCH=OFF -Dxsimd_DIR=${xsimd_DIR}
                                   -DXSIMD_INCLUDE_DIR=${XSIMD_INCLUDE_DIR} -DGTest_DIR=${GTest_DIR} -DBoost_DIR=${Boost_DIR} ${ARGN}
                   --test-command ${build}/tests/golden_test)
  set_tests_properties(golden_bits.${name} PROPERTIES TIMEOUT 900)
endfunction()
vndf_golden_build(unoptimised -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} -DCMAKE_BUILD_TYPE=Debug -DVNDF_DEBUG_KERNELS=ON)
vndf_golden_build(${other} -DCMAKE_CXX_COMPILER=${VNDF_OTHER_COMPILER} -DCMAKE_BUILD_TYPE=Release)
if(NOT VNDF_OTHER_COMPILER)
  set_tests_properties(golden_bits.${other} PROPERTIES DISABLED TRUE)
endif()
