# What a host adds to its project: programs of this folder and their tests.
enable_testing()

# host_program(name [LIBRARIES library...] [ARGUMENTS argument...])
function(host_program name)
  cmake_parse_arguments(PARSE_ARGV 1 program "" "" "LIBRARIES;ARGUMENTS")
  add_executable(${name} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE ${program_LIBRARIES})
  add_test(NAME ${name} COMMAND ${name} ${program_ARGUMENTS})
endfunction()

# The kernel of own_kernel.cpp for an instruction set.
function(host_kernel isa batch)
  add_library(own_kernel_${isa} OBJECT ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/own_kernel_shade.cpp)
  target_link_libraries(own_kernel_${isa} PRIVATE vndf::vndf vndf::lanes)
  target_compile_definitions(own_kernel_${isa} PRIVATE SHADE=shade_${isa} BATCH=${batch})
  target_compile_options(own_kernel_${isa} PRIVATE ${ARGN})
  target_sources(own_kernel PRIVATE $<TARGET_OBJECTS:own_kernel_${isa}>)
endfunction()

# Both doors. EXPECTED is what the library's own build wrote.
function(host_programs)
  host_program(batches LIBRARIES vndf::vndf ARGUMENTS ${EXPECTED})
  host_program(own_kernel LIBRARIES vndf::vndf vndf::lanes)
  host_kernel(scalar float)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
    host_kernel(sse42 xsimd::batch<float,xsimd::sse4_2> -msse4.2)
    host_kernel(avx2 xsimd::batch<float,xsimd::avx2> -mavx2)
  endif()
endfunction()
