# Run by `cmake --install` (recoil_install.cmake): writes the manual page and the completions by the program that is being
# installed, and installs them, with the licences of what is compiled into it.

cmake_policy(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/recoil_version.cmake")
recoil_find_version("${recoil_source_dir}" "${recoil_project_version}" version)
file(MAKE_DIRECTORY "${recoil_work_dir}")

# say(FILE WORDS...): what the program prints, with the data of the source tree and none of the user's.
function(say file)
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -E env --unset=RECOIL_MATERIALS "RECOIL_DATA=${recoil_source_dir}" "${recoil_program}" ${ARGN}
    OUTPUT_FILE "${recoil_work_dir}/${file}" COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# put(FILE FOLDER NAME): a file of the work folder, below the prefix (and DESTDIR).
function(put file folder name)
  file(INSTALL "${recoil_work_dir}/${file}" DESTINATION "${CMAKE_INSTALL_PREFIX}/${folder}" RENAME "${name}")
endfunction()

function(compress file)
  execute_process(COMMAND gzip -9nf "${recoil_work_dir}/${file}" COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The licence of a package, with those of what is compiled into it (ARGN), and its history, which is that of git.
function(put_documents package)
  file(READ "${recoil_source_dir}/cmake/copyright.in" own)
  string(CONCAT text "${own}" ${ARGN})
  file(WRITE "${recoil_work_dir}/copyright" "${text}")
  put(copyright "share/doc/${package}" copyright)
  file(WRITE "${recoil_work_dir}/changelog" "${package} (${version}) unstable; urgency=medium

  * As of ${version}. What is new: docs/changes in the source.

 -- The Recoil developers <recoil@recoil.invalid>  ${date}
")
  compress(changelog)
  put(changelog.gz "share/doc/${package}" changelog.gz)
endfunction()

execute_process(
  COMMAND git -C "${recoil_source_dir}" log -1 --format=%aD
  OUTPUT_VARIABLE date
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT date)
  string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
endif()
if(recoil_part STREQUAL python)
  put_documents(python3-recoil)
  return()
endif()

say(recoil.bash completion bash)
put(recoil.bash share/bash-completion/completions recoil)
say(recoil.zsh completion zsh)
put(recoil.zsh "${recoil_zsh_dir}" _recoil)
say(recoil.fish completion fish)
put(recoil.fish share/fish/vendor_completions.d recoil.fish)

if(recoil_python)
  say(commands.md commands)
  execute_process(
    COMMAND "${recoil_python}" -B "${recoil_source_dir}/tools/command_page.py" "${version}"
    INPUT_FILE "${recoil_work_dir}/commands.md"
    OUTPUT_FILE "${recoil_work_dir}/recoil.1" COMMAND_ERROR_IS_FATAL ANY)
  compress(recoil.1)
  put(recoil.1.gz share/man/man1 recoil.1.gz)
else()
  message(STATUS "No manual page: there was no Python when this was configured")
endif()

# Headers and scripts that become parts of the program, with their own terms.
set(others "Compiled into the program is work of others, under the following terms.\n\n")
foreach(package libcli11-dev libtomlplusplus-dev nlohmann-json3-dev)
  if(EXISTS "/usr/share/doc/${package}/copyright")
    file(READ "/usr/share/doc/${package}/copyright" text)
    string(APPEND others "${package}\n\n${text}\n\n")
  endif()
endforeach()
if(EXISTS "${recoil_page_folder}/node_modules/uplot/LICENSE")
  file(READ "${recoil_page_folder}/node_modules/uplot/LICENSE" text)
  string(APPEND others "uPlot (the page of a run)\n\n${text}\n")
endif()
put_documents(recoil "${others}")
