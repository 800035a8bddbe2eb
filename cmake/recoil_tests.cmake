# The unit tests: one program, one CTest entry per test. tests/CMakeLists.txt, where present, adds the tests that
# need several ranks (recoil_add_mpi_test) or the whole program.

file(GLOB_RECURSE recoil_test_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/unit/*.cpp")

# Containers and CI run as root, with fewer cores than ranks. A test of one process starts no daemon of Open MPI.
set(recoil_test_environment OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_ess_singleton_isolated=1
                            OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1 GTEST_COLOR=no)
if(RECOIL_SANITIZE)
  # No leak check: Open MPI unloads its plug-ins before it would run, so that what they leave cannot be told by name.
  list(APPEND recoil_test_environment
       "ASAN_OPTIONS=detect_leaks=0"
       "UBSAN_OPTIONS=print_stacktrace=1")
endif()

# Runs the tests that match a GoogleTest filter on several ranks: recoil_add_mpi_test(halo "Halo.*" 1 2 3)
function(recoil_add_mpi_test name filter)
  foreach(ranks IN LISTS ARGN)
    set(test "mpi.${name}.${ranks}")
    add_test(NAME "${test}" COMMAND "${MPIEXEC_EXECUTABLE}" --oversubscribe -n ${ranks} $<TARGET_FILE:recoil_tests>
                                    "--gtest_filter=${filter}")
    # A filter that matches nothing must not pass.
    set_tests_properties(
      "${test}"
      PROPERTIES ENVIRONMENT "${recoil_test_environment}"
                 PROCESSORS ${ranks}
                 TIMEOUT 600
                 LABELS mpi
                 FAIL_REGULAR_EXPRESSION "Running 0 tests")
  endforeach()
endfunction()

if(recoil_test_sources)
  find_package(GTest REQUIRED)
  find_package(rapidcheck REQUIRED)
  include(GoogleTest)
  add_executable(recoil_tests ${recoil_test_sources})
  target_compile_definitions(recoil_tests PRIVATE RECOIL_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(recoil_tests PRIVATE recoil_lib recoil_flags recoil_little_optimised rapidcheck rapidcheck_gtest
                                             GTest::gtest GTest::gtest_main)
  add_dependencies(recoil_tests recoil_build_info)
  recoil_compile_by_folder(recoil_tests "${PROJECT_SOURCE_DIR}/tests/unit" 1)
  if(RECOIL_SANITIZE)
    # Saves about two seconds a file. Only here: in the other builds every file has to bring its includes itself.
    target_precompile_headers(recoil_tests PRIVATE <fmt/format.h> <gtest/gtest.h> <algorithm> <array> <cmath> <filesystem>
                              <functional> <string> <vector>)
  endif()
  if(RECOIL_SANITIZE)
    # Sanitized code is about 25 times slower. Left out are runs of seconds that compare numbers; shorter tests, or the
    # same one in fewer dimensions, go through the same code. A process takes 0.3 to 0.4 s to start: tests run in groups.
    set(recoil_long_tests
        BlockSize.DoesNotShowInSpace
        FieldPicture.OutlinesAreDark
        Fracture/2.AScabFliesOff
        Fracture/2.BlocksAndThreadsDoNotMatter
        MovingStrain.KeepsItsProfileAtAnyAngle
        NonlocalDamage/2.BlocksAndThreadsDoNotMatter
        NonlocalDamage/2.BudgetsClose
        OneStage.AWaveAcrossSpaceConvergesAtSecondOrder
        PictureFile.SameFieldGivesTheSameBytes
        Regrid/1.PlatesAreAsOnTheFinestMesh
        Regrid/1.ThreadsGiveTheSameBits
        Regrid/2.PlatesAreAsOnTheFinestMesh
        Regrid/2.RandomLevelsKeepSumsAndLinearFields
        Regrid/2.ThreadsGiveTheSameBits
        Schemes/GhostFluid.ThreadsAndBlocksGiveTheSameBits/Seed
        ShortWavesAlongSurfaces.*)
    list(JOIN recoil_long_tests ":" recoil_long_tests)
    set(recoil_test_groups 24)
    math(EXPR last "${recoil_test_groups} - 1")
    foreach(group RANGE ${last})
      add_test(NAME "unit.${group}" COMMAND recoil_tests --gtest_brief=1 "--gtest_filter=-${recoil_long_tests}")
      set_tests_properties(
        "unit.${group}"
        PROPERTIES ENVIRONMENT "${recoil_test_environment};GTEST_TOTAL_SHARDS=${recoil_test_groups};GTEST_SHARD_INDEX=${group}"
                   TIMEOUT 1200
                   LABELS unit)
    endforeach()
  else()
    gtest_discover_tests(recoil_tests DISCOVERY_TIMEOUT 300 PROPERTIES TIMEOUT 600 LABELS unit)
  endif()
  # gtest_discover_tests cannot pass a list as a property's value, so the environment is set when CTest reads the tests.
  file(WRITE "${PROJECT_BINARY_DIR}/recoil_tests_environment.cmake"
       "set_tests_properties(\${recoil_tests_TESTS} PROPERTIES ENVIRONMENT [==[${recoil_test_environment}]==])\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${PROJECT_BINARY_DIR}/recoil_tests_environment.cmake")
endif()

if(EXISTS "${PROJECT_SOURCE_DIR}/tests/CMakeLists.txt")
  add_subdirectory(tests)
endif()
