# Everything we link, as the target recoil_dependencies. Imported targets, so their headers are system headers
# and our warnings do not reach them. All of it is in Debian 12 (tools/packages_build.txt).

find_package(Threads REQUIRED)
find_package(MPI REQUIRED COMPONENTS C)
find_package(P4est 2.2 REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5-openmpi)
pkg_check_modules(TOMLPLUSPLUS REQUIRED IMPORTED_TARGET tomlplusplus)
pkg_check_modules(UDUNITS REQUIRED IMPORTED_TARGET udunits)
pkg_check_modules(MUPARSER REQUIRED IMPORTED_TARGET muparser)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo cairo-pdf cairo-svg cairo-png)
find_package(CLI11 REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(ZLIB REQUIRED)

add_library(recoil_dependencies INTERFACE)
target_link_libraries(
  recoil_dependencies
  INTERFACE P4est::P4est
            PkgConfig::HDF5
            PkgConfig::TOMLPLUSPLUS
            PkgConfig::UDUNITS
            PkgConfig::MUPARSER
            PkgConfig::CAIRO
            CLI11::CLI11
            fmt::fmt
            nlohmann_json::nlohmann_json
            ZLIB::ZLIB
            MPI::MPI_C
            Threads::Threads)
# We use MPI's C interface only; its old C++ one would bring in headers that do not compile without warnings.
target_compile_definitions(recoil_dependencies INTERFACE OMPI_SKIP_MPICXX=1)
