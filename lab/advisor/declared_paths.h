// Which of the paths that count a method finds, as its integrator declares it and its settings cut it.
#pragma once
#include "integrator/integrator_info.h"
#include "render/document.h"
#include "scene/forward.h"
#include "transport/path_expression/path_expression.h"

namespace etendue::advisor {

// Sets of paths: those from light sources with an extent (surfaces, the environment), and from those without (point,
// spot and directional lights), which no walk can end on.
struct Found {
  transport::Automaton paths, point_paths;
};
Found declared(const integrator::IntegratorInfo& info);

// The same of a document's method: a limit of the path length ("max-depth") takes longer paths out. A limit of more
// edges than automata can count is none.
Found declared(const render::MethodSettings& method);

// The same in the document's own scene: nothing, if something stands in the method's way there.
Found declared(const render::Document& document, const scene::CompiledScene& scene);

// The paths that count in this document.
transport::Automaton asked(const render::Document& document);

// Whether some of the techniques of a bidirectional method are left out, shown alone or counted in full.
bool picks_techniques(const render::MethodSettings& method);

// Whether the method's mean may differ from the picture: of an integrator that is biased, or whose paths are cut.
integrator::Bias bias_of(const render::MethodSettings& method);

// A and B, A without B. What has too many states for an automaton is taken to be all of A.
transport::Automaton common(const transport::Automaton& a, const transport::Automaton& b);
transport::Automaton without(const transport::Automaton& a, const transport::Automaton& b);

}  // namespace etendue::advisor
