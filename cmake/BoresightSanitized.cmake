# The libraries a second time, with sanitizers, for tests alone: what is tested has them; the tests, which
# take as long to compile as all the libraries, are compiled once. Nothing of it is part of `all`:
# `./dev test --sanitized` builds the target `sanitized_tests` and runs the tests of that label.
# Without the checks of every pointer's use that the address sanitizer makes as well: they take two fifths
# of the compile time. Without the compiler's guesses at uninitialised values, which the sanitizers' code
# leads astray.
set(boresight_sanitizers -fsanitize=address,undefined
  -fno-sanitize=null,alignment,object-size,vptr,pointer-overflow -fno-sanitize-recover=undefined)
set(boresight_sanitized_modules "")
add_custom_target(sanitized_tests)

# Objects and no archive: of a function that the tests' files have as well the first is linked, and that
# must be the one with sanitizers.
function(boresight_sanitized_module name)
  get_target_property(sources boresight_${name} SOURCES)
  add_library(sanitized_${name} OBJECT EXCLUDE_FROM_ALL ${sources})
  foreach(property INCLUDE_DIRECTORIES COMPILE_DEFINITIONS COMPILE_OPTIONS LINK_LIBRARIES)
    get_target_property(value boresight_${name} ${property})
    if(value)
      set_target_properties(sanitized_${name} PROPERTIES ${property} "${value}")
    endif()
  endforeach()
  target_include_directories(sanitized_${name} SYSTEM PRIVATE ${ARGN})
  # What the libraries allocate the tests free: by one and the same convention. Eigen would else align by
  # its own hand under the address sanitizer, whose memory is aligned as glibc's.
  target_compile_definitions(sanitized_${name} PRIVATE EIGEN_MALLOC_ALREADY_ALIGNED=1
    _GLIBCXX_ASSERTIONS)
  target_compile_options(sanitized_${name} PRIVATE
    -O1 -g1 -UNDEBUG ${boresight_sanitizers} -fno-omit-frame-pointer -Wno-maybe-uninitialized -Werror)
  boresight_precompiled_headers(sanitized_${name} sanitized_numerics)
  list(APPEND boresight_sanitized_modules ${name})
  set(boresight_sanitized_modules ${boresight_sanitized_modules} PARENT_SCOPE)
endfunction()

# boresight_sanitized_program(NAME OBJECT_LIBRARY): what the objects make, on the libraries with sanitizers.
function(boresight_sanitized_program name objects)
  list(TRANSFORM boresight_sanitized_modules REPLACE "(.+)" "$<TARGET_OBJECTS:sanitized_\\1>"
    OUTPUT_VARIABLE libraries)
  add_executable(${name} EXCLUDE_FROM_ALL ${libraries} $<TARGET_OBJECTS:${objects}>)
  set_target_properties(${name} PROPERTIES LINKER_LANGUAGE CXX)
  target_link_options(${name} PRIVATE ${boresight_sanitizers})
  target_link_libraries(${name} PRIVATE fmt::fmt Threads::Threads SUNDIALS::cvodes_static NLopt::nlopt
    ZLIB::ZLIB Nettle::nettle)
  add_dependencies(sanitized_tests ${name})
endfunction()
