# What shortens the build: precompiled standard headers, source files that are compiled together, and less optimisation
# where it does not matter.
#
# Most of the time to compile an ordinary source file is spent on headers. Standard headers are precompiled once, together
# with glm; headers of the project are not, so that editing one recompiles only the files that include it. The source
# files of a module are compiled in groups, so that their headers are read once per group: a first build takes half the
# time, and recompiling one file takes as long as its group. Turn the groups off if you edit more than you build. The
# preset `separate` turns off both means, and so checks that every file includes what it uses.
option(ETENDUE_PRECOMPILE "Precompile standard headers" ON)
option(ETENDUE_UNITY "Compile the source files of a module in groups" ON)

# In precompiled headers GCC 12 does not suppress its wrong warnings about std::string (PR 105329, PR 105651).
if(ETENDUE_PRECOMPILE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(etendue_options INTERFACE -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
endif()

set(ETENDUE_STANDARD_HEADERS
  <algorithm> <array> <atomic> <bit> <chrono> <cmath> <cstdint> <cstdio> <filesystem> <functional> <map> <memory> <mutex>
  <numeric> <optional> <set> <span> <string> <string_view> <thread> <tuple> <unordered_map> <utility> <variant> <vector>
  <glm/glm.hpp>)

# etendue_precompiled(NAME [header...] LIBRARIES library...): a target whose precompiled headers other targets reuse.
function(etendue_precompiled name)
  cmake_parse_arguments(PRECOMPILED "" "" "LIBRARIES" ${ARGN})
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/${name}.cpp CONTENT "// The precompiled headers of this target are reused.\n")
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE glm::glm etendue_options ${PRECOMPILED_LIBRARIES})
  if(ETENDUE_PRECOMPILE)
    target_precompile_headers(${name} PRIVATE ${ETENDUE_STANDARD_HEADERS} ${PRECOMPILED_UNPARSED_ARGUMENTS})
  endif()
endfunction()

# etendue_use_precompiled(TARGET NAME)
function(etendue_use_precompiled target name)
  if(ETENDUE_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM ${name})
    # CMake would compile programs with -fPIE, and precompiled headers require equal options.
    get_target_property(type ${target} TYPE)
    if(type STREQUAL EXECUTABLE)
      set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
      target_compile_options(${target} PRIVATE -fPIC)
    endif()
  endif()
endfunction()

# etendue_compile_together(TARGET [FILES]): compiles the source files of a target in groups of this many, by default 8.
function(etendue_compile_together target)
  if(ETENDUE_UNITY)
    set(files ${ARGN} 8)
    list(GET files 0 files)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${files})
    # GCC regards the private types of such a file as types of an included file.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

# The optimisation of code without inner loops, which takes less time to compile.
set(ETENDUE_FAST_TO_COMPILE $<$<CONFIG:Release>:-O1>)

etendue_precompiled(etendue_precompiled_std)
