# What `cmake --install` puts into the prefix: headers, libraries, CMake package, pkg-config files. All of it can be moved.
# The components are the packages of packaging/CMakeLists.txt.

include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/ode_predictive_space")

install(
    TARGETS ode_predictive_space
    EXPORT ode_predictive_space-targets
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT runtime NAMELINK_COMPONENT development)
install(
    TARGETS ode_predictive_space_haptics
    EXPORT ode_predictive_space-targets
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT haptics NAMELINK_COMPONENT development)
if(ODE_PREDICTIVE_SPACE_STATIC)
    install(
        TARGETS ode_predictive_space_static ode_predictive_space_haptics_static
        EXPORT ode_predictive_space-targets
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development)
endif()
install(
    DIRECTORY "${PROJECT_SOURCE_DIR}/include/ode_predictive_space"
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
    COMPONENT development
    FILES_MATCHING
    PATTERN "*.h"
    PATTERN "*.hpp")

install(
    EXPORT ode_predictive_space-targets
    NAMESPACE ode_predictive_space::
    DESTINATION "${package_dir}"
    COMPONENT development)
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

# From the folder of the pkg-config files to the prefix.
file(RELATIVE_PATH prefix_from_pkg_config "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
# For `pkg-config --static`: what the archives have to be linked with.
get_target_property(has_spnav ode_predictive_space_haptics HAS_SPNAV)
set(private_libraries "-lstdc++ -lm -ldl")
set(private_haptics_libraries "-pthread")
if(has_spnav)
    string(APPEND private_haptics_libraries " -lspnav")
endif()
foreach(package ode_predictive_space ode_predictive_space_haptics)
    configure_file("${CMAKE_CURRENT_LIST_DIR}/${package}.pc.in" "${CMAKE_CURRENT_BINARY_DIR}/${package}.pc" @ONLY)
    install(
        FILES "${CMAKE_CURRENT_BINARY_DIR}/${package}.pc"
        DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig"
        COMPONENT development)
endforeach()

install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT license)
