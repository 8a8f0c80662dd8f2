#include "render/image_output.h"

#include <filesystem>

#include "base/file.h"
#include "film/film_image.h"
#include "image/display.h"

namespace etendue::render {
namespace {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

image::Layer sample_count_layer(const film::Film& film) {
  image::Layer layer{"sample-count", {"V"}, {}};
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) layer.pixels.push_back(static_cast<float>(film.samples(x, y)));
  return layer;
}

}  // namespace

Result<void> check_output_name(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension != ".exr" && extension != ".hdr" && extension != ".png")
    return usage_error(path + ": '" + extension + "' is not a supported output format; use .exr, .hdr or .png");
  return check_writable(path);
}

Result<void> write_image(const std::string& path, const Rendering& r) {
  const std::string extension = extension_of(path);
  const film::Film& film = r.film;
  if (extension == ".hdr") return image::write_hdr(path, film.width(), film.height(), film::radiance_of(film));
  const std::string state = state_json(r.document, r.samples);
  if (extension == ".png") {
    const Display& display = r.document.display;
    const auto displayed =
        image::display_pixels(r.reweighted ? *r.reweighted : film::radiance_of(film), display.exposure, display.curve);
    return image::write_png(path, film.width(), film.height(), displayed, {{kStateAttribute, state}});
  }
  image::LayeredImage image = film::layered_image_of(film);
  image.attributes[kStateAttribute] = state;
  image.attributes["software"] = "etendue";
  if (!r.certificate.empty()) image.attributes[kCertificateAttribute] = r.certificate;
  if (r.reweighted) image.layers.push_back({"reweighted", {"R", "G", "B"}, *r.reweighted});
  if (r.sample_counts) image.layers.push_back(sample_count_layer(film));
  for (const auto& layer : r.layers) image.layers.push_back(layer);
  return image::write_exr(path, image);
}

}  // namespace etendue::render
