# Script (cmake -P): asks git for the state of the tree and fills in build_info.hpp.in.

set(describe "unknown")
find_program(git_program git)
if(git_program)
  execute_process(
    COMMAND "${git_program}" describe --always --dirty --tags
    WORKING_DIRECTORY "${source_dir}"
    OUTPUT_VARIABLE described
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
    RESULT_VARIABLE failed)
  if(NOT failed AND described)
    set(describe "${described}")
  endif()
endif()
configure_file("${CMAKE_CURRENT_LIST_DIR}/build_info.hpp.in" "${output}" @ONLY)
