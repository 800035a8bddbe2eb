# The page of `recoil report`: built from report/ by npm and Vite into one HTML file, which becomes a part of the
# program (page_bundle.hpp). Sources are copied into the build folder first, so that node_modules lies there.

set(RECOIL_REPORT AUTO CACHE STRING "The page of `recoil report`: ON, OFF, or AUTO (where node and npm can build it)")
set_property(CACHE RECOIL_REPORT PROPERTY STRINGS AUTO ON OFF)
find_program(RECOIL_NPM npm)
if(RECOIL_REPORT STREQUAL "ON" AND NOT RECOIL_NPM)
  message(FATAL_ERROR "RECOIL_REPORT=ON needs npm: install Debian's nodejs and npm")
endif()

set(recoil_page_folder "${PROJECT_BINARY_DIR}/report")
set(recoil_page_source "${recoil_page_folder}/page_bundle.cpp")
file(GLOB recoil_page_inputs CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/report/*.json" "${PROJECT_SOURCE_DIR}/report/*.html"
     "${PROJECT_SOURCE_DIR}/report/*.ts" "${PROJECT_SOURCE_DIR}/report/.npmrc" "${PROJECT_SOURCE_DIR}/report/src/*")
set(recoil_page_npm "")
if(RECOIL_NPM AND NOT RECOIL_REPORT STREQUAL "OFF")
  set(recoil_page_npm "${RECOIL_NPM}")
else()
  message(STATUS "No page for `recoil report`: runs leave no report.html")
endif()

add_custom_command(
  OUTPUT "${recoil_page_source}"
  COMMAND "${CMAKE_COMMAND}" "-Dsource_dir=${PROJECT_SOURCE_DIR}/report" "-Dfolder=${recoil_page_folder}"
          "-Dnpm=${recoil_page_npm}" "-Drequired=${RECOIL_REPORT}" -P "${PROJECT_SOURCE_DIR}/cmake/build_report.cmake"
  DEPENDS ${recoil_page_inputs} "${PROJECT_SOURCE_DIR}/cmake/build_report.cmake"
  COMMENT "The page of `recoil report`"
  VERBATIM)
