// From a film to a picture file of the format that the name asks for.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "film/film.h"
#include "image/image.h"
#include "render/document.h"

namespace etendue::render {

// The attributes of a picture file that hold a document's state, which --like reads, and what the picture is worth.
inline constexpr const char *kStateAttribute = "etendue:state", *kCertificateAttribute = "etendue:certificate";

// Whether the program can write a file of this name: the format and the folder.
Result<void> check_output_name(const std::string& path);

// What a rendering leaves behind.
struct Rendering {
  const Document& document;
  const film::Film& film;
  uint32_t samples = 0;
  std::string certificate;                       // empty: none
  std::optional<std::vector<float>> reweighted;  // what the screen shows, if it is not the film
  bool sample_counts = false;                    // as a layer
  std::vector<image::Layer> layers = {};
};

// .exr takes everything (layers, state, certificate, per-pixel variance); .hdr the radiance; .png what a screen shows.
Result<void> write_image(const std::string& path, const Rendering& rendering);

}  // namespace etendue::render
