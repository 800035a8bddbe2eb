# Finds p4est and its support library sc; Debian ships neither a pkg-config nor a CMake file for them.
# Defines P4est_FOUND, P4est_VERSION and the imported target P4est::P4est. MPI must have been found before.

find_path(P4est_INCLUDE_DIR p4est.h)
find_library(P4est_LIBRARY p4est)
find_library(P4est_SC_LIBRARY sc)

if(P4est_INCLUDE_DIR AND EXISTS "${P4est_INCLUDE_DIR}/p4est_config.h")
  file(STRINGS "${P4est_INCLUDE_DIR}/p4est_config.h" _p4est_lines REGEX "define P4EST_(PACKAGE_VERSION|ENABLE_MPI) ")
  foreach(_line IN LISTS _p4est_lines)
    if(_line MATCHES "PACKAGE_VERSION \"([0-9.]+)")
      set(P4est_VERSION "${CMAKE_MATCH_1}")
    elseif(_line MATCHES "ENABLE_MPI 1")
      set(P4est_HAS_MPI TRUE)
    endif()
  endforeach()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  P4est
  REQUIRED_VARS P4est_LIBRARY P4est_SC_LIBRARY P4est_INCLUDE_DIR P4est_HAS_MPI
  VERSION_VAR P4est_VERSION)
mark_as_advanced(P4est_INCLUDE_DIR P4est_LIBRARY P4est_SC_LIBRARY)

if(P4est_FOUND AND NOT TARGET P4est::P4est)
  add_library(P4est::P4est INTERFACE IMPORTED)
  target_include_directories(P4est::P4est SYSTEM INTERFACE "${P4est_INCLUDE_DIR}")
  target_link_libraries(P4est::P4est INTERFACE "${P4est_LIBRARY}" "${P4est_SC_LIBRARY}" MPI::MPI_C)
endif()
