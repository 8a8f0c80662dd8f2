#include "render/with_integrator.h"

#include "render/incompatibility.h"

namespace etendue::render {

Document with_integrator(const Document& document, const std::string& integrator) {
  Document d = document;
  d.method.integrator = integrator;
  // Both fail if the integrator has no such parameter.
  if (const auto depth = get(document, document.method.integrator + ".max-depth"))
    if (auto limited = with(d, integrator + ".max-depth", *depth)) d = std::move(*limited);
  if (!adaptive_incompatibility(integrator).empty()) d.method.adaptive = Adaptive::off;
  return d;
}

}  // namespace etendue::render
