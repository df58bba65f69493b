# pedicel_library(NAME [ALONE] [COLD] SOURCES file... [PUBLIC target...] [PRIVATE target...])
#
# One static library per folder, a room. Its headers are reached as
#   pedicel/core/check.h        of engine/core
#   pedicel/plant/plant_file.h  of plugins/plant
#   pedicel/app/run/grip.h      of app/run
# and only by targets that link it: each room exports an include root of its own that holds nothing
# but a link to its folder. An include of a room that is not linked is a build error.
#
# Half of a file's compile time goes into headers, so five files of a room are compiled as one; ALONE:
# each by itself (kernels that include themselves once an instruction set). COLD: nothing here takes
# a run's time, so the compiler need not either.
function(pedicel_library NAME)
  cmake_parse_arguments(ARG "ALONE;COLD" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  pedicel_include_root(${NAME} root)
  add_library(${NAME} STATIC ${ARG_SOURCES})
  target_include_directories(${NAME} PUBLIC $<BUILD_INTERFACE:${root}>)
  target_link_libraries(${NAME} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  pedicel_install(${NAME} ${folder})
  if(PEDICEL_UNITY AND NOT ARG_ALONE)
    set_target_properties(${NAME} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 5)
  endif()
  if(ARG_COLD AND CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${NAME} PRIVATE -O2)
  endif()
endfunction()

# pedicel_include_root(NAME ROOT): ROOT becomes the include root of this folder, and `folder` the name
# by which its headers are reached.
function(pedicel_include_root NAME ROOT)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  string(REGEX REPLACE "^(engine|plugins)/" "" folder ${folder})
  set(root ${PROJECT_BINARY_DIR}/include/${NAME})
  get_filename_component(parent ${root}/pedicel/${folder} DIRECTORY)
  file(MAKE_DIRECTORY ${parent})
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${root}/pedicel/${folder} SYMBOLIC)
  set(${ROOT} ${root} PARENT_SCOPE)
  set(folder ${folder} PARENT_SCOPE)
endfunction()

# pedicel_test(NAME SOURCES file... [APART file...] LIBRARIES target... [LABELS label...] [TIMEOUT s])
#
# One GoogleTest program per folder of tests; each of its cases is a ctest case. Most of a test's
# compile time goes into headers, so four files are compiled as one where they agree; APART names
# those that stay by themselves, since they use another's names otherwise. What takes a unit test's
# time is in the libraries, so the compiler need not take much.
function(pedicel_test NAME)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;APART;LIBRARIES;LABELS" ${ARGN})
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
  if(CMAKE_BUILD_TYPE STREQUAL "Release" AND "unit" IN_LIST ARG_LABELS)
    target_compile_options(${NAME} PRIVATE -O1)
  endif()
  target_include_directories(${NAME} PRIVATE ${PROJECT_SOURCE_DIR}/tests ${PROJECT_BINARY_DIR}/include/tests)
  target_link_libraries(${NAME} PRIVATE ${ARG_LIBRARIES} GTest::gmock GTest::gtest_main)
  gtest_discover_tests(${NAME} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT}
                       DISCOVERY_TIMEOUT 120)
endfunction()
