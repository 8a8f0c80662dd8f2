#include "experiments/experiment_output.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/number_text.h"
#include "image/image.h"
#include "metrics/drawing_layout.h"

namespace etendue::experiments {
namespace {

using metrics::ErrorCurve;
using metrics::FunctionChart;
using metrics::FunctionCurve;
using metrics::MatrixChart;
using metrics::MethodCurves;
using nlohmann::json;

// JSON has no infinity and no NaN; both become null.
json finite_json(double value) { return std::isfinite(value) ? json(value) : json(); }

// A field of CSV in quotation marks [RFC 4180].
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + "\"";
}

std::string csv_number(double value) { return std::isfinite(value) ? format_number(value, 17) : ""; }

struct CurveRow {
  int repeat = 0;
  double x = 0, y = 0;
  double low = NAN, high = NAN;
};

std::vector<CurveRow> rows_of(const MethodCurves& curves) {
  std::vector<CurveRow> rows;
  for (const ErrorCurve& curve : curves.repeats)
    for (const auto& p : curve.points) rows.push_back({.repeat = curve.repeat, .x = p.spp, .y = std::sqrt(p.mse)});
  return rows;
}

std::vector<CurveRow> rows_of(const FunctionCurve& curve) {
  std::vector<CurveRow> rows;
  for (size_t i = 0; i < curve.points.size(); ++i) {
    rows.push_back({.x = curve.points[i].x, .y = curve.points[i].y});
    if (i < curve.band.size()) {
      rows.back().low = curve.band[i].low;
      rows.back().high = curve.band[i].high;
    }
  }
  return rows;
}

json points_json(const std::vector<CurveRow>& rows) {
  json points = json::array();
  for (const CurveRow& r : rows) {
    json point{{"repeat", r.repeat}, {"x", finite_json(r.x)}, {"y", finite_json(r.y)}};
    if (std::isfinite(r.low)) point["low"] = r.low;
    if (std::isfinite(r.high)) point["high"] = r.high;
    points.push_back(point);
  }
  return points;
}

template <class Curves>
json curves_json(const Curves& curves) {
  json list = json::array();
  for (const auto& curve : curves) list.push_back({{"name", curve.name}, {"points", points_json(rows_of(curve))}});
  return list;
}

json chart_json(const ErrorChart& c) {
  return {{"title", c.title}, {"curves", curves_json(c.curves)}, {"x", c.work}, {"y", c.error}};
}
json chart_json(const FunctionChart& c) {
  return {{"title", c.title}, {"curves", curves_json(c.curves)}, {"x", c.x_label}, {"y", c.y_label}};
}
json chart_json(const MatrixChart& c) {
  json rows = json::array();
  for (const auto& row : c.rows) {
    rows.push_back(json::array());
    for (const double value : row) rows.back().push_back(finite_json(value));
  }
  return {{"title", c.title}, {"rows", rows}, {"x", c.x_label}, {"y", c.y_label}};
}

std::string csv_line(const std::string& chart, const std::string& curve, const CurveRow& r) {
  return quoted(chart) + "," + quoted(curve) + "," + std::to_string(r.repeat) + "," + csv_number(r.x) + "," +
         csv_number(r.y) + "," + csv_number(r.low) + "," + csv_number(r.high) + "\n";
}

template <class ChartOfCurves>
std::string csv_of(const ChartOfCurves& chart) {
  std::string text;
  for (const auto& curve : chart.curves)
    for (const CurveRow& r : rows_of(curve)) text += csv_line(chart.title, curve.name, r);
  return text;
}
// The rows of a matrix are curves.
std::string csv_of(const MatrixChart& chart) {
  std::string text;
  for (size_t i = 0; i < chart.rows.size(); ++i)
    for (size_t j = 0; j < chart.rows[i].size(); ++j)
      text += csv_line(chart.title, "row " + std::to_string(i), {.x = static_cast<double>(j), .y = chart.rows[i][j]});
  return text;
}

json table_json(const Table& table) {
  json rows = json::array();
  for (const auto& row : table.rows) {
    json cells = json::array();
    for (const auto& cell : row) {
      if (const auto* number = std::get_if<double>(&cell))
        cells.push_back(finite_json(*number));
      else
        cells.push_back(std::get<std::string>(cell));
    }
    rows.push_back(cells);
  }
  return {{"columns", table.columns}, {"rows", rows}};
}

// The text in a column of this many characters. UTF-8 characters count once.
std::string padded(const std::string& text, size_t width) {
  const auto length = static_cast<size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }));
  return text + std::string(width > length ? width - length : 0, ' ');
}

std::string rows_text(const std::vector<std::vector<std::string>>& rows) {
  std::vector<size_t> widths;
  for (const auto& row : rows)
    for (size_t c = 0; c < row.size(); ++c) {
      if (c == widths.size()) widths.push_back(0);
      widths[c] = std::max(widths[c], row[c].size());
    }
  std::string text;
  for (const auto& row : rows) {
    std::string line = " ";
    for (size_t c = 0; c < row.size(); ++c) line += " " + padded(row[c], widths[c]) + " ";
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string table_text(const Table& table) {
  if (table.rows.empty()) return "";
  std::vector<std::vector<std::string>> rows{table.columns};
  for (const auto& row : table.rows) {
    rows.emplace_back();
    for (const auto& cell : row) rows.back().push_back(cell_text(cell));
  }
  return rows_text(rows);
}

std::string checks_text(const std::vector<Check>& checks) {
  if (checks.empty()) return "";
  std::vector<std::vector<std::string>> rows{{"check", "measured", "expected", "tolerance", ""}};
  for (const Check& c : checks)
    rows.push_back({c.name, format_number(c.measured, 6), format_number(c.expected, 6), format_number(c.tolerance, 2),
                    c.holds() ? "holds" : "does not hold"});
  return rows_text(rows);
}

Result<void> write_text(const std::string& file, const std::string& text) {
  return write_file(file, text.data(), text.size());
}

}  // namespace

const std::string& title_of(const Chart& chart) {
  return std::visit([](const auto& c) -> const std::string& { return c.title; }, chart);
}

metrics::Drawing drawing_of(const Chart& chart, const metrics::ChartOptions& options) {
  if (const auto* function = std::get_if<FunctionChart>(&chart)) return metrics::function_drawing(*function, options);
  if (const auto* matrix = std::get_if<MatrixChart>(&chart)) return metrics::matrix_drawing(*matrix, options);
  const auto& error = std::get<ErrorChart>(chart);
  metrics::ChartOptions error_options = options;
  error_options.title = error.title;
  error_options.abscissa = metrics::Abscissa::samples;
  error_options.work_label = error.work;
  error_options.error_label = error.error;
  return metrics::convergence_chart(error.curves, error_options);
}

metrics::Drawing drawing_of(const ExperimentResult& result, const metrics::ChartOptions& options) {
  std::vector<metrics::Drawing> drawings;
  for (const Chart& chart : result.charts) drawings.push_back(drawing_of(chart, options));
  return metrics::stacked(drawings);
}

json to_json(const ExperimentResult& result) {
  json charts = json::array(), checks = json::array();
  for (const Chart& chart : result.charts)
    charts.push_back(std::visit([](const auto& c) { return chart_json(c); }, chart));
  for (const Check& c : result.checks)
    checks.push_back({{"name", c.name},
                      {"measured", finite_json(c.measured)},
                      {"expected", finite_json(c.expected)},
                      {"tolerance", finite_json(c.tolerance)},
                      {"holds", c.holds()}});
  return {{"charts", charts}, {"table", table_json(result.table)}, {"checks", checks}, {"notes", result.notes}};
}

std::string to_csv(const ExperimentResult& result) {
  std::string text = "chart,curve,repeat,x,y,low,high\n";
  for (const Chart& chart : result.charts) text += std::visit([](const auto& c) { return csv_of(c); }, chart);
  return text;
}

std::string cell_text(const Table::Cell& cell, int digits) {
  if (const auto* number = std::get_if<double>(&cell))
    return std::isnan(*number) ? "-" : format_number(*number, digits);
  return std::get<std::string>(cell);
}

std::string to_text(const ExperimentResult& result) {
  std::string text = table_text(result.table);
  const std::string checks = checks_text(result.checks);
  if (!text.empty() && !checks.empty()) text += "\n";
  text += checks;
  for (const std::string& note : result.notes) text += "  " + note + "\n";
  return text;
}

Result<void> write_result(const std::string& file, const ExperimentResult& result) {
  const std::string extension = std::filesystem::path(file).extension().string();
  if (extension == ".csv") return write_text(file, to_csv(result));
  if (extension == ".json") return write_text(file, to_json(result).dump(2) + "\n");
  if (extension != ".svg" && extension != ".png")
    return usage_error(file + ": '" + extension + "' is not a format of results; use .csv, .json, .png or .svg");
  const metrics::Drawing drawing = drawing_of(result);
  if (extension == ".svg") return write_text(file, metrics::to_svg(drawing));
  return image::write_png(file, drawing.width, drawing.height, metrics::rasterize(drawing));
}

}  // namespace etendue::experiments
