# What `cmake --install` puts where. Programs to bin/ (each beside its add_executable), the launcher as suffuse-mpirun; scenes,
# figure scripts and the Python module to share/suffuse/, documentation and licence to share/doc/suffuse/, manual pages and
# completion where there are any; component Development: libraries and headers for find_package(Suffuse).
include(CMakePackageConfigHelpers)
set(suffuse_share ${CMAKE_INSTALL_DATADIR}/suffuse)
install(PROGRAMS scripts/mpirun DESTINATION ${CMAKE_INSTALL_BINDIR} RENAME suffuse-mpirun)
install(DIRECTORY input_scripts/ DESTINATION ${suffuse_share}/input_scripts PATTERN CMakeLists.txt EXCLUDE)
install(DIRECTORY analysis/figures/ DESTINATION ${suffuse_share}/figures
  USE_SOURCE_PERMISSIONS PATTERN __pycache__ EXCLUDE)
install(DIRECTORY analysis/python/ DESTINATION ${suffuse_share}/python PATTERN __pycache__ EXCLUDE)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/suffuse PATTERN __pycache__ EXCLUDE)
install(FILES LICENSE README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/suffuse)

set(suffuse_package ${CMAKE_INSTALL_LIBDIR}/cmake/Suffuse)
configure_package_config_file(cmake/SuffuseConfig.cmake.in ${PROJECT_BINARY_DIR}/SuffuseConfig.cmake
  INSTALL_DESTINATION ${suffuse_package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/SuffuseConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(EXPORT SuffuseTargets NAMESPACE suffuse:: DESTINATION ${suffuse_package} COMPONENT Development)
install(FILES ${PROJECT_BINARY_DIR}/SuffuseConfig.cmake ${PROJECT_BINARY_DIR}/SuffuseConfigVersion.cmake
  cmake/FindLiggghts.cmake DESTINATION ${suffuse_package} COMPONENT Development)
