#include "viewer/capture.h"

#include <cctype>
#include <filesystem>

#include "image/display.h"
#include "image/image.h"

namespace etendue::viewer {
namespace {

// `shown` is what stands on the screen where that is not the film's mean; files of radiance keep the mean.
Result<std::string> write(const std::string& file, const render::Document& document, const film::Film& film, const std::optional<std::vector<float>>& shown) {
  std::vector<float> rgb;
  image::Layer variance{"variance", {"R", "G", "B"}, {}};
  const size_t numbers = film.pixels().size() * 3;
  rgb.reserve(numbers);
  variance.pixels.reserve(numbers);
  uint32_t samples = UINT32_MAX;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const Rgb m = film.mean(x, y), v = film.variance_of_mean(x, y);
      rgb.insert(rgb.end(), {m.r, m.g, m.b});
      variance.pixels.insert(variance.pixels.end(), {v.r, v.g, v.b});
      samples = std::min(samples, film.samples(x, y));
    }
  std::string extension = std::filesystem::path(file).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const std::string state = render::state_json(document, samples);
  Result<void> written;
  if (extension == ".exr") {
    image::LayeredImage picture;
    picture.width = film.width(), picture.height = film.height();
    picture.attributes = {{kStateAttribute, state}, {"software", "etendue"}};
    picture.layers.push_back({"", {"R", "G", "B"}, std::move(rgb)});
    picture.layers.push_back(std::move(variance));
    written = image::write_exr(file, picture);
  } else if (extension == ".hdr") {
    written = image::write_hdr(file, film.width(), film.height(), rgb);
  } else if (extension == ".png") {
    const auto pixels = image::display_pixels(shown.value_or(rgb), document.display.exposure, document.display.curve);
    written = image::write_png(file, film.width(), film.height(), pixels, {{kStateAttribute, state}});
  } else {
    return usage_error(file + ": '" + extension + "' is no format that can be written; give .exr, .hdr or .png");
  }
  if (!written) return written.error();
  return file;
}

}  // namespace

void Capture::request(const std::string& file) { files_.push_back(file); }

void Capture::begin() {
  const render::Status status = session_.status();
  // What stopped at a number of samples stopped between two passes; anything else is asked to.
  const bool whole = status.version == editor_.version() && status.finished && editor_.document().limits.samples > 0 &&
                     status.samples >= editor_.document().limits.samples;
  if (whole) {
    version_ = editor_.version();
  } else {
    session_.pause(false);
    const uint32_t samples = status.version == editor_.version() ? std::max(1u, status.samples) : 1;
    version_ = editor_.submit_limited({.samples = samples, .seconds = 0, .rmse = 0});
  }
  stage_ = Stage::settling;
}

std::optional<Result<std::string>> Capture::advance() {
  if (files_.empty() || editor_.empty()) return std::nullopt;
  if (stage_ == Stage::idle) {
    was_paused_ = session_.paused();
    begin();
  }
  if (stage_ == Stage::settling) {
    // An edit in between makes another picture: that one is taken.
    if (editor_.version() != version_) begin();
    const render::Status status = session_.status();
    if (status.version != version_ || !status.finished) return std::nullopt;
    stage_ = Stage::writing;
    job_.start([file = files_.front(), document = editor_.document(), version = version_, &session = session_]() -> Result<std::string> {
      const film::Film film = session.film_copy();
      const auto shown = session.reweighted_copy();
      // An edit that came before the copy would have its film under the old settings.
      if (session.status().version != version) return std::string();
      return write(file, document, film, shown);
    });
  }
  auto result = job_.take();
  if (!result) return std::nullopt;
  if (*result && (*result)->empty()) {
    begin();
    return std::nullopt;
  }
  stage_ = Stage::idle;
  files_.pop_front();
  if (was_paused_) session_.pause(true);
  editor_.submit();
  return result;
}

}  // namespace etendue::viewer
