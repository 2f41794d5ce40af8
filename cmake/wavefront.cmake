# Targets of the presets wavefront, wavefront-test and wavefront-measure: install the library to a prefix within the build
# directory, and build the renderer of bench/wavefront, a project of its own, from what is there.
set(prefix ${CMAKE_BINARY_DIR}/prefix)
set(renderer ${CMAKE_BINARY_DIR}/renderer)

add_custom_target(wavefront_prefix
  COMMAND ${CMAKE_COMMAND} --install ${CMAKE_BINARY_DIR} --prefix ${prefix}
  COMMAND ${CMAKE_COMMAND} -S ${PROJECT_SOURCE_DIR}/bench/wavefront -B ${renderer} -G ${CMAKE_GENERATOR}
          -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} -DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE} -DCMAKE_PREFIX_PATH=${prefix}
          -DWAVEFRONT_TESTS=${VNDF_WAVEFRONT_TESTS} -DWAVEFRONT_MEASURE=${VNDF_WAVEFRONT_MEASURE}
  COMMAND ${CMAKE_COMMAND} --build ${renderer}
  DEPENDS vndf
  USES_TERMINAL VERBATIM)

add_custom_target(wavefront_picture
  COMMAND ${renderer}/vndf_wavefront --spp 64 --size 960x540 --time-limit 100 --out ${CMAKE_BINARY_DIR}/wavefront.exr
          --png ${CMAKE_BINARY_DIR}/wavefront.png
  COMMAND ${CMAKE_COMMAND} -E echo "The picture: ${CMAKE_BINARY_DIR}/wavefront.png"
  DEPENDS wavefront_prefix
  USES_TERMINAL VERBATIM)

if(VNDF_WAVEFRONT_MEASURE)
  include(cmake/python.cmake)
  add_custom_target(wavefront_measure
    COMMAND ${VNDF_PYTHON} -B ${PROJECT_SOURCE_DIR}/bench/wavefront/measure/measure.py --build ${renderer}
            --out ${CMAKE_BINARY_DIR}/measure --source ${PROJECT_SOURCE_DIR}
            "--compiler=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
    DEPENDS wavefront_prefix
    USES_TERMINAL VERBATIM)
endif()

if(VNDF_WAVEFRONT_TESTS)
  enable_testing()
  add_test(NAME wavefront COMMAND ${CMAKE_CTEST_COMMAND} --test-dir ${renderer} --output-on-failure)
endif()
