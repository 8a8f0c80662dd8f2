#include "render/prepared_document.h"

namespace etendue::render {

std::unique_ptr<Sampler> sampler_of(const Document& document) {
  const std::string& name = document.method.sampler;
  return make_sampler(name, document.method.settings_of(name));
}

PreparedDocument::PreparedDocument(const Document& document, std::shared_ptr<const scene::CompiledScene> scene)
    : PreparedDocument(document, std::move(scene), document.width, document.height) {}

PreparedDocument::PreparedDocument(const Document& document, std::shared_ptr<const scene::CompiledScene> scene,
                                   int width, int height)
    : scene_(std::move(scene)),
      model_(transport::model_for(*scene_, document.forced_flags, document.method.paths)),
      sampler_(sampler_of(document)),
      integrator_(integrator::make_integrator(document.method.integrator,
                                              document.method.settings_of(document.method.integrator))),
      accumulation_(integrator::find_integrator(document.method.integrator)->accumulation),
      camera_(document.camera, width, height, scene_->camera_motion()),
      filter_(document.filter),
      seed_(document.seed),
      width_(width),
      height_(height) {}

integrator::RenderContext PreparedDocument::context(uint64_t seed) const {
  return {.scene = scene_.get(),
          .model = &model_,
          .sampler = sampler_.get(),
          .camera = &camera_,
          .filter = &filter_,
          .seed = seed,
          .width = width_,
          .height = height_};
}

void PreparedDocument::prepare_sampler(uint32_t sample_of_half) {
  const uint32_t window = sample_of_half / kTableSamples;
  if (window + 1 == tables_end_) return;
  sampler_->prepare(window * kTableSamples, kTableSamples);
  tables_end_ = window + 1;
}

}  // namespace etendue::render
