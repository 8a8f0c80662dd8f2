#include "advisor/advice_report.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <span>

#include "advisor/report_numbers.h"
#include "base/json_text.h"

namespace etendue::advisor {
namespace {

using nlohmann::json;

json row_json(const ClassRow& row) {
  return {{"paths", row.paths},
          {"energy", row.energy.mean},
          {"standard_error", row.energy.standard_error},
          {"share", row.share},
          {"of_point_lights", row.energy.mean > 0 ? row.from_points.mean / row.energy.mean : 0},
          {"uncertain", row.energy.uncertain()}};
}

json table_json(const ClassTable& table) {
  json rows = json::array();
  for (const auto& row : table.rows) rows.push_back(row_json(row));
  return {{"width", table.width},           {"height", table.height}, {"spp", table.samples},
          {"total", row_json(table.total)}, {"classes", rows},        {"unseen", table.unseen}};
}

json missing_json(const MissingPaths& missing) {
  json list = json::array();
  for (const auto& c : missing.classes)
    list.push_back(
        {{"paths", c.paths}, {"share", c.share}, {"of_point_lights", c.from_point_lights}, {"part", c.partial}});
  return list;
}

json method_json(const Advice& advice) {
  json j{{"name", advice.method.name},
         {"suitable", advice.suitable},
         {"reason", advice.reason},
         {"missing_share", advice.misses.share},
         {"missing_rmse", advice.misses.rms},
         {"missing_error", advice.missing_error},
         {"missing", missing_json(advice.misses)},
         {"seconds", nullptr},
         {"seconds_interval", nullptr},
         {"pilot", nullptr}};
  if (advice.time) {
    j["seconds"] = advice.time->seconds;
    j["seconds_interval"] = {advice.time->interval.low, advice.time->interval.high};
  }
  if (advice.pilot_samples > 0)
    j["pilot"] = {{"spp", advice.pilot_samples},
                  {"seconds", advice.pilot_seconds},
                  {"error", advice.pilot_error},
                  {"exponent", advice.exponent.value},
                  {"exponent_stderr", advice.exponent.error}};
  return j;
}

template <class... T>
void print(std::string& text, const char* format, T... values) {
  char line[512];
  std::snprintf(line, sizeof line, format, values...);
  text += line;
}

void print_table(std::string& text, const ClassTable& table) {
  print(text, "%-36s %8s  %s\n", "paths", "share", "energy");
  const std::vector<std::string> shares = percents(table.shares());
  for (size_t i = 0; i < table.rows.size(); ++i) {
    const ClassRow& row = table.rows[i];
    print(text, "%-36s %8s  %s +- %s%s\n", row.paths.c_str(), shares[i].c_str(), number(row.energy.mean).c_str(),
          number(row.energy.standard_error).c_str(), row.energy.uncertain() ? "  uncertain" : "");
  }
  if (table.unseen.empty()) return;
  text += "no energy found in";
  for (const auto& paths : table.unseen) text += ' ' + paths;
  text += '\n';
}

std::string time_heading(const Ranking& ranking) {
  return std::string("time to ") + film::measure_label(ranking.measure) + " " +
         error_number(ranking.measure, ranking.target);
}

std::string time_text(const Advice& advice) {
  if (!advice.time) return "-";
  return seconds_text(advice.time->seconds) + " (" + seconds_text(advice.time->interval.low) + " to " +
         seconds_text(advice.time->interval.high) + ")";
}

void print_omitted(std::string& text, std::span<const Advice> omitted) {
  if (omitted.empty()) return;
  const auto slower = std::ranges::count_if(omitted, [](const Advice& advice) { return advice.time.has_value(); });
  print(text, "%td slower methods and %td that do not reach this error are not listed\n", slower,
        std::ssize(omitted) - slower);
}

}  // namespace

std::string ranking_json(const Ranking& ranking, const std::string& scene) {
  json methods = json::array();
  for (const auto& advice : ranking.methods) methods.push_back(method_json(advice));
  return json_text(json{{"scene", scene},
                        {"target", ranking.target},
                        {"measure", Options<film::ErrorMeasure>::kOptions[static_cast<size_t>(ranking.measure)].name},
                        {"table", table_json(ranking.table)},
                        {"methods", methods},
                        {"beyond_all_methods", ranking.beyond_methods}},
                   2);
}

std::string ranking_text(const Ranking& ranking, size_t count) {
  std::string text;
  print_table(text, ranking.table);
  for (const auto& sentence : ranking.beyond_methods) text += sentence + '\n';
  const std::span listed = std::span(ranking.methods).first(std::min(count, ranking.methods.size()));
  size_t widest = 0;
  for (const auto& advice : listed) widest = std::max(widest, advice.method.name.size());
  const auto column = static_cast<int>(widest);
  print(text, "\n%-*s  %-30s  %s\n", column, "method", time_heading(ranking).c_str(), "reason");
  for (const auto& advice : listed)
    print(text, "%-*s  %-30s  %s\n", column, advice.method.name.c_str(), time_text(advice).c_str(),
          advice.reason.c_str());
  print_omitted(text, std::span(ranking.methods).subspan(listed.size()));
  return text;
}

}  // namespace etendue::advisor
