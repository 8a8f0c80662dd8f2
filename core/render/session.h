// Progressive rendering in the background: documents go in, frames come out.
//
// A session owns its threads. `submit` passes it a new version of the document and returns at once. The work in
// progress stops within a fraction of a millisecond, the parts of the scene that the edit affects are compiled again,
// and rendering restarts: previews first, then the full resolution, sample by sample. Frames are immutable and carry
// the version that they show. Only `finish`, the copies of the film and the destructor wait for the session's thread.
//
// The same document, seed and sample count give the same film bit for bit, whatever the number of threads: a sample
// depends on its pixel and its number only.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "film/film.h"
#include "integrator/integrator_info.h"
#include "integrator/solution_view.h"
#include "render/display_frame.h"
#include "render/document.h"
#include "render/focus.h"
#include "render/reliability.h"
#include "render/resume_point.h"
#include "render/time_estimate.h"
#include "scene/build_report.h"
#include "scene/forward.h"
#include "transport/model.h"

namespace etendue::render {

class SharedSampling;

struct Status {
  uint64_t version = 0;  // of the document that is being rendered
  uint32_t samples = 0;  // complete samples of every pixel
  double seconds = 0;    // of sampling this version
  uint64_t rays = 0, paths = 0;
  double rays_per_second = 0, paths_per_second = 0;
  film::ErrorEstimate error;
  film::ErrorMeasure measure = film::ErrorMeasure::rmse;  // of the document's limits
  film::MeasuredError measured_error;                     // in this measure
  film::InvalidSamples rejected;
  std::shared_ptr<const Reliability> reliability;  // of the error, at its last measurement; null before the first
  std::vector<integrator::Statistic> statistics;   // reported by the integrator
  std::vector<std::string> notes;  // approximations and failures of the integrator that affect the image, as sentences
  size_t memory = 0;               // bytes of scene arrays, Embree, the film with its statistics, and the integrator
  scene::BuildReport build;
  // "compiling", "rendering", "paused", "done", or the phase of the integrator ("tracing photons") if it takes long.
  std::string phase;
  double phase_progress = 0;            // of the integrator's phase, 0 to 1
  std::string incompatibility;          // why the integrator finds no light in this scene (incompatibility.h), or empty
  bool finished = false;                // a limit was reached
  double progress = 0;                  // towards the nearest limit, 0 to 1
  std::optional<Prediction> time_left;  // until the nearest limit, if there is one and the time can be predicted
  std::optional<FocusStatus> focus;     // if the session has one; limits then refer to its region
};

struct SessionOptions {
  int threads = 0;                // 0: one per hardware thread
  bool interactive = false;       // produce frames, previews first; otherwise only the film
  double publish_interval = 0.1;  // seconds between frames; longer when many samples make consecutive frames similar
  // The compiled scene of another session, or null. Parts that the first document shares with it are not compiled
  // again.
  std::shared_ptr<const scene::CompiledScene> scene = nullptr;
  SharedSampling* sharing = nullptr;  // other processes that render samples as well (shared_sampling.h); null: none
};

class Session {
 public:
  explicit Session(const SessionOptions& options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Returns the version that the document receives. A document that differs only in limits or display settings does not
  // restart the rendering.
  uint64_t submit(const Document& document);
  // The same, continuing from a checkpoint or from the film of another session.
  uint64_t submit(const Document& document, ResumePoint start);
  // Discards all samples of the last document, and renders it again under the version that is returned. Does nothing before
  // the first document.
  uint64_t restart();
  void pause(bool paused);
  bool paused() const;

  std::shared_ptr<const Frame> frame() const;
  Status status() const;
  std::shared_ptr<const scene::CompiledScene> scene() const;
  transport::Model model() const;
  // Milliseconds from `submit` to the first frame of each version, oldest first. Clears the list.
  std::vector<double> take_latencies();
  // Milliseconds from `submit` until the workers had stopped and the edit was taken up, oldest first. Clears the list.
  std::vector<double> take_restart_latencies();

  // The region that receives all samples from now on, in pixels; nothing: all pixels alike (focus.h). Neither restarts the
  // rendering. A region that is not inside the image is ignored.
  void set_focus(const std::optional<PixelRect>& region);

  // `wake` is called on the session's thread for each new frame, to wake up an event loop. Set it before `submit`.
  void on_update(std::function<void()> wake);

  // Waits until the last submitted version has reached a limit, or another thread calls `stop`.
  void finish();
  void stop();

  // The film as it is now, copied between two slices of work.
  film::Film film_copy();
  // The film and the state of the integrator that belongs to it, for checkpoints.
  ResumePoint resume_point();
  // The states of the tail statistics of all tiles (TailStatistics); none before the first sample.
  std::vector<film::TailState> tail_states();
  // The image with fireflies re-weighted (film.fireflies), three numbers per pixel; nothing if they are kept.
  std::optional<std::vector<float>> reweighted_copy();
  // Photons or virtual lights that the integrator stores; null if none.
  std::shared_ptr<const std::vector<integrator::StoredPoint>> stored_points();
  // The solution of the radiosity equation as far as it is known; null if the integrator has none.
  std::shared_ptr<const integrator::SolutionView> solution_view();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

// Renders a document to this many samples per pixel, without frames. Threads as in SessionOptions.
film::Film rendered(const Document& document, uint32_t samples, int threads = 0);

}  // namespace etendue::render
