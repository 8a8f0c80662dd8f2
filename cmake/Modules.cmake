# A module is a static library with a public include directory of its own: its headers are included as "NAME/header.h".
#
#   etendue_module(NAME [FAST_TO_COMPILE [file...]] [DEPENDS module...] [INTERNAL module...] [PUBLIC library...]
#                  [PRIVATE library...] [WITHOUT_PRECOMPILED])
#
#   DEPENDS    modules whose headers appear in the headers of this module
#   INTERNAL   modules whose headers appear in its .cpp files only
#   PUBLIC     external libraries whose headers appear in its headers
#   PRIVATE    external libraries that only its .cpp files use
#   FAST_TO_COMPILE  patterns of files without inner loops, which are compiled with less optimisation; a pattern
#              matches in all folders below the one that it names
#   WITHOUT_PRECOMPILED  without the precompiled standard headers
#
# The include directory holds nothing but the module, so a module cannot include another one that neither it nor one of
# its dependencies names. The test `Modules` compares both lists with the actual includes (tests/unit/project).
set_property(GLOBAL PROPERTY ETENDUE_MODULES "")

function(etendue_module name)
  cmake_parse_arguments(MODULE "WITHOUT_PRECOMPILED" "" "DEPENDS;INTERNAL;PUBLIC;PRIVATE;FAST_TO_COMPILE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  set(include_directory ${CMAKE_BINARY_DIR}/include/${name})
  file(MAKE_DIRECTORY ${include_directory})
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR}/${name} ${include_directory}/${name} SYMBOLIC)

  add_library(etendue_${name} STATIC ${sources})
  target_include_directories(etendue_${name} PUBLIC ${include_directory})
  set(modules ${MODULE_DEPENDS})
  set(internal ${MODULE_INTERNAL})
  list(TRANSFORM modules PREPEND etendue_)
  list(TRANSFORM internal PREPEND etendue_)
  target_link_libraries(etendue_${name} PUBLIC ${modules} ${MODULE_PUBLIC}
                        PRIVATE ${internal} ${MODULE_PRIVATE} etendue_options)
  if(NOT MODULE_WITHOUT_PRECOMPILED)
    etendue_use_precompiled(etendue_${name} etendue_precompiled_std)
  endif()
  list(TRANSFORM MODULE_FAST_TO_COMPILE PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/${name}/)
  if(MODULE_FAST_TO_COMPILE)
    file(GLOB_RECURSE files CONFIGURE_DEPENDS ${MODULE_FAST_TO_COMPILE})
    set_source_files_properties(${files} PROPERTIES COMPILE_OPTIONS "${ETENDUE_FAST_TO_COMPILE}")
  endif()

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
