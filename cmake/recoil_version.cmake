# The version by git: recoil_find_version(SOURCE_DIR PROJECT_VERSION RESULT) sets RESULT to
#   0.1.0                 at the tag v0.1.0, and where there is no git (a tarball);
#   0.1.0+5.g1a2b3c4      five commits after that tag;
#   0.1.0+g1a2b3c4        where no commit before has a tag; 0.1.0 is then the version of the project.
# Files that differ from the commit add ".dirty". As a script (cmake -P) it prints that of this source tree.

function(recoil_find_version source_dir project_version result)
  set(version "${project_version}")
  find_program(RECOIL_GIT git)
  if(RECOIL_GIT AND EXISTS "${source_dir}/.git") # not of a repository around a tarball
    execute_process(
      COMMAND "${RECOIL_GIT}" describe --always --dirty --tags --match "v[0-9]*"
      WORKING_DIRECTORY "${source_dir}"
      OUTPUT_VARIABLE described
      OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
      RESULT_VARIABLE failed)
    string(REPLACE "-dirty" ".dirty" described "${described}")
    if(failed OR NOT described)
      # a repository that git cannot or may not read
    elseif(described MATCHES "^v([0-9.]*[0-9])$")
      set(version "${CMAKE_MATCH_1}")
    elseif(described MATCHES "^v([0-9.]*[0-9])\\.dirty$")
      set(version "${CMAKE_MATCH_1}+dirty")
    elseif(described MATCHES "^v(.*)-([0-9]+)-(g[0-9a-f]+.*)$")
      set(version "${CMAKE_MATCH_1}+${CMAKE_MATCH_2}.${CMAKE_MATCH_3}")
    else()
      set(version "${project_version}+g${described}")
    endif()
  endif()
  set(${result} "${version}" PARENT_SCOPE)
endfunction()

if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  get_filename_component(source_dir "${CMAKE_CURRENT_LIST_DIR}" DIRECTORY)
  file(STRINGS "${source_dir}/CMakeLists.txt" line REGEX "^project\\(recoil VERSION")
  string(REGEX MATCH "[0-9.]+[0-9]" project_version "${line}")
  recoil_find_version("${source_dir}" "${project_version}" version)
  message("${version}")
endif()
