#include "viewer/tasks/surface_analysis.h"

#include <algorithm>

#include "render/session.h"
#include "viewer/state/editor.h"

namespace etendue::viewer {
namespace {

constexpr uint32_t kPreviewSamples = 400;  // per pixel

std::string model_label(const Material& material) {
  return material.model ? material.model->info().description.label : "glTF surface";
}

std::shared_ptr<const SurfaceMeasurement> measure_material(const Material& material, double angle, bool cosine) {
  using bsdf_analysis::lobe_surface;
  using bsdf_analysis::Side;
  auto result = std::make_shared<SurfaceMeasurement>();
  const bsdf_analysis::Lobes lobes = bsdf_analysis::lobes_of(material);
  result->material = material;
  result->model = model_label(material);
  result->audit = bsdf_analysis::analyze(lobes);
  result->slice = bsdf_analysis::slice(lobes, angle, cosine);
  result->lobes.push_back(lobe_surface(lobes, angle, Side::upper, cosine));
  if (bsdf_analysis::transmits_light(lobes)) result->lobes.push_back(lobe_surface(lobes, angle, Side::lower, cosine));
  return result;
}

render::Document preview_document(const scene::Scene& scene, const Material& material, scene::PreviewLight light) {
  render::Document d;
  d.scene = std::make_shared<scene::Scene>(scene::preview_scene(scene, material, light));
  d.camera = scene::preview_camera();
  d.width = SurfaceAnalysis::kPreviewSize;
  d.height = SurfaceAnalysis::kPreviewSize;
  d.limits.samples = kPreviewSamples;
  return d;
}

}  // namespace

SurfaceAnalysis::SurfaceAnalysis() = default;
SurfaceAnalysis::~SurfaceAnalysis() = default;

SurfaceAnalysis::Input SurfaceAnalysis::input() const {
  return {.materials = {selected_, pinned_}, .angle = parameters.angle, .cosine = parameters.cosine};
}

bool SurfaceAnalysis::is_current() const { return selected_ && results_[0] && measured_input_ == input(); }

void SurfaceAnalysis::reset(const TaskContext&) {
  task_.abandon();
  selected_.reset();
  pinned_.reset();
  results_ = {};
}

void SurfaceAnalysis::pin() {
  if (selected_) pinned_ = selected_;
}

void SurfaceAnalysis::unpin() {
  pinned_.reset();
  results_[1].reset();
}

bool SurfaceAnalysis::has_update() const {
  const auto has_new_frame = [](const PreviewRendering& rendering) {
    return rendering.session && rendering.session->frame() != rendering.frame;
  };
  return std::ranges::any_of(renderings_, has_new_frame);
}

void SurfaceAnalysis::update(const TaskContext& context, int material) {
  const bool previews = previews_requested_;
  checks_shown_ = checks_requested_ || previews_requested_;
  checks_requested_ = false;
  previews_requested_ = false;

  selected_.reset();
  if (!context.editor.empty() && material >= 0) {
    const auto& materials = context.editor.document().scene->materials;
    if (static_cast<size_t>(material) < materials.size()) selected_ = materials[static_cast<size_t>(material)];
  }
  if (auto results = task_.take_result()) {
    results_ = std::move(*results);
    measured_input_ = measuring_input_;
  }
  if (!selected_) results_[0].reset();
  if (checks_shown_ && selected_ && !task_.running() && !is_current()) {
    measuring_input_ = input();
    const auto work = [input = measuring_input_, previous_input = measured_input_, previous = results_] {
      return measure(input, previous_input, previous);
    };
    task_.start(work, context.wake);
  }
  update_previews(context, previews);
}

SurfaceAnalysis::Results SurfaceAnalysis::measure(const Input& input, const Input& previous_input,
                                                  const Results& previous) {
  Results results;
  const bool same_parameters = input.angle == previous_input.angle && input.cosine == previous_input.cosine;
  for (size_t side = 0; side < kSides; ++side) {
    const auto& material = input.materials[side];
    if (!material) continue;
    const bool unchanged = same_parameters && previous[side] && material == previous_input.materials[side];
    results[side] =
        unchanged ? previous[side] : measure_material(*material, static_cast<double>(input.angle), input.cosine);
  }
  return results;
}

void SurfaceAnalysis::take_frame(PreviewRendering& rendering) {
  const auto frame = rendering.session->frame();
  if (!frame || frame == rendering.frame) return;
  auto pixels = std::make_shared<std::vector<float>>();
  pixels->reserve(3 * frame->pixels->size());
  for (const Rgb& c : *frame->pixels) pixels->insert(pixels->end(), {c.r, c.g, c.b});
  rendering.frame = frame;
  rendering.preview = {
      .width = frame->width, .height = frame->height, .samples = frame->samples, .pixels = std::move(pixels)};
}

void SurfaceAnalysis::update_previews(const TaskContext& context, bool requested) {
  for (size_t side = 0; side < kSides; ++side) {
    PreviewRendering& rendering = renderings_[side];
    const auto& material = side == 0 ? selected_ : pinned_;
    if (!requested || !material) {
      // A session is paused rather than destroyed: its destructor would wait for scene compilation.
      if (rendering.session) rendering.session->pause(true);
      if (!material) {
        rendering.preview = {};
        rendering.material.reset();
      }
      continue;
    }
    const auto& scene = *context.editor.document().scene;
    const scene::PreviewLight light = parameters.light;
    if (rendering.session) take_frame(rendering);
    const bool same_environment = light != scene::PreviewLight::scene || rendering.environment == scene.environment;
    if (rendering.session && rendering.material == material && rendering.light == light && same_environment) {
      rendering.session->pause(false);
      continue;
    }
    if (!rendering.session) {
      rendering.session = std::make_unique<render::Session>(render::SessionOptions{.threads = 1, .interactive = true});
      rendering.session->on_update(context.wake);
    }
    rendering.session->pause(false);
    rendering.material = material;
    rendering.light = light;
    rendering.environment = scene.environment;
    rendering.session->submit(preview_document(scene, *material, light));
  }
}

}  // namespace etendue::viewer
