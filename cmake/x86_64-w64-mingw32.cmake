# Builds for 64-bit Windows with Clang and Debian's mingw-w64, and runs what it builds under Wine. Not with mingw's GCC: see
# include/vndf/lanes/compiler.h. Headers that are nothing but headers, xsimd and Boost, are this machine's.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER clang)
set(CMAKE_CXX_COMPILER clang++)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_C_COMPILER_TARGET x86_64-w64-mingw32)
set(CMAKE_CXX_COMPILER_TARGET x86_64-w64-mingw32)
# Clang does not see that 12-posix, as Debian names it, is a version of the C++ library.
file(GLOB runtime /usr/lib/gcc/x86_64-w64-mingw32/*-posix)
set(CMAKE_CXX_FLAGS_INIT
    "-stdlib++-isystem ${runtime}/include/c++ -isystem ${runtime}/include/c++/x86_64-w64-mingw32")
# Nothing that Wine would have to find.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -pthread -fuse-ld=lld -L${runtime}")
set(XSIMD_INCLUDE_DIR /usr/include)
set(Boost_INCLUDE_DIR /usr/include)
find_program(VNDF_WINE wine64 PATHS /usr/lib/wine)
set(CMAKE_CROSSCOMPILING_EMULATOR env WINEDEBUG=-all WINEPREFIX=${CMAKE_BINARY_DIR}/wine ${VNDF_WINE})
