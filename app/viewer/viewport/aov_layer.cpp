#include "viewer/viewport/aov_layer.h"

#include "base/hash.h"
#include "render/aov.h"
#include "spectrum/colormap.h"
#include "viewer/viewport/error_layer.h"
#include "viewer/widgets/format.h"

namespace etendue::viewer {
namespace {

constexpr uint32_t kSamples = 2;

Rgb linear(const Rgb& encoded) {
  return {srgb_to_linear(encoded.r), srgb_to_linear(encoded.g), srgb_to_linear(encoded.b)};
}

// Neighbouring ids get colours that have nothing to do with each other; nothing is black.
Rgb color_of_id(float id) {
  if (id < 0.5f) return Rgb(0);
  const uint64_t bits = mix_bits(static_cast<uint64_t>(id));
  const auto part = [&](unsigned shift) { return 0.2f + 0.75f * static_cast<float>((bits >> shift) & 0xff) / 255.0f; };
  return linear({part(0), part(8), part(16)});
}

std::vector<Rgb> to_look_at(const image::Layer& layer, size_t pixels) {
  std::vector<Rgb> shown(pixels);
  const size_t n = layer.channels.size();
  float most = 0;
  for (const float v : layer.pixels) most = std::max(most, std::abs(v));
  for (size_t i = 0; i < pixels; ++i) {
    const float* v = layer.pixels.data() + i * n;
    if (layer.name == "albedo")
      shown[i] = {v[0], v[1], v[2]};
    else if (layer.name == "depth")
      shown[i] = v[0] > 0 ? linear(viridis(1 - v[0] / most)) : Rgb(0);
    else if (layer.name == "position")
      shown[i] = linear({v[0] / most * 0.5f + 0.5f, v[1] / most * 0.5f + 0.5f, v[2] / most * 0.5f + 0.5f});
    else if (n == 3)  // normals; where nothing was hit they have no length
      shown[i] = v[0] == 0 && v[1] == 0 && v[2] == 0
                     ? Rgb(0)
                     : linear({v[0] * 0.5f + 0.5f, v[1] * 0.5f + 0.5f, v[2] * 0.5f + 0.5f});
    else
      shown[i] = color_of_id(v[0]);
  }
  return shown;
}

AovPicture errors_of(render::Session& session, uint64_t version) {
  const film::Film film = session.film_copy();
  ErrorLayer layer = error_layer(film);
  return {kErrorLayer,
          version,
          session.status().samples,
          text_of("%.2g to %.2g, dark to bright", layer.low, layer.high),
          film.width(),
          film.height(),
          std::move(layer.pixels)};
}

}  // namespace

std::vector<std::string> layer_names() {
  auto names = render::aov_names();
  names.emplace_back(kErrorLayer);
  return names;
}

// Errors fall with samples; a fourth more is a difference that can be seen.
bool AovView::is_stale(const std::string& name) const {
  if (picture_.name != name || picture_.version != editor_.version()) return true;
  const render::Status status = session_.status();
  return name == kErrorLayer && (status.samples > picture_.samples + picture_.samples / 4 ||
                                 (status.finished && status.samples > picture_.samples));
}

bool AovView::advance(const std::string& name) {
  bool fresh = false;
  if (auto made = job_.take()) {
    picture_ = std::move(*made);
    fresh = true;
  }
  const auto scene = session_.scene();
  const bool wanted = !name.empty() && is_stale(name);
  if (wanted && !job_.running() && scene && session_.status().version == editor_.version()) {
    if (name == kErrorLayer) {
      job_.start([&session = session_, version = editor_.version()] { return errors_of(session, version); });
      return fresh;
    }
    job_.start([scene, name, document = editor_.document(), version = editor_.version()] {
      const auto layers = render::render_aovs(*scene, document, {name}, kSamples, 1);
      AovPicture picture{name, version, 0, {}, document.width, document.height, {}};
      const size_t pixels = static_cast<size_t>(picture.width) * static_cast<size_t>(picture.height);
      picture.pixels = layers.empty() ? std::vector<Rgb>(pixels) : to_look_at(layers.front(), pixels);
      return picture;
    });
  }
  return fresh;
}

}  // namespace etendue::viewer
