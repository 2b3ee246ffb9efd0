# Finds Debian's LIGGGHTS library (package libliggghts-dev). Target: Liggghts::Liggghts. Liggghts_VERSION is that of the
# library's file name: its headers know LAMMPS's alone.
find_path(Liggghts_INCLUDE_DIR lammps.h PATH_SUFFIXES liggghts)
find_library(Liggghts_LIBRARY liggghts)
find_program(Liggghts_EXECUTABLE liggghts)
if(Liggghts_LIBRARY)
  file(REAL_PATH ${Liggghts_LIBRARY} liggghts_file)
  if(liggghts_file MATCHES "\\.so\\.([0-9]+\\.[0-9]+(\\.[0-9]+)?)$")
    set(Liggghts_VERSION ${CMAKE_MATCH_1})
  endif()
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Liggghts REQUIRED_VARS Liggghts_LIBRARY Liggghts_INCLUDE_DIR
  VERSION_VAR Liggghts_VERSION HANDLE_VERSION_RANGE)
if(Liggghts_FOUND AND NOT TARGET Liggghts::Liggghts)
  add_library(Liggghts::Liggghts UNKNOWN IMPORTED)
  set_target_properties(Liggghts::Liggghts PROPERTIES
    IMPORTED_LOCATION ${Liggghts_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${Liggghts_INCLUDE_DIR}
    INTERFACE_LINK_LIBRARIES MPI::MPI_CXX)
endif()
mark_as_advanced(Liggghts_INCLUDE_DIR Liggghts_LIBRARY Liggghts_EXECUTABLE)
