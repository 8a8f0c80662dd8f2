// From a film to a picture file of the format that the name asks for.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "film/film.h"
#include "image/image.h"
#include "render/document.h"

namespace etendue::cli {

// The EXR attribute that holds a document's state; what --like reads.
inline constexpr const char* kStateAttribute = "etendue:state";

// Whether the program can write a file of this name: the format and the folder.
Result<void> check_output_name(const std::string& path);

// .exr takes everything (layers, state, per-pixel variance); .hdr the radiance; .png what a screen shows.
// `reweighted`, if there is one, is what the screen shows; .exr takes it as a layer.
Result<void> write_image(const std::string& path, const render::Document& document, const film::Film& film,
                         const std::optional<std::vector<float>>& reweighted, std::vector<image::Layer> layers,
                         bool sample_counts, uint32_t samples);

}  // namespace etendue::cli
