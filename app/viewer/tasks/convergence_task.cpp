#include "viewer/tasks/convergence_task.h"

#include <algorithm>
#include <cctype>

#include "base/file.h"
#include "image/image.h"
#include "viewer/state/notices.h"
#include "viewer/viewport/comparison.h"
#include "viewer/widgets/format.h"

namespace etendue::viewer {
namespace {

// Whether two documents ask for the same picture, by whatever method.
bool same_picture(const render::Document& a, const render::Document& b) {
  return same_view(a, b) && a.method.paths == b.method.paths;
}

std::string in_quotes(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

// One row a point; mse and relmse are without the reference's own error, the measured ones with it.
std::string csv_of(const bench::LiveBenchmarkSnapshot& contest) {
  std::string csv = "method,repeat,seconds,spp,mse,relmse,bias,measured_mse,measured_relmse\n";
  for (const auto& method : contest.methods)
    for (size_t r = 0; r < method.corrected.repeats.size(); ++r)
      for (size_t i = 0; i < method.corrected.repeats[r].points.size(); ++i) {
        const auto &p = method.corrected.repeats[r].points[i], &raw = method.measured.repeats[r].points[i];
        csv += in_quotes(method.name) + text_of(",%d,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n",
                                                method.corrected.repeats[r].repeat, p.seconds, p.spp, p.mse, p.relmse,
                                                p.bias, raw.mse, raw.relmse);
      }
  return csv;
}

Result<std::string> write_chart(const std::string& file, const bench::LiveBenchmarkSnapshot& contest,
                                std::span<const metrics::MethodCurves> curves, const metrics::ChartOptions& options) {
  std::string extension = std::filesystem::path(file).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto drawing = metrics::chart_of(curves, options);
  Result<void> written;
  if (extension == ".svg" || extension == ".csv") {
    const std::string text = extension == ".csv" ? csv_of(contest) : metrics::svg_of(drawing);
    written = write_file(file, text.data(), text.size());
  } else if (extension == ".png") {
    written = image::write_png(file, drawing.width, drawing.height, metrics::raster_of(drawing));
  } else {
    return usage_error(file + ": '" + extension + "' is no format of a chart; give .svg, .png or .csv");
  }
  if (!written) return written.error();
  return file;
}

}  // namespace

bool same_view(const render::Document& a, const render::Document& b) {
  return a.scene == b.scene && a.camera == b.camera && a.width == b.width && a.height == b.height &&
         a.filter == b.filter && a.forced_flags == b.forced_flags;
}

std::string name_of(const render::MethodSettings& method) {
  std::string name = method.integrator + ":sampler=" + method.sampler;
  for (const auto& [setting, value] : method.settings) {
    const size_t dot = setting.find('.');
    const std::string owner = setting.substr(0, dot);
    if (owner == method.integrator || owner == method.sampler)
      name += ":" + setting.substr(dot + 1) + "=" + to_string(value);
  }
  return name;
}

std::string spoken(const std::string& method) {
  std::string text;
  for (const char c : method) text += c == ':' ? ", " : std::string(1, c);
  const std::string sampler = "sampler=";
  if (const size_t at = text.find(sampler); at != std::string::npos) text.erase(at, sampler.size());
  return text;
}

void ContestHand::propose() {
  if (!setup.methods.empty() || editor_.empty()) return;
  render::MethodSettings method = editor_.document().method;
  setup.methods.push_back(name_of(method));
  method.sampler = method.sampler == "random" ? "sobol" : "random";
  setup.methods.push_back(name_of(method));
}

void ContestHand::add(const std::string& method) {
  if (std::ranges::find(setup.methods, method) == setup.methods.end()) setup.methods.push_back(method);
}

void ContestHand::remove(size_t index) {
  setup.methods.erase(setup.methods.begin() + static_cast<std::ptrdiff_t>(index));
  for (size_t* side : {&setup.a, &setup.b})
    if (*side > index) --*side;
}

std::optional<size_t> ContestHand::place_of(const std::string& method) const {
  if (!shown_) return std::nullopt;
  const auto found = std::ranges::find(shown_->methods, method, &bench::Standing::name);
  if (found == shown_->methods.end()) return std::nullopt;
  return static_cast<size_t>(found - shown_->methods.begin());
}

Result<void> ContestHand::start() {
  stop();
  document_ = editor_.document();
  bench::LiveBenchmarkPlan plan;
  for (const auto& name : setup.methods) {
    auto method = bench::parse_method(name, document_);
    if (!method) return method.error();
    plan.methods.push_back(std::move(*method));
  }
  if (plan.methods.empty()) return usage_error("There is no method to compare; add one.");
  plan.rule = setup.rule, plan.seconds = setup.seconds, plan.samples = static_cast<uint32_t>(setup.samples.value);
  plan.repeats = setup.repeats, plan.seed = document_.seed;
  plan.threads = threads_, plan.cache = cache_, plan.compiled = session_.scene();
  retire();
  was_paused_ = session_.paused();
  session_.pause(true);
  contest_ = std::make_unique<bench::LiveBenchmark>(std::move(plan), wake_);
  shown_ = contest_->snapshot();
  running_ = sides_wanted_ = true;
  return {};
}

void ContestHand::stop() {
  if (!running_) return;
  contest_->stop();
  finish();
}

void ContestHand::go_on() {
  if (!can_go_on()) return;
  was_paused_ = session_.paused();
  session_.pause(true);
  before_ = contest_->snapshot();
  contest_->go_on();
  running_ = sides_wanted_ = true;
}

void ContestHand::finish() {
  running_ = false;
  session_.pause(was_paused_);
}

// Its end may take a moment, for its reference is written and its films are given back: not on this thread.
void ContestHand::retire() {
  if (!contest_) return;
  contest_->stop();
  retiring_.start([last = std::make_shared<std::unique_ptr<bench::LiveBenchmark>>(std::move(contest_))] {
    return last->reset(), true;
  });
}

void ContestHand::advance(Comparison& comparison, Notices& notices) {
  if (auto written = job_.take()) {
    if (*written)
      notices.say("Saved " + **written);
    else
      notices.complain(written->error().message);
  }
  if (!contest_) return;
  const bool news = has_news();
  shown_ = contest_->snapshot();
  if (!same_picture(editor_.document(), document_)) {
    if (running_)
      finish(),
          notices.say("The scene was edited: the comparison has ended. Its curves are those of the scene before.");
    retire();
    comparison.a = comparison.b = comparison.reference = {};
    comparison.mode = CompareMode::off;
    return;
  }
  if (running_ && shown_ != before_ && shown_->phase == bench::LiveBenchmarkSnapshot::Phase::done) finish();
  if (news || sides_wanted_) show_sides(comparison);
  // The viewport is split once there is something on both sides; whoever leaves the split then is left alone.
  if (!sides_wanted_ || !comparison.a.frame || !comparison.b.frame) return;
  sides_wanted_ = false;
  if (comparison.mode == CompareMode::off) comparison.mode = CompareMode::wipe;
}

void ContestHand::show_sides(Comparison& comparison) const {
  const auto side = [&](size_t index) {
    const auto place = index < setup.methods.size() ? place_of(setup.methods[index]) : std::nullopt;
    if (!place || !shown_->methods[*place].frame) return Side{};
    const auto& method = shown_->methods[*place];
    return Side{spoken(method.name) + text_of(", %u spp", method.frame->samples), method.frame};
  };
  comparison.a = side(setup.a), comparison.b = side(setup.b);
  comparison.reference = {text_of("reference, %u spp", shown_->reference_samples), shown_->reference};
}

metrics::ChartOptions ContestHand::chart_options() const {
  metrics::ChartOptions options;
  options.along = setup.along, options.kind = setup.kind;
  if (!shown_) return options;
  const auto& d = document_;
  options.title = std::filesystem::path(d.scene_name).filename().string() + text_of(", %d x %d, ", d.width, d.height) +
                  (shown_->rule == bench::Rule::equal_time ? text_of("%g s each", shown_->seconds)
                                                           : text_of("%u spp each", shown_->samples));
  if (options.kind == metrics::ErrorKind::rmse && std::isfinite(shown_->reference_error))
    options.reference_error = shown_->reference_error;
  return options;
}

std::vector<metrics::MethodCurves> ContestHand::curves() const {
  std::vector<metrics::MethodCurves> curves;
  if (!shown_) return curves;
  for (const auto& method : shown_->methods) {
    curves.push_back(method.corrected);
    curves.back().name = spoken(method.name);
  }
  return curves;
}

void ContestHand::write(const std::string& file) {
  if (!shown_) return;
  job_.start([file, contest = shown_, curves = curves(), options = chart_options()] {
    return write_chart(file, *contest, curves, options);
  });
}

}  // namespace etendue::viewer
