// The files that etendue render and etendue merge write.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "render/partial_result.h"
#include "render/session.h"

namespace etendue::integrator {
class PathLayerRecording;
}

namespace etendue::cli {

struct ResultFiles {
  std::string out;                // image file
  std::string png, json;          // additional files, or empty; '-' as `json` is standard output
  std::string denoised;           // additional file with the denoised image, or empty
  std::string denoiser = "auto";  // its name
  std::vector<std::string> aovs;  // additional layers of the image
  int threads = 0;
  // The layers of light paths that were recorded with the image; null: none.
  std::shared_ptr<const integrator::PathLayerRecording> path_layers = nullptr;
};

// Splits the argument of --aov. "all" stands for the AOVs of first hits, "media" for the terms of the equation of
// transfer.
Result<std::vector<std::string>> parse_aovs(const std::string& text);

// Whether layers of light paths are among them, which have to be recorded while the image is rendered.
bool has_light_path_layers(const std::vector<std::string>& aovs);

// Whether an image file and additional ones, unless they are empty, can be written.
Result<void> check_names(const std::string& out, const std::vector<std::string>& additional,
                         const std::string& command);

// Writes the film of a session that has rendered `document`. `choice` is the JSON of the automatic choice of the
// integrator, or "null". The session renders other documents for the certificate.
Result<void> write_results(render::Session& session, const render::Document& document, const render::Status& status,
                           const ResultFiles& files, const std::string& choice);

// Samples that a session of another process has taken.
struct SamplesToWrite {
  render::PartialSamples samples;
  uint64_t rays = 0;
  double seconds = 0;  // of rendering
};

// Writes the results of a rendering of `document`, and prints one line if its estimated error cannot be trusted.
Result<void> write_samples(const render::Document& document, SamplesToWrite rendered, const ResultFiles& files);

// What progress bars show beside the bar: "128 spp  1.90 Msamples/s".
std::string progress_text(const render::Status& status);

// Writes the statistics as JSON to a file; '-' is standard output.
Result<void> write_statistics(const std::string& file, const std::string& json);

// Prints one line if the estimated error of the image cannot be trusted.
void print_reliability(const std::string& file, const render::Status& status);

}  // namespace etendue::cli
