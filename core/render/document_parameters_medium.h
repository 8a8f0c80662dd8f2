// The parameters of a participating medium, in the section of the material or atmosphere that it belongs to.
#pragma once
#include <functional>

#include "render/document_parameters.h"

namespace etendue::render {

// How the medium is named, and where it is stored in a scene.
struct MediumOwner {
  std::string section;
  std::function<MediumDescription&(scene::Scene&)> medium;
};

// Preset, coefficients, the phase function and the density with their parameters, and emission.
void add_medium_parameters(DocumentParameters& list, const MediumOwner& owner, const MediumDescription& medium);

}  // namespace etendue::render
