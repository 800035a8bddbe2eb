# The library in two groups of files, to compile it sooner; results have the same bits.
# Folders that take no time in a run are optimised less (recoil_little_optimised): app, config, record, but for shapes, which
# the start of a run asks for millions of distances, and what packs and draws fields.
# The sanitized build precompiles common headers; other builds bring every file's includes to light.

set(recoil_common_headers <fmt/format.h> <algorithm> <array> <cmath> <filesystem> <functional> <map> <optional> <string>
                          <variant> <vector>)

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
recoil_compile_by_folder(recoil_setup "${PROJECT_SOURCE_DIR}/src" 2)

set(recoil_lib_sources ${recoil_sources})
list(REMOVE_ITEM recoil_lib_sources ${recoil_setup_sources})
list(APPEND recoil_lib_sources $<TARGET_OBJECTS:recoil_setup>)
