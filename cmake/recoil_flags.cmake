# Compiler flags of our own code, as the target recoil_flags. Why these: docs/decisions/0001-flags-and-determinism.md.

add_library(recoil_flags INTERFACE)
target_compile_options(
  recoil_flags
  INTERFACE -Wall
            -Wextra
            -Wconversion
            -fno-math-errno
            -fno-trapping-math
            -ffp-contract=off
            -fopenmp-simd)
# After inlining, g++ 12 sees overlaps and overruns inside std::string, std::vector and nlohmann::json where there are none
# (GCC bug 105651 and its kin). AddressSanitizer looks for the real ones.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(recoil_flags INTERFACE -Wno-restrict -Wno-array-bounds -Wno-stringop-overread
                                                -Wno-stringop-overflow)
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  # The sanitized build and the fuzzers. Warnings are asked of g++; clang++ has others, one for each loop marked
  # `omp simd` that it does not vectorise among them.
  target_compile_options(recoil_flags INTERFACE -w)
endif()
if(RECOIL_WERROR)
  target_compile_options(recoil_flags INTERFACE -Werror)
endif()
if(RECOIL_NATIVE)
  target_compile_options(recoil_flags INTERFACE -march=native)
endif()
if(RECOIL_SANITIZE)
  # Without those that AddressSanitizer sees as well where memory is touched: they took 18 to 46 % of the time
  # to compile a file (decision 0001).
  set(recoil_sanitizers -fsanitize=address,undefined -fno-sanitize=null,alignment,vptr,object-size -fno-sanitize-recover=all)
  target_compile_options(recoil_flags INTERFACE ${recoil_sanitizers} -O2 -g1 -fno-omit-frame-pointer)
  target_compile_definitions(recoil_flags INTERFACE _GLIBCXX_ASSERTIONS)
  target_link_options(recoil_flags INTERFACE ${recoil_sanitizers})
endif()
if(RECOIL_COVERAGE)
  # Threads count at the same time: without atomic counters some would go wrong.
  target_compile_options(recoil_flags INTERFACE --coverage -fprofile-update=prefer-atomic -O1 -g1)
  target_link_options(recoil_flags INTERFACE --coverage)
endif()

# For files that take no time in a run, the tests' own among them, as the target recoil_little_optimised, which has to come
# after recoil_flags: each is compiled in about half the time.
add_library(recoil_little_optimised INTERFACE)
if(RECOIL_SANITIZE)
  target_compile_options(recoil_little_optimised INTERFACE -O0)
elseif(CMAKE_BUILD_TYPE STREQUAL "Release")
  target_compile_options(recoil_little_optimised INTERFACE -O1)
endif()
