// Writing a rendered film to an image file.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "film/film.h"
#include "image/image.h"
#include "render/denoised_image.h"
#include "render/document.h"

namespace etendue::render {

// Attributes of image files: the state of the document (state_json), and the certificate of the image's error.
inline constexpr const char *kStateAttribute = "etendue:state", *kCertificateAttribute = "etendue:certificate";

// Whether a file of this name can be written: its extension must be known, OpenImageIO must be available if the format
// needs it, and files can be created in its folder.
Result<void> check_output_name(const std::string& path);

// The contents of an image file.
struct Rendering {
  const Document& document;
  const film::Film& film;
  uint32_t samples = 0;
  std::string certificate;                       // JSON; empty: none
  std::optional<std::vector<float>> reweighted;  // the displayed image, if fireflies are re-weighted
  bool sample_counts = false;                    // whether to write them as a layer
  std::vector<image::Layer> layers = {};
};

// The extension selects the format (image/format.h). An .exr file holds everything: radiance, variance per pixel, layers,
// state and certificate. Formats for linear values (.hdr, .tif) hold the radiance, others the displayed image; a
// .png file also holds the state.
Result<void> write_image(const std::string& path, const Rendering& rendering);

// Whether files of this format hold the certificate, which takes time to measure.
bool stores_certificate(const std::string& path);

// Writes a denoised image with the settings of the rendering. It has no variance, no certificate and no layers, because its
// error is not known; the attribute kDenoisedAttribute is the name of the denoiser.
inline constexpr const char* kDenoisedAttribute = "etendue:denoised";
Result<void> write_denoised_image(const std::string& path, const Rendering& rendering, const DenoisedImage& denoised);

}  // namespace etendue::render
