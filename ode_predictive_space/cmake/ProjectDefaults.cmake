set(ODE_PREDICTIVE_SPACE_SANITIZERS
    ""
    CACHE STRING "Sanitizers to build with, separated by commas (address,undefined or thread)")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    if(PROJECT_IS_TOP_LEVEL)
        set(CMAKE_BUILD_TYPE
            Release
            CACHE STRING "Build type" FORCE)
    else()
        message(WARNING "Without CMAKE_BUILD_TYPE, ode_predictive_space is compiled without optimisation and is several times "
                        "as slow. Its figures were measured with -DCMAKE_BUILD_TYPE=Release.")
    endif()
endif()

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_C_VISIBILITY_PRESET hidden)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

# Absolute run paths would leave the length of the build folder's path in the libraries, also in installed ones. Builds with
# sanitizers keep them: they are not installed, and their tests run copies of programs in other folders.
if(PROJECT_IS_TOP_LEVEL AND NOT ODE_PREDICTIVE_SPACE_SANITIZERS)
    set(CMAKE_BUILD_RPATH_USE_ORIGIN ON)
endif()

# A fused multiplication and addition rounds once, not twice: without this, results would depend on the processor.
add_compile_options(-ffp-contract=off)

add_compile_options(-Wall -Wextra)
if(ODE_PREDICTIVE_SPACE_WARNINGS_AS_ERRORS)
    add_compile_options(-Werror)
endif()

if(ODE_PREDICTIVE_SPACE_SANITIZERS)
    add_compile_options(-fsanitize=${ODE_PREDICTIVE_SPACE_SANITIZERS} -fno-sanitize-recover=all
                        -fno-omit-frame-pointer)
    add_link_options(-fsanitize=${ODE_PREDICTIVE_SPACE_SANITIZERS})
    # A driver's functions are called through declarations of this project, not through those of the driver's header.
    if(CMAKE_CXX_COMPILER_ID MATCHES Clang AND ODE_PREDICTIVE_SPACE_SANITIZERS MATCHES "undefined")
        add_compile_options(-fno-sanitize=function)
    endif()
    # A preloaded library brings the sanitizer into programs that have none; Clang would leave it to the programs.
    if(CMAKE_CXX_COMPILER_ID MATCHES Clang AND ODE_PREDICTIVE_SPACE_SANITIZERS STREQUAL "address,undefined")
        execute_process(
            COMMAND "${CMAKE_CXX_COMPILER}" "-print-file-name=libclang_rt.asan-${CMAKE_SYSTEM_PROCESSOR}.so"
            OUTPUT_VARIABLE asan_library
            OUTPUT_STRIP_TRAILING_WHITESPACE)
        get_filename_component(asan_folder "${asan_library}" DIRECTORY)
        add_link_options(-shared-libsan "LINKER:-rpath,${asan_folder}")
    endif()
endif()

# Unless functions begin at cache lines, any line of the source changes the time of a tick of a small scene by up to 15 %; calls
# across files cost another 2 to 6 %. A package with its own flags switches both options off.
option(ODE_PREDICTIVE_SPACE_ALIGN_FUNCTIONS "Begin functions of the space with cache lines" ON)
function(ode_predictive_space_align)
    if(NOT ODE_PREDICTIVE_SPACE_ALIGN_FUNCTIONS)
        return()
    endif()
    foreach(target ${ARGN})
        target_compile_options(${target} PRIVATE "$<$<CONFIG:Release>:-falign-functions=64>")
        target_link_options(${target} PRIVATE "$<$<CONFIG:Release>:-falign-functions=64>")
    endforeach()
endfunction()

option(ODE_PREDICTIVE_SPACE_LTO "Optimise the space across files" ON)
function(ode_predictive_space_optimize_across_files)
    if(NOT ODE_PREDICTIVE_SPACE_LTO)
        return()
    endif()
    include(CheckIPOSupported)
    check_ipo_supported(RESULT is_supported LANGUAGES CXX)
    set_target_properties(${ARGN} PROPERTIES INTERPROCEDURAL_OPTIMIZATION_RELEASE ${is_supported})
endfunction()

# Sanitizers have their own checks. docs/reliability.md gives the cost. A package with its own flags switches hardening off.
option(ODE_PREDICTIVE_SPACE_HARDENING "Harden the libraries of a release build" ON)
function(ode_predictive_space_harden)
    if(NOT ODE_PREDICTIVE_SPACE_HARDENING OR ODE_PREDICTIVE_SPACE_SANITIZERS OR NOT UNIX)
        return()
    endif()
    foreach(target ${ARGN})
        target_compile_options(
            ${target} PRIVATE "$<$<CONFIG:Release>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2;-fstack-protector-strong>")
        get_target_property(type ${target} TYPE)
        if(NOT type STREQUAL STATIC_LIBRARY)
            target_link_options(${target} PRIVATE "$<$<CONFIG:Release>:LINKER:-z,relro,-z,now>")
        endif()
    endforeach()
endfunction()

# Looks for a package that the libraries do not need, and says which parts are left out without it.
macro(ode_predictive_space_look_for package debian_name left_out)
    find_package(${package} QUIET)
    if(NOT ${package}_FOUND)
        message(STATUS "${package} (Debian's ${debian_name}) is missing: ${left_out} left out")
    endif()
endmacro()

# A project around this one decides how its compilers are called.
if(PROJECT_IS_TOP_LEVEL)
    find_program(CCACHE_PROGRAM ccache)
    mark_as_advanced(CCACHE_PROGRAM)
endif()
if(PROJECT_IS_TOP_LEVEL AND CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    # With these settings, ccache stores files that are compiled with precompiled headers, and serves other clones.
    set(launcher
        "${CMAKE_COMMAND}" -E env CCACHE_SLOPPINESS=pch_defines,time_macros "CCACHE_BASEDIR=${CMAKE_SOURCE_DIR}"
        CCACHE_NOHASHDIR=1 "${CCACHE_PROGRAM}")
    set(CMAKE_C_COMPILER_LAUNCHER ${launcher})
    set(CMAKE_CXX_COMPILER_LAUNCHER ${launcher})
endif()

# Eigen has 130,000 of the 140,000 lines that most files read. Files still include what they need, so that all builds work with
# -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON.
function(ode_predictive_space_precompile target)
    target_precompile_headers(${target} PRIVATE ${ARGN})
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
        target_compile_options(${target} PRIVATE -fpch-preprocess) # ccache requires it
    endif()
endfunction()

# Reuses the headers of another target that is compiled with the same options. Newer CMake warns if there are none.
function(ode_predictive_space_reuse_precompiled target from)
    if(CMAKE_DISABLE_PRECOMPILE_HEADERS)
        return()
    endif()
    target_precompile_headers(${target} REUSE_FROM ${from})
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
        target_compile_options(${target} PRIVATE -fpch-preprocess)
    endif()
endfunction()
