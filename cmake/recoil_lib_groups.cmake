# The library of the sanitized build. It is compiled once and its tests run for minutes, so that compiling costs more
# than running: folders that take no time in a run are not optimised (half the time to compile), and common headers are
# precompiled. Other builds do neither; there every file has to bring its own includes.

set(recoil_common_headers <fmt/format.h> <algorithm> <array> <cmath> <filesystem> <functional> <map> <optional> <string>
                          <variant> <vector>)

set(recoil_unoptimised_sources ${recoil_sources})
list(FILTER recoil_unoptimised_sources INCLUDE REGEX "/src/(app|config|format|record)/")
add_library(recoil_unoptimised OBJECT ${recoil_unoptimised_sources})
target_link_libraries(recoil_unoptimised PRIVATE recoil_flags recoil_little_optimised recoil_dependencies)
target_include_directories(recoil_unoptimised PRIVATE "${PROJECT_SOURCE_DIR}/src" "${recoil_generated_dir}")
target_precompile_headers(recoil_unoptimised PRIVATE ${recoil_common_headers})
add_dependencies(recoil_unoptimised recoil_build_info)

list(REMOVE_ITEM recoil_lib_sources ${recoil_unoptimised_sources})
list(APPEND recoil_lib_sources $<TARGET_OBJECTS:recoil_unoptimised>)
