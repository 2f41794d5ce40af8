# A program built by hand, with what pkg-config says of the installed copy.
set(ENV{PKG_CONFIG_PATH} ${PREFIX}/${LIBDIR}/pkgconfig)
execute_process(COMMAND ${PKG_CONFIG} --modversion vndf OUTPUT_VARIABLE found OUTPUT_STRIP_TRAILING_WHITESPACE
                COMMAND_ERROR_IS_FATAL ANY)
if(NOT found STREQUAL VERSION)
  message(FATAL_ERROR "pkg-config has vndf ${found}, not ${VERSION}")
endif()
execute_process(COMMAND ${PKG_CONFIG} --cflags --libs vndf OUTPUT_VARIABLE flags COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags UNIX_COMMAND "${flags}")
execute_process(COMMAND ${CXX} -std=c++17 ${PROGRAM} ${flags} -Wl,-rpath,${PREFIX}/${LIBDIR} -o ${WORK}/by_hand
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${WORK}/by_hand ${EXPECTED} COMMAND_ERROR_IS_FATAL ANY)
