#include "render/incompatibility.h"

#include "integrator/integrator.h"

namespace etendue::render {

std::string incompatibility(const Document& document, const scene::CompiledScene& scene) {
  const MethodSettings& method = document.method;
  const auto& info = *integrator::find_integrator(method.integrator);
  if (!integrator::finds_any(info, method.paths))
    return "film.paths: " + info.name + " finds " + info.paths + ", none of " + method.paths +
           ": the picture will be black; take another integrator";
  const auto integrator = integrator::make_integrator(method.integrator, method.settings_of(method.integrator));
  const auto model = transport::model_for(scene, document.forced_flags, method.paths);
  const auto sampler = make_sampler(method.sampler, method.settings_of(method.sampler));
  const CameraRays camera(document.camera, document.width, document.height);
  const film::Filter filter(document.filter);
  const std::string reason = integrator->incompatibility(
      {&scene, &model, sampler.get(), &camera, &filter, document.seed, document.width, document.height});
  return reason.empty() ? "" : info.name + ": " + reason;
}

std::string adaptive_incompatibility(const std::string& integrator) {
  const auto& info = *integrator::find_integrator(integrator);
  if (info.accumulation == integrator::Accumulation::per_pixel) return {};
  return info.name +
         " does not work pixel by pixel, so that all have the same number of samples: leave it off, or take "
         "another integrator";
}

}  // namespace etendue::render
