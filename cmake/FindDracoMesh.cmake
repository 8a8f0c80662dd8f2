# draco_mesh: Draco's static library without its reader of glTF. That one brings an own tinygltf along, of another
# version, whose functions would take the place of ours wherever the linker meets them first (in the shared library too).
find_package(draco CONFIG REQUIRED)
get_target_property(draco_archive draco::draco_static IMPORTED_LOCATION_NONE)
get_target_property(draco_include draco::draco_static INTERFACE_INCLUDE_DIRECTORIES)

set(draco_copy ${CMAKE_BINARY_DIR}/libdraco_mesh.a)
if(NOT EXISTS ${draco_copy} OR ${draco_archive} IS_NEWER_THAN ${draco_copy})
  file(COPY_FILE ${draco_archive} ${draco_copy})
  execute_process(COMMAND ${CMAKE_AR} d ${draco_copy} tiny_gltf_utils.cc.o gltf_decoder.cc.o COMMAND_ERROR_IS_FATAL ANY)
  file(TOUCH ${draco_copy})
endif()

add_library(draco_mesh STATIC IMPORTED GLOBAL)
set_target_properties(draco_mesh PROPERTIES IMPORTED_LOCATION ${draco_copy} INTERFACE_INCLUDE_DIRECTORIES "${draco_include}")
set(DracoMesh_FOUND TRUE)
