// A document's scene as a file is to have it.
#pragma once
#include "render/document.h"

namespace etendue::render {

// With the camera that was looked through: where it still stands at its node, its lens and projection go there; where
// it was moved, it comes along as the first camera, "view". Without the neutral light that new_document added.
scene::Scene scene_to_save(const Document& document);

}  // namespace etendue::render
