#include "render/with_integrator.h"

#include "integrator/integrator.h"
#include "render/incompatibility.h"

namespace etendue::render {
namespace {

// The value of "max-depth" of a method, if its integrator has this parameter.
const Value* max_depth_of(const MethodSettings& method) {
  for (const auto& [name, value] : method.settings)
    if (name == method.integrator + ".max-depth") return &value;
  const auto* info = find_parameter(integrator::find_integrator(method.integrator)->parameters, "max-depth");
  return info ? &info->default_value : nullptr;
}

}  // namespace

Document with_integrator(const Document& document, const std::string& integrator) {
  Document d = document;
  d.method.integrator = integrator;
  const Value* depth = max_depth_of(document.method);
  if (depth && integrator != document.method.integrator && max_depth_of(d.method))
    if (auto limited = with(d, integrator + ".max-depth", *depth)) d = std::move(*limited);
  if (!adaptive_incompatibility(integrator).empty()) d.method.adaptive = Adaptive::off;
  return d;
}

}  // namespace etendue::render
