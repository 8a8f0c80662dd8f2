#include "viewer/viewport/aov_layer.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/hash.h"
#include "metrics/convergence.h"
#include "render/aov.h"
#include "render/light_path_layers.h"
#include "render/session.h"
#include "render/transport_audit.h"
#include "scene/compiled_scene.h"
#include "spectrum/colormap.h"
#include "viewer/state/editor.h"
#include "viewer/viewport/error_layer.h"
#include "viewer/viewport/srgb.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr uint32_t kSamplesPerPixel = 2;
constexpr uint32_t kFirstSamples = 1, kLastSamples = 256, kSampleGrowth = 4;

bool is_medium_term(const std::string& name) {
  const auto& names = render::medium_aov_names();
  return std::ranges::find(names, name) != names.end();
}

// Whether a layer is a part of the radiance, which is rendered with more and more samples.
bool is_part_of_radiance(const std::string& name) { return is_medium_term(name) || render::is_light_path_layer(name); }

// A random colour for each id, so that neighbouring ids differ. Id 0 is black.
Rgb color_of_id(float id) {
  if (id < 0.5f) return Rgb(0);
  const uint64_t bits = mix_bits(static_cast<uint64_t>(id));
  const auto channel = [&](unsigned shift) {
    return 0.2f + 0.75f * static_cast<float>((bits >> shift) & 0xff) / 255.0f;
  };
  return linear_from_srgb({channel(0), channel(8), channel(16)});
}

// Maps a vector with components in [-max, max] to a colour.
Rgb color_of_vector(const float* v, float max) {
  return linear_from_srgb({v[0] / max * 0.5f + 0.5f, v[1] / max * 0.5f + 0.5f, v[2] / max * 0.5f + 0.5f});
}

std::vector<Rgb> false_colors(const image::Layer& layer, size_t pixels) {
  std::vector<Rgb> colors(pixels);
  const size_t channels = layer.channels.size();
  float max = 0;
  for (const float v : layer.pixels) max = std::max(max, std::abs(v));
  for (size_t i = 0; i < pixels; ++i) {
    const float* v = layer.pixels.data() + i * channels;
    if (layer.name == "albedo") {
      colors[i] = {v[0], v[1], v[2]};
    } else if (layer.name == "depth") {
      colors[i] = v[0] > 0 ? linear_from_srgb(viridis(1 - v[0] / max)) : Rgb(0);
    } else if (layer.name == "position") {
      colors[i] = color_of_vector(v, max);
    } else if (channels == 3) {
      // Normals; they are zero where no surface was hit.
      const bool is_zero = v[0] == 0 && v[1] == 0 && v[2] == 0;
      colors[i] = is_zero ? Rgb(0) : color_of_vector(v, 1);
    } else {
      colors[i] = color_of_id(v[0]);
    }
  }
  return colors;
}

AovImage error_image(render::Session& session, uint64_t version) {
  const film::Film film = session.film_copy();
  ErrorLayer layer = error_layer(film);
  return {.name = kErrorLayer,
          .version = version,
          .samples = session.status().samples,
          .scale = formatted("%.2g to %.2g, dark to bright", layer.low, layer.high),
          .width = film.width(),
          .height = film.height(),
          .pixels = std::move(layer.pixels)};
}

AovImage aov_image(const scene::CompiledScene& scene, const std::string& name, const render::Document& document,
                   uint64_t version) {
  const auto layers = render::render_aovs(scene, document, {name}, kSamplesPerPixel, 1);
  const size_t pixels = static_cast<size_t>(document.width) * static_cast<size_t>(document.height);
  return {.name = name,
          .version = version,
          .width = document.width,
          .height = document.height,
          .pixels = layers.empty() ? std::vector<Rgb>(pixels) : false_colors(layers.front(), pixels)};
}

AovImage radiance_image(std::shared_ptr<const scene::CompiledScene> scene, const std::string& name,
                        const render::Document& document, uint64_t version, uint32_t samples,
                        const std::atomic<bool>& cancelled) {
  const auto continues = [&] { return !cancelled.load(); };
  const auto layers =
      is_medium_term(name)
          ? render::render_medium_aovs(std::move(scene), document, {name}, samples, 1, continues)
          : render::render_light_path_layers(std::move(scene), document, {&name, 1}, samples, 1, continues);
  if (layers.empty()) return {};
  AovImage image{.name = name,
                 .version = version,
                 .samples = samples,
                 .is_radiance = true,
                 .scale = formatted(samples == 1 ? "%u sample per pixel" : "%u samples per pixel", samples),
                 .width = document.width,
                 .height = document.height,
                 .pixels = {}};
  const std::vector<float>& values = layers.front().pixels;
  for (size_t i = 0; i + 2 < values.size(); i += 3) image.pixels.push_back({values[i], values[i + 1], values[i + 2]});
  return image;
}

// The importance of places for a camera, seen by that of the document. The colours end at a value that one pixel in 200
// exceeds. If camera paths cannot be traced, the image is black and its scale says why.
AovImage importance_image(std::shared_ptr<const scene::CompiledScene> scene, render::Document document,
                          const Camera& camera, uint64_t version, const std::atomic<bool>& cancelled) {
  constexpr double kPaths = 1e6, kFewest = 2, kMost = 64;
  const size_t pixels = static_cast<size_t>(document.width) * static_cast<size_t>(document.height);
  const Camera view = std::exchange(document.camera, camera);
  const auto samples = static_cast<uint32_t>(std::clamp(kPaths / static_cast<double>(pixels), kFewest, kMost));
  const auto compiled = scene::compile(document.scene, camera, std::move(scene), document.height);
  const auto audit =
      render::audit_importance(document, compiled, view, samples, 0, 1, [&] { return !cancelled.load(); });
  AovImage image{.name = kImportanceLayer,
                 .version = version,
                 .samples = samples,
                 .width = document.width,
                 .height = document.height,
                 .pixels = std::vector<Rgb>(pixels)};
  if (!audit) {
    image.scale = audit.error().message;
    return image;
  }
  const std::vector<float>& values = audit->picture.pixels;
  const double most = metrics::quantile({values.begin(), values.end()}, 0.995);
  image.scale = formatted("0 to %.2g per m\u00b2, for the view in which it was chosen", most);
  for (size_t i = 0; i < pixels && most > 0; ++i)
    image.pixels[i] = linear_from_srgb(viridis(std::min(values[i] / static_cast<float>(most), 1.0f)));
  return image;
}

// `features` are those of an earlier image of this version, or null.
AovImage denoised_image(render::Session& session, const scene::CompiledScene& scene, const render::Document& document,
                        uint64_t version, std::shared_ptr<const render::DenoiseFeatures> features,
                        render::Denoiser denoiser, const std::atomic<bool>& cancelled) {
  if (!features)
    features = std::make_shared<render::DenoiseFeatures>(
        render::denoise_features(scene, document, render::kDenoiseFeatureSamples, 0));
  const film::Film film = session.film_copy();
  const uint32_t samples = session.status().samples;
  const auto continues = [&] { return !cancelled.load(); };
  auto denoised = render::denoised_image(film, *features, denoiser, 0, continues);
  if (!denoised) denoised = render::denoised_image(film, *features, render::Denoiser::regression, 0, continues);
  const auto& values = denoised->pixels;
  const bool is_own_filter = denoised->denoiser == render::Denoiser::regression;
  AovImage image{.name = kDenoisedLayer,
                 .version = version,
                 .samples = samples,
                 .is_radiance = true,
                 .scale = formatted("%u samples per pixel; %s; biased, for display only", samples,
                                    is_own_filter ? "regression" : render::label_of(denoised->denoiser)),
                 .width = film.width(),
                 .height = film.height(),
                 .pixels = {},
                 .features = std::move(features),
                 .denoiser = denoiser};
  for (size_t i = 0; i + 2 < values.size(); i += 3) image.pixels.push_back({values[i], values[i + 1], values[i + 2]});
  return image;
}

bool is_layer_of_film(const std::string& name) { return name == kErrorLayer || name == kDenoisedLayer; }

}  // namespace

std::vector<std::string> aov_layer_names(const scene::CompiledScene* scene) {
  auto names = render::aov_names();
  const auto parts = render::light_path_layer_names();
  names.insert(names.end(), parts.begin(), parts.end());
  if (!scene || scene->scatters())
    names.insert(names.end(), render::medium_aov_names().begin(), render::medium_aov_names().end());
  names.emplace_back(kImportanceLayer);
  names.emplace_back(kErrorLayer);
  names.emplace_back(kDenoisedLayer);
  return names;
}

// Layers of the film are updated when the number of samples has grown by a quarter.
bool AovLayer::is_outdated(const std::string& name) const {
  if (image_.name != name || image_.version != editor_.version()) return true;
  if (is_part_of_radiance(name)) return image_.samples < kLastSamples;
  if (!is_layer_of_film(name)) return false;
  if (name == kDenoisedLayer && image_.denoiser != denoiser_) return true;
  const render::Status status = session_.status();
  return status.samples > image_.samples + image_.samples / 4 || (status.finished && status.samples > image_.samples);
}

AovLayer::~AovLayer() { cancel(); }

// Ends work that takes long: parts of the radiance, the importance and the denoised image. Other work is short and runs to
// its end.
void AovLayer::cancel() {
  if (!cancelled_) return;
  cancelled_->store(true);
  cancelled_.reset();
  task_.abandon();
}

void AovLayer::start_denoising(std::shared_ptr<const scene::CompiledScene> scene, uint64_t version) {
  const bool continues = image_.name == kDenoisedLayer && image_.version == version;
  cancelled_ = std::make_shared<std::atomic<bool>>(false);
  task_.start(
      [&session = session_, scene = std::move(scene), document = editor_.document(), version,
       features = continues ? image_.features : nullptr, denoiser = denoiser_, cancelled = cancelled_] {
        return denoised_image(session, *scene, document, version, features, denoiser, *cancelled);
      },
      wake_);
}

void AovLayer::choose_importance_camera(const std::string& name) {
  const render::Document& document = editor_.document();
  const bool is_chosen = name == kImportanceLayer && (shown_ != name || importance_scene_ != document.scene_name);
  shown_ = name;
  if (!is_chosen) return;
  importance_scene_ = document.scene_name;
  importance_camera_ = document.camera;
  if (image_.name == kImportanceLayer) image_ = {};
}

void AovLayer::start_importance(std::shared_ptr<const scene::CompiledScene> scene, uint64_t version) {
  cancelled_ = std::make_shared<std::atomic<bool>>(false);
  task_.start([scene = std::move(scene), document = editor_.document(), camera = importance_camera_, version,
               cancelled = cancelled_] { return importance_image(scene, document, camera, version, *cancelled); },
              wake_);
}

void AovLayer::start(const std::string& name, std::shared_ptr<const scene::CompiledScene> scene, uint64_t version) {
  requested_ = {.name = name, .version = version};
  cancelled_.reset();
  if (name == kErrorLayer)
    return task_.start([&session = session_, version] { return error_image(session, version); }, wake_);
  if (name == kDenoisedLayer) return start_denoising(std::move(scene), version);
  if (name == kImportanceLayer) return start_importance(std::move(scene), version);
  if (!is_part_of_radiance(name))
    return task_.start(
        [scene, name, document = editor_.document(), version] { return aov_image(*scene, name, document, version); },
        wake_);
  const bool continues = image_.name == name && image_.version == version;
  const uint32_t samples = continues ? image_.samples * kSampleGrowth : kFirstSamples;
  cancelled_ = std::make_shared<std::atomic<bool>>(false);
  task_.start([scene, name, document = editor_.document(), version, samples,
               cancelled = cancelled_] { return radiance_image(scene, name, document, version, samples, *cancelled); },
              wake_);
}

bool AovLayer::update(const std::string& name, render::Denoiser denoiser) {
  denoiser_ = denoiser;
  choose_importance_camera(name);
  bool has_new_image = false;
  if (auto image = task_.take_result()) {
    image_ = std::move(*image);
    has_new_image = true;
  }
  const auto scene = session_.scene();
  const uint64_t version = editor_.version();
  if (task_.running() && (requested_.name != name || requested_.version != version)) cancel();
  const bool can_start = !task_.running() && scene && session_.status().version == version;
  if (!name.empty() && can_start && is_outdated(name)) start(name, scene, version);
  return has_new_image;
}

}  // namespace etendue::viewer
