// The statistics of a rendering as JSON, for `etendue render --json`.
#pragma once
#include <string>

#include "render/session.h"

namespace etendue::cli {

struct RenderStatistics {
  const render::Document& document;
  const render::Status& status;
  const transport::Model& model;
  int threads = 0;                 // 0: one per hardware thread
  const std::string& certificate;  // JSON
  const std::string& choice;       // JSON of the automatic choice of the integrator; "null" if there was none
};

std::string statistics_json(const RenderStatistics& statistics);

}  // namespace etendue::cli
