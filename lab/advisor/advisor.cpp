#include "advisor/advisor.h"

#include <algorithm>
#include <cmath>

#include "advisor/number_text.h"
#include "render/incompatibility.h"
#include "scene/compiled_scene.h"

namespace etendue::advisor {
namespace {

using integrator::Bias;

// The part of the progress that the table takes.
constexpr double kTablePart = 0.2;

// Why a method cannot be had; empty if it can.
std::string objection(const bench::MethodSpec& method, const scene::CompiledScene& scene, const MissingPaths& misses,
                      double target) {
  if (std::string incompatibility = render::incompatibility(method.document, scene); !incompatibility.empty())
    return incompatibility;
  const auto& info = *integrator::find_integrator(method.document.method.integrator);
  if (info.bias == Bias::biased) return "biased: it has an error of its own, which no time takes away";
  if (picks_techniques(method.document.method))
    return "its settings leave techniques out or show some alone: what these miss is not known";
  if (misses.rms > kNegligible * target)
    return sentence_of(misses) + ": its RMSE stays above " + number(misses.rms) + ", whatever the time";
  return {};
}

Advice advice_of(const bench::MethodSpec& method, const scene::CompiledScene& scene, const ClassTable& table,
                 double target) {
  Advice advice;
  advice.method = method;
  advice.misses = missing_paths(declared(method.document, scene), table);
  advice.reason = objection(method, scene, advice.misses, target);
  advice.suitable = advice.reason.empty();
  return advice;
}

// What noise may be left where something is missing.
double noise_target(const Advice& advice, double target) {
  return std::sqrt(std::max(0.0, sqr(target) - sqr(advice.misses.rms)));
}

void take_pilot(Advice& advice, const Pilot& pilot, const Enlargement& enlargement, double target) {
  advice.pilot_samples = pilot.samples, advice.pilot_seconds = pilot.seconds;
  advice.pilot_rmse = pilot.error.rmse * enlargement.rmse;
  advice.exponent = pilot.forecast.exponent();
  advice.time = pilot.time_to(noise_target(advice, target) / enlargement.rmse);
  if (!advice.time) return;
  advice.time->seconds *= enlargement.seconds;
  advice.time->interval.low *= enlargement.seconds, advice.time->interval.high *= enlargement.seconds;
}

// By how much the exponents differ, if that is what makes one slower.
std::string why_slower(const Advice& slow, const Advice& best) {
  const double doubt = std::hypot(slow.exponent.error, best.exponent.error);
  if (best.exponent.value - slow.exponent.value < 2 * doubt) return "";
  return "; its error falls as samples^-" + number(slow.exponent.value) + ", the other's as ^-" +
         number(best.exponent.value);
}

std::string reason_of(const Advice& advice, const Advice& best) {
  if (!advice.time) return "its pilot was too short to tell an error; give it more time";
  const std::string misses = advice.misses.none() ? "" : "; " + sentence_of(advice.misses) + ", which is little enough";
  if (&advice == &best) return "the fastest of those that find what carries light here" + misses;
  const double ratio = advice.time->seconds / best.time->seconds;
  if (advice.time->interval.low <= best.time->interval.high)
    return "not told apart from " + best.method.name + " by the pilots" + misses;
  return times(ratio) + " times as long as " + best.method.name + why_slower(advice, best) + misses;
}

void rank(Ranking& ranking) {
  std::ranges::stable_sort(ranking.methods, {}, [](const Advice& a) {
    return !a.suitable ? std::pair(2, 0.0) : !a.time ? std::pair(1, 0.0) : std::pair(0, a.time->seconds);
  });
  const Advice* best = ranking.best();
  for (Advice& advice : ranking.methods)
    if (advice.suitable) advice.reason = reason_of(advice, best ? *best : advice);
}

}  // namespace

std::vector<bench::MethodSpec> candidates(const render::Document& document) {
  std::vector<bench::MethodSpec> list;
  for (const auto& integrator : integrator::integrator_infos())
    for (const auto& sampler : sampler_infos())
      list.push_back(*bench::parse_method(integrator.name + ":sampler=" + sampler.name, document));
  return list;
}

Ranking advise(render::Session& session, const render::Document& document, const Question& question,
               const bench::Progress& watch, const RankingPublisher& publish) {
  Ranking ranking;
  ranking.target = question.target;
  const auto show = [&] {
    if (publish) publish(ranking);
  };
  const bench::Progress first = [&](double done, const std::string& what) { return watch(kTablePart * done, what); };
  ranking.table = class_table(session, document, question.table, first, [&](const ClassTable& table) {
    ranking.table = table;
    show();
  });
  ranking.interrupted = !ranking.table.finished;
  if (ranking.interrupted) return ranking;
  // The last picture of the table may be of some of the lights alone.
  const auto scene = scene::compile(document.scene, document.camera, session.scene());
  ranking.beyond_methods = beyond_all_methods(*scene);

  std::vector<bench::MethodSpec> fit;
  for (const auto& method : candidates(document)) {
    ranking.methods.push_back(advice_of(method, *scene, ranking.table, question.target));
    if (ranking.methods.back().suitable) fit.push_back(method);
  }
  const bench::Progress second = [&](double done, const std::string& what) {
    return watch(kTablePart + (1 - kTablePart) * done, what);
  };
  const auto take = [&](const Pilots& pilots) {
    for (const Pilot& pilot : pilots.pilots)
      for (Advice& advice : ranking.methods)
        if (advice.method.name == pilot.method.name) take_pilot(advice, pilot, pilots.enlargement, question.target);
    rank(ranking);
    show();
  };
  const PilotPlan plan{question.pilot_seconds, question.target, question.seed};
  const auto pilots = run_pilots(session, fit, plan, second, take);
  take(pilots);
  ranking.interrupted = pilots.interrupted;
  return ranking;
}

}  // namespace etendue::advisor
