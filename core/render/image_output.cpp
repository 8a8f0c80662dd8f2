#include "render/image_output.h"

#include <filesystem>

#include "film/film_image.h"
#include "image/display.h"

namespace etendue::render {
namespace {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

image::Layer count_layer(const film::Film& film) {
  image::Layer layer{"sample-count", {"V"}, {}};
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) layer.pixels.push_back(static_cast<float>(film.samples(x, y)));
  return layer;
}

}  // namespace

Result<void> check_output_name(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension != ".exr" && extension != ".hdr" && extension != ".png")
    return usage_error(path + ": '" + extension + "' is no format that can be written; give .exr, .hdr or .png");
  const auto folder = std::filesystem::path(path).parent_path();
  std::error_code code;
  if (!folder.empty() && !std::filesystem::is_directory(folder, code))
    return output_error(path + ": the folder " + folder.string() + " does not exist");
  return {};
}

Result<void> write_image(const std::string& path, const Rendering& r) {
  const std::string extension = extension_of(path);
  const film::Film& film = r.film;
  if (extension == ".hdr") return image::write_hdr(path, film.width(), film.height(), film::radiance_of(film));
  const std::string state = state_json(r.document, r.samples);
  if (extension == ".png") {
    const Display& display = r.document.display;
    const auto shown =
        image::display_pixels(r.reweighted ? *r.reweighted : film::radiance_of(film), display.exposure, display.curve);
    return image::write_png(path, film.width(), film.height(), shown, {{kStateAttribute, state}});
  }
  image::LayeredImage picture = film::layered_image_of(film);
  picture.attributes[kStateAttribute] = state;
  picture.attributes["software"] = "etendue";
  if (!r.certificate.empty()) picture.attributes[kCertificateAttribute] = r.certificate;
  if (r.reweighted) picture.layers.push_back({"reweighted", {"R", "G", "B"}, *r.reweighted});
  if (r.sample_counts) picture.layers.push_back(count_layer(film));
  for (const auto& layer : r.layers) picture.layers.push_back(layer);
  return image::write_exr(path, picture);
}

}  // namespace etendue::render
