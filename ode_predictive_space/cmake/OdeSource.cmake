# The installed ODE, and the source of the very same version, where it is at hand.
#
# Defines ODE::ODE, ODE_SOURCE_FOUND and ODE_PATCHES_FIT, which is for ODE's releases 0.16 to 0.16.6. The libraries need no
# source. The demo's window and ODE's demos are built from it, and tests compare the layout of ODE's classes with it.
# ODE_SOURCE_DIR (a CMake variable or an environment variable) says where it is, and is empty to go without; `./run` puts the
# source where it is looked for by default.

# Also for a project that this one is a part of, unless it has found ODE by itself. (find_package() can do so from CMake 3.24 on;
# before, it takes GLOBAL for a component.)
if(TARGET ODE::ODE)
    find_package(ODE 0.15 REQUIRED)
else()
    find_package(ODE 0.15 REQUIRED)
    set_target_properties(ODE::ODE PROPERTIES IMPORTED_GLOBAL TRUE)
endif()

set(default_folder "${PROJECT_SOURCE_DIR}/build/ode-source/ode-${ODE_VERSION}")
if(DEFINED ENV{ODE_SOURCE_DIR})
    set(default_folder "$ENV{ODE_SOURCE_DIR}")
elseif(NOT EXISTS "${default_folder}")
    set(default_folder "")
endif()
set(ODE_SOURCE_DIR
    "${default_folder}"
    CACHE PATH "Top folder of ODE's source, in the version of the installed ODE; empty to go without")

set(ODE_SOURCE_FOUND FALSE)
set(ODE_PATCHES_FIT FALSE)
if(NOT ODE_SOURCE_DIR)
    if(PROJECT_IS_TOP_LEVEL)
        message(STATUS "Without ODE's source (ODE_SOURCE_DIR), the demo's window, ODE's own demos and tests that read the source are left out")
    endif()
    return()
endif()

if(NOT EXISTS "${ODE_SOURCE_DIR}/ode/src/collision_kernel.h" OR NOT EXISTS "${ODE_SOURCE_DIR}/configure.ac")
    message(FATAL_ERROR "There is no source of ODE in ODE_SOURCE_DIR (${ODE_SOURCE_DIR}). The libraries do not need it: "
                        "ODE_SOURCE_DIR may be empty.")
endif()
file(STRINGS "${ODE_SOURCE_DIR}/configure.ac" ODE_SOURCE_VERSION REGEX "^AC_INIT")
string(REGEX REPLACE "^AC_INIT\\(\\[?ODE\\]?, *\\[?([0-9.]+).*" "\\1" ODE_SOURCE_VERSION "${ODE_SOURCE_VERSION}")
if(NOT ODE_SOURCE_VERSION VERSION_EQUAL ODE_VERSION)
    message(FATAL_ERROR "The source of ODE in ODE_SOURCE_DIR (${ODE_SOURCE_DIR}) is version ${ODE_SOURCE_VERSION}, but "
                        "the installed headers (${ODE_INCLUDE_DIR}/ode) are version ${ODE_VERSION}.")
endif()
set(ODE_SOURCE_FOUND TRUE)
if(ODE_VERSION MATCHES "^0\\.16(\\.[1-6])?$")
    set(ODE_PATCHES_FIT TRUE)
endif()
