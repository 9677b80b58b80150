# Finds the installed Open Dynamics Engine, with or without a CMake package. This project's CMake package uses this file, too.
# Defines the imported target ODE::ODE, and ODE_VERSION, ODE_INCLUDE_DIR, ODE_LIBRARY, ODE_IS_SHARED and ODE_PKG_CONFIG_NAME.
# For a static ODE, set ODE_LIBRARY to its archive. Some distributions have an ODE for each precision: the first module of
# ODE_PKG_CONFIG_NAMES that pkg-config finds counts.

if(NOT ODE_PKG_CONFIG_NAMES)
    set(ODE_PKG_CONFIG_NAMES ode ode-double)
endif()
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
    pkg_search_module(PC_ODE QUIET ${ODE_PKG_CONFIG_NAMES})
endif()
set(ODE_PKG_CONFIG_NAME ode)
if(PC_ODE_MODULE_NAME)
    set(ODE_PKG_CONFIG_NAME ${PC_ODE_MODULE_NAME})
endif()

find_path(
    ODE_INCLUDE_DIR
    NAMES ode/ode.h
    HINTS ${PC_ODE_INCLUDEDIR} ${PC_ODE_INCLUDE_DIRS})
find_library(
    ODE_LIBRARY
    # The last two names are those of a static ODE for Windows.
    NAMES ${PC_ODE_LIBRARIES} ode ode_double ode-double ode_doubles ode_singles NAMES_PER_DIR
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
    # Headers that serve both precisions expect a definition, which pkg-config has for the library that it describes.
    get_filename_component(ode_library_dir "${ODE_LIBRARY}" DIRECTORY)
    get_filename_component(ode_library_dir "${ode_library_dir}" REALPATH)
    get_filename_component(ode_described_dir "${PC_ODE_LIBDIR}" REALPATH)
    if(PC_ODE_FOUND AND ode_library_dir STREQUAL ode_described_dir)
        set(ode_precision ${PC_ODE_CFLAGS_OTHER})
        list(FILTER ode_precision INCLUDE REGEX "^-Dd(IDE)?(SINGLE|DOUBLE)$")
        list(TRANSFORM ode_precision REPLACE "^-D" "")
        set_target_properties(ODE::ODE PROPERTIES INTERFACE_COMPILE_DEFINITIONS "${ode_precision}")
    endif()
    if(NOT ODE_IS_SHARED)
        # An archive does not name the libraries that it needs. Debian's needs libccd; one built from ODE's source contains it.
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
