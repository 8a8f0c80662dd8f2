#include "render/prepared_document.h"

#include <algorithm>

namespace etendue::render {
namespace {

// Renders a black image.
class BlackImage final : public integrator::RenderState {
 public:
  std::optional<uint64_t> sample(const integrator::PixelBlock&, std::span<Rgb> radiance,
                                 const integrator::TaskContext&) override {
    std::ranges::fill(radiance, Rgb(0));
    return 0;
  }
};

// The integrators that have a feature, as a list for people.
std::string integrators_with(bool integrator::IntegratorInfo::*feature) {
  std::string names;
  for (const auto& info : integrator::integrator_infos())
    if (info.*feature) names += (names.empty() ? "" : ", ") + info.name;
  return names;
}

const transport::Decision& decision_about(const transport::Model& model, std::string_view flag) {
  return *std::ranges::find_if(model.decisions, [&](const auto& decision) { return decision.flag == flag; });
}

// Why the integrator cannot render the scene with wavelengths; empty if it can.
std::string spectral_refusal(const integrator::IntegratorInfo& info, const transport::Model& model,
                             const scene::CompiledScene& scene) {
  if (!info.spectral)
    return "it does not support spectral rendering (" + decision_about(model, "colour").reason +
           "), so the image will be black: use an integrator that does (" +
           integrators_with(&integrator::IntegratorInfo::spectral) + "), or set render.color to rgb";
  const std::string spectral = "spectral rendering (" + decision_about(model, "colour").reason + ") ";
  if (scene.has_subsurface())
    return spectral +
           "does not support subsurface diffusion, which a material uses, so the image will be black: set "
           "render.color to rgb";
  return {};
}

// Why the integrator cannot render the scene; empty if it can.
std::string refusal_of(const std::string& integrator, const transport::Model& model,
                       const scene::CompiledScene& scene) {
  if (const std::string& error = scene.solids().medium_error(); !error.empty())
    return error + "; the image will be black";
  const auto unsupported = [&](const char* what, bool integrator::IntegratorInfo::*media) {
    return std::string("it does not support ") + what + " (" + decision_about(model, "media").reason +
           "), so the image will be black: use an integrator that does (" + integrators_with(media) + ")";
  };
  const integrator::IntegratorInfo& info = *integrator::find_integrator(integrator);
  if (model.spectral)
    if (std::string reason = spectral_refusal(info, model, scene); !reason.empty()) return reason;
  if (scene.has_subsurface() && !info.subsurface)
    return "it does not support subsurface diffusion, which a material uses, so the image will be black: use an "
           "integrator that does (" +
           integrators_with(&integrator::IntegratorInfo::subsurface) + "), or a medium inside the material";
  if (scene.solids().any_heterogeneous() && !info.heterogeneous_media)
    return unsupported("heterogeneous media", &integrator::IntegratorInfo::heterogeneous_media);
  if (scene.solids().any_medium_emits() && !info.emitting_media)
    return "it does not support media that emit light, which a medium of the scene does, so the image will be black: "
           "use an integrator that does (" +
           integrators_with(&integrator::IntegratorInfo::emitting_media) + ")";
  const scene::AtmosphereMedium* atmosphere = scene.solids().atmosphere();
  if (info.starts_in_media && atmosphere && atmosphere->medium.emits() && scene.atmosphere_is_unbounded())
    return "the atmosphere emits light and has no end, so light paths cannot start in it and the image will be black: "
           "set atmosphere.radius, or use an integrator without light paths";
  if (model.scattering && !info.scattering_media)
    return unsupported("scattering media", &integrator::IntegratorInfo::scattering_media);
  return {};
}

std::unique_ptr<integrator::Integrator> make_integrator_of(const Document& document,
                                                           integrator::PathLayerRecording* layers) {
  const std::string& name = document.method.integrator;
  const auto settings = document.method.settings_of(name);
  return layers ? integrator::make_layered_integrator(name, settings, *layers)
                : integrator::make_integrator(name, settings);
}

}  // namespace

std::unique_ptr<Sampler> sampler_of(const Document& document) {
  const std::string& name = document.method.sampler;
  return make_sampler(name, document.method.settings_of(name));
}

PreparedDocument::PreparedDocument(const Document& document, std::shared_ptr<const scene::CompiledScene> scene)
    : PreparedDocument(document, std::move(scene), document.width, document.height) {}

PreparedDocument::PreparedDocument(const Document& document, std::shared_ptr<const scene::CompiledScene> scene,
                                   int width, int height, integrator::PathLayerRecording* layers)
    : scene_(std::move(scene)),
      model_(transport::model_for(*scene_, document.forced_flags, document.method.paths, document.method.color)),
      sampler_name_(document.method.sampler),
      sampler_settings_(document.method.settings_of(sampler_name_)),
      sampler_(sampler_of(document)),
      integrator_(make_integrator_of(document, layers)),
      refusal_(refusal_of(document.method.integrator, model_, *scene_)),
      accumulation_(integrator::find_integrator(document.method.integrator)->accumulation),
      has_negative_samples_(integrator::find_integrator(document.method.integrator)->negative_samples),
      camera_(document.camera, width, height, scene_->camera_motion()),
      filter_(document.filter),
      seed_(document.seed),
      width_(width),
      height_(height) {}

std::unique_ptr<integrator::RenderState> PreparedDocument::begin(const integrator::RenderContext& context,
                                                                 const integrator::RenderState* previous) const {
  if (!refusal_.empty()) return std::make_unique<BlackImage>();
  return integrator_->begin(context, previous);
}

integrator::RenderContext PreparedDocument::context(uint64_t seed) const {
  return {.scene = scene_.get(),
          .model = &model_,
          .sampler = sampler_.get(),
          .camera = &camera_,
          .filter = &filter_,
          .seed = seed,
          .width = width_,
          .height = height_,
          .sampler_name = sampler_name_,
          .sampler_settings = sampler_settings_};
}

void PreparedDocument::prepare_sampler(uint32_t sample_of_half) {
  const uint32_t window = sample_of_half / kTableSamples;
  if (window + 1 == tables_end_) return;
  sampler_->prepare(window * kTableSamples, kTableSamples);
  tables_end_ = window + 1;
}

}  // namespace etendue::render
