// The page that goes to a colleague: charts, figures, pictures under a wipe, and how to make it again.
#include <cmath>
#include <cstdio>

#include "base/base64.h"
#include "bench/html_page.h"
#include "bench/report.h"
#include "bench/report_parts.h"
#include "bench/reproduction_command.h"
#include "metrics/log_axis.h"
#include "metrics/svg_chart.h"
#include "spectrum/colormap.h"

namespace etendue::bench {
namespace {

using metrics::escaped;
using metrics::short_number;

const std::string kNone = "&ndash;";

std::string fixed(double v, int digits) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", digits, v);
  return text;
}

std::string plain(double v) { return std::isfinite(v) ? short_number(v) : kNone; }

std::string with_error(const metrics::Figure& f, const std::string& value, const std::string& error) {
  if (!f.known) return kNone;
  return f.degrees > 0 ? value + " &plusmn; " + error : value;
}

std::string slope_text(const metrics::Figure& f) {
  return with_error(f, fixed(f.value, 3), fixed(f.standard_error, 3));
}
std::string figure_text(const metrics::Figure& f) {
  return with_error(f, short_number(f.value), short_number(f.standard_error));
}

// How many times one is the other; their errors are independent.
metrics::Figure ratio(const metrics::Figure& a, const metrics::Figure& b) {
  if (!a.known || !b.known) return {};
  const double value = a.value / b.value;
  const double error = std::hypot(a.standard_error / a.value, b.standard_error / b.value) * value;
  return {value, error, std::min(a.degrees, b.degrees), true};
}

using Summaries = std::vector<MethodSummary>;

Summaries summaries(const Report& r) {
  Summaries all;
  for (const auto& method : r.outcome.methods) all.push_back(summary_of(method, r.reference, r.document.display));
  return all;
}

std::string name_of(const Summaries& all, size_t i) {
  return "<span class=\"swatch ink\" style=\"background:" + metrics::method_color(i) + "\"></span>" +
         escaped(all[i].name);
}

std::string table(const std::vector<std::string>& heads, const std::vector<std::vector<std::string>>& rows) {
  std::string html = "<div class=\"scroll\"><table class=\"figures\">\n<thead><tr>";
  for (const auto& head : heads) html += "<th scope=\"col\">" + head + "</th>";
  html += "</tr></thead>\n<tbody>\n";
  for (const auto& row : rows) {
    html += "<tr>";
    for (const auto& cell : row) html += "<td>" + cell + "</td>";
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string speed_table(const Summaries& all) {
  std::vector<std::vector<std::string>> rows;
  for (size_t i = 0; i < all.size(); ++i) {
    const MethodSummary& s = all[i];
    if (s.spp <= 0) {
      rows.push_back({name_of(all, i), kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone});
      continue;
    }
    rows.push_back({name_of(all, i), plain(s.spp), plain(s.seconds), plain(s.rays_per_second * 1e-6), plain(s.rmse),
                    plain(s.relmse), plain(s.flip), figure_text(s.efficiency),
                    i == 0 ? "1" : figure_text(ratio(s.efficiency, all[0].efficiency))});
  }
  return table({"method", "spp", "seconds", "Mrays/s", "RMSE", "relMSE", "FLIP", "efficiency", "times the first"},
               rows);
}

std::string khat_text(const MethodSummary& s) {
  if (!s.khat) return kNone;
  return fixed(*s.khat, 2) + (s.heavy_tail ? " (heavy)" : "");
}

std::string error_table(const Summaries& all) {
  std::vector<std::vector<std::string>> rows;
  for (size_t i = 0; i < all.size(); ++i) {
    const MethodSummary& s = all[i];
    rows.push_back({name_of(all, i), slope_text(s.slope), slope_text(s.slope_over_samples), figure_text(s.bias),
                    s.split ? plain(s.split->squared_bias) : kNone, s.split ? plain(s.split->variance) : kNone,
                    khat_text(s)});
  }
  return table({"method", "slope over time", "slope over samples", "mean error", "bias&sup2;", "variance", "k&#770;"},
               rows);
}

std::string figures(const Report& r) {
  const Summaries all = summaries(r);
  return "<h2>How good, how fast</h2>\n" + speed_table(all) +
         "<p class=\"note\">At the end of the repeats, medians; &plusmn; is one standard error, from the repeats. The "
         "error of the reference has been taken off. Efficiency is 1 / (MSE &middot; seconds).</p>\n"
         "<h2>Where the error comes from</h2>\n" +
         error_table(all) +
         "<p class=\"note\">Slopes are those of log RMSE: &minus;1/2 for Monte Carlo, steeper for quasi-Monte Carlo, "
         "flat where only bias is left. MSE = bias&sup2; + variance, told apart by the repeats; either may come out "
         "below zero by chance. k&#770; is the tail of the samples (Pareto): from 0.5 on the variance "
         "is infinite, and where it says heavy, error bars cannot be relied on.</p>\n";
}

std::string fact(const std::string& name, const std::string& text) {
  return "<dt>" + name + "</dt><dd>" + text + "</dd>\n";
}

std::string effort(const Report& r) {
  std::string text = std::to_string(r.plan.repeats) + (r.plan.repeats == 1 ? " repeat of " : " repeats of ");
  if (r.plan.seconds > 0) text += short_number(r.plan.seconds) + " s";
  if (r.plan.seconds > 0 && r.plan.samples > 0) text += " or ";
  if (r.plan.samples > 0) text += std::to_string(r.plan.samples) + " samples";
  return text + " for each method, interleaved, on " + std::to_string(r.threads) +
         (r.threads == 1 ? " thread" : " threads");
}

std::string reference_text(const Report& r) {
  std::string text = r.reference.samples > 0 ? std::to_string(r.reference.samples) + " samples per pixel"
                                             : "<code>" + escaped(r.reference.file) + "</code>";
  if (r.reference.reduced > 1)
    text += ", each pixel the mean of " + std::to_string(r.reference.reduced) + " &times; " +
            std::to_string(r.reference.reduced);
  if (r.reference.seconds > 0) text += ", " + short_number(r.reference.seconds) + " s";
  return text + (r.reference.noise ? ", standard error " + short_number(r.reference.standard_error()) + " (MSE " +
                                         short_number(r.reference.noise->mse) + ")"
                                   : ", standard error unknown");
}

std::string facts(const Report& r) {
  return "<dl class=\"facts\">\n" + fact("scene", "<code>" + escaped(r.document.scene_name) + "</code>") +
         fact("picture",
              std::to_string(r.document.width) + " &times; " + std::to_string(r.document.height) + " pixels") +
         fact("measured", effort(r)) + fact("reference", reference_text(r)) + "</dl>\n";
}

std::string warnings(const Report& r) {
  std::string html;
  const auto warn = [&](const std::string& text) { html += "<p class=\"warning\">" + text + "</p>\n"; };
  if (r.outcome.interrupted) warn("This bench was interrupted; what was whole by then is shown.");
  if (r.plan.repeats == 1)
    warn("There was one repeat only: there are no error bars, and bias cannot be told from chance.");
  if (!r.reference.noise) warn("The error of the reference is unknown: small errors may be the reference's.");
  const double wanted = seconds_wanted(r.outcome, r.reference);
  if (reference_too_noisy(r.outcome, r.reference))
    warn(
        "The reference is too noisy to tell: its standard error is not ten times smaller than the smallest error that "
        "was measured. Its part has been taken off, but the lower ends of the curves are less certain than they look." +
        (wanted > 0 ? " " + std::to_string(std::lround(wanted) + 1) + " s of reference would do." : std::string()));
  return html;
}

std::string charts(const Report& r) {
  const auto curves = corrected_curves(r.outcome, r.reference);
  const auto noise = r.reference.noise.value_or(metrics::ReferenceNoise{});
  const double floor = std::sqrt(noise.mse);
  using metrics::Abscissa, metrics::ErrorKind;
  std::string html = "<div class=\"charts\">\n";
  for (const auto& [title, along] :
       {std::pair{"Error over time", Abscissa::seconds}, {"Error over samples", Abscissa::samples}})
    html += "<figure class=\"chart\" tabindex=\"0\" aria-label=\"" + std::string(title) +
            "; arrow keys read the curves\"><div class=\"ink\">" +
            metrics::svg_chart(curves, {title, along, ErrorKind::rmse, 640, 420, floor, noise}) +
            "</div><div class=\"tip\" role=\"status\" hidden></div></figure>\n";
  return html +
         "</div>\n<p class=\"note\">Lines are medians, bands 10 % to 90 % of the repeats. Point at a curve, or move "
         "along "
         "it with the arrow keys, to read it.</p>\n";
}

std::string picture_button(const PagePicture& p) {
  return "<button type=\"button\" aria-pressed=\"false\"><img alt=\"" + escaped(p.name) +
         "\" src=\"data:image/png;base64," + base64(p.png) + "\"><span>" + escaped(p.caption) + "</span></button>\n";
}

// A bar of colours from one end of their range to the other.
std::string scale(Rgb (*color)(float), float low, float high) {
  constexpr int kSteps = 8;
  std::string stops;
  char text[16];
  for (int i = 0; i <= kSteps; ++i) {
    const Rgb c = color(low + (high - low) * static_cast<float>(i) / kSteps) * 255.0f;
    std::snprintf(text, sizeof text, ", #%02x%02x%02x", int(c.r + 0.5f), int(c.g + 0.5f), int(c.b + 0.5f));
    stops += text;
  }
  return "<span class=\"scale\" style=\"background:linear-gradient(90deg" + stops + ")\"></span>";
}

std::string heading(PagePicture::Kind kind) {
  switch (kind) {
    case PagePicture::Kind::rendering:
      return "<h3>Pictures of the last repeat</h3>\n";
    case PagePicture::Kind::difference:
      return "<h3>Difference to the reference</h3>\n<p class=\"note\">too dark" + scale(diverging_color, -1, 1) +
             "too bright; full colour is the mean of the reference</p>\n";
    case PagePicture::Kind::flip:
      break;
  }
  return "<h3>FLIP: what an eye would notice</h3>\n<p class=\"note\">0" + scale(viridis, 0, 1) + "1</p>\n";
}

std::string gallery(const std::vector<PagePicture>& pictures) {
  std::string html;
  for (const auto kind : {PagePicture::Kind::rendering, PagePicture::Kind::difference, PagePicture::Kind::flip}) {
    std::string buttons;
    for (const auto& p : pictures)
      if (p.kind == kind) buttons += picture_button(p);
    if (!buttons.empty()) html += heading(kind) + "<div class=\"gallery\">\n" + buttons + "</div>\n";
  }
  return html;
}

std::string comparison(const Report& r, const std::vector<PagePicture>& pictures) {
  const std::string size = "--w:" + std::to_string(r.document.width) + ";--h:" + std::to_string(r.document.height);
  return "<h2>Pictures side by side</h2>\n<div style=\"" + size +
         "\">\n<div class=\"choice\"><label>left <select id=\"left\"></select></label>"
         "<label>right <select id=\"right\"></select></label></div>\n"
         "<div class=\"wipe\" id=\"wipe\"><img id=\"under\" alt=\"\"><img id=\"over\" alt=\"\"><div "
         "id=\"edge\"></div></div>\n"
         "<input type=\"range\" id=\"at\" min=\"0\" max=\"1000\" value=\"500\" aria-label=\"where the pictures "
         "meet\">\n"
         "</div>\n" +
         gallery(pictures);
}

std::string making(const Report& r) {
  return "<h2>Making it again</h2>\n<pre id=\"recipe\">" + escaped(recipe(r)) +
         "</pre>\n<p class=\"note\">Errors over samples come out the same to the last digit, unless a longer reference "
         "is kept; those over seconds are of the machine. <code>curves.csv</code> and <code>summary.json</code> beside "
         "this page hold the numbers.</p>\n";
}

}  // namespace

std::string report_html(const Report& r, const std::vector<PagePicture>& pictures) {
  const std::string scene = std::filesystem::path(r.document.scene_name).stem().string();
  return page("Error over time: " + scene, kReportStyle + ("<h1>" + escaped(scene)) + "</h1>\n" + facts(r) +
                                               warnings(r) + charts(r) + figures(r) + comparison(r, pictures) +
                                               making(r) + kReportScript);
}

}  // namespace etendue::bench
