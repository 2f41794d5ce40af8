# Looks at what the object of one instruction set exports: its table, and nothing else. An inline function that were
# exported could be the copy that a linker keeps for the whole program, and would then run where its instructions do not
# exist. Weak symbols are harmless where their name holds the set's own namespace: no other object has them.
# And at what it calls: nothing that allocates, locks, throws or rounds as a mathematics library likes, only what
# compilers put in by themselves.
#   cmake -DNM=nm -DISA=avx2 "-DOBJECTS=a.o;b.o" -P check_symbols.cmake
# Mangled names carry the length of each part, so that sse4 is not found in sse42.
string(LENGTH kernels_${ISA} length)
math(EXPR xsimd_length "${length} + 6")
set(table ^_?_ZN4vndf${length}kernels_${ISA}E$)
set(own_namespace "[^0-9](${length}kernels_${ISA}|${xsimd_length}xsimd_kernels_${ISA})")
set(compilers_own "^_?(mem(cpy|set|move|cmp)|__stack_chk_fail|_GLOBAL_OFFSET_TABLE_|__[a-z]+san_[^ ]+) ")
set(tables 0)
set(leaks "")
set(calls "")
foreach(object IN LISTS OBJECTS)
  execute_process(COMMAND ${NM} --defined-only --extern-only --format=posix ${object}
                  OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" symbols "${symbols}")
  foreach(symbol IN LISTS symbols)
    if(NOT symbol MATCHES "^([^ ]+) ([A-Za-z])")
      message(FATAL_ERROR "${NM} says what is not understood: ${symbol}")
    endif()
    set(name "${CMAKE_MATCH_1}")
    set(kind "${CMAKE_MATCH_2}")
    if(name MATCHES "${table}")
      math(EXPR tables "${tables} + 1")
    elseif(NOT (kind MATCHES "[VWuvw]" AND name MATCHES "${own_namespace}"))
      string(APPEND leaks "\n  ${symbol}")
    endif()
  endforeach()

  execute_process(COMMAND ${NM} --undefined-only --format=posix ${object}
                  OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" symbols "${symbols}")
  list(FILTER symbols EXCLUDE REGEX "${compilers_own}")
  list(APPEND calls ${symbols})
endforeach()
if(leaks)
  message(FATAL_ERROR "Exported by the ${ISA} kernels, and shared with whoever else has them:${leaks}")
endif()
if(NOT tables EQUAL 1)
  message(FATAL_ERROR "${OBJECTS} export ${tables} tables kernels_${ISA}, not one")
endif()
if(calls)
  list(JOIN calls "\n  " calls)
  message(FATAL_ERROR "Called by the ${ISA} kernels:\n  ${calls}")
endif()
