# What is installed, and what find_package(Pedicel) finds. Two components: `program` (the program
# with its assets) and `development` (libraries, headers, CMake files).
set(PEDICEL_CONFIG_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/Pedicel)

# pedicel_package(NAME [CONFIG]): find_package(NAME), here and for whoever links Pedicel.
macro(pedicel_package NAME)
  find_package(${NAME} ${ARGN} REQUIRED)
  set_property(GLOBAL APPEND_STRING PROPERTY pedicel_dependencies "find_dependency(${NAME} ${ARGN})\n")
endmacro()

# pedicel_module(PREFIX MODULE [WINDOW]): PkgConfig::PREFIX of pkg-config's MODULE, in the same way.
# WINDOW: who links no room of the window may lack it.
macro(pedicel_module PREFIX MODULE)
  pkg_check_modules(${PREFIX} REQUIRED IMPORTED_TARGET ${MODULE})
  set_property(GLOBAL APPEND_STRING PROPERTY pedicel_dependencies "pedicel_module(${PREFIX} ${MODULE} ${ARGN})\n")
endmacro()

# pedicel_install(NAME): the library pedicel_x is Pedicel::x for whoever finds the package. Which
# headers come with it is a list (public_headers.txt).
function(pedicel_install NAME)
  string(REGEX REPLACE "^pedicel_" "" short ${NAME})
  add_library(Pedicel::${short} ALIAS ${NAME})
  set_target_properties(${NAME} PROPERTIES EXPORT_NAME ${short})
  # The bits of a run are those of the headers' code, too (see the top CMakeLists.txt).
  target_compile_options(${NAME} INTERFACE $<INSTALL_INTERFACE:-ffp-contract=off>)
  target_compile_features(${NAME} INTERFACE $<INSTALL_INTERFACE:cxx_std_20>)
  install(TARGETS ${NAME} EXPORT PedicelTargets COMPONENT development
          INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pedicel)
endfunction()

# The public headers keep their places: `#include "plugins/plant/plant_file.h"`, as in the tree.
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/public_headers.txt public_headers REGEX "^[^#]")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/public_headers.txt)
foreach(header ${public_headers})
  get_filename_component(place ${header} DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pedicel/${place}
          COMPONENT development)
endforeach()
