# Whole builds in a fraction of the time: files of a target are compiled several at once
# (source_batches.py says which), so that what they include is read and instantiated once a batch. Costs a
# developer who edits one file the others of its batch; -D BORESIGHT_UNITY=OFF compiles each alone, as the
# debug preset does. boresight_unity_build(TARGET [LARGEST]): at most so many files in one. Where nearly all
# the time goes into reading headers, 40 take a fifth less than 20; where matrix code is optimised, none.
function(boresight_unity_build target)
  set(largest 20)
  if(ARGC GREATER 1)
    set(largest ${ARGV1})
  endif()
  if(NOT BORESIGHT_UNITY)
    return()
  endif()
  find_program(BORESIGHT_BATCH_INTERPRETER python3 HINTS /usr/bin REQUIRED)
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  list(TRANSFORM sources PREPEND ${folder}/ REGEX "^[^/]")
  set(alone "")
  foreach(source IN LISTS sources)
    get_source_file_property(kept_out ${source} SKIP_UNITY_BUILD_INCLUSION)
    if(kept_out)
      list(APPEND alone ${source})
    endif()
  endforeach()
  list(REMOVE_ITEM sources ${alone} "")
  execute_process(
    COMMAND ${BORESIGHT_BATCH_INTERPRETER} -B ${PROJECT_SOURCE_DIR}/cmake/source_batches.py
      ${PROJECT_BINARY_DIR}/batches/${target} ${largest} ${sources}
    OUTPUT_VARIABLE batches OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" batches "${batches}")
  set_source_files_properties(${sources} PROPERTIES HEADER_FILE_ONLY ON)
  target_sources(${target} PRIVATE ${batches})
  # GCC calls a type of an unnamed namespace a header's where it stands in a file that a batch includes.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  # An edit can make names clash.
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
    ${sources} ${PROJECT_SOURCE_DIR}/cmake/source_batches.py)
endfunction()
