// The scene of a document as it is written to a file.
#pragma once
#include "render/document.h"

namespace etendue::render {

// The document's scene with its camera, without the environment that new_document added to an unlit scene. If
// the camera is still at the position of its node, its lens and projection are stored there. If it was moved, it
// becomes the first camera of the scene, with the name "view".
scene::Scene scene_to_save(const Document& document);

}  // namespace etendue::render
