// New documents from scenes that are loaded in steps.
#pragma once
#include <string>

#include "base/result.h"
#include "render/document.h"
#include "scene/gltf/load_gltf.h"

namespace etendue::render {

// A new document for a scene that `new_document` would load from this file, or that it has loaded in part.
Result<Document> document_of(scene::Scene scene, const std::string& scene_file_or_name, const std::string& camera = "");

// new_document with options for the loading of a file.
Result<Document> new_document(const std::string& scene_file_or_name, const std::string& camera,
                              const scene::LoadOptions& options);

}  // namespace etendue::render
