#include "viewer/tasks/technique_task.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "advisor/class_energy.h"
#include "camera/camera_ray.h"
#include "film/film_image.h"
#include "integrator/bdpt/techniques.h"
#include "integrator/integrator.h"
#include "render/incompatibility.h"
#include "render/session.h"
#include "viewer/state/document_info.h"
#include "viewer/state/editor.h"
#include "viewer/state/notices.h"
#include "viewer/tasks/technique_export.h"

namespace etendue::viewer {
namespace {

using integrator::Techniques;

constexpr int kWidth = 96;  // of the small images
constexpr int kMaxHeight = 192;
// Seconds after an edit in which the main rendering has the processor to itself.
constexpr double kRestDelay = 0.3;
// The number of samples per pixel grows by this factor from round to round.
constexpr uint32_t kGrowth = 4;

// The parameters of the integrator that select techniques.
const integrator::TechniqueParameters& technique_parameters(const render::Document& d) {
  return integrator::find_integrator(d.method.integrator)->techniques;
}

std::string qualified_name(const render::Document& d, std::string_view parameter) {
  return d.method.integrator + "." + std::string(parameter);
}

render::Document with_value(const render::Document& d, std::string_view parameter, const Value& value) {
  const auto changed = render::with(d, qualified_name(d, parameter), value);
  return changed ? *changed : d;
}

// 0 is no limit.
int64_t max_path_length(const render::Document& d) {
  const auto limit = render::get(d, qualified_name(d, "max-depth"));
  return limit ? std::get<int64_t>(*limit) : 0;
}

// Renders the small images of a document, round by round.
class TechniqueRenderer {
 public:
  TechniqueRenderer(const render::Document& document, const TechniqueTask::Parameters& parameters,
                    const std::shared_ptr<const scene::CompiledScene>& scene,
                    const ProgressiveTask<TechniqueImages>::Publisher& publish, const bench::Progress& progress)
      : small_(reduced(document)),
        parameters_(parameters),
        publish_(publish),
        progress_(progress),
        session_({.threads = 1, .interactive = false, .publish_interval = 0.1, .scene = scene}) {
    result_.width = small_.width;
    result_.height = small_.height;
    for (int edges = 1; edges <= parameters.longest; ++edges)
      for (int s = 0; s <= edges + 1; ++s) {
        const int t = edges + 1 - s;
        result_.images.push_back({.s = s, .t = t, .unavailable = reason_unavailable(s, t)});
      }
    films_.resize(result_.images.size() + 1);
  }

  void render_all() {
    const auto target = static_cast<uint32_t>(parameters_.samples.value);
    for (uint32_t samples = std::min(2u, target);; samples = std::min(samples * kGrowth, target)) {
      if (!render(combined(), result_.combined, films_.back(), samples)) return;
      for (size_t i = 0; i < result_.images.size(); ++i) {
        TechniqueImage& image = result_.images[i];
        if (image.unavailable.empty() && !render(single(image), image, films_[i], samples)) return;
      }
      if (samples == target) return;
    }
  }

 private:
  static render::Document reduced(const render::Document& document) {
    render::Document d = document;
    d.width = kWidth;
    d.height = std::clamp(kWidth * document.height / std::max(1, document.width), 1, kMaxHeight);
    return with_value(d, technique_parameters(d).only, std::string());
  }

  // Why a technique contributes nothing, as far as that follows from the document.
  std::string reason_unavailable(int s, int t) const {
    if (Techniques::parse(TechniqueTask::disabled_techniques(small_))->contains(s, t))
      return "Disabled: its weight goes to the other techniques.";
    if (t == 0 && !CameraRays(small_.camera, small_.width, small_.height).can_be_hit())
      return "A light path cannot hit this lens: its area is zero.";
    const int64_t longest = max_path_length(small_);
    return longest > 0 && s + t - 1 > longest ? "These paths are longer than the maximum of the integrator." : "";
  }

  render::Document combined() const { return with_value(small_, technique_parameters(small_).weighted, true); }

  render::Document single(const TechniqueImage& image) const {
    const auto& names = technique_parameters(small_);
    auto d = with_value(small_, names.only, std::to_string(image.s) + "," + std::to_string(image.t));
    d = with_value(d, names.weighted, parameters_.weighted.value);
    return with_value(d, "max-depth", int64_t{image.edges()});
  }

  // Continues an image to this number of samples. Returns false if the task was cancelled.
  bool render(render::Document d, TechniqueImage& image, film::Film& film, uint32_t samples) {
    d.limits = {.samples = samples, .seconds = 0, .error = 0};
    const uint64_t version = image.samples > 0 ? session_.submit(d, std::move(film)) : session_.submit(d);
    const auto keep_going = [&](const render::Status&) { return progress_(0, "techniques"); };
    if (!bench::wait_for(session_, version, keep_going)) return false;
    film = session_.film_copy();
    const auto energy = advisor::class_energy(film);
    image.samples = samples;
    image.mean = energy.mean;
    image.standard_error = energy.standard_error;
    image.pixels = std::make_shared<const std::vector<float>>(film::radiance_of(film));
    publish_(result_);
    return progress_(0, "techniques");
  }

  const render::Document small_;
  const TechniqueTask::Parameters& parameters_;
  const ProgressiveTask<TechniqueImages>::Publisher& publish_;
  const bench::Progress& progress_;
  render::Session session_;
  TechniqueImages result_;
  std::vector<film::Film> films_;  // of the images, then of the combined image
};

std::string vertices(int count) { return std::to_string(count) + (count == 1 ? " vertex" : " vertices"); }

}  // namespace

std::optional<double> TechniqueImages::share(const TechniqueImage& image) const {
  if (!image.pixels || !(combined.mean > 0)) return {};
  return image.mean / combined.mean;
}

TechniqueImages::Sum TechniqueImages::sum() const {
  Sum sum;
  double variance = 0;
  for (const TechniqueImage& image : images) {
    if (!share(image)) continue;
    sum.share += *share(image);
    variance += sqr(image.standard_error / combined.mean);
  }
  if (combined.mean > 0) variance += sqr(sum.share * combined.standard_error / combined.mean);
  sum.error = std::sqrt(variance);
  return sum;
}

bool TechniqueTask::is_available(const render::Document& document) {
  return document.scene && !technique_parameters(document).empty();
}

std::string TechniqueTask::disabled_parameter(const render::Document& document) {
  return qualified_name(document, technique_parameters(document).without);
}

std::string TechniqueTask::disabled_techniques(const render::Document& document) {
  return std::get<std::string>(*render::get(document, disabled_parameter(document)));
}

bool TechniqueTask::same_question(const render::Document& document) const {
  return same_view(document, document_) && document.method == document_.method &&
         parameters.weighted == rendered_parameters_.weighted && parameters.longest == rendered_parameters_.longest &&
         parameters.samples == rendered_parameters_.samples;
}

bool TechniqueTask::is_current(const render::Document& document) const { return result() && same_question(document); }

void TechniqueTask::update(const TaskContext& context, bool allowed) {
  if (auto written = export_.take_result()) {
    if (*written)
      context.notices.add_message("Saved " + **written);
    else
      context.notices.add_error(written->error().message);
  }
  const Editor& editor = context.editor;
  if (editor.version() != edited_version_) {
    edited_version_ = editor.version();
    edit_time_ = Clock::now();
  }
  if (task_.update()) complete_ = true;
  const bool same = same_question(editor.document());
  if (running() && !(allowed && same)) task_.cancel();
  const double since_edit = std::chrono::duration<double>(Clock::now() - edit_time_).count();
  const bool can_start = allowed && is_available(editor.document()) && !running() && since_edit >= kRestDelay;
  if (!can_start || (complete_ && same)) return;
  document_ = editor.document();
  rendered_parameters_ = parameters;
  complete_ = false;
  const auto work = [document = document_, parameters = parameters, scene = context.session.scene()](
                        const auto& publish, const bench::Progress& progress) {
    TechniqueRenderer(document, parameters, scene, publish, progress).render_all();
  };
  task_.start(work, context.wake);
}

void TechniqueTask::reset(const TaskContext&) {
  task_.reset();
  complete_ = false;
}

void TechniqueTask::save(const TaskContext& context, const std::string& file) {
  if (!result()) return;
  const auto& display = context.editor.document().display;
  const auto write = [file, result = task_.result(), exposure = display.exposure + parameters.exposure,
                      curve = display.curve] { return write_techniques(file, *result, exposure, curve); };
  export_.start(write, context.wake);
}

std::string toggle_technique(const std::string& set, int s, int t) {
  std::istringstream words(set);
  std::string remaining;
  bool contained = false;
  for (std::string word; words >> word;) {
    const auto parsed = Techniques::parse(word);
    if (parsed && parsed->contains(s, t))
      contained = true;
    else
      remaining += (remaining.empty() ? "" : " ") + word;
  }
  if (!contained) remaining += (remaining.empty() ? "" : " ") + std::to_string(s) + "," + std::to_string(t);
  return remaining;
}

std::string describe_technique(int s, int t) {
  if (s == 0) return "The camera subpath hits a light.";
  if (t == 0) return "The light subpath hits the lens.";
  if (s == 1 && t == 1) return "A sampled point on a light is connected to the camera.";
  if (s == 1) return "A camera subpath of " + vertices(t) + " is connected to a sampled point on a light.";
  if (t == 1) return "A light subpath of " + vertices(s) + " is connected to the camera.";
  return "A camera subpath of " + vertices(t) + " is connected to a light subpath of " + vertices(s) + ".";
}

}  // namespace etendue::viewer
