#include "bench/external_renderer.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "bench/shell_command.h"
#include "image/image.h"

namespace etendue::bench {
namespace {

namespace fs = std::filesystem;

// A file that is removed at the end.
class TemporaryImage {
 public:
  TemporaryImage() : path_(fs::temp_directory_path() / ("etendue-" + std::to_string(::getpid()) + ".exr")) { remove(); }
  ~TemporaryImage() { remove(); }
  TemporaryImage(const TemporaryImage&) = delete;
  TemporaryImage& operator=(const TemporaryImage&) = delete;

  const fs::path& path() const { return path_; }

 private:
  void remove() const {
    std::error_code code;
    fs::remove(path_, code);
  }
  fs::path path_;
};

std::string with_value(std::string text, const std::string& placeholder, const std::string& value) {
  for (size_t at = 0; (at = text.find(placeholder, at)) != std::string::npos; at += value.size())
    text.replace(at, placeholder.size(), value);
  return text;
}

}  // namespace

ExternalTime time_of(std::span<const ExternalRun> runs) {
  const ExternalRun& first = runs.front();
  const ExternalRun& last = runs.back();
  if (last.samples <= first.samples || last.seconds <= first.seconds) return {0, last.seconds / last.samples};
  const double per_sample = (last.seconds - first.seconds) / (last.samples - first.samples);
  const double startup = last.seconds - per_sample * last.samples;
  return startup > 0 ? ExternalTime{startup, per_sample} : ExternalTime{0, last.seconds / last.samples};
}

uint32_t next_external_samples(std::span<const ExternalRun> runs, double seconds, uint32_t samples) {
  constexpr uint32_t kMaxSamples = 1 << 20;
  constexpr double kSignificant = 1.2;  // ratio of times from which start-up and rendering can be separated
  if (runs.empty()) return 1;
  const uint32_t done = runs.back().samples;
  uint32_t next = std::min(2 * done, samples > 0 ? samples : kMaxSamples);
  if (seconds > 0 && runs.back().seconds > kSignificant * runs.front().seconds)
    next = static_cast<uint32_t>(std::min<double>(std::round(seconds / time_of(runs).per_sample), next));
  // A last run of nearly the same length would add nothing.
  return next > done + done / 8 ? next : 0;
}

Result<void> check_external_command(const std::string& command) {
  for (const char* placeholder : {"{spp}", "{seed}", "{out}"})
    if (command.find(placeholder) == std::string::npos)
      return usage_error(std::string("the command has no ") + placeholder +
                         "; give external:\"COMMAND {spp} {seed} {out}\"");
  return {};
}

Result<ExternalImage> render_externally(const std::string& command, int width, int height, uint32_t samples,
                                        uint64_t seed, const std::function<bool()>& keep_going) {
  const TemporaryImage file;
  std::string text = with_value(command, "{spp}", std::to_string(samples));
  text = with_value(text, "{seed}", std::to_string(seed));
  text = with_value(text, "{width}", std::to_string(width));
  text = with_value(text, "{height}", std::to_string(height));
  text = with_value(text, "{out}", shell_quoted(file.path().string()));
  const auto seconds = run_shell_command(text, keep_going);
  if (!seconds) return seconds.error();
  if (!fs::exists(file.path())) return output_error("the program wrote no file {out}");
  auto image = image::read_linear(file.path());
  if (!image) return output_error("its image cannot be read: " + image.error().message);
  if (image->width != width || image->height != height)
    return output_error("its image has " + std::to_string(image->width) + "x" + std::to_string(image->height) +
                        " pixels instead of " + std::to_string(width) + "x" + std::to_string(height));
  return ExternalImage{std::move(image->layers.front().pixels), *seconds};
}

}  // namespace etendue::bench
