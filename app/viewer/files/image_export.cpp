#include "viewer/files/image_export.h"

#include <algorithm>

#include "advisor/certificate.h"
#include "render/checkpoint.h"
#include "render/image_output.h"
#include "render/session.h"
#include "viewer/files/file_names.h"
#include "viewer/state/editor.h"

namespace etendue::viewer {
namespace {

// Time limit for measuring missing paths, for integrators that do not declare to find all of them.
constexpr double kCertificateSeconds = 0.5;

std::string certificate_of(const render::Session& session, const render::Document& document,
                           const advisor::RenderStatistics& evidence) {
  render::Session separate_session({.threads = 1, .scene = session.scene()});
  const auto keep_going = [](double, const std::string&) { return true; };
  return advisor::certificate_json(
      advisor::certificate(separate_session, document, evidence, kCertificateSeconds, keep_going));
}

// Everything that an image file and its checkpoint hold, except the certificate.
struct Copies {
  render::ResumePoint point;
  std::optional<std::vector<float>> reweighted;
  render::Status status;
};

Copies copies_of(render::Session& session) {
  return {session.resume_point(), session.reweighted_copy(), session.status()};
}

Result<void> write_copies(const std::string& file, const render::Session& session, const render::Document& document,
                          const Copies& copies) {
  const film::Film& film = copies.point.film;
  std::string certificate;
  if (render::stores_certificate(file))
    certificate =
        certificate_of(session, document, advisor::statistics_of(film, copies.status, session.model(), 0));
  return render::write_image(file,
                             {document, film, copies.status.samples, std::move(certificate), copies.reweighted});
}

Result<void> write_samples(const std::string& image, const render::Document& document, Copies copies) {
  return render::write_checkpoint(render::checkpoint_of_image(image),
                                  {.state = render::state_json(document, copies.status.samples),
                                   .film = std::move(copies.point.film),
                                   .seconds = copies.status.seconds,
                                   .integrator_state = std::move(copies.point.integrator_state),
                                   .tails = std::move(copies.point.tails)});
}

// Returns an empty name if the session has another version of the document.
Result<std::string> write(const std::string& file, SavedSamples samples, render::Session& session,
                          const render::Document& document, uint64_t version) {
  if (auto known = render::check_output_name(file); !known) return known.error();
  Copies copies = copies_of(session);
  // If the document was edited before the copy, the film belongs to other settings.
  if (session.status().version != version) return std::string();
  if (auto written = write_copies(file, session, document, copies); !written) return written.error();
  if (samples == SavedSamples::none) return file;
  if (auto written = write_samples(file, document, std::move(copies)); !written) return written.error();
  return file;
}

}  // namespace

Result<void> write_image_of(render::Session& session, const render::Document& document, const std::string& file) {
  return write_copies(file, session, document, copies_of(session));
}

void ImageExport::finish_pass() {
  const render::Status status = session_.status();
  const uint32_t limit = editor_.document().limits.samples;
  const bool is_current = status.version == editor_.version();
  // A session that has stopped at its limit of samples has finished the pass already.
  if (is_current && status.finished && limit > 0 && status.samples >= limit) {
    version_ = editor_.version();
  } else {
    session_.pause(false);
    const uint32_t samples = is_current ? std::max(1u, status.samples) : 1;
    version_ = editor_.submit_with_limits({.samples = samples, .seconds = 0, .error = 0});
  }
  stage_ = Stage::finishing_pass;
}

std::optional<Result<SavedImage>> ImageExport::update() {
  if (requests_.empty() || editor_.empty()) return std::nullopt;
  if (stage_ == Stage::idle) {
    was_paused_ = session_.paused();
    finish_pass();
  }
  if (stage_ == Stage::finishing_pass) {
    // After an edit, the new image is exported.
    if (editor_.version() != version_) finish_pass();
    const render::Status status = session_.status();
    if (status.version != version_ || !status.finished) return std::nullopt;
    stage_ = Stage::writing;
    const Request& request = requests_.front();
    saved_ = {.file = request.file,
              .has_state = lower_extension(request.file) == ".exr",
              .document = editor_.document(),
              .revision = editor_.revision()};
    const auto work = [request, document = editor_.document(), version = version_, &session = session_] {
      return write(request.file, request.samples, session, document, version);
    };
    task_.start(work, wake_);
  }
  auto result = task_.take_result();
  if (!result) return std::nullopt;
  if (*result && (*result)->empty()) {
    finish_pass();
    return std::nullopt;
  }
  stage_ = Stage::idle;
  requests_.pop_front();
  if (was_paused_) session_.pause(true);
  editor_.submit();
  if (!*result) return result->error();
  return std::move(saved_);
}

}  // namespace etendue::viewer
