# Warnings, sanitizers and the compiler cache, for every target of the project.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  # What ccache needs to cache files with precompiled headers [ccache manual, "Precompiled headers"].
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE_PROGRAM})
endif()

add_library(etendue_options INTERFACE)
# For all targets, because precompiled headers depend on it.
target_compile_options(etendue_options INTERFACE -pthread)
if(CCACHE_PROGRAM AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(etendue_options INTERFACE -fpch-preprocess)
endif()
target_compile_options(etendue_options INTERFACE
  -Wall -Wextra -Wpedantic -Werror -Wshadow -Wnon-virtual-dtor
  -Wno-restrict  # GCC 12 sees overlaps in std::string + std::string that are not there (PR 105329)
  -fno-math-errno -fno-trapping-math)
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  # GCC is the compiler whose warnings are errors. Without time stamps, ccache can cache precompiled headers.
  target_compile_options(etendue_options INTERFACE -w "SHELL:-Xclang -fno-pch-timestamp")
endif()
# Vectors of three that were just written number by number stall when they are read back as four: bundling scalar code into
# vector loads makes the sampling loop a third slower. Loops are still vectorised.
target_compile_options(etendue_options INTERFACE -fno-tree-slp-vectorize $<$<CXX_COMPILER_ID:GNU>:-fno-store-merging>)
# Contraction would make an image depend on the compiler's choice of fused operations.
target_compile_options(etendue_options INTERFACE -ffp-contract=off)

set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(CMAKE_CXX_FLAGS_DEBUG "-O0 -g")

if(ETENDUE_PROFILE)
  target_compile_options(etendue_options INTERFACE -g -fno-omit-frame-pointer)
endif()
if(ETENDUE_COVERAGE)
  target_compile_options(etendue_options INTERFACE --coverage)
  target_link_options(etendue_options INTERFACE --coverage)
endif()

if(ETENDUE_SANITIZE)
  # With sanitizers in between, GCC 12 no longer sees that a variant's string is there when it is read.
  target_compile_options(etendue_options INTERFACE -Wno-maybe-uninitialized)
  target_compile_options(etendue_options INTERFACE -fsanitize=${ETENDUE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(etendue_options INTERFACE -fsanitize=${ETENDUE_SANITIZE})
endif()
# With sanitizers, a program does not unload libraries before its end.
function(etendue_keep_libraries target)
  if(ETENDUE_SANITIZE)
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/keep_libraries.cpp)
    target_link_options(${target} PRIVATE -Wl,--export-dynamic-symbol=dlclose)
  endif()
endfunction()
if(ETENDUE_LIBFUZZER)
  # Counts executed branches, which guides libFuzzer. Programs with a main function are linked as usual.
  target_compile_options(etendue_options INTERFACE -fsanitize=fuzzer-no-link)
endif()
