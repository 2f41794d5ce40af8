# Fibres have little stack: what a call needs, of every function on every set.
add_executable(vndf_host_stack programs/stack.cpp)
target_link_libraries(vndf_host_stack PRIVATE vndf::vndf)
if(NOT VNDF_DEBUG_KERNELS)
  add_test(NAME hosts.stack COMMAND vndf_host_stack)
endif()
