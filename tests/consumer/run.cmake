# Installs the build tree under a prefix of its own, then builds and runs against that prefix only:
# the consumer, found by CMake and found by pkg-config; the installed examples; the program.
#   cmake -D BUILD=<build tree> -D SOURCE=<consumer> -D WORK=<folder> -D CXX=<compiler>
#         -D PKG_CONFIG=<pkg-config> -D PYTHON=<python3> -P run.cmake
set(prefix ${WORK}/prefix)
set(build ${WORK}/build)

# A file left by an earlier install would hide that it is no longer installed.
file(REMOVE_RECURSE ${prefix} ${build} ${build}-examples)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix}
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE} -B ${build}
  -D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_COMPILER=${CXX} -D CMAKE_PREFIX_PATH=${prefix})
run(${CMAKE_COMMAND} --build ${build})
set(case ${prefix}/share/boresight/cases/dss14-70m/case.toml)
run(${build}/consumer ${case})

file(GLOB_RECURSE description ${prefix}/*/boresight.pc)
get_filename_component(folder "${description}" DIRECTORY)
set(ENV{PKG_CONFIG_PATH} ${folder})
execute_process(COMMAND ${PKG_CONFIG} --cflags --libs boresight
  OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags UNIX_COMMAND "${flags}")
run(${CXX} -std=c++20 ${SOURCE}/main.cpp -o ${build}/by_pkg_config ${flags})
run(${build}/by_pkg_config ${case})

run(${CMAKE_COMMAND} -G Ninja -S ${prefix}/share/doc/libboresight-dev/examples -B ${build}-examples
  -D CMAKE_BUILD_TYPE=Debug -D CMAKE_CXX_COMPILER=${CXX} -D CMAKE_PREFIX_PATH=${prefix})
run(${CMAKE_COMMAND} --build ${build}-examples)
run(${PYTHON} -B ${SOURCE}/../examples/examples_test.py ${build}-examples)

run(${prefix}/bin/boresight --version)
run(${prefix}/bin/boresight audit ${case})
foreach(document README.md copyright docs/README.md docs/case-file.md)
  if(NOT EXISTS ${prefix}/share/doc/boresight/${document})
    message(FATAL_ERROR "${document} is not installed")
  endif()
endforeach()
foreach(file man/man1/boresight.1 bash-completion/completions/boresight
    zsh/site-functions/_boresight fish/vendor_completions.d/boresight.fish)
  if(NOT EXISTS ${prefix}/share/${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()
