// Layers of the image by light paths: bounces, direct and indirect light, the terms of photon mapping, and path classes
// of the user. All of them are recorded in one rendering.
#pragma once
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "image/image.h"
#include "integrator/path/path_layers.h"
#include "render/document.h"
#include "scene/forward.h"

namespace etendue::render {

// A set of layers that partitions all paths, so that its layers sum to the image.
struct LightPathLayerSet {
  const char* name;
  const char* doc;
};
// bounces, direct-indirect, photon-terms
const std::vector<LightPathLayerSet>& light_path_layer_sets();

// Whether a name of --aov stands for layers of light paths: the name of a set, of a layer of a set, bounces:N, or
// NAME=EXPRESSION, a path class.
bool is_light_path_layer(std::string_view name);

// The names of the layers of all sets.
std::vector<std::string> light_path_layer_names();

// A recording of these layers for a document. A usage error states why an expression or a name is wrong, or why the
// document's integrator cannot record layers.
Result<std::shared_ptr<integrator::PathLayerRecording>> record_light_path_layers(const Document& document,
                                                                                 std::span<const std::string> names);

// The recorded layers, in cd/m^2.
std::vector<image::Layer> layers_of(const integrator::PathLayerRecording& recording);

// The same from a rendering of their own, by path tracing with `samples` paths per pixel and the settings of the
// document. No layers if `continues`, which is called between blocks of pixels, returns false, or if the names are wrong.
std::vector<image::Layer> render_light_path_layers(
    std::shared_ptr<const scene::CompiledScene> scene, const Document& document, std::span<const std::string> names,
    uint32_t samples, int threads, const std::function<bool()>& continues = [] { return true; });

}  // namespace etendue::render
