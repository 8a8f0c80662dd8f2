// The methods that take turns on the scene on the desk: which ones, by which rule, and what became of them.
//
// While they do, the main rendering is paused. An edit of what the picture is of ends them; their curves stay, marked
// as those of the scene before.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/parameter.h"
#include "bench/live_benchmark.h"
#include "metrics/svg_chart.h"
#include "viewer/state/editor.h"
#include "viewer/tasks/background_task.h"

namespace etendue {

template <>
struct Options<bench::Rule> {
  static constexpr std::array<Option, 2> kOptions{{{"time", "Equal time"}, {"samples", "Equal samples"}}};
};
template <>
struct Options<metrics::Abscissa> {
  static constexpr std::array<Option, 2> kOptions{{{"seconds", "over seconds"}, {"samples", "over samples"}}};
};
template <>
struct Options<metrics::ErrorKind> {
  static constexpr std::array<Option, 2> kOptions{{{"rmse", "RMSE"}, {"relmse", "relMSE"}}};
};

}  // namespace etendue

namespace etendue::viewer {

class Comparison;
class Notices;

// What the user set; none of it changes a contest that runs, but for what is drawn of it.
struct ContestSetup {
  std::vector<std::string> methods;                    // as a bench names them
  size_t a = 0, b = 1;                                 // whose pictures are the sides of the viewport
  std::string integrator = "path", sampler = "sobol";  // that can be added next

  Choice<bench::Rule> rule{"compare.rule", "Rule", bench::Rule::equal_time,
                           "What all methods get alike: time on the machine, or samples of every pixel"};
  Number<float> seconds{
      "compare.seconds", "Budget", 10, {0.1f, 36000}, "Seconds of rendering for each method in each repeat", "s",
      Scale::logarithmic};
  Number<int> samples{
      "compare.samples", "Budget", 64, {1, 1000000}, "Samples per pixel for each method in each repeat", "spp",
      Scale::logarithmic};
  Number<int> repeats{"compare.repeats",
                      "Repeats",
                      5,
                      {1, 100},
                      "How often, with other random numbers: bands and uncertainties come from these",
                      "x"};
  Choice<metrics::Abscissa> along{"compare.axis", "Axis", metrics::Abscissa::seconds, "What the error is drawn over"};
  Choice<metrics::ErrorKind> kind{"compare.error", "Error", metrics::ErrorKind::rmse,
                                  "Root mean square error in radiance, or mean square error relative to the reference"};
  auto knobs() { return std::tie(rule, seconds, samples, repeats, along, kind); }
};

class ContestHand {
 public:
  ContestHand(render::Session& session, Editor& editor, int threads, std::filesystem::path cache,
              std::function<void()> wake)
      : session_(session),
        editor_(editor),
        threads_(threads),
        cache_(std::move(cache)),
        wake_(wake),
        job_(wake),
        retiring_(std::move(wake)) {}

  ContestSetup setup;

  // The method of the document, and one to compare it with; the setup begins with them.
  void propose();
  // A method that is not yet on the list, as a bench names it.
  void add(const std::string& method);
  void remove(size_t index);

  // From the beginning, with the document as it is.
  Result<void> start();
  void stop();
  void go_on();
  bool running() const { return running_; }
  // Whether there is something to go on with.
  bool can_go_on() const { return contest_ && !running_; }
  // Whether the snapshot is of what is on the desk.
  bool up_to_date() const { return contest_ != nullptr; }

  const bench::LiveBenchmarkSnapshot* shown() const { return shown_.get(); }
  // Where the method of that name stands, and its place among the curves; nothing if it did not take part.
  std::optional<size_t> place_of(const std::string& method) const;
  bool has_news() const { return contest_ && contest_->snapshot() != shown_; }
  // Called once a frame: takes up the newest snapshot and hands its pictures to the viewport.
  void advance(Comparison& comparison, Notices& notices);

  // The chart of what is shown; of a given size, with the document's name as its title.
  metrics::ChartOptions chart_options() const;
  std::vector<metrics::MethodCurves> curves() const;
  // Writes the chart (.svg, .png) or its points (.csv) in the background.
  void write(const std::string& file);
  // Has the viewport show the sides that were chosen.
  void choose_sides() { sides_wanted_ = shown_ != nullptr && contest_ != nullptr; }
  bool writing() const { return job_.running(); }

 private:
  void finish();
  void retire();
  void show_sides(Comparison& comparison) const;

  render::Session& session_;
  Editor& editor_;
  const int threads_;
  const std::filesystem::path cache_;
  const std::function<void()> wake_;
  std::unique_ptr<bench::LiveBenchmark> contest_;
  std::shared_ptr<const bench::LiveBenchmarkSnapshot> shown_, before_;  // before it went on
  render::Document document_;                                           // that the contest is of
  bool running_ = false, was_paused_ = false, sides_wanted_ = false;
  Job<Result<std::string>> job_;
  Job<bool> retiring_;
};

// Every knob of the setup, for lists.
std::vector<ParameterInfo> contest_parameters();

// Whether two documents show the same by whatever method, and whichever paths count.
bool same_view(const render::Document& a, const render::Document& b);

// "path:sampler=sobol:max-depth=3" of a document's method; and as a reader likes it: "path, sobol, max-depth=3".
std::string name_of(const render::MethodSettings& method);
std::string spoken(const std::string& method);

}  // namespace etendue::viewer
