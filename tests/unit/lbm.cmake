# The fluid's unit tests. Programs that hold a communicator need MPI's main even on one rank.
suffuse_catch_test(NAME unit_lbm_kernels SOURCES lbm_kernels_test.cpp LINKS suffuse::lbm_solver LABELS fluid RANKS 1)
suffuse_catch_test(NAME unit_lbm_boundary SOURCES lbm_boundary_test.cpp LINKS suffuse::lbm_solver LABELS fluid RANKS 1)
suffuse_catch_test(NAME unit_lbm_ranks SOURCES lbm_ranks_test.cpp LINKS suffuse::lbm_solver LABELS fluid
  RANKS 1 2 3 4 6)
suffuse_catch_test(NAME unit_lbm_units SOURCES lbm_units_test.cpp LINKS suffuse::lbm_solver LABELS fluid)
suffuse_catch_test(NAME unit_lbm_files SOURCES lbm_files_test.cpp LINKS suffuse::lbm_solver suffuse::hdf5_file
  LABELS fluid RANKS 1 2 3)
