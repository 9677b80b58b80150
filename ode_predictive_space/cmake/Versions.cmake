# This version is in the SONAMEs and in the nodes of the symbols. Below 1.0, each minor version has its own binary interface.

set(ODE_PREDICTIVE_SPACE_INTERFACE ${PROJECT_VERSION_MAJOR})
if(PROJECT_VERSION_MAJOR EQUAL 0)
    set(ODE_PREDICTIVE_SPACE_INTERFACE 0.${PROJECT_VERSION_MINOR})
endif()

# The public header has the version as a number, for programs that are compiled with the sources and without this file.
math(EXPR version_number "${PROJECT_VERSION_MAJOR} * 10000 + ${PROJECT_VERSION_MINOR} * 100 + ${PROJECT_VERSION_PATCH}")
set(public_header "${PROJECT_SOURCE_DIR}/include/ode_predictive_space/predictive_space.h")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${public_header}")
file(STRINGS "${public_header}" version_line REGEX "^#define ODE_PREDICTIVE_SPACE_VERSION ")
if(NOT version_line STREQUAL "#define ODE_PREDICTIVE_SPACE_VERSION ${version_number}")
    message(FATAL_ERROR "Version ${PROJECT_VERSION} of the project is ${version_number} in ${public_header}, which has instead: "
                        "${version_line}")
endif()
