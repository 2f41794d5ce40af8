# Looks at what the object of one instruction set exports: its table, and nothing else. An inline function that were
# exported could be the copy that a linker keeps for the whole program, and would then run where its instructions do not
# exist. Weak symbols are harmless where their name holds the set's own namespace: no other object has them.
#   cmake -DNM=nm -DISA=avx2 "-DOBJECTS=a.o;b.o" -P check_symbols.cmake
set(table _ZN4vndf[0-9]+kernels_${ISA}E)
set(tables 0)
set(leaks "")
foreach(object IN LISTS OBJECTS)
  execute_process(COMMAND ${NM} --defined-only --extern-only --format=posix ${object}
                  OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" symbols "${symbols}")
  foreach(symbol IN LISTS symbols)
    if(NOT symbol MATCHES "^([^ ]+) ([A-Za-z])")
      message(FATAL_ERROR "${NM} says what is not understood: ${symbol}")
    endif()
    if(CMAKE_MATCH_1 MATCHES "^_?${table}$")
      math(EXPR tables "${tables} + 1")
    elseif(NOT (CMAKE_MATCH_2 MATCHES "[VWuvw]" AND CMAKE_MATCH_1 MATCHES "[0-9](xsimd_)?kernels_${ISA}[^a-z0-9_]"))
      string(APPEND leaks "\n  ${symbol}")
    endif()
  endforeach()
endforeach()
if(leaks)
  message(FATAL_ERROR "Exported by the ${ISA} kernels, and shared with whoever else has them:${leaks}")
endif()
if(NOT tables EQUAL 1)
  message(FATAL_ERROR "${OBJECTS} export ${tables} tables kernels_${ISA}, not one")
endif()
