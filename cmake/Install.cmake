# What `cmake --install` puts where besides the programs (each is installed beside its add_executable, to bin/): input
# scripts and figure scripts to share/suffuse/, the documentation and the licence to share/doc/suffuse/.
install(DIRECTORY input_scripts/ DESTINATION ${CMAKE_INSTALL_DATADIR}/suffuse/input_scripts
  PATTERN CMakeLists.txt EXCLUDE)
install(DIRECTORY analysis/figures/ DESTINATION ${CMAKE_INSTALL_DATADIR}/suffuse/figures
  USE_SOURCE_PERMISSIONS PATTERN __pycache__ EXCLUDE)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/suffuse)
install(FILES LICENSE README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/suffuse)
