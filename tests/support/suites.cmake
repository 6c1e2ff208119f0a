# Writes FILE, which tells CTest of every suite of a PROGRAM of GoogleTest (tests/CMakeLists.txt). The cases of a suite that
# are listed below it begin with a space.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} --gtest_list_tests ended with ${status}")
endif()
string(REGEX MATCHALL "\n[A-Za-z0-9_/]+\\." suites "\n${listed}")
set(cost "")
if(LABEL STREQUAL verify)
  set(cost " COST 4")  # the longest: before the others
endif()
set(text "")
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "[\n.]" "" suite "${suite}")
  string(APPEND text "add_test(${suite} \"${PROGRAM}\" --gtest_filter=${suite}.*)\n"
    "set_tests_properties(${suite} PROPERTIES LABELS ${LABEL} TIMEOUT 1500${cost})\n")
endforeach()
file(WRITE ${FILE} "${text}")
