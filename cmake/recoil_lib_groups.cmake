# The library in two groups of files, to compile it sooner; results have the same bits.
# Folders that take no time in a run are optimised less (recoil_little_optimised): app, config, record, but for shapes, which
# the start of a run asks for millions of distances, and what packs and draws fields.
# With RECOIL_PRECOMPILE, for builds that compile everything once, headers of the standard library and that of the case are
# read once for each group, for the folders of which most files need them; others would take longer. Other builds bring every
# file's includes to light, and a change to a header of ours compiles only what uses it.

set(recoil_common_headers <fmt/format.h> <algorithm> <array> <cmath> <filesystem> <functional> <map> <optional> <string>
                          <variant> <vector>)
if(RECOIL_PRECOMPILE AND NOT RECOIL_SANITIZE)
  list(APPEND recoil_common_headers "${PROJECT_SOURCE_DIR}/src/config/case.hpp")
endif()

set(recoil_setup_sources ${recoil_sources})
list(FILTER recoil_setup_sources INCLUDE REGEX "/src/(app|config|record)/")
if(RECOIL_SANITIZE)
  set(recoil_format_sources ${recoil_sources})
  list(FILTER recoil_format_sources INCLUDE REGEX "/src/format/")
  list(APPEND recoil_setup_sources ${recoil_format_sources})
else()
  list(FILTER recoil_setup_sources EXCLUDE REGEX "/src/(config/shape|app/report/field_frames)")
endif()
add_library(recoil_setup OBJECT ${recoil_setup_sources})
target_link_libraries(recoil_setup PRIVATE recoil_flags recoil_little_optimised recoil_dependencies)
target_include_directories(recoil_setup PRIVATE "${PROJECT_SOURCE_DIR}/src" "${recoil_generated_dir}")
add_dependencies(recoil_setup recoil_build_info)

set(recoil_lib_sources ${recoil_sources})
list(REMOVE_ITEM recoil_lib_sources ${recoil_setup_sources})
list(APPEND recoil_lib_sources $<TARGET_OBJECTS:recoil_setup>)

if(RECOIL_PRECOMPILE AND NOT RECOIL_SANITIZE)
  set(recoil_caseless_sources ${recoil_sources})
  list(FILTER recoil_caseless_sources EXCLUDE REGEX "/src/(app|gauge|problem|record)/")
  set_source_files_properties(${recoil_caseless_sources} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
endif()
