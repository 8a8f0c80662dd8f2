# A module is a static library with a public include directory of its own: its headers are included as "NAME/header.h".
#
#   etendue_module(NAME [FAST_TO_COMPILE [file...]] [DEPENDS module...] [INTERNAL module...] [PUBLIC library...]
#                  [PRIVATE library...] [WITHOUT_PRECOMPILED] [GROUP count])
#
#   DEPENDS    modules whose headers appear in the headers of this module
#   INTERNAL   modules whose headers appear in its .cpp files only
#   PUBLIC     external libraries whose headers appear in its headers
#   PRIVATE    external libraries that only its .cpp files use
#   FAST_TO_COMPILE  patterns of files without inner loops, which are compiled with less optimisation; a pattern
#              matches in all folders below the one that it names
#   WITHOUT_PRECOMPILED  without the precompiled standard headers
#   GROUP      the number of files that are compiled together (BuildTime.cmake)
#
# The include directory holds nothing but the module, so a module cannot include another one that neither it nor one of
# its dependencies names. The test `Modules` compares both lists with the actual includes (tests/unit/project).
set_property(GLOBAL PROPERTY ETENDUE_MODULES "")

function(etendue_module name)
  cmake_parse_arguments(MODULE "WITHOUT_PRECOMPILED" "GROUP" "DEPENDS;INTERNAL;PUBLIC;PRIVATE;FAST_TO_COMPILE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  set(include_directory ${CMAKE_BINARY_DIR}/include/${name})
  file(MAKE_DIRECTORY ${include_directory})
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR}/${name} ${include_directory}/${name} SYMBOLIC)

  set(modules ${MODULE_DEPENDS})
  set(internal ${MODULE_INTERNAL})
  list(TRANSFORM modules PREPEND etendue_)
  list(TRANSFORM internal PREPEND etendue_)
  set(public_libraries ${modules} ${MODULE_PUBLIC})
  set(private_libraries ${internal} ${MODULE_PRIVATE} etendue_options)
  set(files_without_loops)
  if(MODULE_FAST_TO_COMPILE)
    list(TRANSFORM MODULE_FAST_TO_COMPILE PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/${name}/)
    file(GLOB_RECURSE files_without_loops CONFIGURE_DEPENDS ${MODULE_FAST_TO_COMPILE})
    list(REMOVE_ITEM sources ${files_without_loops})
    add_library(etendue_${name}_without_loops OBJECT ${files_without_loops})
    target_include_directories(etendue_${name}_without_loops PRIVATE ${include_directory})
    target_link_libraries(etendue_${name}_without_loops PRIVATE ${public_libraries} ${private_libraries})
    target_compile_options(etendue_${name}_without_loops PRIVATE ${ETENDUE_FAST_TO_COMPILE})
    list(APPEND sources $<TARGET_OBJECTS:etendue_${name}_without_loops>)
  endif()
  add_library(etendue_${name} STATIC ${sources})
  target_include_directories(etendue_${name} PUBLIC ${include_directory})
  target_link_libraries(etendue_${name} PUBLIC ${public_libraries} PRIVATE ${private_libraries})
  set(targets etendue_${name})
  if(files_without_loops)
    list(APPEND targets etendue_${name}_without_loops)
  endif()
  foreach(target ${targets})
    etendue_compile_together(${target} ${MODULE_GROUP})
    if(NOT MODULE_WITHOUT_PRECOMPILED)
      etendue_use_precompiled(${target} etendue_precompiled_std)
    endif()
  endforeach()

  file(RELATIVE_PATH folder ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/${name})
  string(REPLACE ";" "," depends "${MODULE_DEPENDS}")
  string(REPLACE ";" "," internal "${MODULE_INTERNAL}")
  set_property(GLOBAL APPEND PROPERTY ETENDUE_MODULES "${name}|${folder}|${depends}|${internal}")
endfunction()

# Writes one line per module, "name|folder|depends|internal", for the test that compares them with the includes.
function(etendue_write_modules file)
  get_property(modules GLOBAL PROPERTY ETENDUE_MODULES)
  string(REPLACE ";" "\n" text "${modules}")
  file(CONFIGURE OUTPUT ${file} CONTENT "${text}\n" @ONLY)
endfunction()
