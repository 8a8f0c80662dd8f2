// The paths that a method declares to find: the declaration of its integrator, restricted by its settings.
#pragma once
#include "integrator/integrator_info.h"
#include "render/document.h"
#include "scene/forward.h"
#include "transport/path_expression/path_expression.h"

namespace etendue::advisor {

// Two sets of paths: from lights with an extent (surfaces, the environment) and from lights without (point, spot and
// directional lights), which a sampled direction never hits.
struct DeclaredPaths {
  transport::Automaton paths, point_paths;
};
DeclaredPaths declared_paths(const integrator::IntegratorInfo& info);

// The paths that the method samples with its settings in a scene (null: in any scene that they apply to): some settings
// add paths, and "max-depth" removes longer ones. A depth beyond the number of edges that automata can count is ignored.
DeclaredPaths declared_paths(const render::MethodSettings& method, const scene::CompiledScene* scene = nullptr);

// The same for the scene of the document; empty if the method is incompatible with it.
DeclaredPaths declared_paths(const render::Document& document, const scene::CompiledScene& scene);

// The paths that the document counts, by its path expression.
transport::Automaton requested_paths(const render::Document& document);

// True if the settings disable, isolate or stop weighting techniques of a bidirectional method.
bool selects_techniques(const render::MethodSettings& method);

// The bias of the integrator; Bias::biased if its settings truncate paths or select techniques.
integrator::Bias bias_of(const render::MethodSettings& method);

// The intersection of A and B, and A without B. If the result has too many states for an automaton, returns A.
transport::Automaton common(const transport::Automaton& a, const transport::Automaton& b);
transport::Automaton without(const transport::Automaton& a, const transport::Automaton& b);

}  // namespace etendue::advisor
