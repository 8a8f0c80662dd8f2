// Sections "film" and "display".
#include "render/document_parameters.h"
#include "transport/path_expression/path_expression.h"

namespace etendue::render {
namespace {

Result<void> check_paths(std::string_view text) {
  const auto parsed = transport::PathExpression::parse_paths(text);
  return parsed ? Result<void>() : parsed.error();
}

// Any path expression is accepted. The offered classes are examples; the second to the fifth one partition all paths.
DocumentParameter paths_choice(const MethodSettings& method) {
  constexpr std::array<Option, 6> kOffered{{{"", "All"},
                                            {"EL", "Directly visible lights, EL"},
                                            {"E(D|G)L", "Direct illumination, E(D|G)L"},
                                            {"E(D|G).+L", "Indirect illumination, E(D|G).+L"},
                                            {"ES.*L", "Specular reflections and refractions, ES.*L"},
                                            {"E.*DS+L", "Caustics, E.*DS+L"}}};
  DocumentParameter parameter;
  parameter.section = "film";
  parameter.info.name = "film.paths";
  parameter.info.label = "Light paths";
  parameter.info.doc =
      "Restricts the image to light paths that match this expression: E eye, D diffuse, G glossy, S specular, L light";
  parameter.info.type = ParameterType::choice;
  for (const Option& option : kOffered) {
    parameter.info.options.emplace_back(option.name);
    parameter.info.option_labels.emplace_back(option.label);
  }
  parameter.info.validate_text = check_paths;
  parameter.info.default_value = method.paths;
  parameter.assign = [](Document& d, const Value& v) { d.method.paths = std::get<std::string>(v); };
  return parameter;
}

}  // namespace

DocumentParameters film_parameters(const Document& document) {
  constexpr int kLargestSize = 16384;
  return {make_parameter("film",
                         Number<int>{"width", "Width", document.width, {1, kLargestSize}, "Width of the image", "px"},
                         [](Document& d, int v) { d.width = v; }),
          make_parameter(
              "film", Number<int>{"height", "Height", document.height, {1, kLargestSize}, "Height of the image", "px"},
              [](Document& d, int v) { d.height = v; }),
          make_parameter("film",
                         Choice<film::FilterKind>{"filter", "Pixel filter", document.filter,
                                                  "Reconstruction filter: weights the samples around a pixel's centre"},
                         [](Document& d, film::FilterKind v) { d.filter = v; }),
          make_parameter("film",
                         Choice<film::Fireflies>{
                             "fireflies", "Fireflies", document.fireflies,
                             "Re-weighting darkens bright outliers on screen until similar samples confirm them. "
                             "Linear files and error estimates are not affected"},
                         [](Document& d, film::Fireflies v) { d.fireflies = v; }),
          paths_choice(document.method)};
}

DocumentParameters display_parameters(const Document& document) {
  return {make_parameter("display",
                         Choice<image::ToneCurve>{"curve", "Tone mapping", document.display.curve,
                                                  "Maps radiance to the range of the screen"},
                         [](Document& d, image::ToneCurve v) { d.display.curve = v; })};
}

}  // namespace etendue::render
