# cmake -DSOURCE= -DBUILD= -DPREFIX= -P install.cmake -- OPTION...: configures, builds and installs the library alone.
set(options "")
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(i RANGE ${last})
  if(DEFINED at_options)
    list(APPEND options "${CMAKE_ARGV${i}}")
  elseif("${CMAKE_ARGV${i}}" STREQUAL "--")
    set(at_options TRUE)
  endif()
endforeach()
file(REMOVE_RECURSE "${PREFIX}")
execute_process(COMMAND ${CMAKE_COMMAND} -S "${SOURCE}" -B "${BUILD}" -G "Unix Makefiles" -DVNDF_BUILD_TESTS=OFF
                        -DVNDF_BUILD_BENCH=OFF "-DCMAKE_INSTALL_PREFIX=${PREFIX}" ${options}
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build "${BUILD}" -j 2 COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --install "${BUILD}" COMMAND_ERROR_IS_FATAL ANY)
