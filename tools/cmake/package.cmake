# The program with its assets, PedicelConfig.cmake, and the Debian packages `pedicel` and
# `libpedicel-dev`. The rooms say themselves what they install (install.cmake).
set(PEDICEL_SHARE ${CMAKE_INSTALL_DATADIR}/pedicel)

# What the program tells of itself: its man page and what a shell completes.
set(told ${PROJECT_BINARY_DIR}/told)
add_custom_command(
  OUTPUT ${told}/pedicel.1 ${told}/pedicel.bash ${told}/pedicel.zsh
  COMMAND ${CMAKE_COMMAND} -E make_directory ${told}
  COMMAND pedicel --man-page > ${told}/pedicel.1
  COMMAND pedicel --completion bash > ${told}/pedicel.bash
  COMMAND pedicel --completion zsh > ${told}/pedicel.zsh
  DEPENDS pedicel VERBATIM)
add_custom_target(pedicel_told ALL DEPENDS ${told}/pedicel.1 ${told}/pedicel.bash ${told}/pedicel.zsh)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
install(TARGETS pedicel)
# Scenes name plants as ../../plants/NAME: both folders keep their places.
install(DIRECTORY assets plants DESTINATION ${PEDICEL_SHARE})
install(FILES README.md CHANGELOG.md LICENSE tools/package/copyright TYPE DOC)
# The manual's pages, where tools/manual made them.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/build/manual/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/html OPTIONAL)
install(FILES ${told}/pedicel.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${told}/pedicel.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME pedicel)
# The first is where Debian's zsh looks below /usr, the second where any looks below /usr/local.
foreach(folder vendor-completions site-functions)
  install(FILES ${told}/pedicel.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${folder} RENAME _pedicel)
endforeach()
if(PEDICEL_WINDOW)
  install(FILES tools/package/pedicel.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
  install(FILES tools/package/pedicel.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
endif()

include(CMakePackageConfigHelpers)
get_property(dependencies GLOBAL PROPERTY pedicel_dependencies)
configure_package_config_file(tools/cmake/PedicelConfig.cmake.in ${PROJECT_BINARY_DIR}/PedicelConfig.cmake
  INSTALL_DESTINATION ${PEDICEL_CONFIG_FOLDER} PATH_VARS PEDICEL_SHARE)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/PedicelConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/PedicelConfig.cmake ${PROJECT_BINARY_DIR}/PedicelConfigVersion.cmake
        DESTINATION ${PEDICEL_CONFIG_FOLDER} COMPONENT development)
install(EXPORT PedicelTargets NAMESPACE Pedicel:: DESTINATION ${PEDICEL_CONFIG_FOLDER} COMPONENT development)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME pedicel)
set(CPACK_PACKAGE_CONTACT "The Pedicel authors <pedicel@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "sandbox where robots handle plants")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
"Robots, grippers and rigid things move by Bullet, plants by Cosserat rods.
Given measured trials of a real plant, Pedicel says what the simulation gets
wrong, and why.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
"Static libraries, headers and find_package(Pedicel), for programs that simulate
plants with Pedicel.")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME pedicel)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libosmesa6, ffmpeg, fonts-roboto-unhinted | fonts-dejavu-core")
if(PEDICEL_PYTHON)
  string(APPEND CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS
         ", python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), python3-numpy")
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "python3-tk")
endif()
find_program(SHLIBDEPS dpkg-shlibdeps)
if(SHLIBDEPS)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
endif()
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libpedicel-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "pedicel (= ${PROJECT_VERSION}), pkg-config, libeigen3-dev, libbullet-dev, liburdfdom-dev, libtinyxml-dev, \
libconsole-bridge-dev, libassimp-dev, libhwy-dev, libyaml-cpp-dev, nlohmann-json3-dev, libcli11-dev, libmd-dev, \
libceres-dev, libpng-dev, zlib1g-dev, libzstd-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "libimgui-dev, libglfw3-dev")
include(CPack)
