# Targets of the presets wavefront and wavefront-test: install the library to a prefix within the build directory, and build
# the renderer of bench/wavefront, a project of its own, from what is there.
set(prefix ${CMAKE_BINARY_DIR}/prefix)
set(renderer ${CMAKE_BINARY_DIR}/renderer)

add_custom_target(wavefront_prefix
  COMMAND ${CMAKE_COMMAND} --install ${CMAKE_BINARY_DIR} --prefix ${prefix}
  COMMAND ${CMAKE_COMMAND} -S ${PROJECT_SOURCE_DIR}/bench/wavefront -B ${renderer} -G ${CMAKE_GENERATOR}
          -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} -DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE} -DCMAKE_PREFIX_PATH=${prefix}
          -DWAVEFRONT_TESTS=${VNDF_WAVEFRONT_TESTS}
  COMMAND ${CMAKE_COMMAND} --build ${renderer}
  DEPENDS vndf
  USES_TERMINAL VERBATIM)

add_custom_target(wavefront_picture
  COMMAND ${renderer}/vndf_wavefront --spp 64 --size 960x540 --time-limit 100 --out ${CMAKE_BINARY_DIR}/wavefront.exr
          --png ${CMAKE_BINARY_DIR}/wavefront.png
  COMMAND ${CMAKE_COMMAND} -E echo "The picture: ${CMAKE_BINARY_DIR}/wavefront.png"
  DEPENDS wavefront_prefix
  USES_TERMINAL VERBATIM)

if(VNDF_WAVEFRONT_TESTS)
  enable_testing()
  add_test(NAME wavefront COMMAND ${CMAKE_CTEST_COMMAND} --test-dir ${renderer} --output-on-failure)
endif()
