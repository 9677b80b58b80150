# NOT RUN: this port has never been built.
# An overlay port: vcpkg install ode-predictive-space --overlay-ports=packaging/vcpkg
# It builds the sources that it lies in. ODE is static unless the triplet makes libraries shared: then there is no launcher.

get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)

vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS
        -DODE_SOURCE_DIR=
        -DODE_PREDICTIVE_SPACE_BUILD_TESTS=OFF
        -DODE_PREDICTIVE_SPACE_BUILD_DEMOS=OFF
        -DODE_PREDICTIVE_SPACE_HARDENING=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/ode_predictive_space PACKAGE_NAME ode_predictive_space)
vcpkg_fixup_pkgconfig()
if(EXISTS "${CURRENT_PACKAGES_DIR}/bin/ode-predictive")
    vcpkg_copy_tools(TOOL_NAMES ode-predictive ode-predictive-run ode-predictive-replay AUTO_CLEAN)
endif()

file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
