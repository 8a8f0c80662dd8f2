# A room is a library that sees only the rooms it names.
#
#   etendue_room(NAME [ROOMS room...] [USES public library...] [HIDES private library...])
#
# Its sources are every .cpp in its folder. Its headers are included as "NAME/header.h" through a folder of links that
# holds nothing but this room, so that including a room which is not named is an error of the compiler.
function(etendue_room name)
  cmake_parse_arguments(ROOM "" "" "ROOMS;USES;HIDES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  set(door ${CMAKE_BINARY_DIR}/rooms/${name})
  file(MAKE_DIRECTORY ${door})
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR}/${name} ${door}/${name} SYMBOLIC)

  list(TRANSFORM ROOM_ROOMS PREPEND etendue_)
  if(sources)
    add_library(etendue_${name} STATIC ${sources})
    target_include_directories(etendue_${name} PUBLIC ${door})
    target_link_libraries(etendue_${name} PUBLIC ${ROOM_ROOMS} ${ROOM_USES} PRIVATE ${ROOM_HIDES} etendue_options)
  else()
    add_library(etendue_${name} INTERFACE)
    target_include_directories(etendue_${name} INTERFACE ${door})
    target_link_libraries(etendue_${name} INTERFACE ${ROOM_ROOMS} ${ROOM_USES} ${ROOM_HIDES})
  endif()
endfunction()
