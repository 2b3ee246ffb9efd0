# The fluid's unit tests. Programs that hold a communicator need MPI's main even on one rank.
suffuse_catch_test(NAME unit_lbm_kernels SOURCES lbm_kernels_test.cpp LINKS suffuse::lbm_solver LABELS fluid RANKS 1)
