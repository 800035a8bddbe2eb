# Script (cmake -P): builds the page of `recoil report` in `folder` from `source_dir` with `npm`, and writes it as
# page_bundle.cpp. Without npm, or where npm fails and `required` is not ON, the page is empty.

function(run_npm)
  execute_process(
    COMMAND "${npm}" ${ARGN}
    WORKING_DIRECTORY "${folder}"
    OUTPUT_VARIABLE said
    ERROR_VARIABLE said
    RESULT_VARIABLE failed)
  if(failed AND required STREQUAL "ON")
    message(FATAL_ERROR "npm ${ARGN} failed in ${folder}:\n${said}")
  elseif(failed)
    message(WARNING "npm ${ARGN} failed in ${folder}: the program is built without the page of `recoil report`\n${said}")
  endif()
  set(npm_failed "${failed}" PARENT_SCOPE)
endfunction()

function(build_page)
  file(REMOVE_RECURSE "${folder}/src" "${folder}/dist")
  file(COPY "${source_dir}/" DESTINATION "${folder}" PATTERN node_modules EXCLUDE PATTERN dist EXCLUDE)
  # node_modules is made anew only when the list of packages changes.
  file(SHA256 "${folder}/package-lock.json" wanted)
  set(present "")
  if(EXISTS "${folder}/node_modules/.recoil")
    file(READ "${folder}/node_modules/.recoil" present)
  endif()
  if(NOT wanted STREQUAL present)
    run_npm(ci --loglevel=error)
    if(npm_failed)
      return()
    endif()
    file(WRITE "${folder}/node_modules/.recoil" "${wanted}")
  endif()
  run_npm(run build --silent)
endfunction()

set(bytes "")
if(npm)
  build_page()
  if(EXISTS "${folder}/dist/index.html")
    file(READ "${folder}/dist/index.html" hex HEX)
    string(REGEX REPLACE "(..)" "0x\\1," bytes "${hex}")
    string(REGEX REPLACE "((0x..,){24})" "\\1\n" bytes "${bytes}")
  endif()
endif()
file(
  WRITE "${folder}/page_bundle.cpp"
  "#include \"app/report/page_bundle.hpp\"

namespace recoil::app {

namespace {
constexpr unsigned char page[] = {
${bytes}0};
}  // namespace

std::string_view page_bundle() { return {reinterpret_cast<const char*>(page), sizeof page - 1}; }

}  // namespace recoil::app
")
