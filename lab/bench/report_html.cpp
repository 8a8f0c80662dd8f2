// The HTML page of a benchmark: charts, tables, an image comparison, and the command that reproduces it.
#include <cmath>
#include <cstdio>
#include <set>

#include "base/base64.h"
#include "bench/html_page.h"
#include "bench/report.h"
#include "bench/report_page_assets.h"
#include "bench/reproduction_command.h"
#include "metrics/convergence_chart.h"
#include "metrics/log_axis.h"
#include "spectrum/colormap.h"

namespace etendue::bench {
namespace {

using metrics::escape_markup;
using metrics::short_number;

const std::string kNone = "&ndash;";

std::string fixed(double v, int digits) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", digits, v);
  return text;
}

std::string cell(double v) { return std::isfinite(v) ? short_number(v) : kNone; }

std::string with_error(const metrics::Estimate& e, const std::string& value, const std::string& error) {
  if (!e.known) return kNone;
  return e.degrees > 0 ? value + " &plusmn; " + error : value;
}

std::string slope_text(const metrics::Estimate& e) {
  return with_error(e, fixed(e.value, 3), fixed(e.standard_error, 3));
}
std::string estimate_text(const metrics::Estimate& e) {
  return with_error(e, short_number(e.value), short_number(e.standard_error));
}

// The ratio of two estimates with independent errors.
metrics::Estimate ratio(const metrics::Estimate& a, const metrics::Estimate& b) {
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
  return "<span class=\"swatch inverts\" style=\"background:" + metrics::css_color(metrics::method_color(i)) +
         "\"></span>" + escape_markup(all[i].name);
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
      rows.push_back({name_of(all, i), kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone});
      continue;
    }
    rows.push_back({name_of(all, i), cell(s.spp), cell(s.seconds), s.startup_seconds ? cell(*s.startup_seconds) : kNone,
                    cell(s.rays_per_second * 1e-6), cell(s.rmse), cell(s.relmse), cell(s.displayed), cell(s.flip),
                    estimate_text(s.efficiency), i == 0 ? "1" : estimate_text(ratio(s.efficiency, all[0].efficiency))});
  }
  return table({"method", "spp", "seconds", "start-up", "Mrays/s", "RMSE", "relMSE", "displayed error", "FLIP",
                "efficiency", "relative efficiency"},
               rows);
}

std::string khat_text(const MethodSummary& s) {
  if (!s.khat) return kNone;
  return fixed(*s.khat, 2) + (s.has_heavy_tail ? " (unreliable)" : "");
}

std::string error_table(const Summaries& all) {
  std::vector<std::vector<std::string>> rows;
  for (size_t i = 0; i < all.size(); ++i) {
    const MethodSummary& s = all[i];
    rows.push_back({name_of(all, i), slope_text(s.slope), slope_text(s.slope_over_samples), estimate_text(s.bias),
                    s.bias_variance ? cell(s.bias_variance->squared_bias) : kNone,
                    s.bias_variance ? cell(s.bias_variance->variance) : kNone, khat_text(s)});
  }
  return table({"method", "slope over time", "slope over samples", "mean error", "bias&sup2;", "variance", "k&#770;"},
               rows);
}

std::string tables(const Report& r) {
  const Summaries all = summaries(r);
  return "<h2>Error and speed</h2>\n" + speed_table(all) +
         "<p class=\"note\">Medians over the repeats, at their end; &plusmn; is one standard error over the repeats. "
         "The error of the reference has been subtracted. Efficiency is 1 / (MSE &middot; seconds); relative "
         "efficiency "
         "is the ratio to the first method. Seconds are rendering time, with the pilots of the automatic choice; the "
         "start-up of other renderers is stated separately.</p>\n"
         "<h2>Convergence, bias and variance</h2>\n" +
         error_table(all) +
         "<p class=\"note\">Slopes are those of log RMSE: &minus;1/2 for Monte Carlo, steeper for quasi-Monte Carlo, "
         "0 where only bias is left. MSE = bias&sup2; + variance, separated by means of the repeats; either estimate "
         "may be negative by chance. k&#770; is the Pareto tail index of the samples: from 0.5 on the variance is "
         "infinite. Where it is marked unreliable, the error bars cannot be trusted.</p>\n";
}

std::string fact(const std::string& name, const std::string& text) {
  return "<dt>" + name + "</dt><dd>" + text + "</dd>\n";
}

std::string plan_text(const Report& r) {
  std::string text = std::to_string(r.plan.repeats) + (r.plan.repeats == 1 ? " repeat of " : " repeats of ");
  if (r.plan.seconds > 0) text += short_number(r.plan.seconds) + " s";
  if (r.plan.seconds > 0 && r.plan.samples > 0) text += " or ";
  if (r.plan.samples > 0) text += std::to_string(r.plan.samples) + " samples";
  return text + " per method, interleaved, on " + std::to_string(r.threads) + (r.threads == 1 ? " thread" : " threads");
}

std::string reference_text(const Report& r) {
  std::string text = r.reference.samples > 0
                         ? r.reference.integrator + ", " + std::to_string(r.reference.samples) + " samples per pixel"
                         : "<code>" + escape_markup(r.reference.file) + "</code>";
  if (r.reference.reduction > 1)
    text += ", each pixel the mean of " + std::to_string(r.reference.reduction) + " &times; " +
            std::to_string(r.reference.reduction);
  if (r.reference.seconds > 0) text += ", " + short_number(r.reference.seconds) + " s";
  return text + (r.reference.noise ? ", standard error " + short_number(r.reference.standard_error()) + " (MSE " +
                                         short_number(r.reference.noise->mse) + ")"
                                   : ", standard error unknown");
}

// The reasons of the automatic choice, each once.
std::string choice_facts(const Report& r) {
  std::string html;
  for (const MethodResult& method : r.outcome.methods) {
    const std::set<std::string> reasons(method.choices.begin(), method.choices.end());
    for (const std::string& reason : reasons) html += fact(escape_markup(method.curves.name), escape_markup(reason));
  }
  return html;
}

std::string facts(const Report& r) {
  return "<dl class=\"facts\">\n" + fact("scene", "<code>" + escape_markup(r.document.scene_name) + "</code>") +
         fact("image", std::to_string(r.document.width) + " &times; " + std::to_string(r.document.height) + " pixels") +
         fact("measured", plan_text(r)) + fact("reference", reference_text(r)) + choice_facts(r) + "</dl>\n";
}

std::string warnings(const Report& r) {
  std::string html;
  const auto warn = [&](const std::string& text) { html += "<p class=\"warning\">" + text + "</p>\n"; };
  if (r.outcome.interrupted) warn("The benchmark was interrupted; only complete repeats are shown.");
  for (const auto& method : r.outcome.methods)
    if (!method.incompatibility.empty())
      warn(escape_markup(method.curves.name) + " was not measured: " + escape_markup(method.incompatibility));
  if (r.plan.repeats == 1)
    warn("Only one repeat was measured: there are no error bars, and bias cannot be distinguished from noise.");
  if (!r.reference.noise) warn("The error of the reference is unknown: small errors may be those of the reference.");
  const double required = required_reference_seconds(r.outcome, r.reference);
  if (reference_too_noisy(r.outcome, r.reference))
    warn("The reference is too noisy: errors below " +
         short_number(metrics::smallest_certain_rmse(*r.reference.noise)) +
         " are uncertain by more than 5 %, although its own error has been subtracted." +
         (required > 0
              ? " A reference of " + std::to_string(std::lround(required) + 1) + " s rendering time would suffice."
              : std::string()));
  return html;
}

std::string charts(const Report& r) {
  const auto curves = corrected_curves(r.outcome, r.reference);
  const auto noise = r.reference.noise.value_or(metrics::ReferenceNoise{});
  using metrics::Abscissa;
  std::string html = "<div class=\"charts\">\n";
  for (const auto& [title, abscissa] :
       {std::pair{"Error over time", Abscissa::seconds}, {"Error over samples", Abscissa::samples}}) {
    const metrics::ChartOptions options{.title = title,
                                        .abscissa = abscissa,
                                        .measure = r.measure,
                                        .width = 640,
                                        .height = 420,
                                        .reference_error = noise.error(r.measure),
                                        .noise = noise};
    html += "<figure class=\"chart\" tabindex=\"0\" aria-label=\"" + std::string(title) +
            "; use the arrow keys to read values\"><div class=\"inverts\">" +
            metrics::to_svg(metrics::convergence_chart(curves, options)) +
            "</div><div class=\"tip\" role=\"status\" hidden></div></figure>\n";
  }
  return html +
         "</div>\n<p class=\"note\">Lines are medians over the repeats, bands 10 % to 90 % quantiles. Hover over a "
         "curve "
         "or use the arrow keys to read values.</p>\n";
}

std::string image_button(const PageImage& p) {
  return "<button type=\"button\" aria-pressed=\"false\"><img alt=\"" + escape_markup(p.name) +
         "\" src=\"data:image/png;base64," + base64(p.png) + "\"><span>" + escape_markup(p.caption) +
         "</span></button>\n";
}

// A horizontal colour bar over the range [low, high] of the colour map.
std::string color_bar(Rgb (*color)(float), float low, float high) {
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

std::string heading(PageImage::Kind kind) {
  switch (kind) {
    case PageImage::Kind::rendering:
      return "<h3>Images of the last repeat</h3>\n";
    case PageImage::Kind::difference:
      return "<h3>Difference to the reference</h3>\n<p class=\"note\">too dark" + color_bar(diverging_color, -1, 1) +
             "too bright; full colour is a difference of the mean of the reference</p>\n";
    case PageImage::Kind::flip:
      break;
  }
  return "<h3>FLIP: perceived difference</h3>\n<p class=\"note\">0" + color_bar(viridis, 0, 1) + "1</p>\n";
}

std::string gallery(const std::vector<PageImage>& images) {
  std::string html;
  for (const auto kind : {PageImage::Kind::rendering, PageImage::Kind::difference, PageImage::Kind::flip}) {
    std::string buttons;
    for (const auto& p : images)
      if (p.kind == kind) buttons += image_button(p);
    if (!buttons.empty()) html += heading(kind) + "<div class=\"gallery\">\n" + buttons + "</div>\n";
  }
  return html;
}

std::string comparison(const Report& r, const std::vector<PageImage>& images) {
  const std::string size = "--w:" + std::to_string(r.document.width) + ";--h:" + std::to_string(r.document.height);
  return "<h2>Image comparison</h2>\n<div style=\"" + size +
         "\">\n<div class=\"choice\"><label>left <select id=\"left\"></select></label>"
         "<label>right <select id=\"right\"></select></label></div>\n"
         "<div class=\"wipe\" id=\"wipe\"><img id=\"under\" alt=\"\"><img id=\"over\" alt=\"\"><div "
         "id=\"edge\"></div></div>\n"
         "<input type=\"range\" id=\"at\" min=\"0\" max=\"1000\" value=\"500\" aria-label=\"position of the "
         "divider\">\n"
         "</div>\n" +
         gallery(images);
}

std::string reproduction(const Report& r) {
  return "<h2>Reproduction</h2>\n<pre id=\"command\">" + escape_markup(reproduction_command(r)) +
         "</pre>\n<p class=\"note\">The command reproduces errors over samples exactly, unless a longer reference is "
         "cached. Errors over seconds depend on the machine. The numbers are in <code>curves.csv</code> and "
         "<code>summary.json</code> next to this page.</p>\n";
}

}  // namespace

std::string report_html(const Report& r, const std::vector<PageImage>& images) {
  const std::string scene = std::filesystem::path(r.document.scene_name).stem().string();
  return html_page("Error over time: " + scene, kReportStyle + ("<h1>" + escape_markup(scene)) + "</h1>\n" + facts(r) +
                                                    warnings(r) + charts(r) + tables(r) + comparison(r, images) +
                                                    reproduction(r) + kReportScript);
}

}  // namespace etendue::bench
