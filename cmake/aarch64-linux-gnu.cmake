# Builds for 64-bit ARM with Debian's cross compiler, and runs what it builds under QEMU. xsimd is header-only: this
# machine's serves.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L /usr/aarch64-linux-gnu)
set(XSIMD_INCLUDE_DIR /usr/include)
