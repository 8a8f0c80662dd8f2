#include "stress/matrix.h"

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/base64.h"
#include "base/file.h"
#include "image/image.h"
#include "measure/svg_chart.h"

namespace etendue::stress {
namespace {

using measure::escaped;

std::string picture_tag(const Thumbnail& picture) {
  if (picture.rgb.empty()) return "";
  const auto png = image::encode_png(picture.width, picture.height, picture.rgb);
  return png ? "<img alt=\"\" src=\"data:image/png;base64," + base64(*png) + "\">" : "";
}

std::string row_html(const Row& row) {
  const Case& c = *row.stress_case;
  std::string html = "<tbody><tr class=\"case\"><th>" + escaped(c.name) + "</th><td colspan=\"4\"><b>" +
                     std::string(kind_name(c.kind)) + ".</b> " + escaped(c.theory) + ".</td></tr>\n";
  for (const Finding& f : row.findings)
    html += std::string("<tr class=\"") + (f.ok ? "ok" : "failed") + "\"><td>" + picture_tag(f.picture) + "</td><td>" +
            escaped(f.method) + "</td><td>" + escaped(f.expectation) + "</td><td>" + number(f.measured) + "</td><td>" +
            (f.ok ? "as expected" : "NOT as expected") + "</td></tr>\n";
  return html + "</tbody>\n";
}

constexpr const char* kStyle =
    "body{font:15px/1.45 system-ui,sans-serif;margin:2em auto;max-width:70em;padding:0 1em;color:#1c2024;"
    "background:#fff}table{border-collapse:collapse;width:100%}td,th{padding:.3em .6em;text-align:left;"
    "vertical-align:middle}.case td,.case th{padding-top:1.4em;border-bottom:1px solid #ccd}img{width:48px;height:48px;"
    "image-rendering:pixelated;display:block}.failed td{background:#fde4e1}td:nth-child(4){font-variant-numeric:"
    "tabular-nums}@media(prefers-color-scheme:dark){body{background:#15181c;color:#dde1e6}.failed td{background:"
    "#5a2420}.case td,.case th{border-color:#39404a}}";

}  // namespace

Row run(const Case& stress_case, const LabOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  Lab lab(options);
  stress_case.run(lab);
  return {&stress_case, lab.take_findings(),
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

std::string matrix_json(const std::vector<Row>& rows) {
  auto list = nlohmann::json::array();
  for (const Row& row : rows)
    for (const Finding& f : row.findings) {
      // JSON has no infinity.
      const nlohmann::json measured = std::isfinite(f.measured) ? nlohmann::json(f.measured) : nlohmann::json();
      list.push_back({{"case", row.stress_case->name},
                      {"kind", kind_name(row.stress_case->kind)},
                      {"method", f.method},
                      {"expectation", f.expectation},
                      {"measured", measured},
                      {"ok", f.ok}});
    }
  return list.dump(2);
}

std::string matrix_html(const std::vector<Row>& rows) {
  size_t findings = 0, failed = 0;
  std::string body;
  for (const Row& row : rows) {
    for (const Finding& f : row.findings) ++findings, failed += f.ok ? 0 : 1;
    body += row_html(row);
  }
  return std::string("<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Stress</title><style>") +
         kStyle + "</style></head><body>\n<h1>Where methods fail</h1>\n<p>" + std::to_string(rows.size()) + " cases, " +
         std::to_string(findings) + " expectations, " + std::to_string(failed) +
         " not met. That a method fails is an expectation too.</p>\n<table>\n<thead><tr><th></th><th>method</th>"
         "<th>expected</th><th>measured</th><th></th></tr></thead>\n" +
         body + "</table>\n</body></html>\n";
}

}  // namespace etendue::stress
