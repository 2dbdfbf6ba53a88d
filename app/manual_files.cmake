# The manual page and the shells' completions, written by the program itself:
#   cmake -D PROGRAM=... -D FOLDER=... -P manual_files.cmake
file(MAKE_DIRECTORY ${FOLDER})
function(keep file)
  execute_process(COMMAND ${PROGRAM} ${ARGN} OUTPUT_FILE ${FOLDER}/${file} RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "boresight ${ARGN} ended with ${failed}")
  endif()
endfunction()
keep(boresight.1 man)
keep(boresight completion bash)
keep(_boresight completion zsh)
keep(boresight.fish completion fish)
