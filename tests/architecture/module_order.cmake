# Fails if a module includes one that stands after it in plant -> identification -> control ->
# design -> app, or if a library reads files of the user: formats are the business of app.
#   cmake -D ROOT=<source tree> -P module_order.cmake
set(modules plant identification control design app)
set(formats "toml\\+\\+/|CLI/|nlohmann/")

set(offences "")
set(later ${modules})
foreach(module IN LISTS modules)
  list(REMOVE_ITEM later ${module})
  set(forbidden "")
  if(later)
    list(JOIN later "|" names)
    set(forbidden "[<\"](boresight/(${names})/|${formats})")
  endif()

  file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/${module}/*.hpp ${ROOT}/${module}/*.cpp)
  foreach(file IN LISTS files)
    file(STRINGS ${ROOT}/${file} includes REGEX "^[ \t]*#[ \t]*include")
    foreach(line IN LISTS includes)
      if(forbidden AND line MATCHES "${forbidden}")
        list(APPEND offences "${file}: ${line}")
      elseif(line MATCHES "\"")
        # A quoted include finds a neighbour in the tree, but not once installed.
        list(APPEND offences "${file}: ${line}")
      endif()
    endforeach()
  endforeach()
endforeach()

if(offences)
  list(LENGTH offences count)
  list(JOIN offences "\n  " text)
  message(FATAL_ERROR "${count} includes against the order of the modules:\n  ${text}")
endif()
