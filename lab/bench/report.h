// What a bench leaves behind: figures for scripts, a chart, and a page that stands alone.
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
};

// Columns method,repeat,seconds,spp,mse,relmse,bias: as measured, with the reference's noise in them.
std::string curves_csv(const Report& report);

std::string summary_json(const Report& report);

// A picture of the page as PNG bytes.
struct PagePicture {
  enum class Kind { rendering, difference, flip } kind;
  std::string name, caption;
  std::vector<std::byte> png;
};

// A page of HTML that needs nothing else: charts, figures, and any two of the pictures, in order of their kind, under a
// wipe.
std::string report_html(const Report& report, const std::vector<PagePicture>& pictures);

// Writes curves.csv, summary.json, chart.svg, chart.png, report.html and the pictures into the folder, which is made if
// it is not there.
Result<void> write_report(const std::filesystem::path& folder, const Report& report);

// Makes the folder if it is not there; an output error if that cannot be.
Result<void> make_folder(const std::filesystem::path& folder);

}  // namespace etendue::bench
