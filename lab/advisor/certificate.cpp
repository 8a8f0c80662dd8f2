#include "advisor/certificate.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace etendue::advisor {
namespace {

using integrator::Bias;
using nlohmann::json;

// A small picture blurs what is missing: its root mean square is less than the true one's, by no more than this.
constexpr double kBlur = 1.4;
constexpr double kDoubt = 0.9;  // and more than this of it, noise considered

film::Interval lack_of(double lack, bool same_size, double sharpest) {
  return {kDoubt * lack, lack * (same_size ? 1 / kDoubt : sharpest)};
}

// Noise and lack are independent: their squares add up.
Stated total(double noise, const film::Interval& noise_interval, double lack, const film::Interval& lack_interval) {
  return {noise + lack, {noise_interval.low + lack_interval.low, noise_interval.high + lack_interval.high}};
}

Stated root_of(const Stated& s) {
  return {std::sqrt(s.value), {std::sqrt(s.interval.low), std::sqrt(s.interval.high)}};
}

void state_error(Certificate& c, const Evidence& evidence, const MeasuredMissingPaths& missing, bool same_size) {
  const film::ErrorEstimate& e = evidence.error;
  if (!e.known || !evidence.relative) return;
  const double lack = sqr(missing.spots.rms), relative = missing.relative_square;
  const auto squared = [](const film::Interval& i) { return film::Interval{sqr(i.low), sqr(i.high)}; };
  c.rmse = root_of(total(sqr(e.rmse), squared(e.rmse_interval), lack, lack_of(lack, same_size, sqr(kBlur))));
  c.relmse =
      total(evidence.relative->relmse, evidence.relative->interval, relative, lack_of(relative, same_size, sqr(kBlur)));
}

json interval_json(const film::Interval& interval) {
  return {interval.low, std::isfinite(interval.high) ? json(interval.high) : json()};
}

std::optional<Stated> stated_from(const json& j, const char* name) {
  if (!j.contains(name) || !j[name].is_number()) return {};
  Stated s{j[name].get<double>(), {0, INFINITY}};
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
  c.rmse = stated_from(j, "rmse"), c.relmse = stated_from(j, "relmse");
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

Certificate certificate(render::Session& session, const render::Document& document, const Evidence& evidence,
                        double seconds, const bench::Progress& watch) {
  Certificate c;
  c.bias = bias_of(document.method);
  c.rejected = evidence.rejected, c.khat = evidence.khat;
  for (const auto& decision : evidence.model.decisions) c.model.emplace_back(decision.flag, decision.value);
  if (const auto scene = session.scene()) c.beyond_methods = beyond_all_methods(*scene);
  TableOptions options;
  options.samples = 4, options.seconds = seconds;
  const auto missing = measured_missing_paths(session, document, options, watch);
  for (const auto& spot : missing.spots.classes) c.missing.push_back({spot.paths, spot.share, spot.points});
  c.missing_share = missing.spots.share;
  state_error(c, evidence, missing, missing.width == document.width);
  const auto& info = *integrator::find_integrator(document.method.integrator);
  if (info.bias != Bias::unbiased)
    for (auto* stated : {&c.rmse, &c.relmse})
      if (*stated) (*stated)->interval.high = INFINITY;
  return c;
}

std::string certificate_json(const Certificate& c) {
  json missing = json::array(), model = json::object();
  for (const auto& m : c.missing)
    missing.push_back({{"paths", m.paths}, {"share", m.share}, {"of_point_lights", m.points}});
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
    return input_error(source + ": its certificate is not what this program writes; give an .exr of this program");
  }
}

}  // namespace etendue::advisor
