// The HTML page of the matrix: an overview of cases and methods, then each case with its theory and results.
#include "base/base64.h"
#include "bench/html_page.h"
#include "image/image.h"
#include "integrator/integrator.h"
#include "metrics/drawing.h"
#include "stress/matrix.h"

namespace etendue::stress {
namespace {

using metrics::escape_markup;

constexpr const char* kStyle = R"html(<style>
thead th { position: sticky; top: 0; background: var(--page) }
.overview td, .overview th { text-align: center } .overview th:first-child { text-align: left }
.overview tbody th { font-weight: 500 } .overview .kind th { color: var(--soft); padding-top: 16px }
a { color: inherit } .passed { color: #1a7f37 } .missed { color: #c62828; font-weight: 700 }
.results { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 360px), 1fr)); gap: 8px;
  list-style: none; padding: 0; margin: 8px 0 }
.results li { display: grid; grid-template-columns: 56px 1fr; align-content: start; gap: 0 12px;
  background: var(--card); padding: 8px;
  border-radius: 4px; border-left: 4px solid #2da44e; overflow-wrap: anywhere }
.results li.failed { background: var(--bad); border-left-color: #c62828 }
.results img, .results .blank { width: 56px; height: 56px; outline: 1px solid var(--line); grid-row: span 3 }
h3 { font-size: 15px; margin: 24px 0 0; scroll-margin-top: 16px } .kind-of { color: var(--soft); font-weight: 400 }
.expected { color: var(--soft); font-size: 13px } .value { font-variant-numeric: tabular-nums }
@media (prefers-color-scheme: dark) { .passed { color: #56d364 } .missed { color: #ff8a80 } }
</style>
)html";

struct Count {
  size_t passed = 0, missed = 0;
  void add(const TestResult& r) { ++(r.ok ? passed : missed); }
};

// One column per integrator, and one for samplers, settings, the display and other components.
std::vector<std::string> columns() {
  std::vector<std::string> names;
  for (const auto& info : integrator::integrator_infos()) names.push_back(info.name);
  names.emplace_back("other");
  return names;
}

bool belongs_to(const TestResult& r, const std::string& column, const std::vector<std::string>& all) {
  const std::string base = r.method.substr(0, r.method.find(':'));
  const bool is_integrator = std::find(all.begin(), all.end() - 1, base) != all.end() - 1;
  return is_integrator ? base == column : column == all.back();
}

std::string cell(const Count& c) {
  if (c.passed + c.missed == 0) return "<td></td>";
  if (c.missed == 0) return "<td class=\"passed\">&#10003; " + std::to_string(c.passed) + "</td>";
  return "<td class=\"missed\">&#10007; " + std::to_string(c.missed) + " of " + std::to_string(c.passed + c.missed) +
         "</td>";
}

std::string overview(const std::vector<CaseResult>& rows) {
  const auto names = columns();
  std::string html = "<div class=\"scroll\"><table class=\"overview\">\n<thead><tr><th scope=\"col\">case</th>";
  for (const auto& name : names) html += "<th scope=\"col\">" + escape_markup(name) + "</th>";
  html += "</tr></thead>\n<tbody>\n";
  const CaseResult* previous = nullptr;
  for (const CaseResult& row : rows) {
    const Case& c = *row.stress_case;
    if (!previous || previous->stress_case->kind != c.kind)
      html += "<tr class=\"kind\"><th colspan=\"" + std::to_string(names.size() + 1) + "\">" +
              std::string(kind_label(c.kind)) + "</th></tr>\n";
    previous = &row;
    html += "<tr><th scope=\"row\"><a href=\"#" + escape_markup(c.name) + "\">" + escape_markup(c.name) + "</a></th>";
    for (const auto& name : names) {
      Count count;
      for (const TestResult& r : row.results)
        if (belongs_to(r, name, names)) count.add(r);
      html += cell(count);
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string image_tag(const Thumbnail& image) {
  if (image.rgb.empty()) return "<span class=\"blank\"></span>";
  const auto png = image::encode_png(image.width, image.height, image.rgb);
  return png ? "<img alt=\"\" src=\"data:image/png;base64," + base64(*png) + "\">" : "";
}

// Allows line breaks between the settings of a method.
std::string breakable(const std::string& text) {
  std::string out;
  for (const char c : escape_markup(text)) out += c == ':' ? ":<wbr>" : std::string(1, c);
  return out;
}

std::string result_html(const TestResult& r) {
  return std::string("<li class=\"") + (r.ok ? "ok" : "failed") + "\">" + image_tag(r.image) + "<span>" +
         breakable(r.method) + "</span><span class=\"value\">" + number(r.measured) +
         (r.ok ? "" : " <b class=\"missed\">not as expected</b>") + "</span><span class=\"expected\">expected " +
         escape_markup(r.expectation) + "</span></li>\n";
}

std::string case_html(const CaseResult& row) {
  const Case& c = *row.stress_case;
  std::string html = "<h3 id=\"" + escape_markup(c.name) + "\">" + escape_markup(c.name) + " <span class=\"kind-of\">" +
                     std::string(kind_label(c.kind)) + "</span></h3>\n<p>" + escape_markup(c.theory) +
                     ".</p>\n<ul class=\"results\">\n";
  for (const TestResult& r : row.results) html += result_html(r);
  return html + "</ul>\n";
}

}  // namespace

std::string matrix_html(const std::vector<CaseResult>& rows) {
  Count count;
  std::string cases;
  for (const CaseResult& row : rows) {
    for (const TestResult& r : row.results) count.add(r);
    cases += case_html(row);
  }
  return bench::html_page("Stability matrix",
                          kStyle + ("<h1>Stability matrix</h1>\n<p>" + std::to_string(rows.size())) + " cases, " +
                              std::to_string(count.passed + count.missed) + " expectations, " +
                              std::to_string(count.missed) +
                              " not met. A tick means that the method behaves as theory predicts; the prediction may "
                              "be that it fails.</p>\n" +
                              overview(rows) + "<h2>Expected and measured values</h2>\n" +
                              "<p class=\"note\">Images are tone mapped with AgX.</p>\n" + cases);
}

}  // namespace etendue::stress
