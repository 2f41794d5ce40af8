# The public functions: each has a file in src/dispatch/, which chooses, and one in src/kernels/, which is compiled once
# for each instruction set and exports vndf::<set>::<function>, its table.
set(vndf_functions sample_normals sample_disk sample_reflection evaluate_reflection pdf_normals sample_dielectric
    evaluate_dielectric)
set_property(GLOBAL PROPERTY vndf_functions ${vndf_functions})

list(TRANSFORM vndf_functions PREPEND src/dispatch/ OUTPUT_VARIABLE fronts)
list(TRANSFORM fronts APPEND .cpp)
target_sources(vndf PRIVATE ${fronts})

# Objects of the library that compute with the lanes. Their functions and xsimd's own land in namespaces of these
# objects, so that no linker can mistake its copy of an inline function for one of another set; see check_symbols.cmake.
function(vndf_lanes_objects name)
  add_library(vndf_${name} OBJECT ${ARGN})
  target_link_libraries(vndf_${name} PRIVATE vndf::lanes)
  target_include_directories(vndf_${name} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  vndf_library_target(vndf_${name})
  # GCC's own AVX-512 header sets off these (its _mm512_undefined_ps reads an uninitialized variable).
  target_compile_options(vndf_${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized;-Wno-maybe-uninitialized>)
  # GCC leaves this scheduler off on x86. With it, K vectors at once are K chains side by side; without, one after the
  # other.
  target_compile_options(vndf_${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fschedule-insns;-fsched-pressure>
                                              ${vndf_kernel_options})
  # Several pointers in one store, and then loaded one by one, wait for the store to reach the cache: 20 ns a call.
  vndf_shell(one_by_one -fno-tree-slp-vectorize)
  target_compile_options(vndf_${name} PRIVATE "${one_by_one}")
  target_compile_definitions(vndf_${name} PRIVATE VNDF_LANES_BUILD=kernels_${name} xsimd=xsimd_kernels_${name})
  target_sources(vndf PRIVATE $<TARGET_OBJECTS:vndf_${name}>)
endfunction()

vndf_lanes_objects(make_shape src/make_shape.cpp)

# The instruction sets of the library, slowest first: one row each, and nothing else names them.
#   vndf_isa(name [ARCHITECTURE X86|ARM] BATCH vector-type VECTORS n [CPU feature...] [FLAGS flag...])
# ARCHITECTURE: where the row is; without, everywhere.
# VECTORS: how many a kernel takes at once: what the registers hold.
# CPU: what __builtin_cpu_supports must affirm, or processor.h in its place; it asks the operating system as well as the
# processor. Compiles the kernels into the library with FLAGS and adds the name to isa_rows.h, which dispatch reads.
function(vndf_isa name)
  cmake_parse_arguments(PARSE_ARGV 1 row "" "ARCHITECTURE;BATCH;VECTORS" "CPU;FLAGS")
  if(NOT name IN_LIST VNDF_ISAS OR NOT "${row_ARCHITECTURE}" MATCHES "^(${vndf_architecture})?$")
    return()
  endif()

  set(sources "")
  foreach(function IN LISTS vndf_functions)
    # Under a name of its own, for archives and debuggers.
    set(source ${CMAKE_CURRENT_BINARY_DIR}/generated/${function}_${name}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "#include \"kernels/${function}.cpp\"\n")
    list(APPEND sources ${source})
  endforeach()
  vndf_lanes_objects(${name} ${sources})
  vndf_shell(flags ${row_FLAGS})
  target_compile_options(vndf_${name} PRIVATE "${flags}")
  target_compile_definitions(vndf_${name} PRIVATE VNDF_SET=${name} VNDF_BATCH=${row_BATCH}
                                                  VNDF_VECTORS=${row_VECTORS})

  set(supported true)
  foreach(feature IN LISTS row_CPU)
    string(APPEND supported " && VNDF_PROCESSOR_HAS(\"${feature}\")")
  endforeach()
  set_property(GLOBAL APPEND_STRING PROPERTY vndf_isa_rows "VNDF_ISA(${name}, ${supported})\n")
  set_property(GLOBAL APPEND_STRING PROPERTY vndf_isa_names " ${name}")
  set_property(GLOBAL APPEND PROPERTY vndf_isas ${name})
endfunction()

set(VNDF_ISAS scalar sse42 avx2 avx512 neon CACHE STRING
    "The instruction sets to compile, those of other architectures left out; scalar must be one of them")
if(NOT scalar IN_LIST VNDF_ISAS)
  message(FATAL_ERROR "VNDF_ISAS is \"${VNDF_ISAS}\": scalar must be among them, for processors that have no other")
endif()

vndf_isa(scalar BATCH float VECTORS 1)
vndf_isa(sse42 ARCHITECTURE X86 BATCH xsimd::batch<float,xsimd::sse4_2> VECTORS 2 CPU sse4.2 FLAGS -msse4.2)
vndf_isa(avx2 ARCHITECTURE X86 BATCH xsimd::batch<float,xsimd::avx2> VECTORS 2 CPU avx2 FLAGS -mavx2)
vndf_isa(avx512 ARCHITECTURE X86 BATCH xsimd::batch<float,xsimd::avx512bw> VECTORS 4
         CPU avx512f avx512cd avx512dq avx512bw FLAGS -mavx512f -mavx512cd -mavx512dq -mavx512bw)
# Every 64-bit ARM has it. VECTORS are those of the other set with 32 registers: nobody has measured it.
vndf_isa(neon ARCHITECTURE ARM BATCH xsimd::batch<float,xsimd::neon64> VECTORS 4)

get_property(rows GLOBAL PROPERTY vndf_isa_rows)
get_property(names GLOBAL PROPERTY vndf_isa_names)
file(CONFIGURE OUTPUT generated/isa_rows.h CONTENT "// Included with a VNDF_ISA(name, supported), which it undefines.\n${rows}#undef VNDF_ISA\n")
target_include_directories(vndf PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/generated)
set_source_files_properties(src/dispatch/dispatch.cpp PROPERTIES COMPILE_DEFINITIONS "VNDF_ISA_NAMES=\"${names}\"")
