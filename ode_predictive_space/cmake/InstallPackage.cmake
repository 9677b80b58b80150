# The prefix can be moved. The components are those of the packages in packaging/debian.

include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/ode_predictive_space")

function(install_part target component development export)
    if(ODE_IS_SHARED)
        install(
            TARGETS ${target}
            EXPORT ${export}
            LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT ${component} NAMELINK_COMPONENT ${development})
    endif()
    if(ODE_PREDICTIVE_SPACE_STATIC)
        install(
            TARGETS ${target}_static
            EXPORT ${export}
            ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT ${development})
    endif()
    install(
        EXPORT ${export}
        NAMESPACE ode_predictive_space::
        DESTINATION "${package_dir}"
        COMPONENT ${development})
endfunction()

# A program that uses the space alone needs nothing of the haptics part: neither its headers nor Eigen, which they include.
install_part(ode_predictive_space runtime development ode_predictive_space-targets)
set(without_recorder)
if(NOT UNIX)
    set(without_recorder PATTERN "history.h" EXCLUDE)
endif()
install(
    DIRECTORY "${PROJECT_SOURCE_DIR}/include/ode_predictive_space"
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
    COMPONENT development
    FILES_MATCHING
    ${without_recorder}
    PATTERN "predictive_space.h"
    PATTERN "predictive_space.hpp"
    PATTERN "history.h"
    PATTERN "haptics" EXCLUDE)
if(TARGET ode_predictive_space::haptics)
    install_part(ode_predictive_space_haptics haptics haptics_development ode_predictive_space-haptics-targets)
    install(
        DIRECTORY "${PROJECT_SOURCE_DIR}/include/ode_predictive_space/haptics"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/ode_predictive_space"
        COMPONENT haptics_development
        FILES_MATCHING
        PATTERN "*.h")
endif()
configure_package_config_file(
    "${CMAKE_CURRENT_LIST_DIR}/ode_predictive_space-config.cmake.in"
    "${CMAKE_CURRENT_BINARY_DIR}/ode_predictive_space-config.cmake"
    INSTALL_DESTINATION "${package_dir}"
    NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/ode_predictive_space-config-version.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(
    FILES "${CMAKE_CURRENT_BINARY_DIR}/ode_predictive_space-config.cmake"
          "${CMAKE_CURRENT_BINARY_DIR}/ode_predictive_space-config-version.cmake" "${CMAKE_CURRENT_LIST_DIR}/FindODE.cmake"
    DESTINATION "${package_dir}"
    COMPONENT development)

# pkg-config files find the prefix by this relative path, also after a move.
file(RELATIVE_PATH prefix_from_pkg_config "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
# Libraries for `pkg-config --static`, which programs link with the archives.
set(private_libraries "-lstdc++ -lm")
if(UNIX)
    string(APPEND private_libraries " -ldl")
endif()
set(private_haptics_libraries "-pthread")
if(ODE_PREDICTIVE_SPACE_HAS_SPNAV IN_LIST haptics_definitions)
    string(APPEND private_haptics_libraries " -lspnav")
endif()
function(install_pkg_config package component)
    configure_file("${CMAKE_CURRENT_FUNCTION_LIST_DIR}/${package}.pc.in" "${CMAKE_CURRENT_BINARY_DIR}/${package}.pc" @ONLY)
    install(
        FILES "${CMAKE_CURRENT_BINARY_DIR}/${package}.pc"
        DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig"
        COMPONENT ${component})
endfunction()
install_pkg_config(ode_predictive_space development)
if(TARGET ode_predictive_space::haptics)
    install_pkg_config(ode_predictive_space_haptics haptics_development)
endif()

install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT license)
