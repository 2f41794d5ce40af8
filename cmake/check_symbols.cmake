# Looks at what the object of one function and one instruction set exports: its table, and nothing else. An inline
# function that is exported could be the copy that a linker keeps for the whole program, and would then run where its
# instructions do not exist. Weak symbols are harmless where their name holds the set's own namespace: no other set has
# them.
# And at what it calls: nothing that allocates, locks, throws or rounds as a mathematics library likes, only what
# compilers put in by themselves.
#   cmake -DNM=nm -DISA=avx2 "-DFUNCTIONS=sample_disk;sample_normals" "-DOBJECTS=a.o;b.o" -P check_symbols.cmake
# Mangled names carry the length of each part, so that sse4 is not found in sse42.
cmake_minimum_required(VERSION 3.22)
string(LENGTH ${ISA} isa_length)
string(LENGTH kernels_${ISA} length)
math(EXPR xsimd_length "${length} + 6")
set(own_namespace "[^0-9](${length}kernels_${ISA}|${xsimd_length}xsimd_kernels_${ISA})")
set(compilers_own "^_?(mem(cpy|set|move|cmp)|__stack_chk_fail|___chkstk_ms|_GLOBAL_OFFSET_TABLE_|__[a-z]+san_[^ ]+|__gcov_[^ ]+|__sanitizer_cov_[^ ]+|(__st(art|op)_)?__sancov_[^ ]+) ")
set(tables "")
set(leaks "")
set(calls "")

function(symbols_of object kind result)
  execute_process(COMMAND ${NM} ${kind} --format=posix ${object} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" symbols "${symbols}")
  set(${result} "${symbols}" PARENT_SCOPE)
endfunction()

foreach(function IN LISTS FUNCTIONS)
  string(LENGTH ${function} function_length)
  list(APPEND expected ${isa_length}${ISA}${function_length}${function})
endforeach()

foreach(object IN LISTS OBJECTS)
  symbols_of(${object} "--defined-only;--extern-only" symbols)
  set(tables_here 0)
  list(FILTER symbols EXCLUDE REGEX "^__odr_asan\\.")  # AddressSanitizer's, one for each table
  foreach(symbol IN LISTS symbols)
    if(NOT symbol MATCHES "^([^ ]+) ([A-Za-z])")
      message(FATAL_ERROR "${NM} says what is not understood: ${symbol}")
    endif()
    set(name "${CMAKE_MATCH_1}")
    set(kind "${CMAKE_MATCH_2}")
    string(REGEX REPLACE "^_?_ZN4vndf(.*)E$" "\\1" table "${name}")
    if(table IN_LIST expected)
      list(APPEND tables ${table})
      math(EXPR tables_here "${tables_here} + 1")
    elseif(NOT (kind MATCHES "[VWuvw]" AND name MATCHES "${own_namespace}"))
      string(APPEND leaks "\n  ${symbol}")
    endif()
  endforeach()
  if(NOT tables_here EQUAL 1)
    message(FATAL_ERROR "${object} exports ${tables_here} tables, not one")
  endif()

  symbols_of(${object} --undefined-only symbols)
  list(FILTER symbols EXCLUDE REGEX "${compilers_own}")
  list(APPEND calls ${symbols})
endforeach()
if(leaks)
  message(FATAL_ERROR "Exported by the ${ISA} kernels, and shared with whoever else has them:${leaks}")
endif()
list(SORT tables)
list(SORT expected)
if(NOT tables STREQUAL expected)
  message(FATAL_ERROR "The ${ISA} kernels export the tables ${tables}, not ${expected}")
endif()
if(calls)
  list(JOIN calls "\n  " calls)
  message(FATAL_ERROR "Called by the ${ISA} kernels:\n  ${calls}")
endif()
