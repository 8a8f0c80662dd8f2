#include "render/image_output.h"

#include <filesystem>
#include <map>

#include "base/file.h"
#include "film/film_image.h"
#include "image/display.h"
#include "image/format.h"

namespace etendue::render {
namespace {

image::Layer sample_count_layer(const film::Film& film) {
  image::Layer layer{"sample-count", {"V"}, {}};
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) layer.pixels.push_back(static_cast<float>(film.samples(x, y)));
  return layer;
}

}  // namespace

Result<void> check_output_name(const std::string& path) {
  if (const auto format = image::require_writer(path); !format) return format.error();
  return check_writable(path);
}

bool stores_certificate(const std::string& path) {
  const auto format = image::require_writer(path);
  return format && !(*format)->write_linear && !(*format)->write_display;
}

Result<void> write_image(const std::string& path, const Rendering& r) {
  const auto format = image::require_writer(path);
  if (!format) return format.error();
  const film::Film& film = r.film;
  if ((*format)->write_linear)
    return (*format)->write_linear(path, film.width(), film.height(), film::radiance_of(film));
  const std::string state = state_json(r.document, r.samples);
  if ((*format)->write_display) {
    const Display& display = r.document.display;
    const auto displayed =
        image::display_pixels(r.reweighted ? *r.reweighted : film::radiance_of(film), display.exposure, display.curve);
    return (*format)->write_display(path, film.width(), film.height(), displayed, {{kStateAttribute, state}});
  }
  image::LayeredImage image = film::layered_image_of(film);
  image.attributes[kStateAttribute] = state;
  image.attributes["software"] = "etendue";
  if (!r.certificate.empty()) image.attributes[kCertificateAttribute] = r.certificate;
  if (r.reweighted) image.layers.push_back({"reweighted", {"R", "G", "B"}, *r.reweighted});
  if (r.sample_counts) image.layers.push_back(sample_count_layer(film));
  for (const auto& layer : r.layers) image.layers.push_back(layer);
  return (*format)->write_layers(path, image);
}

Result<void> write_denoised_image(const std::string& path, const Rendering& r, const DenoisedImage& denoised) {
  const auto format = image::require_writer(path);
  if (!format) return format.error();
  const int width = r.film.width(), height = r.film.height();
  if ((*format)->write_linear) return (*format)->write_linear(path, width, height, denoised.pixels);
  const std::map<std::string, std::string> attributes = {{kStateAttribute, state_json(r.document, r.samples)},
                                                         {"software", "etendue"},
                                                         {kDenoisedAttribute, name_of(denoised.denoiser)}};
  if ((*format)->write_display) {
    const Display& display = r.document.display;
    const auto displayed = image::display_pixels(denoised.pixels, display.exposure, display.curve);
    return (*format)->write_display(path, width, height, displayed, attributes);
  }
  return (*format)->write_layers(
      path,
      {.width = width, .height = height, .layers = {{"", {"R", "G", "B"}, denoised.pixels}}, .attributes = attributes});
}

}  // namespace etendue::render
