// The page of the matrix: an overview of cases and methods, then every finding below the theory of its case.
#include "base/base64.h"
#include "bench/html_page.h"
#include "image/image.h"
#include "integrator/integrator.h"
#include "metrics/drawing.h"
#include "stress/matrix.h"

namespace etendue::stress {
namespace {

using metrics::escaped;

constexpr const char* kStyle = R"html(<style>
thead th { position: sticky; top: 0; background: var(--page) }
.overview td, .overview th { text-align: center } .overview th:first-child { text-align: left }
.overview tbody th { font-weight: 500 } .overview .kind th { color: var(--soft); padding-top: 16px }
a { color: inherit } .met { color: #1a7f37 } .missed { color: #c62828; font-weight: 700 }
.findings { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 360px), 1fr)); gap: 8px;
  list-style: none; padding: 0; margin: 8px 0 }
.findings li { display: grid; grid-template-columns: 56px 1fr; align-content: start; gap: 0 12px;
  background: var(--card); padding: 8px;
  border-radius: 4px; border-left: 4px solid #2da44e; overflow-wrap: anywhere }
.findings li.failed { background: var(--bad); border-left-color: #c62828 }
.findings img, .findings .blank { width: 56px; height: 56px; outline: 1px solid var(--line); grid-row: span 3 }
h3 { font-size: 15px; margin: 24px 0 0; scroll-margin-top: 16px } .kind-of { color: var(--soft); font-weight: 400 }
.expected { color: var(--soft); font-size: 13px } .value { font-variant-numeric: tabular-nums }
@media (prefers-color-scheme: dark) { .met { color: #56d364 } .missed { color: #ff8a80 } }
</style>
)html";

struct Count {
  size_t met = 0, missed = 0;
  void add(const Finding& f) { ++(f.ok ? met : missed); }
};

// Findings are of integrators, or of other parts of the program: samplers, settings, the display.
std::vector<std::string> columns() {
  std::vector<std::string> names;
  for (const auto& info : integrator::integrator_infos()) names.push_back(info.name);
  names.emplace_back("other parts");
  return names;
}

bool is_of(const Finding& f, const std::string& column, const std::vector<std::string>& all) {
  const std::string base = f.method.substr(0, f.method.find(':'));
  const bool integrator = std::find(all.begin(), all.end() - 1, base) != all.end() - 1;
  return integrator ? base == column : column == all.back();
}

std::string cell(const Count& c) {
  if (c.met + c.missed == 0) return "<td></td>";
  if (c.missed == 0) return "<td class=\"met\">&#10003; " + std::to_string(c.met) + "</td>";
  return "<td class=\"missed\">&#10007; " + std::to_string(c.missed) + " of " + std::to_string(c.met + c.missed) +
         "</td>";
}

std::string overview(const std::vector<Row>& rows) {
  const auto names = columns();
  std::string html = "<div class=\"scroll\"><table class=\"overview\">\n<thead><tr><th scope=\"col\">case</th>";
  for (const auto& name : names) html += "<th scope=\"col\">" + escaped(name) + "</th>";
  html += "</tr></thead>\n<tbody>\n";
  const Row* before = nullptr;
  for (const Row& row : rows) {
    const Case& c = *row.stress_case;
    if (!before || before->stress_case->kind != c.kind)
      html += "<tr class=\"kind\"><th colspan=\"" + std::to_string(names.size() + 1) + "\">" +
              std::string(kind_name(c.kind)) + "</th></tr>\n";
    before = &row;
    html += "<tr><th scope=\"row\"><a href=\"#" + escaped(c.name) + "\">" + escaped(c.name) + "</a></th>";
    for (const auto& name : names) {
      Count count;
      for (const Finding& f : row.findings)
        if (is_of(f, name, names)) count.add(f);
      html += cell(count);
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string picture_tag(const Thumbnail& picture) {
  if (picture.rgb.empty()) return "<span class=\"blank\"></span>";
  const auto png = image::encode_png(picture.width, picture.height, picture.rgb);
  return png ? "<img alt=\"\" src=\"data:image/png;base64," + base64(*png) + "\">" : "";
}

// Long names may break between settings.
std::string breakable(const std::string& text) {
  std::string out;
  for (const char c : escaped(text)) out += c == ':' ? ":<wbr>" : std::string(1, c);
  return out;
}

std::string finding_html(const Finding& f) {
  return std::string("<li class=\"") + (f.ok ? "ok" : "failed") + "\">" + picture_tag(f.picture) + "<span>" +
         breakable(f.method) + "</span><span class=\"value\">" + number(f.measured) +
         (f.ok ? "" : " <b class=\"missed\">not as expected</b>") + "</span><span class=\"expected\">expected " +
         escaped(f.expectation) + "</span></li>\n";
}

std::string case_html(const Row& row) {
  const Case& c = *row.stress_case;
  std::string html = "<h3 id=\"" + escaped(c.name) + "\">" + escaped(c.name) + " <span class=\"kind-of\">" +
                     std::string(kind_name(c.kind)) + "</span></h3>\n<p>" + escaped(c.theory) +
                     ".</p>\n<ul class=\"findings\">\n";
  for (const Finding& f : row.findings) html += finding_html(f);
  return html + "</ul>\n";
}

}  // namespace

std::string matrix_html(const std::vector<Row>& rows) {
  Count count;
  std::string cases;
  for (const Row& row : rows) {
    for (const Finding& f : row.findings) count.add(f);
    cases += case_html(row);
  }
  return bench::page("Stress", kStyle + ("<h1>Where methods fail</h1>\n<p>" + std::to_string(rows.size())) +
                                   " cases, " + std::to_string(count.met + count.missed) + " expectations, " +
                                   std::to_string(count.missed) +
                                   " not met. That a method fails is an expectation too: a tick says that it does what "
                                   "theory says.</p>\n" +
                                   overview(rows) + "<h2>What was expected, what was found</h2>\n" +
                                   "<p class=\"note\">Pictures are shown through AgX.</p>\n" + cases);
}

}  // namespace etendue::stress
