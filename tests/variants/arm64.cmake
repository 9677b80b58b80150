# Cross build for arm64 with Debian's compiler, run by qemu. ODE, GoogleTest and Google Benchmark come from the folder
# ARM64_ROOT, and header-only packages from this machine.

set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES ARM64_ROOT)

set(arm64_libraries "${ARM64_ROOT}/usr/lib/aarch64-linux-gnu")
set(GTest_DIR "${arm64_libraries}/cmake/GTest")
set(benchmark_DIR "${arm64_libraries}/cmake/benchmark")
set(ODE_INCLUDE_DIR "${ARM64_ROOT}/usr/include")
set(ODE_LIBRARY "${arm64_libraries}/libode.so")

# The compiler brings the system's own libraries for arm64.
add_link_options("LINKER:-rpath-link,${arm64_libraries}")
set(CMAKE_CROSSCOMPILING_EMULATOR
    qemu-aarch64-static
    -L
    /usr/aarch64-linux-gnu
    -E
    "LD_LIBRARY_PATH=${arm64_libraries}")
