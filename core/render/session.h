// A progressive rendering: edits in, frames out.
//
// A session owns its threads. `submit` hands it a new version of the document and returns at once; whatever is being
// rendered stops within a fraction of a millisecond, what the edit touched is compiled anew, and rendering restarts:
// coarse first, then at full resolution, sample by sample. Frames are immutable and say which version they show.
// Nothing here waits for the caller, and the caller never waits for anything here, except in `finish` and the
// destructor.
//
// The same document, seed and sample count give the same film bit for bit, whatever the number of threads: a sample
// depends on its pixel and its number alone.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "film/film.h"
#include "integrator/integrator_info.h"
#include "render/document.h"
#include "render/frame.h"
#include "render/reliability.h"
#include "render/time_estimate.h"
#include "scene/build_report.h"
#include "scene/forward.h"
#include "transport/model.h"

namespace etendue::render {

struct Status {
  uint64_t version = 0;  // of the document that is being rendered
  uint32_t samples = 0;  // complete samples of every pixel
  double seconds = 0;    // spent sampling this version
  uint64_t rays = 0, paths = 0;
  double rays_per_second = 0, paths_per_second = 0;
  film::ErrorEstimate error;
  film::InvalidSamples rejected;
  std::shared_ptr<const Reliability> reliability;  // as it was at some sample before; null until it was first looked at
  std::vector<integrator::Statistic> statistics;   // what the method knows of its own work
  size_t memory = 0;  // bytes of scene arrays, Embree, the film and what watches its samples
  scene::BuildReport build;
  // "compiling", "rendering", "paused", "done", or what a method does first ("tracing photons"), where that takes long.
  std::string phase;
  double phase_progress = 0;    // of what a method does first, 0 to 1
  std::string incompatibility;  // why the method finds no light at all here (render/obstacle.h); empty if it may
  bool finished = false;        // a limit was reached
  double progress = 0;          // towards the nearest limit, 0 to 1
  std::optional<Prediction> time_left;  // seconds to the nearest limit, if there is one and it can be told
};

// What a rendering goes on from.
struct ResumePoint {
  film::Film film;
  std::vector<std::byte> integrator_state;  // the state of the method's work, where it has one

  ResumePoint(film::Film film_, std::vector<std::byte> integrator_state_ = {})  // NOLINT(google-explicit-constructor)
      : film(std::move(film_)), integrator_state(std::move(integrator_state_)) {}
};

struct SessionOptions {
  int threads = 0;                // 0: one per hardware thread
  bool interactive = false;       // coarse frames first, and frames at all; without, frames come from `film` at the end
  double publish_interval = 0.1;  // seconds between frames; longer when many samples make them alike
  // Of a session beside this one, or null: what the first document has in common with it is not compiled again.
  std::shared_ptr<const scene::CompiledScene> scene = nullptr;
};

class Session {
 public:
  explicit Session(const SessionOptions& options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Returns the version that the document got. What does not change the light (limits, display) does not restart.
  uint64_t submit(const Document& document);
  void restart();
  void pause(bool paused);
  bool paused() const;

  std::shared_ptr<const Frame> frame() const;
  Status status() const;
  std::shared_ptr<const scene::CompiledScene> scene() const;
  transport::Model model() const;
  // Milliseconds from `submit` to the first frame of that version, oldest first; clears the list.
  std::vector<double> take_latencies();
  // Milliseconds from `submit` until the workers had stopped and taken up the edit, oldest first; clears the list.
  std::vector<double> take_restart_latencies();

  // Called on the session's thread when a new frame or status is there: to wake up an event loop. Set before `submit`.
  void on_update(std::function<void()> wake);

  // Waits until the version that was last submitted has reached a limit, or `stop` is called from another thread.
  void finish();
  void stop();

  // The film as it is, taken between two slices of work.
  film::Film film_copy();
  // The same with what belongs to it, for checkpoints.
  ResumePoint resume_point();
  // The same as it is shown, three numbers a pixel, where film.fireflies re-weights it; nothing where it does not.
  std::optional<std::vector<float>> reweighted_copy();
  // What the method keeps in space (photons, virtual lights), taken likewise; null if nothing.
  std::shared_ptr<const std::vector<integrator::StoredPoint>> stored_points();
  // Continues from a checkpoint. Call after `submit`, before anything was rendered: rendering starts from
  // there.
  uint64_t submit(const Document& document, ResumePoint start);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

// A document rendered to this many samples of every pixel, without frames in between; threads as in SessionOptions.
film::Film rendered(const Document& document, uint32_t samples, int threads = 0);

}  // namespace etendue::render
