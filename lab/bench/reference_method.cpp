#include "bench/reference_method.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/reference.h"
#include "integrator/integrator.h"
#include "light/light.h"

namespace etendue::bench {
namespace {

constexpr const char* kDefault = "path";
// It finds light that path tracing finds seldom: caustics, and light from sources that are hidden from most of the scene.
constexpr const char* kAlternative = "bdpt";

bool has_delta_lights(const scene::Scene& scene) {
  return std::ranges::any_of(scene.lights, [](const Light& light) { return !light.is_area_light(); });
}

// Whether an integrator has independent samples of the paths that path tracing samples.
bool is_candidate(const std::string& integrator, const scene::Scene& scene) {
  const auto* info = integrator::find_integrator(integrator);
  const auto* usual = integrator::find_integrator(kDefault);
  if (!info || info->bias != integrator::Bias::unbiased || info->group == integrator::Group::markov_chain) return false;
  return info->paths == usual->paths && (!has_delta_lights(scene) || info->point_paths == usual->point_paths);
}

bool is_candidate(const MethodSpec& method, const render::Document& base) {
  return !method.is_external() && is_candidate(method.document.method.integrator, *base.scene) &&
         method.document.method.adaptive == render::Adaptive::off &&
         method.document.method.settings == base.method.settings;
}

// The upper end of the interval is used, because rare bright samples make the estimate of a pilot too small.
ReferencePilot pilot_of(const std::string& name, const film::Film& film, double seconds) {
  ReferencePilot pilot;
  pilot.name = name;
  const film::ErrorEstimate error = film.error();
  pilot.cost = error.known ? error.rmse_interval.high * error.rmse_interval.high * seconds : INFINITY;
  double variance = 0;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      pilot.mean += static_cast<double>(luminance(film.mean(x, y)));
      variance += static_cast<double>(luminance(film.variance_of_mean(x, y)));
    }
  const auto pixels = static_cast<double>(film.pixels().size());
  pilot.mean /= pixels;
  pilot.standard_error = std::sqrt(variance) / pixels;
  return pilot;
}

// A pilot that is significantly darker than another one has missed rare bright samples; its error is unknown.
bool misses_light(const ReferencePilot& pilot, std::span<const ReferencePilot> pilots) {
  return std::ranges::any_of(pilots, [&](const ReferencePilot& other) {
    return other.mean - pilot.mean > 3 * std::hypot(pilot.standard_error, other.standard_error);
  });
}

}  // namespace

const ReferencePilot* most_efficient(std::span<const ReferencePilot> pilots) {
  const ReferencePilot* best = nullptr;
  for (const ReferencePilot& pilot : pilots)
    if (std::isfinite(pilot.cost) && !misses_light(pilot, pilots) && (!best || pilot.cost < best->cost)) best = &pilot;
  return best;
}

std::vector<std::string> reference_candidates(const render::Document& base, std::span<const MethodSpec> methods) {
  std::vector<std::string> names{kDefault};
  if (is_candidate(kAlternative, *base.scene)) names.push_back(kAlternative);
  for (const MethodSpec& method : methods) {
    const std::string& name = method.document.method.integrator;
    if (is_candidate(method, base) && std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

std::string reference_integrator(render::Session& session, const render::Document& base,
                                 std::span<const MethodSpec> methods, double seconds, const Progress& progress) {
  const std::vector<std::string> names = reference_candidates(base, methods);
  if (names.size() == 1) return kDefault;
  std::vector<ReferencePilot> pilots;
  for (const std::string& name : names) {
    render::Document d = ReferenceStore(base, {}, name).document();
    d.limits.seconds = seconds;
    const auto keep_going = [&](const render::Status& s) { return progress(s.progress, "pilot of " + name); };
    if (!wait_for(session, session.submit(d), keep_going)) return kDefault;
    if (session.status().incompatibility.empty())
      pilots.push_back(pilot_of(name, session.film_copy(), session.status().seconds));
  }
  const ReferencePilot* best = most_efficient(pilots);
  return best ? best->name : kDefault;
}

}  // namespace etendue::bench
