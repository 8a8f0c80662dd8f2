// Methods as users write them: integrator[:name=value]..., with the sampler as one of the values.
#pragma once
#include <string>
#include <vector>

#include "render/document.h"

namespace etendue::bench {

// An integrator with its settings, applied to a document.
struct MethodSpec {
  std::string name;  // as the user wrote it
  render::Document document;
};

// Parses one method, as "path:sampler=sobol", and applies it to the base document.
Result<MethodSpec> parse_method(const std::string& text, const render::Document& base);

// Parses a list, as "path:sampler=sobol,path-pure:max-depth=3". Usage errors: an unknown name, a value out of range, a
// setting that changes the image itself (size, camera, scene, seed), a method given twice, and an empty list.
Result<std::vector<MethodSpec>> parse_methods(const std::string& list, const render::Document& base);

}  // namespace etendue::bench
