// The reference manual: one Markdown page per entry of every registry, and a page for man(1).
#pragma once
#include <string>
#include <vector>

#include "head_comment.h"

namespace etendue::cli {

struct ManualPage {
  std::string file;  // relative to the folder of the manual: "integrators/path.md"
  std::string text;
};

// The pages for the registries of this program and the comments of its sources. They refer to images by the names
// that manual_images.h writes.
std::vector<ManualPage> manual_pages(const SourceFiles& sources);

}  // namespace etendue::cli
