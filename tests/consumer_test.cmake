# Another project finds an installed copy and builds against it.
set(prefix ${CMAKE_CURRENT_BINARY_DIR}/consumer/prefix)
add_test(NAME consumer.install
         COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --config $<CONFIG> --prefix ${prefix})
set_tests_properties(consumer.install PROPERTIES FIXTURES_SETUP vndf_installed)
add_test(NAME consumer.build_and_run
         COMMAND ${CMAKE_CTEST_COMMAND}
                 --build-and-test ${CMAKE_CURRENT_SOURCE_DIR}/consumer ${CMAKE_CURRENT_BINARY_DIR}/consumer/build
                 --build-generator ${CMAKE_GENERATOR}
                 --build-options -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
                                 -DCMAKE_BUILD_TYPE=$<CONFIG> -Dxsimd_DIR=${xsimd_DIR}
                 --test-command ${CMAKE_CTEST_COMMAND} --output-on-failure)
set_tests_properties(consumer.build_and_run PROPERTIES FIXTURES_REQUIRED vndf_installed)
