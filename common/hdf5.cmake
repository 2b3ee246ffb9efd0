# HDF5 in parallel, behind a class that shows none of its types; a library of its own, for those who write files.
set(HDF5_PREFER_PARALLEL ON)
find_package(HDF5 REQUIRED COMPONENTS C)
if(NOT HDF5_IS_PARALLEL)
  message(FATAL_ERROR "HDF5 without MPI was found; install libhdf5-openmpi-dev")
endif()
suffuse_library(NAME hdf5_file SOURCES src/hdf5_file.cpp PUBLIC_LINKS suffuse::common)
target_include_directories(suffuse_hdf5_file SYSTEM PRIVATE ${HDF5_C_INCLUDE_DIRS})
target_link_libraries(suffuse_hdf5_file PRIVATE ${HDF5_C_LIBRARIES})
