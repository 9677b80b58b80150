# Finds the Open Dynamics Engine that is installed, with or without a CMake package of its own.
#
# Defines the imported target ODE::ODE and ODE_VERSION, ODE_INCLUDE_DIR, ODE_LIBRARY, and ODE_IS_SHARED. To have a static ODE, set
# ODE_LIBRARY to its archive.
# This file is installed beside the CMake package of ode_predictive_space, which uses it too.

find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
    pkg_check_modules(PC_ODE QUIET ode)
endif()

find_path(
    ODE_INCLUDE_DIR
    NAMES ode/ode.h
    HINTS ${PC_ODE_INCLUDEDIR} ${PC_ODE_INCLUDE_DIRS})
find_library(
    ODE_LIBRARY
    NAMES ode ode_double
    HINTS ${PC_ODE_LIBDIR} ${PC_ODE_LIBRARY_DIRS})
mark_as_advanced(ODE_INCLUDE_DIR ODE_LIBRARY)

if(ODE_INCLUDE_DIR AND EXISTS "${ODE_INCLUDE_DIR}/ode/version.h")
    file(STRINGS "${ODE_INCLUDE_DIR}/ode/version.h" ODE_VERSION REGEX "define +dODE_VERSION")
    string(REGEX REPLACE ".*\"([^\"]+)\".*" "\\1" ODE_VERSION "${ODE_VERSION}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
    ODE
    REQUIRED_VARS ODE_LIBRARY ODE_INCLUDE_DIR
    VERSION_VAR ODE_VERSION)

set(ODE_IS_SHARED TRUE)
if(ODE_LIBRARY MATCHES "\\${CMAKE_STATIC_LIBRARY_SUFFIX}$")
    set(ODE_IS_SHARED FALSE)
endif()

if(ODE_FOUND AND NOT TARGET ODE::ODE)
    add_library(ODE::ODE UNKNOWN IMPORTED)
    set_target_properties(ODE::ODE PROPERTIES IMPORTED_LOCATION "${ODE_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES
                                                                                 "${ODE_INCLUDE_DIR}")
    if(NOT ODE_IS_SHARED)
        # An archive does not name what it needs. Debian's needs libccd, which an ODE from its own source contains.
        find_package(Threads REQUIRED)
        find_library(ODE_CCD_LIBRARY ccd)
        mark_as_advanced(ODE_CCD_LIBRARY)
        set(ode_archive_needs Threads::Threads stdc++ m)
        if(ODE_CCD_LIBRARY)
            list(APPEND ode_archive_needs "${ODE_CCD_LIBRARY}")
        endif()
        set_target_properties(ODE::ODE PROPERTIES INTERFACE_LINK_LIBRARIES "${ode_archive_needs}")
    endif()
endif()
