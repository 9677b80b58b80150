# Defines ODE::ODE, ODE_SOURCE_FOUND, and ODE_PATCHES_FIT, which is true for ODE's releases 0.16 to 0.16.6. The libraries need
# no source; the demo's window, ODE's demos, and the tests of the layout of ODE's classes do.
# ODE_SOURCE_DIR (of CMake or the environment) is its folder; `./run` puts the source into the default one.

# The target is global, so that a project around this one can use it, unless that has found ODE already. (CMake before 3.24
# takes GLOBAL in find_package() for a component.)
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
