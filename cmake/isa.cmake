# An object of the library that computes with the lanes. Their functions and xsimd's own land in namespaces of this
# object, so that no linker can mistake its copy of an inline function for one of another set; see check_symbols.cmake.
function(vndf_lanes_object name source)
  add_library(vndf_${name} OBJECT ${source})
  target_link_libraries(vndf_${name} PRIVATE vndf::lanes)
  # GCC's own AVX-512 header sets off -Wmaybe-uninitialized (its _mm512_undefined_ps reads an uninitialized variable).
  target_compile_options(vndf_${name} PRIVATE ${vndf_compile_options}
                         $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  # GCC leaves this scheduler off on x86. With it AVX2's shading kernels
  # take 1 to 8 % less time on Zen 1, those of normals 1 to 2 % more.
  target_compile_options(vndf_${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fschedule-insns;-fsched-pressure>)
  target_compile_definitions(vndf_${name} PRIVATE VNDF_LANES_BUILD=kernels_${name} xsimd=xsimd_kernels_${name})
  set_target_properties(vndf_${name} PROPERTIES INTERPROCEDURAL_OPTIMIZATION OFF POSITION_INDEPENDENT_CODE ON)
  target_sources(vndf PRIVATE $<TARGET_OBJECTS:vndf_${name}>)
endfunction()

vndf_lanes_object(make_shape src/make_shape.cpp)

# The instruction sets of the library, slowest first: one row each, and nothing else names them.
#   vndf_isa(name BATCH vector-type [CPU feature...] [FLAGS flag...])
# CPU: what __builtin_cpu_supports must affirm; GCC's and Clang's run-times ask the operating system as well as the
# processor. Compiles src/kernels.cpp into the library with FLAGS and adds the name to isa_rows.h, which dispatch reads.
function(vndf_isa name)
  cmake_parse_arguments(PARSE_ARGV 1 row "" "BATCH" "CPU;FLAGS")
  if(row_FLAGS AND NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
    return()
  endif()

  vndf_lanes_object(${name} src/kernels.cpp)
  target_compile_options(vndf_${name} PRIVATE ${row_FLAGS})
  target_compile_definitions(vndf_${name} PRIVATE VNDF_BATCH=${row_BATCH} VNDF_TABLE=kernels_${name})

  set(supported true)
  foreach(feature IN LISTS row_CPU)
    string(APPEND supported " && __builtin_cpu_supports(\"${feature}\")")
  endforeach()
  set_property(GLOBAL APPEND_STRING PROPERTY vndf_isa_rows "VNDF_ISA(${name}, ${supported})\n")
  set_property(GLOBAL APPEND_STRING PROPERTY vndf_isa_names " ${name}")
  set_property(GLOBAL APPEND PROPERTY vndf_isas ${name})
endfunction()

vndf_isa(scalar BATCH float)
vndf_isa(sse42 BATCH xsimd::batch<float,xsimd::sse4_2> CPU sse4.2 FLAGS -msse4.2)
vndf_isa(avx2 BATCH xsimd::batch<float,xsimd::avx2> CPU avx2 FLAGS -mavx2)
vndf_isa(avx512 BATCH xsimd::batch<float,xsimd::avx512bw>
         CPU avx512f avx512cd avx512dq avx512bw FLAGS -mavx512f -mavx512cd -mavx512dq -mavx512bw)

get_property(rows GLOBAL PROPERTY vndf_isa_rows)
get_property(names GLOBAL PROPERTY vndf_isa_names)
file(CONFIGURE OUTPUT generated/isa_rows.h CONTENT "${rows}")
target_include_directories(vndf PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/generated)
target_compile_definitions(vndf PRIVATE "VNDF_ISA_NAMES=\"${names}\"")
