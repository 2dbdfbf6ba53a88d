# The tests of the program: what it prints and writes, and the documents that show it.
boresight_tests(app boresight::io fmt::fmt)
target_compile_definitions(tests_of_app PRIVATE BORESIGHT_PROGRAM="$<TARGET_FILE:boresight>")

function(boresight_python_test name script)
  add_test(NAME ${name} COMMAND ${BORESIGHT_INTERPRETER} -B ${CMAKE_CURRENT_SOURCE_DIR}/app/${script}
    $<TARGET_FILE:boresight> ${PROJECT_SOURCE_DIR} ${ARGN})
  set_tests_properties(${name} PROPERTIES TIMEOUT 1800)
endfunction()
boresight_python_test(case_file_doc case_file_doc_test.py)
boresight_python_test(case_form case_form_test.py)
boresight_python_test(structured_text structured_text_test.py)
# Whole campaigns and reports: minutes under sanitizers, which see the same code in test_app.
if(NOT CMAKE_BUILD_TYPE STREQUAL Sanitize)
  boresight_python_test(simulation_schema simulation_schema_test.py)
  boresight_python_test(benchmark_schema benchmark_schema_test.py)
  boresight_python_test(change change_test.py)
  boresight_python_test(readme readme_test.py)
  boresight_python_test(program program_test.py)
  boresight_python_test(reports reports_test.py)
  boresight_python_test(commission_schema commission_schema_test.py)
  boresight_python_test(commission_doc commission_doc_test.py)
  boresight_python_test(evaluate_doc evaluate_doc_test.py)
  boresight_python_test(user_docs user_docs_test.py)
  boresight_python_test(octave octave_test.py)
  boresight_python_test(export export_test.py)
  boresight_python_test(identification_doc identification_doc_test.py ${PROJECT_BINARY_DIR}/campaigns)
  if(TARGET boresight_mpi)
    boresight_python_test(montecarlo montecarlo_test.py $<TARGET_FILE:boresight_mpi>)
  elseif(BORESIGHT_MPI)
    boresight_python_test(montecarlo montecarlo_test.py $<TARGET_FILE:boresight>)
  else()
    boresight_python_test(montecarlo montecarlo_test.py)
  endif()
  # What the sliders of a report page compute, against the program.
  find_program(BORESIGHT_NODE node)
  if(BORESIGHT_NODE)
    add_executable(loop_settings ${CMAKE_CURRENT_LIST_DIR}/loop_settings.cpp)
    target_include_directories(loop_settings PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
    target_link_libraries(loop_settings PRIVATE boresight_app nlohmann_json::nlohmann_json
      boresight_warnings)
    add_test(NAME loop_analysis COMMAND ${BORESIGHT_NODE}
      ${CMAKE_CURRENT_LIST_DIR}/loop_analysis_test.mjs $<TARGET_FILE:loop_settings>
      ${PROJECT_SOURCE_DIR})
    set_tests_properties(loop_analysis PROPERTIES TIMEOUT 600)
  else()
    message(STATUS "The sliders of report pages are not tested: node is missing")
  endif()
  # Report pages in a browser, driven by what npm brings (./dev test does).
  find_program(BORESIGHT_CHROMIUM chromium)
  set(modules ${PROJECT_SOURCE_DIR}/web/node_modules)
  if(BORESIGHT_NODE AND BORESIGHT_CHROMIUM AND EXISTS ${modules}/playwright-core
      AND EXISTS ${modules}/plotly.js-basic-dist-min AND BORESIGHT_PLOTTING_LIBRARY)
    add_test(NAME page COMMAND ${BORESIGHT_NODE} ${CMAKE_CURRENT_LIST_DIR}/page_test.mjs
      $<TARGET_FILE:boresight> ${PROJECT_SOURCE_DIR} ${BORESIGHT_CHROMIUM}
      ${PROJECT_BINARY_DIR}/pages)
    set_tests_properties(page PROPERTIES TIMEOUT 1800)
  else()
    message(STATUS "Report pages are not tested: node, chromium or web/node_modules is missing")
  endif()
  # The longest begin first, as seconds one beside the other: else one of them ends alone.
  foreach(test_and_cost user_docs:900 page:600 reports:500 evaluate_doc:350 readme:220
      montecarlo:150 simulation_schema:100)
    string(REPLACE ":" ";" test_and_cost ${test_and_cost})
    list(GET test_and_cost 0 test)
    list(GET test_and_cost 1 cost)
    if(TEST ${test})
      set_tests_properties(${test} PROPERTIES COST ${cost})
    endif()
  endforeach()
endif()

# The Python module, where it is built.
if(TARGET boresight_python)
  add_test(NAME python COMMAND ${Python_EXECUTABLE} -B -m pytest -q -p no:cacheprovider
    ${CMAKE_CURRENT_SOURCE_DIR}/python)
  set_tests_properties(python PROPERTIES TIMEOUT 1800 ENVIRONMENT
    "BORESIGHT_MODULE_FOLDER=$<TARGET_FILE_DIR:boresight_python>;BORESIGHT_PROGRAM=$<TARGET_FILE:boresight>;BORESIGHT_SOURCE=${PROJECT_SOURCE_DIR}")
endif()
