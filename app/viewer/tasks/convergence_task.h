// The live comparison of methods: renders them in turns and measures their errors against a reference.
//
// The task has the processor to itself. An edit of the scene or the camera stops it. Its curves remain, marked as
// outdated.
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/parameter.h"
#include "bench/live_benchmark.h"
#include "metrics/convergence_chart.h"
#include "render/document.h"
#include "viewer/tasks/background_task.h"
#include "viewer/tasks/task.h"

namespace etendue::viewer {

enum class ConvergenceChart : uint8_t { curves, pareto };

}  // namespace etendue::viewer

namespace etendue {

template <>
struct Options<bench::Rule> {
  static constexpr std::array<Option, 2> kOptions{{{"time", "Equal time"}, {"samples", "Equal samples"}}};
};
template <>
struct Options<viewer::ConvergenceChart> {
  static constexpr std::array<Option, 2> kOptions{{{"curves", "Error curves"}, {"pareto", "Pareto front"}}};
};
template <>
struct Options<metrics::Abscissa> {
  static constexpr std::array<Option, 2> kOptions{{{"seconds", "over time"}, {"samples", "over samples"}}};
};

}  // namespace etendue

namespace etendue::viewer {

class Comparison;

class ConvergenceTask final : public Task {
 public:
  // Changes of these do not affect a running comparison, except for `axis` and `error`, which concern the chart only.
  struct Parameters {
    std::vector<std::string> methods;  // as `bench` writes them: "path:sampler=sobol"
    size_t a = 0;                      // index of the method in image A of the viewport
    size_t b = 1;                      // likewise for B
    std::string integrator = "path";   // of the next method that is added
    std::string sampler = "sobol";     // likewise

    Toggle denoised{"compare.denoised", "Denoised", false,
                    "Measures the next method that is added on its denoised image. The time of the denoiser counts"};
    Choice<bench::Rule> rule{"compare.rule", "Compare at", bench::Rule::equal_time,
                             "All methods get the same rendering time or the same number of samples per pixel"};
    Number<float> seconds{
        "compare.seconds", "Time budget", 10, {0.1f, 36000}, "Rendering time of each method in each repeat", "s",
        Scale::logarithmic};
    Number<int> samples{
        "compare.samples", "Sample budget", 64, {1, 1000000}, "Samples per pixel of each method in each repeat", "spp",
        Scale::logarithmic};
    Number<int> repeats{"compare.repeats",
                        "Repeats",
                        5,
                        {1, 100},
                        "Independent repeats with different seeds. More repeats give narrower confidence bands",
                        "x"};
    Choice<metrics::Abscissa> axis{"compare.axis", "Horizontal axis", metrics::Abscissa::seconds,
                                   "Whether errors are drawn over rendering time or over samples per pixel"};
    Choice<film::ErrorMeasure> error{"compare.error", "Error measure", film::ErrorMeasure::rmse,
                                     "Measure of the chart and the table. RMSE: in the unit of the image. Relative: "
                                     "relative to the reference. Displayed: after exposure, tone mapping and sRGB "
                                     "encoding"};
    Choice<ConvergenceChart> chart{"compare.chart-type", "Chart", ConvergenceChart::curves,
                                   "Error curves, or the ends of the curves as points: error against cost, with the "
                                   "methods that no other one beats in both"};
    Text added{"compare.methods", "Methods", "",
               "Methods to add: INTEGRATOR:NAME=VALUE, several separated by commas. {a,b} stands for alternatives, as in "
               "{path,bdpt}:sampler={sobol,random}",
               [](std::string_view) { return Result<void>(); },
               {{"{path,bdpt}:sampler={sobol,random}", "{path,bdpt}:sampler={sobol,random}"},
                {"path:path.roulette-start={1,2,4,8}", "path:path.roulette-start={1,2,4,8}"},
                {"path:path.heuristic={constant,balance,power}", "path:path.heuristic={constant,balance,power}"}}};
    auto all() { return std::tie(denoised, rule, seconds, samples, repeats, axis, error, chart, added); }
  };
  Parameters parameters;

  // Fills an empty list with the method of the document and the same integrator with another sampler.
  void propose_methods(const render::Document& document);
  // Adds a method that is not on the list yet.
  void add_method(const std::string& spec);
  // Adds the methods of a list (bench::parse_methods). An error if one of them is not valid; then none is added.
  Result<void> add_methods(const std::string& list, const render::Document& document);
  void remove_method(size_t index);

  // Starts a new comparison of the methods on the list. A method that cannot be parsed is an error.
  Result<void> start(const TaskContext& context);
  void stop(const TaskContext& context);
  // Continues after a stop; after the end, with twice the budget.
  void resume(const TaskContext& context);
  bool running() const { return running_; }
  bool can_resume() const { return benchmark_ && !running_; }
  // Whether the result belongs to the document as it is.
  bool is_current() const { return benchmark_ != nullptr; }

  // Null before the first comparison.
  const bench::LiveBenchmarkSnapshot* result() const { return snapshot_.get(); }
  // The index of a method in the result; nothing if it did not take part.
  std::optional<size_t> index_in_result(const std::string& spec) const;

  // Called once per frame. Takes the newest result and shows the images of the methods A and B in the viewport.
  void update(const TaskContext& context, Comparison& comparison);
  void reset(const TaskContext& context) override { stop(context); }
  bool has_update() const override { return benchmark_ && benchmark_->snapshot() != snapshot_; }
  bool is_saving() const override { return export_.running(); }
  // Shows the images of the methods A and B at the next `update`.
  void request_images() { images_requested_ = snapshot_ != nullptr && benchmark_ != nullptr; }

  // The chart of the result.
  metrics::ChartOptions chart_options() const;
  std::vector<metrics::MethodCurves> curves() const;
  // Writes the chart (.svg, .png) or its points (.csv) in the background.
  void save_chart(const TaskContext& context, const std::string& file);

 private:
  void set_running(const TaskContext& context);
  void finish(const TaskContext& context);
  void discard_benchmark(const TaskContext& context);
  void show_images(Comparison& comparison, const render::Document& document) const;

  std::unique_ptr<bench::LiveBenchmark> benchmark_;
  std::shared_ptr<const bench::LiveBenchmarkSnapshot> snapshot_;
  std::shared_ptr<const bench::LiveBenchmarkSnapshot> resumed_from_;  // the snapshot when it was resumed
  render::Document document_;                                         // that is compared
  bool running_ = false;
  bool images_requested_ = false;
  BackgroundTask<Result<std::string>> export_;
  BackgroundTask<bool> destruction_;
};

}  // namespace etendue::viewer
