// Methods as users write them: integrator[:name=value]..., with the sampler as one of the values, auto[:name=value]...
// for the automatic choice of the integrator, or external:"COMMAND" for another renderer (external_renderer.h). The setting
// denoise=true measures the denoised image (denoised_images.h); denoise=regression and denoise=oidn choose the denoiser.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "render/denoised_image.h"
#include "render/document.h"

namespace etendue::bench {

// An integrator with its settings, applied to a document, or another renderer.
struct MethodSpec {
  std::string name;  // as the user wrote it
  render::Document document;
  std::string command = {};  // of another renderer; empty for an integrator
  std::optional<render::Denoiser> denoiser = {};  // nothing: the image itself is measured

  bool is_external() const { return !command.empty(); }
  // Whether the integrator is chosen before each rendering (Plan::choose).
  bool is_automatic() const { return !is_external() && document.automatic.enabled; }
  // For charts and tables: the name, or the program of another renderer.
  std::string label() const;
};

// Parses one method, as "path:sampler=sobol", and applies it to the base document.
Result<MethodSpec> parse_method(const std::string& text, const render::Document& base);

// Parses a list, as "path:sampler=sobol,path-pure:max-depth=3,auto:allow=consistent". Commas inside double quotes do not
// separate methods, and those inside braces separate alternatives (bench/alternatives.h). Only lists may contain the automatic choice, and other renderers, because sessions and other files
// must not name programs to run. Usage errors: an unknown name, a value out of range, a setting that changes the image
// itself (size, camera, scene, seed), a method given twice, and an empty list.
Result<std::vector<MethodSpec>> parse_methods(const std::string& list, const render::Document& base);

}  // namespace etendue::bench
