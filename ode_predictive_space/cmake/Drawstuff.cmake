# Builds drawstuff, ODE's renderer, which Debian does not have, with patches for a pointer's callback and runs without a window.
# Defines ode_predictive_space_drawstuff and DRAWSTUFF_TEXTURES, a folder, or lists what is missing in DRAWSTUFF_MISSING.

find_package(OpenGL QUIET)
find_package(X11 QUIET)

set(drawstuff_patches "${PROJECT_SOURCE_DIR}/patches/drawstuff-headless.patch"
                      "${PROJECT_SOURCE_DIR}/patches/drawstuff-pointer.patch")
set(DRAWSTUFF_MISSING "")
if(NOT TARGET OpenGL::GL)
    list(APPEND DRAWSTUFF_MISSING "OpenGL")
endif()
if(NOT TARGET OpenGL::GLU)
    list(APPEND DRAWSTUFF_MISSING "GLU")
endif()
if(NOT TARGET X11::X11)
    list(APPEND DRAWSTUFF_MISSING "X11")
endif()
if(NOT EXISTS "${ODE_SOURCE_DIR}/drawstuff/src/x11.cpp")
    list(APPEND DRAWSTUFF_MISSING "drawstuff in ODE's source")
endif()
if(NOT ODE_PATCHES_FIT)
    list(APPEND DRAWSTUFF_MISSING "a patch of drawstuff for ODE ${ODE_VERSION}")
endif()
set(drawstuff_copy "${PROJECT_BINARY_DIR}/drawstuff")
set(DRAWSTUFF_TEXTURES "${drawstuff_copy}/drawstuff/textures")
if(DRAWSTUFF_MISSING OR TARGET ode_predictive_space_drawstuff)
    return()
endif()

set(drawstuff_sources "${drawstuff_copy}/drawstuff/src/drawstuff.cpp" "${drawstuff_copy}/drawstuff/src/x11.cpp")
add_custom_command(
    OUTPUT ${drawstuff_sources}
    COMMAND "${CMAKE_COMMAND}" -E rm -rf "${drawstuff_copy}"
    COMMAND "${CMAKE_COMMAND}" -E copy_directory "${ODE_SOURCE_DIR}/drawstuff" "${drawstuff_copy}/drawstuff"
    COMMAND "${CMAKE_COMMAND}" -E copy_directory "${ODE_SOURCE_DIR}/include/drawstuff"
            "${drawstuff_copy}/include/drawstuff"
    COMMAND "${CMAKE_COMMAND}" -E copy "${ODE_SOURCE_DIR}/configure.ac" "${drawstuff_copy}"
    # ODE's configure would write this file; the definitions below replace it.
    COMMAND "${CMAKE_COMMAND}" -E touch "${drawstuff_copy}/config.h"
    COMMAND "${PROJECT_SOURCE_DIR}/patches/apply" "${drawstuff_copy}" ${drawstuff_patches}
    DEPENDS ${drawstuff_patches} "${PROJECT_SOURCE_DIR}/patches/apply"
    COMMENT "Patching a copy of drawstuff"
    VERBATIM)

add_library(ode_predictive_space_drawstuff STATIC ${drawstuff_sources})
target_compile_definitions(
    ode_predictive_space_drawstuff
    PRIVATE HAVE_GETTIMEOFDAY=1 HAVE_SYS_TIME_H=1 HAVE_UNISTD_H=1
            "DEFAULT_PATH_TO_TEXTURES=\"${DRAWSTUFF_TEXTURES}\"")
target_include_directories(
    ode_predictive_space_drawstuff SYSTEM
    PUBLIC "${drawstuff_copy}/include"
    PRIVATE "${drawstuff_copy}" "${ODE_SOURCE_DIR}/ode/src")
target_compile_options(ode_predictive_space_drawstuff PRIVATE -w)
target_link_libraries(ode_predictive_space_drawstuff PUBLIC ODE::ODE OpenGL::GL OpenGL::GLU X11::X11)
