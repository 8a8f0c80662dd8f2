#include "render_statistics.h"

#include <sys/resource.h>

#include <thread>

#include "base/json_text.h"
#include "json.h"

namespace etendue::cli {
namespace {

// The largest resident memory of the process so far, in bytes.
size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<size_t>(usage.ru_maxrss) * 1024;
}

json invalid_samples_json(const film::InvalidSamples& invalid) {
  json first = json::array();
  for (const auto& r : invalid.first)
    first.push_back({{"x", r.x}, {"y", r.y}, {"sample", r.sample}, {"kind", film::reason_name(r.reason)}});
  return {{"nan", invalid.nan}, {"infinite", invalid.infinite}, {"negative", invalid.negative}, {"first", first}};
}

json reliability_json(const render::Reliability& r) {
  return {{"verdict", render::verdict_name(r.verdict)},
          {"reason", r.reason},
          {"khat_heavy_share", r.heavy_share},
          {"khat_limit", film::khat_limit(r.samples)},
          {"khat_error", r.tail.khat ? number_json(r.tail.khat_error) : json()},
          {"vov", number_json(r.tail.vov)},
          {"brightest_share", number_json(r.tail.brightest_share)},
          {"samples", r.samples}};
}

json integrator_statistics_json(const std::vector<integrator::Statistic>& statistics) {
  json all = json::object();
  for (const auto& s : statistics) all[s.name] = {{"value", s.value}, {"unit", s.unit}, {"doc", s.doc}};
  return all;
}

json model_json(const transport::Model& model) {
  json flags = json::object();
  for (const auto& decision : model.decisions)
    flags[decision.flag] = {{"value", decision.value}, {"reason", decision.reason}};
  return flags;
}

}  // namespace

std::string statistics_json(const RenderStatistics& statistics) {
  const render::Document& d = statistics.document;
  const render::Status& s = statistics.status;
  const int threads =
      statistics.threads > 0 ? statistics.threads : static_cast<int>(std::thread::hardware_concurrency());
  const json j{{"integrator", d.method.integrator},
               {"sampler", d.method.sampler},
               {"spp", s.samples},
               {"seconds", s.seconds},
               {"rays", s.rays},
               {"statistics", integrator_statistics_json(s.statistics)},
               {"width", d.width},
               {"height", d.height},
               {"threads", threads},
               {"seed", d.seed},
               {"rmse_estimate", s.error.known ? json(s.error.rmse) : json()},
               {"error_measure", Options<film::ErrorMeasure>::kOptions[static_cast<size_t>(s.measure)].name},
               {"error", s.measured_error.known ? json(s.measured_error.value) : json()},
               {"error_interval", s.measured_error.known
                                      ? json{s.measured_error.interval.low, s.measured_error.interval.high}
                                      : json()},
               {"rejected", invalid_samples_json(s.rejected)},
               {"khat", s.reliability ? number_json(s.reliability->tail.khat) : json()},
               {"health", s.reliability ? reliability_json(*s.reliability) : json()},
               {"peak_rss_bytes", peak_memory()},
               {"model", model_json(statistics.model)},
               {"notes", s.notes},
               {"obstacle", s.incompatibility.empty() ? json() : json(s.incompatibility)},
               {"automatic", json::parse(statistics.choice)},
               {"certificate", json::parse(statistics.certificate)}};
  return json_text(j, 2);
}

}  // namespace etendue::cli
