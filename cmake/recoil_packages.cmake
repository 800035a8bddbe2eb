# Debian packages by CPack (make deb): recoil, and python3-recoil. Dependencies on libraries come from dpkg-shlibdeps.

include(recoil_version)
recoil_find_version("${PROJECT_SOURCE_DIR}" "${PROJECT_VERSION}" recoil_full_version)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME recoil)
set(CPACK_PACKAGE_VERSION "${recoil_full_version}")
set(CPACK_PACKAGE_CONTACT "The Recoil developers <recoil@recoil.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program python)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
# Whatever the umask of who builds.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME recoil)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "fonts-dejavu-core, openmpi-bin")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "webp")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "apngasm, ffmpeg, paraview, python3-recoil")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
    "hydrocode for the impact of solids
Recoil computes what happens when solids strike each other at high velocity:
bodies collide, slide and separate, each with its own sharp surface on a fixed
Cartesian mesh. In one, two and three dimensions, with threads and MPI.
.
The package has the program, cited materials, cases with their references,
and commented cases to start from.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-recoil)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3-h5py, python3-numpy, python3-pandas")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "recoil")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, python3-xarray")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION
    "hydrocode for the impact of solids (Python package)
Reads what runs of Recoil leave: gauges and histories as pandas tables, fields
as numpy arrays. With the package recoil it starts runs and sweeps, too.")
include(CPack)
