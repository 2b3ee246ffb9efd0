# What `cmake --install` puts where: programs to bin/, input scripts and figure scripts to share/suffuse/, the
# documentation and the licence to share/doc/suffuse/. Included last, when every program is known.
foreach(program suffuse suffuse-analyse suffuse-study)
  # The target of a program has its name, or that name with _ for - and _app behind it.
  string(REPLACE "-" "_" target_name ${program})
  foreach(candidate ${program} ${target_name}_app ${target_name}_program)
    if(TARGET ${candidate})
      install(TARGETS ${candidate} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
      break()
    endif()
  endforeach()
endforeach()

install(DIRECTORY input_scripts/ DESTINATION ${CMAKE_INSTALL_DATADIR}/suffuse/input_scripts
  PATTERN CMakeLists.txt EXCLUDE)
install(DIRECTORY analysis/figures/ DESTINATION ${CMAKE_INSTALL_DATADIR}/suffuse/figures
  USE_SOURCE_PERMISSIONS PATTERN __pycache__ EXCLUDE)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/suffuse)
install(FILES LICENSE README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/suffuse)
