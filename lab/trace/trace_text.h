// A traced sample as text for people: one paragraph per vertex.
#pragma once
#include <string>
#include <vector>

#include "render/pixel_trace.h"

namespace etendue::trace {

// One row of the table of a trace.
struct TraceRow {
  int vertex = -1;         // index; -1: the camera
  std::string event = {};  // "vertex 1", "light sample", "BSDF sample", "emission"
  std::string details = {};
  std::string pdf = {};  // with its unit; empty if there is none
  std::string mis_weight = {};
  std::string contribution = {};  // cd/m^2; empty if the event cannot contribute
  bool rejected = false;          // an occluded shadow ray, the end of a path
};

// The rows in the order of the vertices.
std::vector<TraceRow> trace_rows(const render::PixelTrace& trace);

std::string to_text(const render::PixelTrace& trace);

}  // namespace etendue::trace
