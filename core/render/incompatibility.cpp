#include "render/incompatibility.h"

#include "render/prepared_document.h"

namespace etendue::render {

std::string incompatibility(const Document& document, const scene::CompiledScene& scene) {
  const MethodSettings& method = document.method;
  const auto& info = *integrator::find_integrator(method.integrator);
  // The scene outlives this call, so the pointer need not own it.
  const std::shared_ptr<const scene::CompiledScene> unowned(std::shared_ptr<const void>(), &scene);
  const PreparedDocument prepared(document, unowned);
  const std::string sampled = prepared.integrator().sampled_paths(&scene).paths;
  if (!integrator::finds_any(sampled, method.paths))
    return "film.paths: " + info.name + " finds " + sampled + ", none of " + method.paths +
           ": the image will be black; choose another integrator";
  std::string reason = prepared.refusal();
  if (reason.empty()) reason = prepared.integrator().incompatibility(prepared.context());
  return reason.empty() ? "" : info.name + ": " + reason;
}

std::string adaptive_incompatibility(const std::string& integrator) {
  const auto& info = *integrator::find_integrator(integrator);
  if (info.accumulation == integrator::Accumulation::per_pixel) return {};
  return info.name +
         " does not sample pixel by pixel, so all pixels receive the same number of samples: turn adaptive sampling "
         "off or choose another integrator";
}

}  // namespace etendue::render
