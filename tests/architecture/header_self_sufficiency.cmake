# Every public header once as the first line of a source file, so that none lives on what another
# happened to include before it.
file(GLOB_RECURSE headers CONFIGURE_DEPENDS
  ${PROJECT_SOURCE_DIR}/numerics/*.hpp ${PROJECT_SOURCE_DIR}/plant/*.hpp
  ${PROJECT_SOURCE_DIR}/identification/*.hpp ${PROJECT_SOURCE_DIR}/control/*.hpp
  ${PROJECT_SOURCE_DIR}/design/*.hpp ${PROJECT_SOURCE_DIR}/io/*.hpp)
set(sources "")
foreach(header IN LISTS headers)
  file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR} ${header})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  # Twice: an include guard is part of standing alone.
  file(CONFIGURE OUTPUT ${source} CONTENT
    "#include <boresight/${name}>\n#include <boresight/${name}>\n")
  list(APPEND sources ${source})
endforeach()

# Part of `all` only where asked for (the debug preset): it takes minutes, and header_includes_test.py checks
# all but functions, constants and types that are only declared in a second.
add_library(header_self_sufficiency OBJECT ${sources})
if(NOT BORESIGHT_CHECK_HEADERS)
  set_target_properties(header_self_sufficiency PROPERTIES EXCLUDE_FROM_ALL ON)
endif()
# Nothing here runs, and parsing is all that is asked.
target_compile_options(header_self_sufficiency PRIVATE -O0 -g0 -fno-sanitize=all -Werror)
target_link_libraries(header_self_sufficiency PRIVATE boresight::io boresight_warnings)
# Read once, where the preset has precompiled headers: most of the time went into these.
target_precompile_headers(header_self_sufficiency PRIVATE <Eigen/Core>
  <array> <complex> <cstdint> <functional> <limits> <map> <memory> <optional> <random> <span> <string>
  <string_view> <variant> <vector>)
