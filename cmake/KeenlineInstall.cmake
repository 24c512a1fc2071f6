include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS keenline EXPORT keenlineTargets FILE_SET HEADERS)
if(KEENLINE_APPS)
  install(TARGETS keenline_cli)
endif()
set(keenline_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/keenline")
install(EXPORT keenlineTargets NAMESPACE keenline:: DESTINATION "${keenline_package_dir}")
configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/keenlineConfig.cmake.in"
  "${CMAKE_BINARY_DIR}/keenlineConfig.cmake" INSTALL_DESTINATION "${keenline_package_dir}")
write_basic_package_version_file("${CMAKE_BINARY_DIR}/keenlineConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/keenlineConfig.cmake" "${CMAKE_BINARY_DIR}/keenlineConfigVersion.cmake"
  DESTINATION "${keenline_package_dir}")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
