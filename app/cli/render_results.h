// The files that etendue render and etendue merge write.
#pragma once
#include <string>
#include <vector>

#include "render/session.h"

namespace etendue::cli {

struct ResultFiles {
  std::string out;                // image file
  std::string png, json;          // additional files, or empty; '-' as `json` is standard output
  std::vector<std::string> aovs;  // additional layers of the image
  int threads = 0;
};

// Splits the argument of --aov. "all" stands for the AOVs of first hits, "media" for the terms of the equation of
// transfer.
Result<std::vector<std::string>> parse_aovs(const std::string& text);

// Whether an image file and, unless it is empty, an additional one can be written.
Result<void> check_names(const std::string& out, const std::string& png, const std::string& command);

// Writes the film of a session that has rendered `document`. `choice` is the JSON of the automatic choice of the
// integrator, or "null". The session renders other documents for the certificate.
Result<void> write_results(render::Session& session, const render::Document& document, const render::Status& status,
                           const ResultFiles& files, const std::string& choice);

// Writes the statistics as JSON to a file; '-' is standard output.
Result<void> write_statistics(const std::string& file, const std::string& json);

// Prints one line if the estimated error of the image cannot be trusted.
void print_reliability(const std::string& file, const render::Status& status);

}  // namespace etendue::cli
