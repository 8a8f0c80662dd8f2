#include "viewer/files/image_export.h"

#include "advisor/certificate.h"
#include "render/image_output.h"

namespace etendue::viewer {
namespace {

// For finding out what a method may miss, where it does not declare to find everything.
constexpr double kCertificateSeconds = 0.5;

std::string certificate_of(const render::Session& session, const render::Document& document,
                           const advisor::Evidence& evidence) {
  render::Session own({.threads = 1, .scene = session.scene()});
  return advisor::certificate_json(advisor::certificate(own, document, evidence, kCertificateSeconds,
                                                        [](double, const std::string&) { return true; }));
}

// An empty name if the picture is no longer of this version.
Result<std::string> write(const std::string& file, render::Session& session, const render::Document& document,
                          uint64_t version) {
  if (auto known = render::check_output_name(file); !known) return known.error();
  const film::Film film = session.film_copy();
  auto shown = session.reweighted_copy();
  const render::Status status = session.status();
  const advisor::Evidence evidence{film.error(), film::relative_error(film), status.rejected, session.model(),
                                   status.health ? status.health->tail.khat : std::nullopt};
  // An edit that came before the copy would have its film under the old settings.
  if (session.status().version != version) return std::string();
  const render::Rendering rendering{document, film, status.samples, certificate_of(session, document, evidence),
                                    std::move(shown)};
  if (auto written = render::write_image(file, rendering); !written) return written.error();
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
    job_.start([file = files_.front(), document = editor_.document(), version = version_, &session = session_] {
      return write(file, session, document, version);
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
