#include "render_results.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "advisor/certificate.h"
#include "base/file.h"
#include "base/number_text.h"
#include "render/aov.h"
#include "render/denoised_image.h"
#include "render/image_output.h"
#include "render/light_path_layers.h"
#include "render_statistics.h"

namespace etendue::cli {
namespace {

constexpr uint32_t kAovSamples = 16;  // per pixel
// Time for finding out which light paths the method may miss: a fraction of the rendering time, with an upper limit in
// seconds.
constexpr double kCertificateFraction = 0.1, kCertificateSeconds = 0.5;

std::string certificate_of(render::Session& session, const render::Document& d, const render::Status& s,
                           const film::Film& film, int threads) {
  const double seconds = std::min(kCertificateSeconds, kCertificateFraction * s.seconds);
  const advisor::RenderStatistics evidence = advisor::statistics_of(film, s, session.model(), threads);
  return advisor::certificate_json(
      advisor::certificate(session, d, evidence, seconds, [](double, const std::string&) { return true; }));
}

// Without a scene, the image is denoised without features.
Result<void> write_denoised(const scene::CompiledScene* scene, const render::Rendering& rendering,
                            const ResultFiles& files) {
  render::DenoiseFeatures features;
  if (scene)
    features = render::denoise_features(*scene, rendering.document, kAovSamples / film::kHalfBuffers, files.threads);
  const auto denoiser = render::denoiser_named(files.denoiser);
  if (!denoiser) return denoiser.error();
  const auto image = render::denoised_image(rendering.film, std::move(features), *denoiser, files.threads);
  if (!image) return image.error();
  return render::write_denoised_image(files.denoised, rendering, *image);
}

}  // namespace

Result<std::vector<std::string>> parse_aovs(const std::string& text) {
  std::vector<std::string> names;
  const auto& of_media = render::medium_aov_names();
  std::vector<std::string> known = render::aov_names();
  const size_t of_hits = known.size();
  known.insert(known.end(), of_media.begin(), of_media.end());
  std::istringstream stream(text);
  for (std::string name; std::getline(stream, name, ',');) {
    if (name == "all") {
      names.insert(names.end(), known.begin(), known.begin() + static_cast<std::ptrdiff_t>(of_hits));
      continue;
    }
    if (name == "media") {
      names.insert(names.end(), of_media.begin(), of_media.end());
      continue;
    }
    if (name.empty()) continue;
    if (render::is_light_path_layer(name)) {
      names.push_back(name);
      continue;
    }
    if (name != "sample-count" && std::ranges::find(known, name) == known.end()) {
      std::string all = "sample-count";
      for (const auto& k : known) all += ", " + k;
      for (const auto& set : render::light_path_layer_sets()) all += std::string(", ") + set.name;
      for (const auto& k : render::light_path_layer_names()) all += ", " + k;
      all += ", bounces:N, or NAME=EXPRESSION for a path class";
      return usage_error("--aov: there is no layer '" + name + "'; give some of " + all);
    }
    names.push_back(name);
  }
  return names;
}

bool has_light_path_layers(const std::vector<std::string>& aovs) {
  return std::ranges::any_of(aovs, [](const std::string& name) { return render::is_light_path_layer(name); });
}

Result<void> check_names(const std::string& out, const std::vector<std::string>& additional,
                         const std::string& command) {
  if (out.empty()) return usage_error(command + ": no output; give -o FILE.exr, .hdr, .png or .tif");
  if (auto ok = render::check_output_name(out); !ok) return ok;
  for (const std::string& file : additional)
    if (!file.empty())
      if (auto ok = render::check_output_name(file); !ok) return ok;
  return {};
}

Result<void> write_results(render::Session& session, const render::Document& document, const render::Status& status,
                           const ResultFiles& files, const std::string& choice) {
  const film::Film film = session.film_copy();
  const transport::Model model = session.model();
  render::Rendering rendering{.document = document,
                              .film = film,
                              .samples = status.samples,
                              .certificate = {},
                              .reweighted = session.reweighted_copy()};
  rendering.sample_counts = std::ranges::find(files.aovs, "sample-count") != files.aovs.end();
  const auto compiled = session.scene();
  if (compiled && !files.aovs.empty()) {
    const uint32_t samples = std::max(status.samples, 1u);
    rendering.layers =
        render::render_aovs(*compiled, document, files.aovs, std::min(samples, kAovSamples), files.threads);
    for (image::Layer& layer : render::render_medium_aovs(compiled, document, files.aovs, samples, files.threads))
      rendering.layers.push_back(std::move(layer));
  }
  if (files.path_layers)
    for (image::Layer& layer : render::layers_of(*files.path_layers)) rendering.layers.push_back(std::move(layer));
  // The session renders other documents for the certificate, so its film and model are copied before.
  if (!files.json.empty() || render::stores_certificate(files.out))
    rendering.certificate = certificate_of(session, document, status, film, files.threads);
  if (auto ok = render::write_image(files.out, rendering); !ok) return ok;
  if (!files.png.empty())
    if (auto ok = render::write_image(files.png, rendering); !ok) return ok;
  if (!files.denoised.empty())
    if (auto ok = write_denoised(compiled.get(), rendering, files); !ok) return ok;
  if (files.json.empty()) return {};
  return write_statistics(files.json, statistics_json({.document = document,
                                                       .status = status,
                                                       .model = model,
                                                       .threads = files.threads,
                                                       .certificate = rendering.certificate,
                                                       .choice = choice}));
}

Result<void> write_samples(const render::Document& document, SamplesToWrite rendered, const ResultFiles& files) {
  render::Document limited = document;
  limited.limits = {std::max(rendered.samples.film.samples(0, 0), 1U), 0, 0, document.limits.measure};
  render::Session session({.threads = files.threads});
  render::ResumePoint start(std::move(rendered.samples.film));
  start.tails = std::move(rendered.samples.tails);
  session.submit(limited, std::move(start));
  session.finish();
  render::Status status = session.status();
  status.rays = rendered.rays;
  status.seconds = rendered.seconds;
  if (auto ok = write_results(session, document, status, files, "null"); !ok) return ok;
  print_reliability(files.out, status);
  return {};
}

std::string progress_text(const render::Status& s) {
  std::string text = std::to_string(s.samples) + " spp  " + format_rate(s.paths_per_second, "samples") + "  " +
                     format_rate(s.rays_per_second, "rays");
  if (s.phase_progress > 0) text += "  " + s.phase + " " + format_percent(s.phase_progress);
  if (s.measured_error.known)
    text +=
        std::string("  ") + film::measure_label(s.measure) + " " + film::error_text(s.measure, s.measured_error.value);
  return text;
}

Result<void> write_statistics(const std::string& file, const std::string& statistics) {
  const std::string text = statistics + "\n";
  if (file != "-") return write_file(file, text.data(), text.size());
  std::fputs(text.c_str(), stdout);
  return {};
}

void print_reliability(const std::string& file, const render::Status& status) {
  if (status.reliability && status.reliability->verdict == render::Verdict::unreliable)
    std::fprintf(stderr, "etendue: %s: unreliable: %s\n", file.c_str(), status.reliability->reason.c_str());
}

}  // namespace etendue::cli
