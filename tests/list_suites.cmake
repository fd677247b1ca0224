# Writes a CTest file with one test for every suite of a GoogleTest program. A process for every
# single test costs more, in loading libraries, than most tests do.
#   cmake -DPROGRAM=… -DPREFIX=… -DTIMEOUT=… -DOUTPUT=… -P list_suites.cmake

execute_process(COMMAND "${PROGRAM}" --gtest_list_tests
  OUTPUT_VARIABLE listing COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "[[;]" "." listing "${listing}") # they mean something to CMake's lists
string(REPLACE "\n" ";" lines "${listing}")
# CTest takes this for skipped whatever the program returned: nothing passed, and the rest of what is
# printed lists what was skipped, and nothing that failed.
set(all_skipped "\\[  PASSED  \\] 0 tests\\..(\\[  SKIPPED \\][^[]*)+$")
set(script "")
foreach(line IN LISTS lines)
  # A suite: its name, a point, for typed ones a remark. Tests are indented.
  if(line MATCHES "^([^ ]+)\\.( .*)?$")
    set(suite "${CMAKE_MATCH_1}")
    string(APPEND script
      "add_test([==[${PREFIX}.${suite}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${suite}.*]==])\n"
      "set_tests_properties([==[${PREFIX}.${suite}]==] PROPERTIES TIMEOUT ${TIMEOUT}"
      " LABELS ${PREFIX} SKIP_REGULAR_EXPRESSION [==[${all_skipped}]==])\n")
  endif()
endforeach()
file(WRITE "${OUTPUT}" "${script}")
