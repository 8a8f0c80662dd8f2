// The integrators among which the automatic choice selects: those that the user allows, that support the scene, and
// that find all of its light.
#pragma once
#include <string>
#include <vector>

#include "render/document.h"
#include "scene/forward.h"
#include "transport/path_expression/automaton.h"

namespace etendue::advisor {

struct AllowedMethod {
  render::MethodSettings method;
  std::string refusal;  // why it is not a candidate; empty if it is
  // If the only reason is that it does not find these paths of point, spot and directional lights: the paths. It may
  // still be used if they carry little energy.
  transport::Automaton missing_of_points = {};
};

// All integrators of the registry, each with the sampler, the path expression and the maximum path depth of the
// document. Nothing is rendered: an integrator is complete if it declares all paths that the document requests and that
// the materials of the scene permit. For point, spot and directional lights, where no integrator finds all paths, it
// must find those of the reference integrator (reference_integrator.h).
std::vector<AllowedMethod> allowed_methods(const render::Document& document, const scene::CompiledScene& scene);

}  // namespace etendue::advisor
