# The fluid's unit tests. Programs that hold a communicator need MPI's main even on one rank.
suffuse_catch_test(NAME unit_lbm_kernels SOURCES lbm_kernels_test.cpp LINKS suffuse::lbm_solver LABELS fluid RANKS 1)
suffuse_catch_test(NAME unit_lbm_boundary SOURCES lbm_boundary_test.cpp LINKS suffuse::lbm_solver LABELS fluid RANKS 1)
suffuse_catch_test(NAME unit_lbm_ranks SOURCES lbm_ranks_test.cpp LINKS suffuse::lbm_solver LABELS fluid
  RANKS 1 2 3 4 6)
suffuse_catch_test(NAME unit_lbm_units SOURCES lbm_units_test.cpp LINKS suffuse::lbm_solver LABELS fluid)
suffuse_catch_test(NAME unit_lbm_files SOURCES lbm_files_test.cpp LINKS suffuse::lbm_solver suffuse::hdf5_file
  LABELS fluid RANKS 1 2 3)
# VTK's own reader opens what the files test wrote. ParaView is large, so the test runs only where it is installed.
find_program(PVPYTHON_EXECUTABLE pvpython)
set_tests_properties(unit_lbm_files_1_ranks PROPERTIES FIXTURES_SETUP lbm_field_files)
if(PVPYTHON_EXECUTABLE)
  add_test(NAME unit_lbm_xdmf_reader COMMAND ${PVPYTHON_EXECUTABLE} --force-offscreen-rendering
    ${CMAKE_CURRENT_SOURCE_DIR}/lbm_xdmf_reader_test.py ${CMAKE_CURRENT_BINARY_DIR}/lbm_files_test_1/flow.xdmf)
  set_tests_properties(unit_lbm_xdmf_reader PROPERTIES LABELS fluid FIXTURES_REQUIRED lbm_field_files TIMEOUT 120)
endif()
find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_test(NAME unit_lbm_flow_driver COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/lbm_flow_driver_test.py
  $<TARGET_FILE:suffuse-flow> ${CMAKE_SOURCE_DIR}/scripts/mpirun ${CMAKE_CURRENT_BINARY_DIR}/lbm_flow_driver)
set_tests_properties(unit_lbm_flow_driver PROPERTIES LABELS fluid TIMEOUT 200 PROCESSORS 2)
