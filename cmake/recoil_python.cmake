# The module `_material` of the Python package, which binds materials and their paths (python/native), by pybind11. Without a
# choice it is built with the tests where pybind11 and the headers of Python are there; -DRECOIL_PYTHON=ON insists on it.
# What it needs of the library is compiled again, position-independent: these files and no mesh, MPI or HDF5.

set(recoil_python_wanted "${RECOIL_PYTHON}")
if(NOT DEFINED RECOIL_PYTHON)
  set(recoil_python_wanted ${RECOIL_TESTS})
  set(recoil_python_required "")
else()
  set(recoil_python_required REQUIRED)
endif()
if(NOT recoil_python_wanted OR RECOIL_SANITIZE OR RECOIL_FUZZ)
  return()
endif()

if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3) # Debian's, for which its packages are
  set(Python_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python 3.11 ${recoil_python_required} QUIET COMPONENTS Interpreter Development.Module)
find_package(pybind11 2.10 ${recoil_python_required} QUIET CONFIG)
if(NOT Python_FOUND OR NOT pybind11_FOUND)
  message(STATUS "The Python module of materials is left out: python3-dev and pybind11-dev are needed")
  return()
endif()

set(recoil_point_sources ${recoil_sources})
list(FILTER recoil_point_sources INCLUDE REGEX "/src/(app/point|material|material/eos|config|config/habits)/[^/]*$")
list(FILTER recoil_point_sources EXCLUDE REGEX "/src/config/(case|read_case|explain|expected_columns|schema|kept_files|overrides)")
list(FILTER recoil_point_sources EXCLUDE REGEX "/src/material/(lint|ls_dyna|tabulate)")
foreach(file config/declare/write kernels/row_kernels dynamics/plastic_return dynamics/failed_matter gauge/point_state)
  list(APPEND recoil_point_sources "${PROJECT_SOURCE_DIR}/src/${file}.cpp")
endforeach()

pybind11_add_module(recoil_python_module MODULE NO_EXTRAS python/native/material_module.cpp ${recoil_point_sources})
set_target_properties(recoil_python_module PROPERTIES OUTPUT_NAME _material LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/python")
target_include_directories(recoil_python_module PRIVATE "${PROJECT_SOURCE_DIR}/src" "${recoil_generated_dir}")
target_link_libraries(recoil_python_module PRIVATE recoil_flags recoil_little_optimised recoil_dependencies)
target_link_options(recoil_python_module PRIVATE -Wl,--as-needed)
add_dependencies(recoil_python_module recoil_build_info)
if(recoil_has_main)
  install(TARGETS recoil_python_module LIBRARY DESTINATION "${RECOIL_PYTHON_DIR}/recoil" COMPONENT python)
endif()
