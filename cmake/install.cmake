# Installs the program, the public headers and the modules as frangia::<module> for find_package(frangia).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(modules GLOBAL PROPERTY FRANGIA_MODULES)
install(TARGETS ${modules} EXPORT frangiaTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(TARGETS frangia RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
if(FRANGIA_CAD)
  install(TARGETS frangia_cad_module LIBRARY DESTINATION lib/frangia COMPONENT program)
endif()
# What `cmake --install` takes, and no test: `./run build`. python/ adds its modules.
add_custom_target(installed_files)
add_dependencies(installed_files frangia ${modules})

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/frangia)
configure_package_config_file(cmake/frangiaConfig.cmake.in ${PROJECT_BINARY_DIR}/frangiaConfig.cmake
  INSTALL_DESTINATION ${package_dir})
# Before 1.0 a minor version may break the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/frangiaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/frangiaConfig.cmake ${PROJECT_BINARY_DIR}/frangiaConfigVersion.cmake
  cmake/FindOpenCVModules.cmake DESTINATION ${package_dir} COMPONENT development)
install(EXPORT frangiaTargets NAMESPACE frangia:: DESTINATION ${package_dir} COMPONENT development)
install(FILES LICENSE NOTICE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
