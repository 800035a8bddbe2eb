# Script (cmake -P): asks git for the state of the tree and fills in build_info.hpp.in.

include("${CMAKE_CURRENT_LIST_DIR}/recoil_version.cmake")
recoil_find_version("${source_dir}" "${version}" full_version)
configure_file("${CMAKE_CURRENT_LIST_DIR}/build_info.hpp.in" "${output}" @ONLY)
