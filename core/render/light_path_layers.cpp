#include "render/light_path_layers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "film/film.h"
#include "render/prepared_document.h"
#include "render/thread_pool.h"
#include "transport/path_expression/path_expression.h"

namespace etendue::render {
namespace {

using integrator::PathLayer;
using integrator::PathLayerRecording;
using transport::Automaton;
using transport::PathExpression;

constexpr int kDefaultBounces = 4, kMostBounces = 64;
constexpr std::string_view kBounces = "bounces";

// A layer of a set: a range of bounces, or a path expression.
struct LayerInfo {
  const char* name;
  int first_bounce = 0, last_bounce = PathLayer::kNoLimit;
  const char* paths = "";  // empty: all
};

constexpr std::array<LayerInfo, 3> kDirectIndirect{{{.name = "emission", .last_bounce = 0},
                                                    {.name = "direct", .first_bounce = 1, .last_bounce = 1},
                                                    {.name = "indirect", .first_bounce = 2}}};

// The terms of photon mapping at the first surface that is not specular [Lang, eq. 9.143; Jensen 1996], and the emission
// that is visible without one.
constexpr std::array<LayerInfo, 5> kPhotonTerms{{{.name = "photon-emission", .paths = "ES*L"},
                                                 {.name = "photon-direct", .paths = "ES*(D|G|V)L"},
                                                 {.name = "photon-glossy", .paths = "ES*G.+L"},
                                                 {.name = "photon-caustics", .paths = "ES*(D|V)S+L"},
                                                 {.name = "photon-indirect", .paths = "ES*(D|V)S*(D|G|V).*L"}}};

std::string bounce_name(int bounce) { return "bounce-" + std::to_string(bounce); }

// bounce-0, bounce-1, ..., bounce-rest
std::vector<PathLayer> bounce_layers(int count) {
  std::vector<PathLayer> layers;
  for (int i = 0; i < count; ++i) layers.push_back({.name = bounce_name(i), .first_bounce = i, .last_bounce = i});
  layers.push_back({.name = "bounce-rest", .first_bounce = count});
  return layers;
}

PathLayer layer_of(const LayerInfo& info) {
  PathLayer layer{.name = info.name, .first_bounce = info.first_bounce, .last_bounce = info.last_bounce};
  if (*info.paths) layer.paths = std::make_shared<Automaton>(PathExpression::parse_paths(info.paths)->automaton());
  return layer;
}

std::vector<PathLayer> layers_of_set(std::string_view set) {
  if (set == kBounces) return bounce_layers(kDefaultBounces);
  std::vector<PathLayer> layers;
  if (set == "direct-indirect")
    for (const LayerInfo& info : kDirectIndirect) layers.push_back(layer_of(info));
  if (set == "photon-terms")
    for (const LayerInfo& info : kPhotonTerms) layers.push_back(layer_of(info));
  return layers;
}

std::optional<PathLayer> find_layer(std::string_view name) {
  for (const LightPathLayerSet& set : light_path_layer_sets())
    for (PathLayer& layer : layers_of_set(set.name))
      if (layer.name == name) return std::move(layer);
  return {};
}

// The number in bounces:N.
Result<int> bounce_count(std::string_view name) {
  const std::string_view digits = name.substr(kBounces.size() + 1);
  int count = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
  if (error != std::errc() || end != digits.data() + digits.size() || count < 1 || count > kMostBounces)
    return usage_error("--aov: " + std::string(name) + ": give a number of bounces from 1 to " +
                       std::to_string(kMostBounces));
  return count;
}

bool is_layer_name(std::string_view name) {
  const auto is_allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  return !name.empty() && std::ranges::all_of(name, is_allowed);
}

// NAME=EXPRESSION
Result<PathLayer> class_layer(std::string_view text) {
  const size_t equals = text.find('=');
  const std::string name(text.substr(0, equals));
  if (!is_layer_name(name))
    return usage_error("--aov: '" + name + "' is no name of a layer; use letters, digits, '-' and '_'");
  const auto expression = PathExpression::parse_paths(text.substr(equals + 1));
  if (!expression) return usage_error("--aov: " + name + ": " + expression.error().message);
  return PathLayer{.name = name, .paths = std::make_shared<Automaton>(expression->automaton())};
}

Result<std::vector<PathLayer>> parse_layers(std::span<const std::string> names) {
  std::vector<PathLayer> layers;
  for (const std::string& name : names) {
    if (!is_light_path_layer(name)) continue;
    if (name.find('=') != std::string::npos) {
      auto layer = class_layer(name);
      if (!layer) return layer.error();
      layers.push_back(std::move(*layer));
    } else if (name.starts_with(std::string(kBounces) + ":")) {
      const auto count = bounce_count(name);
      if (!count) return count.error();
      for (PathLayer& layer : bounce_layers(*count)) layers.push_back(std::move(layer));
    } else if (auto layer = find_layer(name)) {
      layers.push_back(std::move(*layer));
    } else {
      for (PathLayer& member : layers_of_set(name)) layers.push_back(std::move(member));
    }
  }
  for (size_t i = 0; i < layers.size(); ++i)
    for (size_t k = 0; k < i; ++k)
      if (layers[i].name == layers[k].name) return usage_error("--aov: there are two layers '" + layers[i].name + "'");
  return layers;
}

}  // namespace

const std::vector<LightPathLayerSet>& light_path_layer_sets() {
  static const std::vector<LightPathLayerSet> sets{
      {"bounces", "Light by the number of scattering events: bounce-0 is visible emission, bounce-1 direct light"},
      {"direct-indirect", "Visible emission, light that is scattered once, light that is scattered more often"},
      {"photon-terms", "The terms of photon mapping at the first surface that is not specular"}};
  return sets;
}

bool is_light_path_layer(std::string_view name) {
  if (name.find('=') != std::string_view::npos || name.starts_with(std::string(kBounces) + ":")) return true;
  return std::ranges::any_of(light_path_layer_sets(), [&](const auto& set) { return name == set.name; }) ||
         find_layer(name).has_value();
}

std::vector<std::string> light_path_layer_names() {
  std::vector<std::string> names;
  for (const LightPathLayerSet& set : light_path_layer_sets())
    for (const PathLayer& layer : layers_of_set(set.name)) names.push_back(layer.name);
  return names;
}

Result<std::shared_ptr<PathLayerRecording>> record_light_path_layers(const Document& document,
                                                                     std::span<const std::string> names) {
  auto layers = parse_layers(names);
  if (!layers) return layers.error();
  const MethodSettings& method = document.method;
  if (const std::string reason = integrator::path_layers_incompatibility(method.integrator); !reason.empty())
    return usage_error("--aov: " + reason);
  if (method.adaptive != Adaptive::off)
    return usage_error(
        "--aov: layers of light paths need the same number of samples in every pixel: set "
        "render.adaptive to off");
  std::shared_ptr<const Automaton> image;
  if (!method.paths.empty()) {
    image = std::make_shared<Automaton>(PathExpression::parse_paths(method.paths)->automaton());
    for (PathLayer& layer : *layers) {
      if (!layer.paths) continue;
      const auto both = Automaton::intersection(*image, *layer.paths);
      if (!both)
        return usage_error("--aov: " + layer.name + ": together with film.paths the expression needs too many states");
      layer.paths = std::make_shared<Automaton>(*both);
    }
  }
  return std::make_shared<PathLayerRecording>(std::move(*layers), image);
}

std::vector<image::Layer> layers_of(const PathLayerRecording& recording) {
  std::vector<image::Layer> layers;
  for (size_t k = 0; k < recording.layers().size(); ++k)
    layers.push_back({recording.layers()[k].name, {"R", "G", "B"}, recording.mean(k)});
  return layers;
}

std::vector<image::Layer> render_light_path_layers(std::shared_ptr<const scene::CompiledScene> scene,
                                                   const Document& document, std::span<const std::string> names,
                                                   uint32_t samples, int threads,
                                                   const std::function<bool()>& continues) {
  Document layered = document;
  layered.method.adaptive = Adaptive::off;
  if (!integrator::path_layers_incompatibility(document.method.integrator).empty()) layered.method.integrator = "path";
  const auto recording = record_light_path_layers(layered, names);
  if (!recording || (*recording)->layers().empty()) return {};
  (*recording)->clear(document.width, document.height);
  PreparedDocument prepared(layered, std::move(scene), document.width, document.height, recording->get());
  const auto state = prepared.begin(prepared.context());
  using integrator::PixelBlock;
  const int columns = (document.width + PixelBlock::kWidth - 1) / PixelBlock::kWidth,
            rows = (document.height + PixelBlock::kHeight - 1) / PixelBlock::kHeight;
  const std::function<bool()> keep_going = continues;
  const auto render_block = [&](int number, uint32_t sample) {
    const auto block =
        integrator::block_containing(number % columns * PixelBlock::kWidth, number / columns * PixelBlock::kHeight,
                                     document.width, document.height, sample);
    std::array<Rgb, PixelBlock::kMostPixels> radiance;
    state->sample(block, radiance, {.keep_going = &keep_going});
  };
  ThreadPool workers(threads);
  for (uint32_t sample = 0; sample < samples; ++sample) {
    if (sample % film::kHalfBuffers == 0) prepared.prepare_sampler(sample / film::kHalfBuffers);
    workers.run(
        0, columns * rows, [&](int number) { render_block(number, sample); }, continues);
    if (!continues()) return {};
  }
  return layers_of(**recording);
}

}  // namespace etendue::render
