// Reasons why an integrator cannot render a document, with a remedy.
#pragma once
#include <string>

#include "render/document.h"
#include "scene/forward.h"

namespace etendue::render {

// Why the integrator of a document finds no light at all in this scene; empty if it may find some.
std::string incompatibility(const Document& document, const scene::CompiledScene& scene);

// Why adaptive sampling (render.adaptive) has no effect with an integrator of the registry; empty if it has one.
std::string adaptive_incompatibility(const std::string& integrator);

}  // namespace etendue::render
