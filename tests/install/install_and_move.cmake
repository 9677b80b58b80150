# Installs the build in BUILD_DIR into FIRST_PREFIX and moves that to PREFIX.
file(REMOVE_RECURSE "${FIRST_PREFIX}" "${PREFIX}")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${FIRST_PREFIX}"
                        COMMAND_ERROR_IS_FATAL ANY)
file(RENAME "${FIRST_PREFIX}" "${PREFIX}")
