# The consumer is compiled without sanitizers, so it cannot link libraries compiled with them.
if(NOT CMAKE_BUILD_TYPE STREQUAL "Sanitize")
  find_program(BORESIGHT_PKG_CONFIG pkg-config REQUIRED)
  add_test(NAME installed_package COMMAND ${CMAKE_COMMAND}
    -D BUILD=${PROJECT_BINARY_DIR}
    -D SOURCE=${CMAKE_CURRENT_LIST_DIR}
    -D WORK=${PROJECT_BINARY_DIR}/consumer
    -D CXX=${CMAKE_CXX_COMPILER} -D PKG_CONFIG=${BORESIGHT_PKG_CONFIG}
    -D PYTHON=${BORESIGHT_INTERPRETER}
    -P ${CMAKE_CURRENT_LIST_DIR}/run.cmake)
  set_tests_properties(installed_package PROPERTIES TIMEOUT 300)
endif()
