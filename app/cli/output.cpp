#include "output.h"

#include <filesystem>

#include "image/display.h"

namespace etendue::cli {
namespace {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

std::vector<float> radiance_of(const film::Film& film) {
  std::vector<float> rgb;
  rgb.reserve(film.pixels().size() * 3);
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const Rgb m = film.mean(x, y);
      rgb.insert(rgb.end(), {m.r, m.g, m.b});
    }
  return rgb;
}

image::Layer variance_layer(const film::Film& film) {
  image::Layer layer{"variance", {"R", "G", "B"}, {}};
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const Rgb v = film.variance_of_mean(x, y);
      layer.pixels.insert(layer.pixels.end(), {v.r, v.g, v.b});
    }
  return layer;
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

Result<void> write_image(const std::string& path, const render::Document& document, const film::Film& film,
                         std::vector<image::Layer> layers, bool sample_counts, uint32_t samples) {
  const std::string extension = extension_of(path);
  std::vector<float> rgb = radiance_of(film);
  if (extension == ".hdr") return image::write_hdr(path, film.width(), film.height(), rgb);
  const std::string state = render::state_json(document, samples);
  if (extension == ".png") {
    const auto shown = image::display_pixels(rgb, document.display.exposure, document.display.curve);
    return image::write_png(path, film.width(), film.height(), shown, {{kStateAttribute, state}});
  }
  image::LayeredImage picture;
  picture.width = film.width(), picture.height = film.height();
  picture.attributes[kStateAttribute] = state;
  picture.attributes["software"] = "etendue";
  picture.layers.push_back({"", {"R", "G", "B"}, std::move(rgb)});
  picture.layers.push_back(variance_layer(film));
  if (sample_counts) picture.layers.push_back(count_layer(film));
  for (auto& layer : layers) picture.layers.push_back(std::move(layer));
  return image::write_exr(path, picture);
}

}  // namespace etendue::cli
