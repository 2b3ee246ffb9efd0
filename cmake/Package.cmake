# `cpack` in the build folder: a Debian package of the programs, scenes, figures and documentation (docs/developer.md).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME suffuse)
set(CPACK_PACKAGE_CONTACT "The Suffuse developers")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL Runtime Development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME suffuse)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "openmpi-bin, mawk | gawk")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "python3-matplotlib, python3-h5py")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "python3-pandas, paraview")
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "${PROJECT_DESCRIPTION}
 LIGGGHTS with fixes and computes of soil mechanics, coupled to a
 lattice-Boltzmann solver: suffusion, fluidisation, mud pumping.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME suffuse-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "suffuse (= ${PROJECT_VERSION}), libliggghts-dev, libopenmpi-dev, libeigen3-dev, libfmt-dev, libhdf5-openmpi-dev")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "${PROJECT_DESCRIPTION}
 Libraries and headers for find_package(Suffuse).")
include(CPack)
