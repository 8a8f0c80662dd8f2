// The figures of [Lang]: plots, point patterns and renderings, made by this program.
//
// A figure is a function in a .cpp file of this folder, named after its number,
//
//   Figure figure_7_4() {
//     return {.title = "Halton sequence", .make = [](const MakeContext&) -> Result<Parts> { ... }};
//   }
//
// and one line in registry.cpp. `etendue figure`, the manual and the tests read the registry. Figures that cannot be made
// are listed with the reason in not_made.cpp.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/result.h"
#include "metrics/drawing.h"

namespace etendue::figures {

struct Picture {
  int width = 0, height = 0;
  std::vector<uint8_t> pixels;  // 8-bit sRGB, row by row
};

// One of the pictures or plots that a figure consists of.
struct Part {
  std::string caption;
  std::variant<metrics::Drawing, Picture> content;
};
using Parts = std::vector<Part>;

struct MakeContext {
  int threads = 0;    // of renderings; 0: all
  int width = 320;    // of a rendered picture, pixels
  double effort = 1;  // factor for the numbers of samples of renderings, except where they are the subject
  uint64_t seed = 0;
};

struct Figure {
  const char* number = nullptr;  // as in [Lang]: "7.4"
  const char* title;
  const char* note = "";  // in which way it differs from the printed figure, and other explanations; sentences
  int columns = 0;        // of the arrangement of its parts; 0: all in one row
  Result<Parts> (*make)(const MakeContext&);
};

// All figures that the program makes, in the order of their numbers.
const std::vector<Figure>& figures();
// The figure with this number, or null.
const Figure* find_figure(std::string_view number);

// ---- Figures that are not made

enum class Reason {
  diagram,     // illustrates a definition or a geometry and shows nothing computed
  pseudocode,  // a listing
  artwork      // a photograph, or an image of assets that are not available
};
struct NotMade {
  const char* number;
  Reason reason;
};
std::span<const NotMade> not_made();
const NotMade* find_not_made(std::string_view number);
// As a sentence.
const char* explanation(Reason reason);

}  // namespace etendue::figures
