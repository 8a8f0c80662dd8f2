// Parameters of the textures of a material: "material.N.texture.SLOT" and its transform.
#pragma once
#include "render/document_parameters.h"

namespace etendue::render {

// For each slot, the index of its texture; if it has one, also the set of texture coordinates and their transform.
void add_texture_parameters(DocumentParameters& list, const scene::Scene& scene, size_t material,
                            const std::string& section);

}  // namespace etendue::render
