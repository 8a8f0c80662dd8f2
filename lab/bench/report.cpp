#include "bench/report.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/json_text.h"
#include "metrics/convergence_chart.h"
#include "metrics/flip.h"
#include "metrics/heat_map.h"

namespace etendue::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Quotes a field of a comma-separated table if necessary.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

json number(double v) { return std::isfinite(v) ? json(v) : json(); }

json number(const metrics::Estimate& e) { return e.known ? number(e.value) : json(); }

// null with a single repeat.
json error_of(const metrics::Estimate& e) { return e.known && e.degrees > 0 ? number(e.standard_error) : json(); }

json method_json(const MethodSummary& s, const MethodResult& result) {
  return {{"name", s.name},
          {"choices", result.choices},
          {"slope", number(s.slope)},
          {"slope_stderr", error_of(s.slope)},
          {"slope_over_samples", number(s.slope_over_samples)},
          {"slope_over_samples_stderr", error_of(s.slope_over_samples)},
          {"efficiency", number(s.efficiency)},
          {"efficiency_stderr", error_of(s.efficiency)},
          {"bias", number(s.bias)},
          {"bias_stderr", error_of(s.bias)},
          {"squared_bias", s.bias_variance ? number(s.bias_variance->squared_bias) : json()},
          {"variance", s.bias_variance ? number(s.bias_variance->variance) : json()},
          {"rmse", s.spp > 0 ? number(s.rmse) : json()},
          {"relmse", s.spp > 0 ? number(s.relmse) : json()},
          {"displayed", s.spp > 0 ? number(s.displayed) : json()},
          {"flip", number(s.flip)},
          {"spp", number(s.spp)},
          {"seconds", number(s.seconds)},
          {"startup_seconds", s.startup_seconds ? number(*s.startup_seconds) : json()},
          {"khat", s.khat ? number(*s.khat) : json()},
          {"rays_per_second", number(s.rays_per_second)},
          {"reference_too_noisy", s.reference_too_noisy}};
}

Result<void> write_text(const fs::path& path, const std::string& text) {
  return write_file(path, text.data(), text.size());
}

std::string chart_title(const Report& r) {
  return r.document.scene_name + ", " + std::to_string(r.document.width) + " x " + std::to_string(r.document.height);
}

Result<void> write_charts(const fs::path& folder, const Report& r) {
  const auto curves = corrected_curves(r.outcome, r.reference);
  metrics::ChartOptions options{chart_title(r)};
  options.noise = r.reference.noise.value_or(metrics::ReferenceNoise{});
  options.measure = r.measure;
  options.reference_error = options.noise.error(r.measure);
  const auto drawing = metrics::convergence_chart(curves, options);
  if (auto ok = write_text(folder / "chart.svg", metrics::to_svg(drawing)); !ok) return ok;
  return image::write_png(folder / "chart.png", drawing.width, drawing.height, metrics::rasterize(drawing));
}

image::LayeredImage beauty(const Reference& reference, const std::vector<float>& rgb) {
  image::LayeredImage image;
  image.width = reference.image.width;
  image.height = reference.image.height;
  image.layers.push_back({"", {"R", "G", "B"}, rgb});
  return image;
}

// Writes the images as files and collects their bytes for the page.
class ImageWriter {
 public:
  ImageWriter(fs::path folder, const Report& report) : folder_(std::move(folder)), report_(report) {}

  Result<void> write() {
    if (auto ok = add(Kind::rendering, "reference", "", "reference", displayed(report_.reference.rgb())); !ok)
      return ok;
    for (const Kind kind : {Kind::rendering, Kind::difference, Kind::flip})
      if (auto ok = write(kind); !ok) return ok;
    return {};
  }

  const std::vector<PageImage>& images() const { return images_; }

 private:
  using Kind = PageImage::Kind;

  // Writes this kind of image for every method that has one.
  Result<void> write(Kind kind) {
    int number = 0;
    for (const auto& method : report_.outcome.methods) {
      const std::string name = method.curves.name, file = "method-" + std::to_string(++number);
      if (method.image.empty()) continue;
      if (auto ok = write(kind, name, file, method.image); !ok) return ok;
    }
    return {};
  }

  Result<void> write(Kind kind, const std::string& name, const std::string& file, const std::vector<float>& rgb) {
    if (kind == Kind::rendering) return add(kind, name, "", file, displayed(rgb));
    const auto image = beauty(report_.reference, rgb);
    if (kind == Kind::difference)
      return add(kind, name, "difference: ", file + "-error",
                 metrics::heat_map(image, report_.reference.image, metrics::HeatMap::difference));
    const auto& display = report_.document.display;
    const auto map = metrics::flip_map(image, report_.reference.image, {display.exposure, display.curve});
    if (!map) return map.error();
    return add(kind, name, "FLIP: ", file + "-flip", metrics::color_mapped(*map));
  }

  std::vector<uint8_t> displayed(const std::vector<float>& rgb) const {
    return image::display_pixels(rgb, report_.document.display.exposure, report_.document.display.curve);
  }

  Result<void> add(Kind kind, const std::string& name, const std::string& prefix, const std::string& file,
                   const std::vector<uint8_t>& rgb) {
    const fs::path path = folder_ / (file + ".png");
    const auto& size = report_.reference.image;
    if (auto ok = image::write_png(path, size.width, size.height, rgb); !ok) return ok;
    auto bytes = read_file(path);
    if (!bytes) return bytes.error();
    images_.push_back({kind, prefix + name, name, std::move(*bytes)});
    return {};
  }

  fs::path folder_;
  const Report& report_;
  std::vector<PageImage> images_;
};

}  // namespace

std::string curves_csv(const Report& report) {
  std::string csv = "method,repeat,seconds,spp,mse,relmse,bias,displayed_mse\n";
  char line[160];
  for (const auto& method : report.outcome.methods)
    for (const auto& curve : method.curves.repeats)
      for (const auto& p : curve.points) {
        std::snprintf(line, sizeof line, ",%d,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", curve.repeat, p.seconds, p.spp, p.mse,
                      p.relmse, p.bias, p.displayed_mse);
        csv += csv_field(method.curves.name) + line;
      }
  return csv;
}

std::string summary_json(const Report& r) {
  json methods = json::array();
  bool too_noisy = !r.reference.noise;
  for (const auto& method : r.outcome.methods) {
    const auto summary = summary_of(method, r.reference, r.document.display);
    too_noisy = too_noisy || summary.reference_too_noisy;
    methods.push_back(method_json(summary, method));
  }
  const json reference{{"file", r.reference.file},
                       {"standard_error", number(r.reference.standard_error())},
                       {"integrator", r.reference.integrator.empty() ? json() : json(r.reference.integrator)},
                       {"spp", r.reference.samples},
                       {"seconds", r.reference.seconds},
                       {"too_noisy", too_noisy}};
  const json j{{"scene", r.document.scene_name},
               {"width", r.document.width},
               {"height", r.document.height},
               {"budget", r.plan.seconds},
               {"samples", r.plan.samples},
               {"repeats", r.plan.repeats},
               {"seed", r.plan.seed},
               {"threads", r.threads},
               {"interrupted", r.outcome.interrupted},
               {"reference", reference},
               {"methods", std::move(methods)}};
  return json_text(j, 2) + "\n";
}

Result<void> create_folder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (fs::is_directory(folder, code)) return {};
  return output_error(folder.string() + ": not a folder, and it cannot be created");
}

Result<void> write_report(const fs::path& folder, const Report& report) {
  if (auto ok = create_folder(folder); !ok) return ok;
  if (auto ok = write_text(folder / "curves.csv", curves_csv(report)); !ok) return ok;
  if (auto ok = write_text(folder / "summary.json", summary_json(report)); !ok) return ok;
  if (auto ok = write_charts(folder, report); !ok) return ok;
  ImageWriter images(folder, report);
  if (auto ok = images.write(); !ok) return ok;
  return write_text(folder / "report.html", report_html(report, images.images()));
}

}  // namespace etendue::bench
