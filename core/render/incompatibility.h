// What stands in the way of a method, in words that say what to do about it.
#pragma once
#include <string>

#include "render/document.h"
#include "scene/forward.h"

namespace etendue::render {

// Why the document's method finds no light at all in this scene; empty if nothing stands in its way.
std::string incompatibility(const Document& document, const scene::CompiledScene& scene);

// Why render.adaptive does nothing with an integrator (it must be of the registry); empty if it does.
std::string adaptive_incompatibility(const std::string& integrator);

}  // namespace etendue::render
