# What a host adds to its project: programs of this folder and their tests.
enable_testing()

# host_program(name [LIBRARIES library...] [ARGUMENTS argument...])
function(host_program name)
  cmake_parse_arguments(PARSE_ARGV 1 program "" "" "LIBRARIES;ARGUMENTS")
  add_executable(${name} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE ${program_LIBRARIES})
  add_test(NAME ${name} COMMAND ${name} ${program_ARGUMENTS})
endfunction()

# Both doors. EXPECTED is what the library's own build wrote.
function(host_programs)
  host_program(batches LIBRARIES vndf::vndf ARGUMENTS ${EXPECTED})
  host_program(own_kernel LIBRARIES vndf::vndf vndf::lanes)
endfunction()
