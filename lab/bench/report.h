// The files of a benchmark: tables for scripts, a chart, and a self-contained HTML page.
#pragma once
#include <filesystem>
#include <string>

#include "bench/benchmark.h"
#include "bench/summary.h"

namespace etendue::bench {

struct Report {
  const render::Document& document;
  const Plan& plan;
  const Reference& reference;
  const Outcome& outcome;
  int threads = 0;
  film::ErrorMeasure measure = film::ErrorMeasure::rmse;  // of the charts
};

// Columns method,repeat,seconds,spp,mse,relmse,bias,displayed_mse: as measured, including the noise of the reference.
std::string curves_csv(const Report& report);

std::string summary_json(const Report& report);

// An image of the page, as the bytes of a PNG file.
struct PageImage {
  enum class Kind { rendering, difference, flip } kind;
  std::string name, caption;
  std::vector<std::byte> png;
};

// The HTML page: charts, tables, and a wipe between any two of the images, which are given in the order of their kind.
std::string report_html(const Report& report, const std::vector<PageImage>& images);

// Writes curves.csv, summary.json, chart.svg, chart.png, report.html and the images into the folder, which is created
// if necessary.
Result<void> write_report(const std::filesystem::path& folder, const Report& report);

// Creates the folder if it does not exist; an output error if that fails.
Result<void> create_folder(const std::filesystem::path& folder);

}  // namespace etendue::bench
