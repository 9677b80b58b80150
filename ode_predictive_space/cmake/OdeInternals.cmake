# The installed ODE, and the internal headers of the very same version, which only ODE's source package has.
#
# Defines ODE::ODE and ode_predictive_space_ode_internals. ODE_SOURCE_DIR (a CMake variable or an environment variable)
# says where ODE's source is; `./run` puts it where it is looked for by default.

find_package(ODE 0.15 REQUIRED GLOBAL)

if(DEFINED ENV{ODE_SOURCE_DIR})
    set(ODE_SOURCE_DIR_DEFAULT "$ENV{ODE_SOURCE_DIR}")
else()
    set(ODE_SOURCE_DIR_DEFAULT "${PROJECT_SOURCE_DIR}/build/ode-source/ode-${ODE_VERSION}")
endif()
set(ODE_SOURCE_DIR
    "${ODE_SOURCE_DIR_DEFAULT}"
    CACHE PATH "Top folder of ODE's source, in the version of the installed ODE")

set(ODE_SOURCE_ADVICE
    "The predictive space derives from a class that ODE declares only in its source package. Either run "
    "`./run build`, which fetches the source that matches the installed ODE ${ODE_VERSION} (Debian and its relatives), "
    "or unpack that source yourself and pass -DODE_SOURCE_DIR=<its top folder> to CMake.")
string(CONCAT ODE_SOURCE_ADVICE ${ODE_SOURCE_ADVICE})

if(NOT EXISTS "${ODE_SOURCE_DIR}/ode/src/collision_kernel.h" OR NOT EXISTS "${ODE_SOURCE_DIR}/configure.ac")
    message(FATAL_ERROR "There is no source of ODE in ODE_SOURCE_DIR (${ODE_SOURCE_DIR}).\n${ODE_SOURCE_ADVICE}")
endif()

file(STRINGS "${ODE_SOURCE_DIR}/configure.ac" ODE_SOURCE_VERSION REGEX "^AC_INIT")
string(REGEX REPLACE "^AC_INIT\\(\\[?ODE\\]?, *\\[?([0-9.]+).*" "\\1" ODE_SOURCE_VERSION "${ODE_SOURCE_VERSION}")
if(NOT ODE_SOURCE_VERSION VERSION_EQUAL ODE_VERSION)
    message(FATAL_ERROR "The source of ODE in ODE_SOURCE_DIR (${ODE_SOURCE_DIR}) is version ${ODE_SOURCE_VERSION}, but "
                        "the installed headers (${ODE_INCLUDE_DIR}/ode) are version ${ODE_VERSION}.\n"
                        "${ODE_SOURCE_ADVICE}")
endif()

add_library(ode_predictive_space_ode_internals INTERFACE)
target_include_directories(ode_predictive_space_ode_internals SYSTEM INTERFACE "${ODE_SOURCE_DIR}/ode/src")
target_link_libraries(ode_predictive_space_ode_internals INTERFACE ODE::ODE)
