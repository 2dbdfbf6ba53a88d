# What is installed beside the libraries and the program, and the Debian packages that CPack makes of
# it: `boresight` (program, cases, documents), `libboresight-dev` (libraries, headers, examples) and,
# with BORESIGHT_PYTHON, `python3-boresight`. See docs/packaging.md.

# All libraries are static: who links one links what it rests on, so nothing is private.
file(RELATIVE_PATH prefix_from_pkgconfig
  /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" prefix_from_pkgconfig "${prefix_from_pkgconfig}")
configure_file(cmake/boresight.pc.in ${PROJECT_BINARY_DIR}/boresight.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/boresight.pc
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
install(DIRECTORY examples/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libboresight-dev/examples
  COMPONENT development PATTERN "*.py" EXCLUDE)

set(documents ${CMAKE_INSTALL_DATADIR}/doc/boresight)
install(DIRECTORY cases DESTINATION ${CMAKE_INSTALL_DATADIR}/boresight COMPONENT program)
# As in the source tree, so that links lead somewhere.
install(DIRECTORY docs DESTINATION ${documents} COMPONENT program
  PATTERN "*.py" EXCLUDE PATTERN Doxyfile EXCLUDE)
install(FILES README.md CHANGELOG.md CONTRIBUTING.md CITATION.cff
  DESTINATION ${documents} COMPONENT program)
install(FILES LICENSE DESTINATION ${documents} COMPONENT program RENAME copyright)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libboresight-dev
  COMPONENT development RENAME copyright)
# The licences of what is linked statically or comes in by headers go with the binaries. Debian has
# each where its package documents itself.
foreach(package libsundials-dev libeigen3-dev libboost-dev libcli11-dev libtomlplusplus-dev
    nlohmann-json3-dev)
  set(licence /usr/share/doc/${package}/copyright)
  if(EXISTS ${licence})
    install(FILES ${licence} DESTINATION ${documents}/licences COMPONENT program RENAME ${package})
  endif()
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
# Each package's description begins with its own summary.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(CPACK_PACKAGE_CONTACT "Boresight developers <developers@boresight.invalid>")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME boresight)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "${PROJECT_DESCRIPTION}
From a case file and recorded tests it identifies the inertia that the motors drive, builds the
plant, tunes rate and position loops, and says what pointing error is left in wind and what changes
of the drive would buy. With four worked cases, among them the 70-m and 64-m antennas of the Deep Space Network.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libboresight-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libeigen3-dev (>= 3.4), libfmt-dev (>= 9), libnlopt-dev (>= 2.7), libsundials-dev (>= 6.4), zlib1g-dev, nettle-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Servo design of large antennas: libraries and headers
Static libraries for C++20: numerics, plant, identification, control, design and io, with a CMake
package, a pkg-config file and examples.")

if(TARGET boresight_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-boresight
    COMPONENT python RENAME copyright)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-boresight)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3-numpy, \
python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), python3 (<< ${Python_VERSION_MAJOR}.${next})")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Servo design of large antennas: Python module
Cases, identification, plant, tuning, inertia matching and simulated tests with numpy arrays.")
endif()

include(CPack)
