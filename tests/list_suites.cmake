# Writes a CTest file with one test per suite of a GoogleTest program. With one process per test,
# loading libraries would take longer than most tests.
#   cmake -DPROGRAM=… -DPREFIX=… -DTIMEOUT=… -DDRAWING=… -DOUTPUT=… -P list_suites.cmake
# The tests whose names match DRAWING, unless it is empty, run without a search for leaks.

execute_process(COMMAND "${PROGRAM}" --gtest_list_tests
  OUTPUT_VARIABLE listing COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "[[;]" "." listing "${listing}") # special characters in CMake lists
string(REPLACE "\n" ";" lines "${listing}")
# CTest counts a test as skipped if its output matches, whatever the exit status: no test passed, and
# the rest of the output lists only skipped tests, no failed ones.
set(all_skipped "\\[  PASSED  \\] 0 tests\\..(\\[  SKIPPED \\][^[]*)+$")
# Suites that take minutes start early, so that they do not run alone at the end.
set(slow "PictureTest|BenchViewCommand|PrepareCommand|RenderCommand|CatalogFile|LevelFile$|Stability|TiledLayers")
set(script "")
foreach(line IN LISTS lines)
  # A suite: its name, a dot, and a comment for typed ones. Tests are indented.
  if(line MATCHES "^([^ ]+)\\.( .*)?$")
    set(suite "${CMAKE_MATCH_1}")
    set(environment "")
    if(DRAWING AND "${PREFIX}.${suite}" MATCHES "${DRAWING}")
      set(environment " ENVIRONMENT ASAN_OPTIONS=detect_leaks=0:detect_stack_use_after_return=1")
    endif()
    set(cost "")
    if("${suite}" MATCHES "${slow}")
      set(cost " COST 100")
    endif()
    string(APPEND script
      "add_test([==[${PREFIX}.${suite}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${suite}.*]==] --gtest_brief=1)\n"
      "set_tests_properties([==[${PREFIX}.${suite}]==] PROPERTIES TIMEOUT ${TIMEOUT}"
      " LABELS ${PREFIX} SKIP_REGULAR_EXPRESSION [==[${all_skipped}]==]${cost}${environment})\n")
  endif()
endforeach()
file(WRITE "${OUTPUT}" "${script}")
