# How every target of the project is compiled: language, warnings, sanitizers.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE RelWithDebInfo)
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
endif()

# Debian installs GeographicLib's find module outside of CMake's module path.
list(APPEND CMAKE_MODULE_PATH "${CMAKE_INSTALL_PREFIX}/share/cmake/geographiclib"
  /usr/share/cmake/geographiclib)

find_package(Threads REQUIRED)

add_library(marsview_flags INTERFACE)
target_include_directories(marsview_flags INTERFACE "${CMAKE_SOURCE_DIR}")
target_compile_options(marsview_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wcast-align
  -Woverloaded-virtual -Wnon-virtual-dtor -Wformat=2
  # clang's version also warns about double to long double, which the tests' references use
  $<$<CXX_COMPILER_ID:GNU>:-Wdouble-promotion>
  -ffp-contract=off # the same bits on every machine
  # Collecting garbage less often saves a twelfth of the time of large groups, for 0.2 GB a job.
  "$<$<CXX_COMPILER_ID:GNU>:SHELL:--param ggc-min-heapsize=400000>"
  $<$<BOOL:${MARSVIEW_WERROR}>:-Werror>)
if(MARSVIEW_SANITIZE)
  target_compile_options(marsview_flags INTERFACE
    -fsanitize=${MARSVIEW_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
    # GCC 12 warns about its own library then
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_options(marsview_flags INTERFACE -fsanitize=${MARSVIEW_SANITIZE})
endif()

# marsview_library(NAME SOURCES … LINKS …): a static library of one layer. Its links are public
# because our headers use types of the libraries below them. With FOR_MODULES it can also be linked
# into shared libraries; hidden, its functions are as fast as in a program.
function(marsview_library name)
  cmake_parse_arguments(ARG "FOR_MODULES" "" "SOURCES;LINKS;SYSTEM_INCLUDES" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  if(ARG_FOR_MODULES)
    set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON
      CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  endif()
  target_link_libraries(${name} PUBLIC ${ARG_LINKS} PRIVATE marsview_flags)
  target_include_directories(${name} PUBLIC "${CMAKE_SOURCE_DIR}")
  target_include_directories(${name} SYSTEM PUBLIC ${ARG_SYSTEM_INCLUDES})
endfunction()

# marsview_compile_together(): compiles the targets defined after this call sixteen files at a time,
# which takes a third of the time if headers dominate. Not for performance-critical code, nor for
# daily work: a change in one file recompiles the others of its group.
option(MARSVIEW_COMPILE_TOGETHER "Compile tests, window and commands several files at a time" OFF)
macro(marsview_compile_together)
  if(MARSVIEW_COMPILE_TOGETHER)
    set(CMAKE_UNITY_BUILD ON)
    set(CMAKE_UNITY_BUILD_BATCH_SIZE 16)
    # The warning treats every included file as a header.
    add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-subobject-linkage>)
  endif()
endmacro()

# marsview_compile_by_folder(TARGET [ONLY FOLDER...] [EXCEPT FILE...]): compiles the files of each
# folder, or of each folder named, together: a new file changes one group, and local names need to
# differ within a folder only. Files with compiler options of their own stay alone.
function(marsview_compile_by_folder target)
  cmake_parse_arguments(ARG "" "" "ONLY;EXCEPT" ${ARGN})
  if(NOT MARSVIEW_COMPILE_TOGETHER)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_filename_component(folder "${source}" DIRECTORY)
    if(NOT source MATCHES "\\.cpp$" OR folder STREQUAL "" OR (ARG_ONLY AND NOT folder IN_LIST ARG_ONLY)
        OR source IN_LIST ARG_EXCEPT)
      continue()
    endif()
    string(REPLACE "/" "_" group "${folder}")
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${group}")
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  target_compile_options(${target} PRIVATE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-subobject-linkage>)
endfunction()

# `format` and `tidy` work on the project's own sources. clang-tidy needs a database written for
# clang: build the target in the "clang" preset.
file(GLOB_RECURSE MARSVIEW_OWN_SOURCES CONFIGURE_DEPENDS
  "${CMAKE_SOURCE_DIR}/app/*.cpp" "${CMAKE_SOURCE_DIR}/app/*.h"
  "${CMAKE_SOURCE_DIR}/core/*.cpp" "${CMAKE_SOURCE_DIR}/core/*.h"
  "${CMAKE_SOURCE_DIR}/haptics/*.cpp" "${CMAKE_SOURCE_DIR}/haptics/*.h"
  "${CMAKE_SOURCE_DIR}/ui/*.cpp" "${CMAKE_SOURCE_DIR}/ui/*.h"
  "${CMAKE_SOURCE_DIR}/tests/*.cpp" "${CMAKE_SOURCE_DIR}/tests/*.h")
find_program(CLANG_FORMAT_PROGRAM NAMES clang-format-14 clang-format)
if(CLANG_FORMAT_PROGRAM)
  add_custom_target(format
    COMMAND "${CLANG_FORMAT_PROGRAM}" -i ${MARSVIEW_OWN_SOURCES} VERBATIM)
  add_custom_target(format-check
    COMMAND "${CLANG_FORMAT_PROGRAM}" --dry-run -Werror ${MARSVIEW_OWN_SOURCES} VERBATIM)
endif()
find_program(RUN_CLANG_TIDY_PROGRAM NAMES run-clang-tidy-14 run-clang-tidy)
if(RUN_CLANG_TIDY_PROGRAM)
  add_custom_target(tidy
    COMMAND "${RUN_CLANG_TIDY_PROGRAM}" -quiet -j 2 -p "${CMAKE_BINARY_DIR}"
      "^${CMAKE_SOURCE_DIR}/(app|core|haptics|ui|tests)/" VERBATIM)
endif()
