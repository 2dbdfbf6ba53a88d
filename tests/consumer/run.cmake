# Installs the build tree under a prefix of its own, then configures, builds and runs the consumer
# against that prefix only.
#   cmake -D BUILD=<build tree> -D SOURCE=<consumer> -D WORK=<folder> -D CXX=<compiler> -P run.cmake
set(prefix ${WORK}/prefix)
set(build ${WORK}/build)

# A file left by an earlier install would hide that it is no longer installed.
file(REMOVE_RECURSE ${prefix} ${build})

execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix}
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -G Ninja -S ${SOURCE} -B ${build}
  -D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_COMPILER=${CXX} -D CMAKE_PREFIX_PATH=${prefix}
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${build} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${build}/consumer COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${prefix}/bin/boresight --version COMMAND_ERROR_IS_FATAL ANY)
