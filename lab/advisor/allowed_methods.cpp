#include "advisor/allowed_methods.h"

#include <algorithm>

#include "advisor/declared_paths.h"
#include "advisor/reference_integrator.h"
#include "render/incompatibility.h"
#include "render/with_integrator.h"
#include "scene/light_kinds.h"

namespace etendue::advisor {
namespace {

using integrator::Bias;
using transport::Automaton;
using transport::PathExpression;

bool is_allowed(Bias bias, render::AllowedIntegrators allowed) {
  using enum render::AllowedIntegrators;
  return allowed == anything || bias == Bias::unbiased || (allowed == consistent && bias == Bias::consistent);
}

// The paths that the document requests and that can exist: without specular lobes, no vertex is specular.
Automaton possible_paths(const render::Document& document, const scene::CompiledScene& scene) {
  const Automaton requested = requested_paths(document);
  if (has_specular_surfaces(scene)) return requested;
  return common(requested, PathExpression::parse_paths("E(D|G|V)*L")->automaton());
}

class Filter {
 public:
  Filter(const render::Document& document, const scene::CompiledScene& scene)
      : document_(document), scene_(scene), possible_(possible_paths(document, scene)) {
    // The reference integrator has the same limit on the path depth.
    const render::MethodSettings reference =
        render::with_integrator(document, with_reference_integrator(document, scene).method.integrator).method;
    needed_ = common(possible_, declared_paths(reference, &scene).paths);
    if (has_point_lights(*document.scene))
      needed_of_points_ = common(possible_, declared_paths(reference, &scene).point_paths);
  }

  // The method with the reason why it is not a candidate, if there is one.
  AllowedMethod examined(const render::MethodSettings& method) const {
    if (std::string reason = refusal(method); !reason.empty()) return {method, reason};
    const DeclaredPaths declared = declared_paths(method, &scene_);
    if (const Automaton rest = without(needed_, declared.paths); !rest.empty()) return {method, missing_text(rest)};
    const Automaton rest = without(needed_of_points_, declared.point_paths);
    return {method, rest.empty() ? "" : missing_text(rest) + " of point lights", rest};
  }

 private:
  std::string refusal(const render::MethodSettings& method) const {
    const integrator::IntegratorInfo& info = *integrator::find_integrator(method.integrator);
    if (!is_allowed(info.bias, document_.automatic.allow))
      return "it is " + std::string(integrator::bias_name(info.bias)) + "; auto.allow permits others only";
    if (info.negative_samples) return "its samples may be negative, so no tail of bright samples can be measured";
    if (!info.same_without_specular.empty() && !has_specular_surfaces(scene_))
      return "without mirrors and smooth glass it is the same as " + info.same_without_specular;
    if (selects_techniques(method)) return "its settings disable or isolate sampling techniques";
    render::Document d = document_;
    d.method = method;
    if (std::string reason = render::incompatibility(d, scene_); !reason.empty())
      return reason.starts_with(info.name + ": ") ? reason.substr(info.name.size() + 2) : reason;
    return {};
  }

  std::string missing_text(const Automaton& paths) const {
    constexpr size_t kLongest = 60;  // characters of an expression that people can read
    const std::string text = transport::expression_of(paths, volumes_);
    return text.size() <= kLongest ? "it does not find the paths " + text : "it does not find some of the paths";
  }

  const render::Document& document_;
  const scene::CompiledScene& scene_;
  bool volumes_ = scene::has_scattering_media(*document_.scene);
  Automaton possible_, needed_, needed_of_points_;
};

}  // namespace

std::vector<AllowedMethod> allowed_methods(const render::Document& document, const scene::CompiledScene& scene) {
  const Filter filter(document, scene);
  std::vector<AllowedMethod> list;
  for (const auto& info : integrator::integrator_infos())
    list.push_back(filter.examined(render::with_integrator(document, info.name).method));
  return list;
}

}  // namespace etendue::advisor
