# cmake --install: the core library with its headers, the portable text, the tool. find_package(cotan)
# then gives cotan::core.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS cotan_core cotan_portable EXPORT cotanTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/cotan DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY shaders/cotan DESTINATION share/cotan/shaders)
install(FILES LICENSE DESTINATION share/doc/cotan)
set_target_properties(cotan_portable PROPERTIES EXPORT_NAME portable)
install(EXPORT cotanTargets NAMESPACE cotan:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/cotan)

configure_package_config_file(cmake/cotanConfig.cmake.in ${PROJECT_BINARY_DIR}/cotanConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/cotan)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cotanConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/cotanConfig.cmake ${PROJECT_BINARY_DIR}/cotanConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/cotan)
