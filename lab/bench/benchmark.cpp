#include "bench/benchmark.h"

#include <cmath>

#include "bench/external_renderer.h"
#include "bench/measurement_schedule.h"
#include "film/film_image.h"
#include "render/incompatibility.h"
#include "scene/compiled_scene.h"

namespace etendue::bench {
namespace {

// The fraction of the budget that is left for rendering after an automatic choice, if the choice took longer.
constexpr double kLeastRemaining = 0.01;

class Runner {
 public:
  Runner(render::Session& session, const Plan& plan, const Reference& reference, const Progress& progress)
      : session_(session), plan_(plan), reference_(reference), progress_(progress) {
    for (const auto& method : plan.methods) {
      MethodResult& result = outcome_.methods.emplace_back();
      result.curves.name = method.label();
      if (!method.is_external() && !method.is_automatic()) result.incompatibility = incompatibility_of(method);
    }
  }

  Outcome run() {
    for (int repeat = 0; repeat < plan_.repeats; ++repeat)
      for (size_t method = 0; method < plan_.methods.size(); ++method)
        if (outcome_.methods[method].incompatibility.empty() && !run_repeat(method, repeat)) {
          outcome_.interrupted = true;
          return std::move(outcome_);
        }
    return std::move(outcome_);
  }

 private:
  std::string incompatibility_of(const MethodSpec& method) {
    const render::Document& d = method.document;
    scene_ = scene::compile(d.scene, d.camera, scene_ ? scene_ : session_.scene(), d.height);
    return render::incompatibility(d, *scene_);
  }

  // One repeat of one method. Returns false if it was interrupted; its results are then discarded.
  bool run_repeat(size_t method, int repeat) {
    return plan_.methods[method].is_external() ? run_external(method, repeat) : run_integrator(method, repeat);
  }

  bool run_external(size_t method, int repeat) {
    const MethodSpec& spec = plan_.methods[method];
    MethodResult& result = outcome_.methods[method];
    metrics::ErrorCurve curve{repeat, {}};
    std::vector<ExternalRun> runs;
    std::vector<float> image;
    while (const uint32_t samples = next_external_samples(runs, plan_.seconds, plan_.samples)) {
      render::Status status;
      if (!runs.empty()) status.seconds = runs.back().seconds - time_of(runs).startup;
      status.samples = runs.empty() ? 0 : runs.back().samples;
      auto rendered =
          render_externally(spec.command, spec.document.width, spec.document.height, samples,
                            repeat_seed(plan_.seed, method, repeat), [&] { return report(method, repeat, status); });
      if (!rendered && rendered.error().fault == Fault::interrupted) return false;
      if (!rendered) return fail(result, rendered.error().message);
      runs.push_back({samples, rendered->seconds});
      image = std::move(rendered->rgb);
      curve.points.push_back(measure_error(image, reference_, rendered->seconds, samples));
    }
    const ExternalTime time = time_of(runs);
    for (metrics::ErrorPoint& point : curve.points) point.seconds = time.per_sample * point.spp;
    result.startup_seconds.push_back(time.startup);
    render::Status status;
    status.rays_per_second = NAN;
    finish(result, std::move(curve), std::move(image), status);
    return true;
  }

  // Gives up on another renderer.
  static bool fail(MethodResult& result, const std::string& message) {
    const std::string name = result.curves.name;
    result = {};
    result.curves.name = name;
    result.incompatibility = message;
    return true;
  }

  bool run_integrator(size_t method, int repeat) {
    render::Document d = plan_.methods[method].document;
    d.seed = repeat_seed(plan_.seed, method, repeat);
    double choice_seconds = 0;
    if (plan_.methods[method].is_automatic()) {
      const auto chosen = choose(d, method, repeat);
      if (!chosen) return fail(outcome_.methods[method], chosen.error().message);
      if (chosen->interrupted) return false;
      d = chosen->document;
      choice_seconds = chosen->seconds;
      outcome_.methods[method].choices.push_back(chosen->reason);
    }
    const double seconds =
        plan_.seconds > 0 ? std::max(kLeastRemaining * plan_.seconds, plan_.seconds - choice_seconds) : 0;
    metrics::ErrorCurve curve{repeat, {}};
    std::vector<float> image;
    render::Status status;
    for (uint32_t count = 1;; count = next_sample_count(count)) {
      if (!report(method, repeat, status)) return false;  // short renderings end before wait_for reports
      const bool last = plan_.samples > 0 && count >= plan_.samples;
      d.limits = {last ? plan_.samples : count, seconds, 0};
      if (!wait_for(session_, session_.submit(d), [&](const auto& s) { return report(method, repeat, s); }))
        return false;
      const uint32_t before = status.samples;
      status = session_.status();
      if (status.samples > before || curve.points.empty()) {
        image = film::radiance_of(session_.film_copy());
        curve.points.push_back(measure_error(image, reference_, choice_seconds + status.seconds, status.samples));
      }
      if (last || status.samples < count) break;
    }
    finish(outcome_.methods[method], std::move(curve), std::move(image), status);
    return true;
  }

  Result<ChosenMethod> choose(render::Document d, size_t method, int repeat) {
    if (!plan_.choose) return usage_error("the integrator cannot be chosen automatically here");
    d.limits = {plan_.samples, plan_.seconds, 0};
    return plan_.choose(session_, d, [&](double, const std::string&) { return report(method, repeat, {}); });
  }

  void finish(MethodResult& result, metrics::ErrorCurve curve, std::vector<float> image, const render::Status& status) {
    result.rays_per_second.push_back(status.rays_per_second);
    const auto n = static_cast<double>(result.rays_per_second.size());
    result.mean_mse += (curve.points.back().mse - result.mean_mse) / n;
    result.mean_image.resize(image.size());
    for (size_t i = 0; i < image.size(); ++i)
      result.mean_image[i] += (static_cast<double>(image[i]) - result.mean_image[i]) / n;
    result.curves.repeats.push_back(std::move(curve));
    result.image = std::move(image);
    result.reliability = status.reliability;
  }

  bool report(size_t method, int repeat, const render::Status& s) const {
    const double runs = static_cast<double>(plan_.methods.size()) * plan_.repeats;
    const double finished =
        static_cast<double>(repeat) * static_cast<double>(plan_.methods.size()) + static_cast<double>(method);
    double current = plan_.seconds > 0 ? s.seconds / plan_.seconds : 0;
    if (plan_.samples > 0) current = std::max(current, static_cast<double>(s.samples) / plan_.samples);
    return progress_((finished + std::min(current, 1.0)) / runs, plan_.methods[method].label() + ", repeat " +
                                                                     std::to_string(repeat + 1) + " of " +
                                                                     std::to_string(plan_.repeats));
  }

  render::Session& session_;
  const Plan& plan_;
  const Reference& reference_;
  const Progress& progress_;
  std::shared_ptr<const scene::CompiledScene> scene_;
  Outcome outcome_;
};

}  // namespace

Outcome run(render::Session& session, const Plan& plan, const Reference& reference, const Progress& progress) {
  return Runner(session, plan, reference, progress).run();
}

}  // namespace etendue::bench
