#include "advisor/declared_paths.h"

#include <algorithm>

#include "render/incompatibility.h"
#include "transport/path_expression/path_expression.h"

namespace etendue::advisor {
namespace {

using transport::Automaton;
using transport::PathExpression;

Automaton automaton_of(const std::string& paths) {
  return paths.empty() ? Automaton() : PathExpression::parse_paths(paths)->automaton();
}

// Segments that the method's paths have at most; 0 if there is no limit.
int64_t limit_of(const render::MethodSettings& method) {
  for (const auto& setting : method.settings_of(method.integrator))
    if (const auto* depth = std::get_if<int64_t>(&setting.value); depth && setting.name == "max-depth") return *depth;
  const auto* depth = find_parameter(integrator::find_integrator(method.integrator)->parameters, "max-depth");
  return depth ? std::get<int64_t>(depth->default_value) : 0;
}

// E[.[.[.]]]L: paths of so many segments at most.
std::string no_longer_than(int64_t segments) {
  std::string text = "E";
  for (int64_t i = 1; i < segments; ++i) text += "[.";
  return text + std::string(static_cast<size_t>(segments - 1), ']') + "L";
}

}  // namespace

Automaton common(const Automaton& a, const Automaton& b) { return Automaton::intersection(a, b).value_or(a); }
Automaton without(const Automaton& a, const Automaton& b) { return Automaton::difference(a, b).value_or(a); }

Found declared(const integrator::IntegratorInfo& info) {
  return {automaton_of(info.paths), automaton_of(info.point_paths)};
}

Found declared(const render::MethodSettings& method) {
  Found found = declared(*integrator::find_integrator(method.integrator));
  const int64_t limit = limit_of(method);
  if (limit == 0) return found;
  const auto cut = PathExpression::parse_paths(no_longer_than(limit));
  if (!cut) return found;
  return {common(found.paths, cut->automaton()), common(found.point_paths, cut->automaton())};
}

Found declared(const render::Document& document, const scene::CompiledScene& scene) {
  return render::incompatibility(document, scene).empty() ? declared(document.method) : Found();
}

Automaton asked(const render::Document& document) {
  return document.method.paths.empty() ? PathExpression::all().automaton() : automaton_of(document.method.paths);
}

bool picks_techniques(const render::MethodSettings& method) {
  const auto& knobs = integrator::find_integrator(method.integrator)->techniques;
  if (knobs.empty()) return false;
  return std::ranges::any_of(method.settings_of(method.integrator), [&](const Setting& setting) {
    return setting.name == knobs.without || setting.name == knobs.only || setting.name == knobs.weighted;
  });
}

integrator::Bias bias_of(const render::MethodSettings& method) {
  return limit_of(method) > 0 || picks_techniques(method) ? integrator::Bias::biased
                                                          : integrator::find_integrator(method.integrator)->bias;
}

}  // namespace etendue::advisor
