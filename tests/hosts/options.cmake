# Behind a host's flags, the library's own options leave the compiler as they do alone. What the builds of single flags
# (-C slow) see by running, for every option there is and within seconds.
#   cmake -DCXX= -DID= "-DOPTIONS=..." "-DTRIALS=name;flags;name;flags..." -DWORK= -P options.cmake
function(effect_of flags result)
  string(REPLACE "SHELL:" "" options "${OPTIONS}")
  separate_arguments(arguments UNIX_COMMAND "-O2 ${flags} ${options}")
  set(effect "")
  if(ID STREQUAL "GNU")
    foreach(kind common optimizers target params c++)
      execute_process(COMMAND ${CXX} ${arguments} -Q --help=${kind} OUTPUT_VARIABLE settings ERROR_QUIET
                      COMMAND_ERROR_IS_FATAL ANY)
      # A temporary file's name; instructions that no compiler uses unasked.
      string(REGEX REPLACE "\n +(-o <file>|-mxsave )[^\n]*" "" settings "${settings}")
      string(APPEND effect "${settings}")
    endforeach()
  else()  # Clang writes them beside its functions and operations.
    execute_process(COMMAND ${CXX} ${arguments} -S -emit-llvm -o - ${WORK}/options.cpp OUTPUT_VARIABLE effect ERROR_QUIET
                    COMMAND_ERROR_IS_FATAL ANY)
  endif()
  set(${result} "${effect}" PARENT_SCOPE)
endfunction()

file(WRITE ${WORK}/options.cpp "float f(float a, float b, float c) { return a * b / c + (a == b ? c : -c); }\n")
effect_of("" alone)
string(LENGTH "${alone}" length)
if(length LESS 500)
  message(FATAL_ERROR "${CXX} says too little of its options: ${alone}")
endif()
while(TRIALS)
  list(POP_FRONT TRIALS name flags)
  effect_of("${flags}" behind)
  if(NOT behind STREQUAL alone)
    file(WRITE ${WORK}/options_alone.txt "${alone}")
    file(WRITE ${WORK}/options_${name}.txt "${behind}")
    message(SEND_ERROR "${flags} reaches the library: compare options_alone.txt and options_${name}.txt in ${WORK}")
  endif()
endwhile()
