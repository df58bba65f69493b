# pedicel_library(NAME [ALONE] [COLD] SOURCES file... [PUBLIC target...] [PRIVATE target...])
#
# One static library per folder, a room. Its headers are reached by their place in the tree:
# `#include "plugins/plant/plant_file.h"`. A room includes only the rooms that it links; tools/house
# compares both (ctest House.rooms).
#
# Half of a file's compile time goes into headers, so five files of a room are compiled as one; ALONE:
# each by itself (kernels that include themselves once an instruction set). COLD: nothing here takes
# a run's time, so the compiler need not either.
# All rooms have the same flags but for that, so that they share two sets of precompiled headers, and
# their code is position independent, so that the Python module can take it. What is hidden is called
# and read as directly as before.
function(pedicel_library NAME)
  cmake_parse_arguments(ARG "ALONE;COLD" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(${NAME} STATIC ${ARG_SOURCES})
  target_include_directories(${NAME} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  target_link_libraries(${NAME} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  pedicel_install(${NAME})
  if(PEDICEL_UNITY AND NOT ARG_ALONE)
    set_target_properties(${NAME} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 5)
  endif()
  if(ARG_COLD)
    pedicel_compiled(${NAME} cold)
  else()
    pedicel_compiled(${NAME} hot)
  endif()
endfunction()

# pedicel_compiled(NAME cold|hot|test): the flags of that kind, and its precompiled headers: what a
# third of a file's time would go into. clang-tidy and the fuzzers go without.
function(pedicel_compiled NAME KIND)
  if(NOT KIND STREQUAL test)
    set_target_properties(${NAME} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
                          VISIBILITY_INLINES_HIDDEN ON)
  endif()
  if(CMAKE_BUILD_TYPE STREQUAL "Release" AND NOT KIND STREQUAL hot)
    target_compile_options(${NAME} PRIVATE -O1)
  endif()
  if(NOT PEDICEL_PCH)
    return()
  endif()
  if(NOT TARGET pedicel_headers_${KIND})
    file(WRITE ${PROJECT_BINARY_DIR}/headers.cpp "")
    add_library(pedicel_headers_${KIND} OBJECT ${PROJECT_BINARY_DIR}/headers.cpp)
    set(headers <Eigen/Dense> <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory>
        <optional> <set> <span> <sstream> <string> <variant> <vector>)
    if(KIND STREQUAL test)
      target_link_libraries(pedicel_headers_${KIND} PRIVATE GTest::gmock)
      list(APPEND headers <gmock/gmock.h> <gtest/gtest.h>)
    endif()
    target_link_libraries(pedicel_headers_${KIND} PRIVATE Eigen3::Eigen)
    target_precompile_headers(pedicel_headers_${KIND} PRIVATE ${headers})
    set(PEDICEL_PCH OFF)  # for the call below alone: the same flags
    pedicel_compiled(pedicel_headers_${KIND} ${KIND})
    set(PEDICEL_PCH ON)
  endif()
  target_compile_options(${NAME} PRIVATE -fpch-preprocess)  # for ccache
  target_precompile_headers(${NAME} REUSE_FROM pedicel_headers_${KIND})
endfunction()

# pedicel_headers(NAME [PUBLIC target...]): a room of headers alone.
function(pedicel_headers NAME)
  cmake_parse_arguments(ARG "" "" "PUBLIC" ${ARGN})
  add_library(${NAME} INTERFACE)
  target_include_directories(${NAME} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  target_link_libraries(${NAME} INTERFACE ${ARG_PUBLIC})
  pedicel_install(${NAME})
endfunction()

# pedicel_test(NAME SOURCES file... [APART file...] LIBRARIES target... [LABELS label...] [TIMEOUT s]
#              [HIDDEN filter])
#
# One GoogleTest program per folder of tests; each of its cases is a ctest case. Most of a test's
# compile time goes into headers, so four files are compiled as one where they agree; APART names
# those that stay by themselves, since they use another's names otherwise. What takes a unit test's
# time is in the libraries, so the compiler need not take much. Cases that GoogleTest's filter HIDDEN
# names get the label `hidden` alone: long ones beside shorter siblings.
function(pedicel_test NAME)
  cmake_parse_arguments(ARG "" "TIMEOUT;HIDDEN" "SOURCES;APART;LIBRARIES;LABELS" ${ARGN})
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  add_executable(${NAME} ${ARG_SOURCES} ${ARG_APART})
  if(PEDICEL_UNITY)
    set_target_properties(${NAME} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 4)
    set_source_files_properties(${ARG_APART} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    target_compile_options(${NAME} PRIVATE -Wno-shadow)  # of another file's constants
  endif()
  pedicel_compiled(${NAME} test)
  target_link_libraries(${NAME} PRIVATE ${ARG_LIBRARIES} pedicel_places GTest::gmock GTest::gtest_main)
  gtest_discover_tests(${NAME} TEST_FILTER "-${ARG_HIDDEN}" DISCOVERY_TIMEOUT 120
                       PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT})
  if(ARG_HIDDEN)
    gtest_discover_tests(${NAME} TEST_FILTER "${ARG_HIDDEN}" DISCOVERY_TIMEOUT 120
                         PROPERTIES LABELS hidden TIMEOUT 1200)
  endif()
endfunction()
