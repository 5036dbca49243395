# SPDX-License-Identifier: Apache-2.0
# cmake --install: the program, the libraries with their headers, the presets, the guide with the reference circuits, and
# a CMake package for consumers.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS parallax parallax_tlm parallax_modules parallax_traces parallax_platform parallax_stage EXPORT parallax)
install(DIRECTORY tlm modules traces platform DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/parallax
  FILES_MATCHING PATTERN "*.hpp" PATTERN presets EXCLUDE PATTERN cosim/stage EXCLUDE PATTERN platform/python EXCLUDE)
install(DIRECTORY platform/presets/ DESTINATION ${CMAKE_INSTALL_DATADIR}/parallax/presets
  OPTIONAL FILES_MATCHING PATTERN "*.toml")
install(DIRECTORY platform/cosim/circuit/ DESTINATION ${CMAKE_INSTALL_DATADIR}/parallax/circuit)
install(FILES platform/cosim/stage/parallax_stage.h platform/cosim/stage/parallax_stage.sv
  DESTINATION ${CMAKE_INSTALL_DATADIR}/parallax/stage)

# The folders as they are here, so that the links from page to page hold.
install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY platform modules tlm traces DESTINATION ${CMAKE_INSTALL_DOCDIR}
  FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.sv" PATTERN cosim EXCLUDE)
install(DIRECTORY modules DESTINATION ${CMAKE_INSTALL_DOCDIR} FILES_MATCHING PATTERN "*.hpp")

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/parallax)
install(EXPORT parallax DESTINATION ${package} NAMESPACE parallax:: FILE parallax-targets.cmake)
set(parallax_presets ${CMAKE_INSTALL_DATADIR}/parallax/presets)
configure_package_config_file(platform/parallax-config.cmake.in parallax-config.cmake INSTALL_DESTINATION ${package}
  PATH_VARS parallax_presets)
write_basic_package_version_file(parallax-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/parallax-config.cmake ${PROJECT_BINARY_DIR}/parallax-config-version.cmake
  platform/parallax-cosim.cmake DESTINATION ${package})
