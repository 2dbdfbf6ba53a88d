# Fails if a module includes one that stands after it in plant -> identification -> control ->
# design -> app -> python, if a library reads files of the user (formats are the business of app), if
# anything but python knows Python, or if an example uses more than the installed libraries.
#   cmake -D ROOT=<source tree> -P module_order.cmake
cmake_minimum_required(VERSION 3.25)
set(modules plant identification control design app python)
set(libraries plant identification control design)
set(formats "toml\\+\\+/|CLI/|nlohmann/")
set(scripting "pybind11/")

set(offences "")

# check(FOLDER FORBIDDEN QUOTED): FORBIDDEN is a pattern behind the opening < or "; QUOTED whether
# neighbours may be included by quotes.
function(check folder forbidden quoted)
  file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/${folder}/*.hpp ${ROOT}/${folder}/*.cpp)
  foreach(file IN LISTS files)
    file(STRINGS ${ROOT}/${file} includes REGEX "^[ \t]*#[ \t]*include")
    foreach(line IN LISTS includes)
      if(forbidden AND line MATCHES "[<\"](${forbidden})")
        list(APPEND offences "${file}: ${line}")
      elseif(line MATCHES "\"" AND NOT quoted)
        # A quoted include finds a neighbour in the tree, but not once installed.
        list(APPEND offences "${file}: ${line}")
      endif()
    endforeach()
  endforeach()
  set(offences "${offences}" PARENT_SCOPE)
endfunction()

set(later ${modules})
foreach(module IN LISTS modules)
  list(REMOVE_ITEM later ${module})
  set(forbidden "")
  if(later)
    list(JOIN later "|" names)
    set(forbidden "boresight/(${names})/|${scripting}")
  endif()
  if(module IN_LIST libraries)
    string(APPEND forbidden "|${formats}")
  endif()
  check(${module} "${forbidden}" FALSE)
endforeach()
check(examples "boresight/(app|python)/|${formats}|${scripting}" TRUE)

if(offences)
  list(LENGTH offences count)
  list(JOIN offences "\n  " text)
  message(FATAL_ERROR "${count} includes against the order of the modules:\n  ${text}")
endif()
