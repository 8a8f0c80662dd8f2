// The image that a session is rendering: previews, then samples in slices of limited duration, with statistics and
// limits.
//
// Functions are called by the session's thread, or by other threads while no slice is running.
#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "render/clock.h"
#include "render/error_monitor.h"
#include "render/film_clearing.h"
#include "render/focus.h"
#include "render/preview_resolution.h"
#include "render/renderer.h"
#include "render/session.h"
#include "render/session_film.h"
#include "render/shared_sampling.h"

namespace etendue::render {

class ProgressiveRender {
 public:
  // `keep_going` returns false if the current slice has to end. It is called from all workers.
  ProgressiveRender(ThreadPool& workers, const SessionOptions& options, std::function<bool()> keep_going);

  // Begins the image of a document, with the samples of `start` if there are any. The first preview is planned to take
  // at most this many seconds. `shares`: other processes render samples as well, and have begun the same document.
  void begin(Document document, std::shared_ptr<const scene::CompiledScene> scene, std::optional<ResumePoint> start,
             double preview_seconds, bool shares);
  bool has_begun() const { return renderer_ != nullptr; }
  const transport::Model& model() const { return renderer_->model(); }
  // The time that enlarging a preview of this document is expected to take, in seconds.
  double enlarging_seconds(const Document& document) const {
    return enlarging_seconds_per_pixel_ * document.width * document.height;
  }
  // Replaces the document by one whose samples are the same.
  void set_document(const Document& document);

  // The region that receives all samples from now on; nothing: all pixels alike. A region that is not inside the image
  // is ignored.
  void set_focus(const std::optional<PixelRect>& region) { requested_focus_ = region; }

  // Whether the edit has no frame yet.
  bool awaits_first_frame() const { return awaits_first_frame_; }
  void first_frame_shown() { awaits_first_frame_ = false; }

  // True while previews are to be rendered instead of slices.
  bool needs_preview();
  // Renders a preview; null if it was cancelled. `on_progress` is called now and then and may call `write_phase`. If the
  // phases of the integrator take long, `publish` receives a frame of another integrator meanwhile.
  std::shared_ptr<Frame> render_preview(const std::function<void(const Renderer&)>& on_progress,
                                        const std::function<void(std::shared_ptr<Frame>)>& publish);

  // Takes samples for a while. False if it was interrupted before the first one.
  bool render_slice();
  // Measures the error if it is due, and the last time when a limit was reached. Returns whether one was reached.
  bool update_statistics();
  // The frame that follows a slice; null if it is not due.
  std::shared_ptr<Frame> frame_after_slice(bool finished);

  // Writes the state of the image into a status: before the first sample, and after each slice.
  void write_initial_status(Status& status) const;
  void write_status(Status& status, bool finished);
  // Writes the phase of a renderer into a status. Phases that end quickly are not reported.
  void write_phase(Status& status, const Renderer& renderer);

  // The film, empty while the edit has no samples yet.
  film::Film film_copy() const;
  ResumePoint resume_point() const;
  std::vector<film::TailState> tail_states() const;
  std::optional<std::vector<float>> reweighted_copy() const;
  std::shared_ptr<const std::vector<integrator::StoredPoint>> stored_points() const;
  std::shared_ptr<const integrator::SolutionView> solution_view() const;

 private:
  size_t pixel_count() const { return static_cast<size_t>(document_.width) * static_cast<size_t>(document_.height); }
  bool is_first_slice() const { return awaits_first_frame_ && samples_ == 0; }
  double slice_seconds() const;
  bool clear_film();
  bool begin_step();
  void finish_step();
  bool add_shared_samples();
  bool limit_reached(double seconds);
  std::shared_ptr<Frame> render_substitute(uint32_t samples);
  std::shared_ptr<Frame> enlarge_preview();
  bool uses_focus() const;
  void update_focus();
  uint32_t samples_to_limit() const { return focus_ ? renderer_->samples() : samples_; }
  void write_focus(Status& status) const;
  void write_limit(Status& status) const;

  ThreadPool& workers_;
  SharedSampling* sharing_;  // null: none
  bool interactive_;
  double publish_interval_;
  std::function<bool()> keep_going_;
  FrameMaker frames_;

  Document document_;
  std::shared_ptr<const scene::CompiledScene> scene_;
  size_t scene_memory_ = 0;
  std::shared_ptr<integrator::PathLayerRecording> layers_;  // null: no layers of the paths; outlives the renderer
  std::unique_ptr<Renderer> renderer_;
  SessionFilm film_;
  bool film_is_stale_ = false;  // the film still holds samples of an earlier document
  ErrorMonitor error_monitor_;
  Renderer::Counters counters_;
  uint32_t samples_ = 0;
  bool shares_ = false;                    // other processes render samples of this document
  std::optional<SharedSamples> received_;  // samples of other processes that are being added to the film
  uint32_t shared_samples_ = 0;            // of other processes, per pixel; part of `samples_`
  double seconds_ = 0;                     // of rendering
  double earlier_seconds_ = 0;             // part of `seconds_` before the resume point
  double focus_seconds_ = 0;               // part of `seconds_` with a focus
  std::optional<PixelRect> requested_focus_;
  std::optional<FocusMonitor> focus_;  // nothing while all pixels are sampled alike

  PreviewResolution preview_resolution_;
  PreviewFilms preview_films_;
  double enlarging_seconds_per_pixel_ = 0;
  bool awaits_first_frame_ = false;
  bool shows_substitute_ = false;           // the last frame is one, of this or an earlier document
  std::shared_ptr<const Preview> preview_;  // shown where the film has no samples yet
  uint64_t paths_in_frame_ = 0;             // paths and samples that the last frame was made of
  uint32_t samples_in_frame_ = 0;

  const char* phase_ = nullptr;  // of the integrator, in the current sample
  uint32_t phase_sample_ = 0;
  Clock::time_point phase_began_;
};

}  // namespace etendue::render
