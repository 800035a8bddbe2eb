# With RECOIL_UNITY the files of a folder are compiled as one, which reads their common headers once: half the time in a clean
# build, more after a change to a single file. Names in the anonymous namespaces of files that share a folder must differ; the
# unit tests have a namespace for each file. Kernels are compiled file by file in every build.
# recoil_compile_by_folder(TARGET ROOT DEPTH): groups are the folders below ROOT, DEPTH (1 or 2) deep.
function(recoil_compile_by_folder target root depth)
  if(NOT RECOIL_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage) # it takes the files for headers
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    file(RELATIVE_PATH path "${root}" "${source}")
    string(REPLACE "/" ";" parts "${path}")
    list(POP_BACK parts)
    list(SUBLIST parts 0 ${depth} folders)
    string(JOIN "_" group ${folders})
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${group}")
  endforeach()
endfunction()
