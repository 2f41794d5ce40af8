# The flags of everything that must give the same bits. A host's flags (CMAKE_CXX_FLAGS, its build type's,
# add_compile_options) come first on the command line, so that these have the last word. Each list is one SHELL: string:
# CMake drops a flag that repeats an earlier one, and would drop ours where a host has it first and then takes it back.
function(vndf_shell result)
  if(MSVC)
    list(TRANSFORM ARGN PREPEND /clang:)  # clang-cl's own names are Microsoft's
  endif()
  list(JOIN ARGN " " flags)
  set(${result} "SHELL:${flags}" PARENT_SCOPE)
endfunction()
if(CMAKE_CXX_COMPILER_ID STREQUAL MSVC)
  message(FATAL_ERROR "Microsoft's compiler has no flags for these instruction sets and for this arithmetic: build vndf "
                      "with clang-cl (-T ClangCL), which links to what Microsoft's compiler made.")
endif()

# Every operation is rounded by itself, as it is written. One by one: Clang warns of -fno-fast-math after -ffast-math.
set(vndf_exact -ffp-contract=off -fno-unsafe-math-optimizations -fno-associative-math -fno-reciprocal-math
    -fno-finite-math-only -fsigned-zeros)
vndf_shell(vndf_exact ${vndf_exact})
# Clang's -fno-unsafe-math-optimizations also keeps the order of traps, which nobody reads and which costs up to 9 %.
# Without -ftrapping-math before it, Clang 14 warns of taking that back.
vndf_shell(vndf_exact_clang -fno-approx-func -fdenormal-fp-math=ieee -ftrapping-math -fno-trapping-math)
set(vndf_exact "${vndf_exact}" "$<$<CXX_COMPILER_ID:GNU>:SHELL:-fno-fast-math -fno-single-precision-constant>"
    "$<$<CXX_COMPILER_ID:Clang,AppleClang>:${vndf_exact_clang}>")

# Code for any processor of its architecture, whatever -march=native and the like say; an instruction set's own flags come
# after it. The later -march wins. On x86 -mno-sse3 takes away every set above SSE2 that was asked for by name, the others
# what compilers use unasked.
set(vndf_architecture "")
set(vndf_any_processor "")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  set(vndf_architecture X86)
  set(vndf_any_processor -march=x86-64 -mtune=generic -mfpmath=sse -mno-sse3 -mno-bmi -mno-bmi2 -mno-lzcnt -mno-popcnt
      -mno-movbe -mno-tbm -mno-gfni)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64|ARM64)$")
  set(vndf_architecture ARM)
  set(vndf_any_processor -march=armv8-a -mcpu=generic)
endif()
vndf_shell(vndf_any_processor ${vndf_any_processor})

# Of a source file of the library. No link-time optimisation: an inline function of one instruction set could be inlined
# into, or kept for, another, and no other compiler could link the archive.
vndf_shell(vndf_warnings -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
vndf_shell(vndf_lean -fno-math-errno -fno-exceptions -fno-lto)
set(vndf_compile_options "${vndf_warnings}" ${vndf_exact} "${vndf_any_processor}" "${vndf_lean}")

# Kernels are fast in any host: one without a build type would have them 200 times slower.
option(VNDF_DEBUG_KERNELS "Compile the kernels with the build type's optimisation, to debug the library itself" OFF)
vndf_shell(vndf_kernel_options -O3)
set(vndf_kernel_options "$<$<NOT:$<BOOL:${VNDF_DEBUG_KERNELS}>>:${vndf_kernel_options}>")

# An object of the library, in a unity or an IPO build too. Its symbols are its own: two plugins may carry two versions.
function(vndf_library_target target)
  target_compile_options(${target} PRIVATE ${vndf_compile_options})
  target_compile_definitions(${target} PRIVATE $<$<BOOL:${BUILD_SHARED_LIBS}>:VNDF_SHARED>)
  set_target_properties(${target} PROPERTIES
    POSITION_INDEPENDENT_CODE ON INTERPROCEDURAL_OPTIMIZATION OFF UNITY_BUILD OFF
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON WINDOWS_EXPORT_ALL_SYMBOLS ON)
endfunction()
