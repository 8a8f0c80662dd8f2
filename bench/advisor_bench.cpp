// Quality of the advisor: its ranking against a full benchmark, and predicted times against measured ones.
//
//   advisor_bench [WIDTH HEIGHT] [SCENE...]
//
// Ranking: the target is the error that the best integrator reaches in the benchmark. The ranking of the advisor is
// compared with the order of errors after equal time. Times: long renderings are replayed. After a pilot of 16 to 128
// samples the predictor estimates when the error will be 1.5 to 8 times smaller; the remainder of the rendering shows
// when it was. Results are given in seconds and in samples. Samples are independent of the load of the machine.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "advisor/advisor.h"
#include "advisor/reference_integrator.h"
#include "advisor/true_error.h"
#include "bench/benchmark.h"
#include "bench/summary.h"
#include "film/film_image.h"
#include "support/scenes.h"

namespace etendue {
namespace {

constexpr double kBudget = 2;  // seconds per method and repeat
constexpr int kRepeats = 2, kSeeds = 3;
constexpr uint32_t kLongest = 1024, kReference = 2048;
constexpr double kFactor = 1.5;

bool never_stop(double, const std::string&) { return true; }

// --- Rankings ------------------------------------------------------------------------------------------------------

// Kendall's tau: the fraction of pairs in the same order minus the fraction in the opposite order.
double tau(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0, pairs = 0;
  for (size_t i = 0; i < a.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      sum += (a[i] - a[j]) * (b[i] - b[j]) > 0 ? 1 : -1;
      pairs += 1;
    }
  return pairs > 0 ? sum / pairs : 1;
}

void compare_ranking(render::Session& session, const render::Document& d, const bench::Reference& reference) {
  std::vector<bench::MethodSpec> methods;
  for (auto& method : advisor::candidates(d))
    if (integrator::find_integrator(method.document.method.integrator)->bias == integrator::Bias::unbiased)
      methods.push_back(method);
  const auto outcome = bench::run(session, {methods, kBudget, 0, kRepeats, 7}, reference, never_stop);
  std::vector<double> rmse;
  for (const auto& result : outcome.methods) rmse.push_back(bench::summary_of(result, reference, {}).rmse);
  const double best = *std::ranges::min_element(rmse);
  advisor::AdviceRequest question;
  question.target = best;
  question.pilot_seconds = 0.5;
  const auto ranking = advisor::advise(session, d, question, never_stop);
  std::vector<double> seconds(methods.size(), INFINITY);
  double rmse_of_best = INFINITY;
  for (size_t i = 0; i < methods.size(); ++i)
    for (const auto& advice : ranking.methods)
      if (advice.method.name == methods[i].name && advice.time) {
        seconds[i] = advice.time->seconds;
        if (&advice == ranking.best()) rmse_of_best = rmse[i];
      }
  std::printf(
      "  ranking of %zu: tau %.2f; best in the benchmark %s, recommended %s, its error over the smallest %.2f\n",
      methods.size(), tau(seconds, rmse),
      methods[static_cast<size_t>(std::ranges::min_element(rmse) - rmse.begin())].name.c_str(),
      ranking.best() ? ranking.best()->method.name.c_str() : "nothing", rmse_of_best / best);
  std::fflush(stdout);
}

// --- Times ---------------------------------------------------------------------------------------------------------

struct Observation {
  uint32_t samples;
  double seconds, truth;
  film::ErrorEstimate error;
};

std::vector<Observation> long_run(render::Session& session, render::Document d, const film::Film& reference) {
  std::vector<Observation> observations;
  film::Film film;
  double seconds = 0;
  for (uint32_t samples = 2; samples <= kLongest; samples *= 2) {
    d.limits = {samples, 0, 0};
    const uint64_t version = observations.empty() ? session.submit(d) : session.submit(d, std::move(film));
    bench::wait_for(session, version, [](const render::Status&) { return true; });
    film = session.film_copy();
    seconds += session.status().seconds;
    observations.push_back(
        {samples, seconds, advisor::true_error(film::radiance_of(film), reference).absolute.root(), film.error()});
  }
  return observations;
}

// When the true error first fell below the target, by linear interpolation between logarithms; empty if it never did.
std::optional<double> reached(const std::vector<Observation>& observations, size_t from, double target,
                              bool in_samples) {
  const auto time = [&](size_t i) { return in_samples ? observations[i].samples : observations[i].seconds; };
  for (size_t i = from + 1; i < observations.size(); ++i) {
    if (observations[i].truth > target) continue;
    if (observations[i - 1].truth <= target) return {};  // too close to the pilot for a prediction
    const double t =
        std::log(observations[i - 1].truth / target) / std::log(observations[i - 1].truth / observations[i].truth);
    return time(i - 1) * std::pow(time(i) / time(i - 1), t);
  }
  return {};
}

struct Score {
  int trials = 0, good = 0, held = 0;

  void replay(const std::vector<Observation>& observations, bool independent, bool in_samples) {
    render::TimeEstimator forecast(independent);
    for (size_t i = 0; i < observations.size(); ++i) {
      const Observation& observation = observations[i];
      forecast.add(observation.samples, in_samples ? observation.samples : observation.seconds, observation.error);
      if (observation.samples < 16 || observation.samples > 128) continue;
      for (const double less : {1.5, 2.0, 3.0, 4.0, 6.0, 8.0}) {
        const double target = observation.error.rmse / less;
        const auto actual = reached(observations, i, target, in_samples);
        const auto predicted = forecast.time_to(target, 0);
        if (!actual || !predicted) continue;
        ++trials;
        good += std::abs(std::log(predicted->seconds / *actual)) < std::log(kFactor);
        held += predicted->interval.low <= *actual && *actual <= predicted->interval.high;
      }
    }
  }
  void add(const Score& o) { trials += o.trials, good += o.good, held += o.held; }
  void print(const char* what) const {
    std::printf("  %-44s %4d trials, %3.0f %% within %.1f, %3.0f %% within the 80 %% interval\n", what, trials,
                100.0 * good / std::max(trials, 1), kFactor, 100.0 * held / std::max(trials, 1));
    std::fflush(stdout);
  }
};

struct Scores {
  Score seconds, samples;
};

Scores compare_times(render::Session& session, const render::Document& d, const film::Film& reference) {
  Scores all;
  for (const char* name : {"path:sampler=sobol", "path:sampler=random", "path-pure:sampler=sobol"}) {
    auto method = *bench::parse_method(name, d);
    Scores sum;
    for (int seed = 0; seed < kSeeds; ++seed) {
      method.document.seed = 100 + static_cast<uint64_t>(seed);
      const auto observations = long_run(session, method.document, reference);
      const bool independent = find_sampler(method.document.method.sampler)->independent;
      sum.seconds.replay(observations, independent, false);
      sum.samples.replay(observations, independent, true);
    }
    sum.seconds.print((std::string(name) + ", seconds").c_str());
    sum.samples.print((std::string(name) + ", samples").c_str());
    all.seconds.add(sum.seconds);
    all.samples.add(sum.samples);
  }
  return all;
}

}  // namespace

int run(int width, int height, const std::vector<std::string>& scenes) {
  render::Session session({2});
  Scores all;
  for (const auto& scene : scenes) {
    auto opened = render::new_document(scene);
    if (!opened) return std::fprintf(stderr, "%s\n", opened.error().message.c_str()), 3;
    render::Document d = *opened;
    d.width = width;
    d.height = height;
    std::printf("%s\n", scene.c_str());
    const auto reference = bench::render_reference(session, d, {0, kReference}, {}, never_stop);
    const film::Film halves = session.film_copy();
    compare_ranking(session, d, reference);
    const Scores scores = compare_times(session, d, halves);
    all.seconds.add(scores.seconds);
    all.samples.add(scores.samples);
  }
  std::printf("all scenes\n");
  all.seconds.print("seconds");
  all.samples.print("samples");
  return 0;
}

}  // namespace etendue

int main(int argc, char** argv) {
  const int width = argc > 2 ? std::atoi(argv[1]) : 80, height = argc > 2 ? std::atoi(argv[2]) : 60;
  std::vector<std::string> scenes(argv + std::min(argc, 3), argv + argc);
  const std::string data = etendue::test::data_folder();
  if (scenes.empty()) scenes = {"cornell"};
  if (argc <= 3 && !data.empty())
    for (const char* file : {"/scenes/staircase2/staircase2.glb", "/scenes/veach-bidir/veach-bidir.glb",
                             "/scenes/cornell-box/cornell-box.glb", "/gltf/ToyCar/glTF/ToyCar.gltf"})
      scenes.push_back(data + file);
  return etendue::run(width, height, scenes);
}
