// The page: styles and a script of its own, everything inside one file.
#include <cmath>
#include <cstdio>

#include "base/base64.h"
#include "bench/report.h"
#include "measure/log_axis.h"
#include "measure/svg_chart.h"

namespace etendue::bench {
namespace {

using measure::escaped;
using measure::short_number;

constexpr const char* kHead = R"html(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<style>
body { font: 15px/1.5 sans-serif; color: #222; background: #fff; max-width: 960px; margin: 24px auto; padding: 0 16px }
h1 { font-size: 22px } h2 { font-size: 17px; margin-top: 32px }
svg { max-width: 100%; height: auto }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums }
th, td { text-align: right; padding: 4px 8px; border-bottom: 1px solid #ddd; white-space: nowrap }
th:first-child, td:first-child { text-align: left }
.scroll { overflow-x: auto }
.warning { background: #fff3d6; border-left: 4px solid #e69f00; padding: 8px 12px }
.wipe { position: relative; width: 100%; background: #ddd; overflow: hidden; touch-action: none; cursor: ew-resize }
.wipe img { display: block; width: 100%; image-rendering: pixelated; user-select: none }
.wipe img + img { position: absolute; inset: 0 }
.wipe div { position: absolute; top: 0; bottom: 0; width: 2px; margin-left: -1px; background: #fff; mix-blend-mode: difference }
.choice { display: flex; justify-content: space-between; gap: 16px; margin: 8px 0 }
input[type=range] { width: 100% }
</style>
)html";

constexpr const char* kWipe = R"html(<div class="choice">
<label>left <select id="left"></select></label><label>right <select id="right"></select></label></div>
<div class="wipe" id="wipe"><img id="under" alt="left picture"><img id="over" alt="right picture"><div id="edge"></div></div>
<input type="range" id="at" min="0" max="1000" value="500" aria-label="where the pictures meet">
)html";

constexpr const char* kScript = R"html(<script>
const $ = id => document.getElementById(id);
const show = (select, image) => { image.src = "data:image/png;base64," + pictures[select.selectedIndex][1]; };
const place = () => {
  const percent = $("at").value / 10;
  $("over").style.clipPath = "inset(0 0 0 " + percent + "%)";
  $("edge").style.left = percent + "%";
};
for (const [id, image, first] of [["left", "under", 0], ["right", "over", 1]]) {
  for (const [name] of pictures) $(id).add(new Option(name));
  $(id).selectedIndex = Math.min(first, pictures.length - 1);
  $(id).oninput = () => show($(id), $(image));
  show($(id), $(image));
}
const drag = e => {
  if (e.type === "pointermove" && !e.buttons) return;
  const box = $("wipe").getBoundingClientRect();
  $("at").value = 1000 * (e.clientX - box.left) / box.width;
  place();
};
$("wipe").onpointerdown = $("wipe").onpointermove = drag;
$("wipe").ondragstart = () => false;
$("at").oninput = place;
place();
</script>
)html";

std::string fixed(double v, int digits) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", digits, v);
  return text;
}

std::string with_error(const measure::Figure& f, const std::string& value, const std::string& error) {
  if (!f.known) return "&ndash;";
  return f.degrees > 0 ? value + " &plusmn; " + error : value;
}

std::string slope_text(const measure::Figure& f) {
  return with_error(f, fixed(f.value, 3), fixed(f.standard_error, 3));
}
std::string figure_text(const measure::Figure& f) {
  return with_error(f, short_number(f.value), short_number(f.standard_error));
}

std::string cell(const std::string& text) { return "<td>" + text + "</td>"; }

std::string row(const MethodSummary& s) {
  if (!s.slope.known && s.seconds <= 0)
    return "<tr><td>" + escaped(s.name) + "</td><td colspan=\"9\">&ndash;</td></tr>\n";
  return "<tr>" + cell(escaped(s.name)) + cell(short_number(s.spp)) + cell(short_number(s.seconds)) +
         cell(short_number(s.rmse)) + cell(short_number(s.relmse)) + cell(short_number(s.flip)) +
         cell(slope_text(s.slope)) + cell(figure_text(s.efficiency)) + cell(figure_text(s.bias)) +
         cell(short_number(s.rays_per_second * 1e-6)) + "</tr>\n";
}

std::string table(const Report& r) {
  std::string html =
      "<div class=\"scroll\"><table>\n<tr><th>method</th><th>spp</th><th>seconds</th><th>RMSE</th><th>relMSE</th>"
      "<th>FLIP</th><th>slope</th><th>efficiency</th><th>bias</th><th>Mrays/s</th></tr>\n";
  for (const auto& method : r.outcome.methods) html += row(summary_of(method, r.reference, r.document.display));
  return html +
         "</table></div>\n<p>Medians and means over the repeats, at the end; &plusmn; is one standard error. The slope "
         "is "
         "that of log RMSE over log time: &minus;1/2 for Monte Carlo. Efficiency is 1 / (MSE &middot; seconds). The "
         "error "
         "of the reference has been taken off.</p>\n";
}

std::string facts(const Report& r) {
  std::string text = std::to_string(r.document.width) + " &times; " + std::to_string(r.document.height) + " pixels, " +
                     std::to_string(r.plan.repeats) + " repeats of ";
  if (r.plan.seconds > 0) text += short_number(r.plan.seconds) + " s";
  if (r.plan.seconds > 0 && r.plan.samples > 0) text += " or ";
  if (r.plan.samples > 0) text += std::to_string(r.plan.samples) + " samples";
  text += " for each method, interleaved, on " + std::to_string(r.threads) + " threads.";
  if (r.reference.samples > 0)
    text += " The reference has " + std::to_string(r.reference.samples) + " samples per pixel.";
  if (r.reference.noise) text += " Its standard error is " + short_number(r.reference.standard_error()) + ".";
  return "<p>" + text + "</p>\n";
}

std::string warnings(const Report& r) {
  std::string html;
  const auto warn = [&](const std::string& text) { html += "<p class=\"warning\">" + text + "</p>\n"; };
  if (r.outcome.interrupted) warn("This bench was interrupted; what was whole by then is shown.");
  if (!r.reference.noise) warn("The error of the reference is unknown: small errors may be the reference's.");
  if (seconds_wanted(r.outcome, r.reference) > 0)
    warn(
        "The reference is too noisy to tell: its standard error is not ten times smaller than the smallest error that "
        "was measured. Its part has been taken off, but the lower ends of the curves are less certain than they look.");
  return html;
}

std::string charts(const Report& r) {
  const auto curves = corrected_curves(r.outcome, r.reference);
  const double floor = r.reference.noise ? r.reference.standard_error() : 0;
  using measure::Abscissa, measure::ErrorKind;
  std::string html;
  for (const auto& [title, along] :
       {std::pair{"Error over time", Abscissa::seconds}, {"Error over samples", Abscissa::samples}})
    html += measure::svg_chart(curves, {title, along, ErrorKind::rmse, 900, 520, floor});
  return html;
}

// A string of JavaScript: nothing in it can end the script.
std::string script_string(const std::string& text) {
  std::string out = "\"";
  char code[8];
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if (u < 0x20 || c == '"' || c == '\\' || c == '<') {
      std::snprintf(code, sizeof code, "\\u%04x", u);
      out += code;
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string picture_data(const std::vector<PagePicture>& pictures) {
  std::string script = "<script>\nconst pictures = [\n";
  for (const auto& p : pictures) script += "[" + script_string(p.name) + ", \"" + base64(p.png) + "\"],\n";
  return script + "];\n</script>\n";
}

}  // namespace

std::string report_html(const Report& r, const std::vector<PagePicture>& pictures) {
  const std::string title = "Error over time: " + escaped(r.document.scene_name);
  return kHead + ("<title>" + title + "</title></head><body>\n<h1>" + title + "</h1>\n") + facts(r) + warnings(r) +
         charts(r) + "<h2>Figures</h2>\n" + table(r) + "<h2>Pictures of the last repeat</h2>\n" + kWipe +
         picture_data(pictures) + kScript + "</body></html>\n";
}

}  // namespace etendue::bench
