#include "bench/report.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "metrics/flip.h"
#include "metrics/heat_map.h"
#include "metrics/svg_chart.h"

namespace etendue::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// A field of a table separated by commas: methods may have any name.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

json number(double v) { return std::isfinite(v) ? json(v) : json(); }

json number(const metrics::Figure& f) { return f.known ? number(f.value) : json(); }

// Without a second repeat there is no error bar.
json error_of(const metrics::Figure& f) { return f.known && f.degrees > 0 ? number(f.standard_error) : json(); }

json method_json(const MethodSummary& s) {
  return {{"name", s.name},
          {"slope", number(s.slope)},
          {"slope_stderr", error_of(s.slope)},
          {"slope_over_samples", number(s.slope_over_samples)},
          {"slope_over_samples_stderr", error_of(s.slope_over_samples)},
          {"efficiency", number(s.efficiency)},
          {"efficiency_stderr", error_of(s.efficiency)},
          {"bias", number(s.bias)},
          {"bias_stderr", error_of(s.bias)},
          {"squared_bias", s.split ? number(s.split->squared_bias) : json()},
          {"variance", s.split ? number(s.split->variance) : json()},
          {"rmse", number(s.rmse)},
          {"relmse", number(s.relmse)},
          {"flip", number(s.flip)},
          {"spp", number(s.spp)},
          {"seconds", number(s.seconds)},
          {"khat", s.khat ? number(*s.khat) : json()},
          {"rays_per_second", number(s.rays_per_second)},
          {"reference_too_noisy", s.too_noisy}};
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
  options.reference_error = std::sqrt(options.noise.mse);
  const auto drawing = metrics::chart_of(curves, options);
  if (auto ok = write_text(folder / "chart.svg", metrics::svg_of(drawing)); !ok) return ok;
  return image::write_png(folder / "chart.png", drawing.width, drawing.height, metrics::raster_of(drawing));
}

image::LayeredImage beauty(const Reference& reference, const std::vector<float>& rgb) {
  image::LayeredImage picture;
  picture.width = reference.picture.width, picture.height = reference.picture.height;
  picture.layers.push_back({"", {"R", "G", "B"}, rgb});
  return picture;
}

// Writes pictures as files of their own and keeps their bytes for the page.
class Pictures {
 public:
  Pictures(fs::path folder, const Report& report) : folder_(std::move(folder)), report_(report) {}

  Result<void> write() {
    if (auto ok = add(Kind::rendering, "reference", "", "reference", shown(report_.reference.rgb())); !ok) return ok;
    for (const Kind kind : {Kind::rendering, Kind::difference, Kind::flip})
      if (auto ok = write(kind); !ok) return ok;
    return {};
  }

  const std::vector<PagePicture>& pictures() const { return pictures_; }

 private:
  using Kind = PagePicture::Kind;

  // Of every method that has one.
  Result<void> write(Kind kind) {
    int number = 0;
    for (const auto& method : report_.outcome.methods) {
      const std::string name = method.curves.name, file = "method-" + std::to_string(++number);
      if (method.picture.empty()) continue;
      if (auto ok = write(kind, name, file, method.picture); !ok) return ok;
    }
    return {};
  }

  Result<void> write(Kind kind, const std::string& name, const std::string& file, const std::vector<float>& rgb) {
    if (kind == Kind::rendering) return add(kind, name, "", file, shown(rgb));
    const auto picture = beauty(report_.reference, rgb);
    if (kind == Kind::difference)
      return add(kind, name, "difference: ", file + "-error",
                 metrics::heat_map(picture, report_.reference.picture, metrics::HeatMap::difference));
    const auto& display = report_.document.display;
    const auto map = metrics::flip_map(picture, report_.reference.picture, {display.exposure, display.curve});
    if (!map) return map.error();
    return add(kind, name, "FLIP: ", file + "-flip", metrics::painted(*map));
  }

  std::vector<uint8_t> shown(const std::vector<float>& rgb) const {
    return image::display_pixels(rgb, report_.document.display.exposure, report_.document.display.curve);
  }

  Result<void> add(Kind kind, const std::string& name, const std::string& prefix, const std::string& file,
                   const std::vector<uint8_t>& rgb) {
    const fs::path path = folder_ / (file + ".png");
    const auto& size = report_.reference.picture;
    if (auto ok = image::write_png(path, size.width, size.height, rgb); !ok) return ok;
    auto bytes = read_file(path);
    if (!bytes) return bytes.error();
    pictures_.push_back({kind, prefix + name, name, std::move(*bytes)});
    return {};
  }

  fs::path folder_;
  const Report& report_;
  std::vector<PagePicture> pictures_;
};

}  // namespace

std::string curves_csv(const Report& report) {
  std::string csv = "method,repeat,seconds,spp,mse,relmse,bias\n";
  char line[160];
  for (const auto& method : report.outcome.methods)
    for (const auto& curve : method.curves.repeats)
      for (const auto& p : curve.points) {
        std::snprintf(line, sizeof line, ",%d,%.9g,%.9g,%.9g,%.9g,%.9g\n", curve.repeat, p.seconds, p.spp, p.mse,
                      p.relmse, p.bias);
        csv += quoted(method.curves.name) + line;
      }
  return csv;
}

std::string summary_json(const Report& r) {
  json methods = json::array();
  bool noisy = !r.reference.noise;
  for (const auto& method : r.outcome.methods) {
    const auto summary = summary_of(method, r.reference, r.document.display);
    noisy = noisy || summary.too_noisy;
    methods.push_back(method_json(summary));
  }
  const json reference{{"file", r.reference.file},
                       {"standard_error", number(r.reference.standard_error())},
                       {"spp", r.reference.samples},
                       {"seconds", r.reference.seconds},
                       {"too_noisy", noisy}};
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
  return j.dump(2) + "\n";
}

Result<void> make_folder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (fs::is_directory(folder, code)) return {};
  return output_error(folder.string() + ": this is no folder, and none can be made there");
}

Result<void> write_report(const fs::path& folder, const Report& report) {
  if (auto ok = make_folder(folder); !ok) return ok;
  if (auto ok = write_text(folder / "curves.csv", curves_csv(report)); !ok) return ok;
  if (auto ok = write_text(folder / "summary.json", summary_json(report)); !ok) return ok;
  if (auto ok = write_charts(folder, report); !ok) return ok;
  Pictures pictures(folder, report);
  if (auto ok = pictures.write(); !ok) return ok;
  return write_text(folder / "report.html", report_html(report, pictures.pictures()));
}

}  // namespace etendue::bench
