# What `cmake --install` puts where, in two components: `program`, and `python` with the Python package.

find_package(Python3 COMPONENTS Interpreter)
set(RECOIL_PYTHON_DIR "lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/dist-packages"
    CACHE STRING "Where the Python package goes, below the prefix; the default is what Debian's Python reads below /usr/local")
set(RECOIL_ZSH_DIR "share/zsh/site-functions" CACHE STRING "Where completion for zsh goes, below the prefix")

install(TARGETS recoil RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT program)
install(
  DIRECTORY materials cases templates
  DESTINATION "${CMAKE_INSTALL_DATADIR}/recoil"
  COMPONENT program
  PATTERN __pycache__ EXCLUDE)
# The cases name their schema by its place beside them.
install(DIRECTORY docs/reference DESTINATION "${CMAKE_INSTALL_DATADIR}/recoil/docs" COMPONENT program)
install(FILES README.md CITATION.cff DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program)

# Manual page and completion come from the program itself, once it is built; licence and history.
foreach(part program python)
  install(
    CODE "set(recoil_part ${part})
        set(recoil_program \"$<TARGET_FILE:recoil>\")
        set(recoil_source_dir \"${PROJECT_SOURCE_DIR}\")
        set(recoil_project_version \"${PROJECT_VERSION}\")
        set(recoil_work_dir \"${PROJECT_BINARY_DIR}/install\")
        set(recoil_python \"${Python3_EXECUTABLE}\")
        set(recoil_zsh_dir \"${RECOIL_ZSH_DIR}\")
        set(recoil_page_folder \"${recoil_page_folder}\")
        include(\"${PROJECT_SOURCE_DIR}/cmake/install_generated.cmake\")"
    COMPONENT ${part})
endforeach()

install(
  DIRECTORY python/recoil
  DESTINATION "${RECOIL_PYTHON_DIR}"
  COMPONENT python
  FILES_MATCHING
  PATTERN "*.py")
# By this `importlib.metadata` and pip know the package and its version.
set(recoil_python_info "${PROJECT_BINARY_DIR}/recoil-${PROJECT_VERSION}.dist-info")
file(WRITE "${recoil_python_info}/METADATA" "Metadata-Version: 2.1\nName: recoil\nVersion: ${PROJECT_VERSION}\n"
                                            "Summary: Reads runs of the hydrocode Recoil, and starts them\n")
file(WRITE "${recoil_python_info}/INSTALLER" "cmake\n")
install(DIRECTORY "${recoil_python_info}" DESTINATION "${RECOIL_PYTHON_DIR}" COMPONENT python)
