# Writes generated/core/build_info.hpp at every build, and touches it only when something in it has changed,
# so that a new commit recompiles the few files that include it and nothing else.

set(recoil_generated_dir "${PROJECT_BINARY_DIR}/generated")
file(RELATIVE_PATH recoil_relative_data_dir "${CMAKE_INSTALL_FULL_BINDIR}" "${CMAKE_INSTALL_FULL_DATADIR}/recoil")

set(recoil_write_build_info
    "${CMAKE_COMMAND}"
    "-Dsource_dir=${PROJECT_SOURCE_DIR}"
    "-Doutput=${recoil_generated_dir}/core/build_info.hpp"
    "-Dversion=${PROJECT_VERSION}"
    "-Dcompiler=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
    "-Dbuild_type=${CMAKE_BUILD_TYPE}"
    "-Dnative=$<IF:$<BOOL:${RECOIL_NATIVE}>,true,false>"
    "-Drelative_data_dir=${recoil_relative_data_dir}"
    -P
    "${PROJECT_SOURCE_DIR}/cmake/write_build_info.cmake")

add_custom_target(
  recoil_build_info
  COMMAND ${recoil_write_build_info}
  BYPRODUCTS "${recoil_generated_dir}/core/build_info.hpp"
  COMMENT "build_info.hpp"
  VERBATIM)
