#include "advisor/certificate.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "render/thread_pool.h"

namespace etendue::advisor {
namespace {

using integrator::Bias;
using nlohmann::json;

// The root mean square of the missing paths, measured on an image of larger pixels, is too small by at most this
// factor.
constexpr double kMaxBlur = 1.4;
// Relative uncertainty of the measured missing square, due to noise: its true value is at least this fraction of it.
constexpr double kMinFraction = 0.9;

// The interval of a mean square due to missing paths.
film::Interval missing_interval(double square, bool same_size) {
  return {kMinFraction * square, square * (same_size ? 1 / kMinFraction : sqr(kMaxBlur))};
}

// Noise and missing paths are independent, so their mean squares add.
IntervalEstimate total_square(double noise, const film::Interval& noise_interval, double missing, bool same_size) {
  const film::Interval interval = missing_interval(missing, same_size);
  return {noise + missing, {noise_interval.low + interval.low, noise_interval.high + interval.high}};
}

IntervalEstimate root_of(const IntervalEstimate& s) {
  return {std::sqrt(s.value), {std::sqrt(s.interval.low), std::sqrt(s.interval.high)}};
}

void set_error(Certificate& c, const RenderStatistics& statistics, const MeasuredMissingPaths& measured,
               bool same_size) {
  const film::ErrorEstimate& e = statistics.error;
  if (!e.known || !statistics.relative) return;
  const film::RelativeError& relative = *statistics.relative;
  const auto squared = [](const film::Interval& i) { return film::Interval{sqr(i.low), sqr(i.high)}; };
  c.rmse = root_of(total_square(sqr(e.rmse), squared(e.rmse_interval), sqr(measured.missing.rms), same_size));
  c.relmse = total_square(relative.relmse, relative.interval, measured.relative_square, same_size);
}

json interval_json(const film::Interval& interval) {
  return {interval.low, std::isfinite(interval.high) ? json(interval.high) : json()};
}

std::optional<IntervalEstimate> estimate_from(const json& j, const char* name) {
  if (!j.contains(name) || !j[name].is_number()) return {};
  IntervalEstimate s{j[name].get<double>(), {0, INFINITY}};
  const auto& interval = j[std::string(name) + "_interval"];
  s.interval.low = interval.at(0).get<double>();
  if (!interval.at(1).is_null()) s.interval.high = interval.at(1).get<double>();
  return s;
}

Bias bias_from(const std::string& name) {
  for (const Bias bias : {Bias::unbiased, Bias::consistent})
    if (name == integrator::bias_name(bias)) return bias;
  return Bias::biased;
}

Certificate certificate_of(const json& j) {
  Certificate c;
  c.rmse = estimate_from(j, "rmse");
  c.relmse = estimate_from(j, "relmse");
  c.bias = bias_from(j.at("bias").get<std::string>());
  for (const auto& m : j.at("missing")) c.missing.push_back({m.at("paths"), m.at("share"), m.at("of_point_lights")});
  c.missing_share = j.at("missing_share");
  c.beyond_methods = j.at("beyond_all_methods").get<std::vector<std::string>>();
  if (!j.at("khat").is_null()) c.khat = j["khat"].get<double>();
  const auto& rejected = j.at("rejected");
  c.rejected = {rejected.at("nan"), rejected.at("infinite"), rejected.at("negative"), {}};
  for (const auto& [flag, value] : j.at("model").items()) c.model.emplace_back(flag, value);
  return c;
}

}  // namespace

RenderStatistics statistics_of(const film::Film& film, const render::Status& status, const transport::Model& model,
                               int threads) {
  render::ThreadPool workers(threads);
  const film::RangeRunner run = [&](int count, const std::function<void(int, int)>& task) {
    return workers.run_ranges(count, task);
  };
  return {film.error(), film::relative_error(film, run), status.rejected, model,
          status.reliability ? status.reliability->tail.khat : std::optional<double>()};
}

Certificate certificate(render::Session& session, const render::Document& document, const RenderStatistics& statistics,
                        double seconds, const bench::Progress& progress) {
  Certificate c;
  c.bias = bias_of(document.method);
  c.rejected = statistics.rejected;
  c.khat = statistics.khat;
  for (const auto& decision : statistics.model.decisions) c.model.emplace_back(decision.flag, decision.value);
  if (const auto scene = session.scene()) c.beyond_methods = beyond_all_methods(*scene);
  TableOptions options;
  options.samples = 4;
  options.seconds = seconds;
  const auto measured = measure_missing_paths(session, document, options, progress);
  for (const auto& m : measured.missing.classes) c.missing.push_back({m.paths, m.share, m.from_point_lights});
  c.missing_share = measured.missing.share;
  set_error(c, statistics, measured, measured.width == document.width);
  const auto& info = *integrator::find_integrator(document.method.integrator);
  if (info.bias != Bias::unbiased)
    for (auto* estimate : {&c.rmse, &c.relmse})
      if (*estimate) (*estimate)->interval.high = INFINITY;
  return c;
}

std::string certificate_json(const Certificate& c) {
  json missing = json::array(), model = json::object();
  for (const auto& m : c.missing)
    missing.push_back({{"paths", m.paths}, {"share", m.share}, {"of_point_lights", m.from_point_lights}});
  for (const auto& [flag, value] : c.model) model[flag] = value;
  return json{
      {"rmse", c.rmse ? json(c.rmse->value) : json()},
      {"rmse_interval", c.rmse ? interval_json(c.rmse->interval) : json()},
      {"relmse", c.relmse ? json(c.relmse->value) : json()},
      {"relmse_interval", c.relmse ? interval_json(c.relmse->interval) : json()},
      {"bias", integrator::bias_name(c.bias)},
      {"missing", missing},
      {"missing_share", c.missing_share},
      {"beyond_all_methods", c.beyond_methods},
      {"khat", c.khat ? json(*c.khat) : json()},
      {"rejected", {{"nan", c.rejected.nan}, {"infinite", c.rejected.infinite}, {"negative", c.rejected.negative}}},
      {"model", model}}
      .dump();
}

Result<Certificate> certificate_from_json(const std::string& text, const std::string& source) {
  const json j = json::parse(text, nullptr, false);
  try {
    return certificate_of(j);
  } catch (const json::exception&) {
    return input_error(source + ": the certificate is not valid; give an .exr written by etendue render");
  }
}

}  // namespace etendue::advisor
