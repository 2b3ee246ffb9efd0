# Manual pages and bash completion of the programs, made from what their --help says and from docs/reference/styles.tsv
# (target `manual`, in `all`); where help2man is installed, which only they need.
find_program(HELP2MAN_EXECUTABLE help2man)
find_package(Python3 COMPONENTS Interpreter)
if(NOT HELP2MAN_EXECUTABLE OR NOT Python3_FOUND)
  message(STATUS "No manual pages: help2man or Python is missing (scripts/install_packages check)")
  return()
endif()
set(suffuse_manual ${PROJECT_BINARY_DIR}/manual)
set(suffuse_programs suffuse suffuse-analyse suffuse-study suffuse-flow)
list(TRANSFORM suffuse_programs REPLACE "(.+)" "$<TARGET_FILE:\\1>" OUTPUT_VARIABLE suffuse_program_files)
add_custom_command(OUTPUT ${suffuse_manual}/suffuse.1
  COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/scripts/make_manual --help2man ${HELP2MAN_EXECUTABLE}
    --output ${suffuse_manual} ${suffuse_program_files}
  DEPENDS ${suffuse_programs} scripts/make_manual scripts/reference_tables docs/reference/styles.tsv
  COMMENT "Manual pages and completion" VERBATIM)
add_custom_target(manual ALL DEPENDS ${suffuse_manual}/suffuse.1)
install(DIRECTORY ${suffuse_manual}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL FILES_MATCHING PATTERN "*.1")
install(FILES ${suffuse_manual}/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  RENAME suffuse OPTIONAL)
foreach(program suffuse-analyse suffuse-study suffuse-flow)  # bash-completion looks for a file of the program's name
  install(FILES ${suffuse_manual}/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
    RENAME ${program} OPTIONAL)
endforeach()
