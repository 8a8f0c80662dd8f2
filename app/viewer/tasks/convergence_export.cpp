#include "viewer/tasks/convergence_export.h"

#include "base/file.h"
#include "image/image.h"
#include "viewer/files/file_names.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

std::string csv_quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

// One row per point. The error of the reference is not subtracted from the measured_ columns.
std::string csv_of(const bench::LiveBenchmarkSnapshot& snapshot) {
  std::string csv = "method,repeat,seconds,spp,mse,relmse,bias,displayed_mse,measured_mse,measured_relmse,measured_displayed_mse\n";
  for (const auto& method : snapshot.methods)
    for (size_t r = 0; r < method.corrected.repeats.size(); ++r) {
      const auto& corrected = method.corrected.repeats[r];
      const auto& measured = method.measured.repeats[r];
      for (size_t i = 0; i < corrected.points.size(); ++i) {
        const auto& point = corrected.points[i];
        csv += csv_quoted(method.name) + formatted(",%d,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", corrected.repeat,
                                                   point.seconds, point.spp, point.mse, point.relmse, point.bias, point.displayed_mse,
                                                   measured.points[i].mse, measured.points[i].relmse,
                                                   measured.points[i].displayed_mse);
      }
    }
  return csv;
}

}  // namespace

Result<std::string> write_convergence_chart(const std::string& file, const bench::LiveBenchmarkSnapshot& snapshot,
                                            std::span<const metrics::MethodCurves> curves,
                                            const metrics::ChartOptions& options, bool is_pareto) {
  const std::string extension = lower_extension(file);
  Result<void> written;
  const auto chart = [&] {
    return is_pareto ? metrics::pareto_chart(curves, options) : metrics::convergence_chart(curves, options);
  };
  if (extension == ".csv") {
    const std::string text = csv_of(snapshot);
    written = write_file(file, text.data(), text.size());
  } else if (extension == ".svg") {
    const std::string text = metrics::to_svg(chart());
    written = write_file(file, text.data(), text.size());
  } else if (extension == ".png") {
    const auto drawing = chart();
    written = image::write_png(file, drawing.width, drawing.height, metrics::rasterize(drawing));
  } else {
    return usage_error(file + ": '" + extension + "' is not a chart format; use .svg, .png or .csv");
  }
  if (!written) return written.error();
  return file;
}

}  // namespace etendue::viewer
