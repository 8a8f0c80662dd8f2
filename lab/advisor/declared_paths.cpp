#include "advisor/declared_paths.h"

#include <algorithm>

#include "integrator/integrator.h"
#include "render/incompatibility.h"
#include "transport/path_expression/path_expression.h"

namespace etendue::advisor {
namespace {

using transport::Automaton;
using transport::PathExpression;

Automaton automaton_of(const std::string& paths) {
  return paths.empty() ? Automaton() : PathExpression::parse_paths(paths)->automaton();
}

// The maximum number of path segments of the method; 0 if there is no limit.
int64_t max_depth_of(const render::MethodSettings& method) {
  for (const auto& setting : method.settings_of(method.integrator))
    if (const auto* depth = std::get_if<int64_t>(&setting.value); depth && setting.name == "max-depth") return *depth;
  const auto* depth = find_parameter(integrator::find_integrator(method.integrator)->parameters, "max-depth");
  return depth ? std::get<int64_t>(depth->default_value) : 0;
}

// The expression of all paths with at most this many segments, as E[.[.[.]]]L.
std::string paths_up_to(int64_t segments) {
  std::string text = "E";
  for (int64_t i = 1; i < segments; ++i) text += "[.";
  return text + std::string(static_cast<size_t>(segments - 1), ']') + "L";
}

// In the declaration of an integrator without scattering media, '.' does not stand for V.
DeclaredPaths declaration(const integrator::IntegratorInfo& info, const integrator::SampledPaths& sampled) {
  const Automaton& space = PathExpression::all_of(info.scattering_media).automaton();
  return {common(automaton_of(sampled.paths), space), common(automaton_of(sampled.point_paths), space)};
}

}  // namespace

Automaton common(const Automaton& a, const Automaton& b) { return Automaton::intersection(a, b).value_or(a); }
Automaton without(const Automaton& a, const Automaton& b) { return Automaton::difference(a, b).value_or(a); }

DeclaredPaths declared_paths(const integrator::IntegratorInfo& info) {
  return declaration(info, {info.paths, info.point_paths});
}

DeclaredPaths declared_paths(const render::MethodSettings& method, const scene::CompiledScene* scene) {
  const auto integrator = integrator::make_integrator(method.integrator, method.settings_of(method.integrator));
  DeclaredPaths declared =
      declaration(*integrator::find_integrator(method.integrator), integrator->sampled_paths(scene));
  const int64_t limit = max_depth_of(method);
  if (limit == 0) return declared;
  const auto limited = PathExpression::parse_paths(paths_up_to(limit));
  if (!limited) return declared;
  return {common(declared.paths, limited->automaton()), common(declared.point_paths, limited->automaton())};
}

DeclaredPaths declared_paths(const render::Document& document, const scene::CompiledScene& scene) {
  return render::incompatibility(document, scene).empty() ? declared_paths(document.method, &scene) : DeclaredPaths();
}

Automaton requested_paths(const render::Document& document) {
  const Automaton& all = PathExpression::all_of(scene::has_scattering_media(*document.scene)).automaton();
  return document.method.paths.empty() ? all : common(automaton_of(document.method.paths), all);
}

bool selects_techniques(const render::MethodSettings& method) {
  const auto& names = integrator::find_integrator(method.integrator)->techniques;
  if (names.empty()) return false;
  return std::ranges::any_of(method.settings_of(method.integrator), [&](const Setting& setting) {
    return setting.name == names.without || setting.name == names.only || setting.name == names.weighted;
  });
}

integrator::Bias bias_of(const render::MethodSettings& method) {
  return max_depth_of(method) > 0 || selects_techniques(method) ? integrator::Bias::biased
                                                                : integrator::find_integrator(method.integrator)->bias;
}

}  // namespace etendue::advisor
