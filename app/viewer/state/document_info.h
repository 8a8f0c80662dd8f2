// Comparison of documents, and names of what they render.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace etendue::render {
struct Document;
struct DocumentParameter;
struct MethodSettings;
}  // namespace etendue::render

namespace etendue::viewer {

inline constexpr int kMinImageSize = 16;  // pixels; images that follow the size of the viewport are not smaller

// Whether two documents show the same scene from the same camera at the same size. Integrator, sampler, path filter and
// display may differ.
bool same_view(const render::Document& a, const render::Document& b);

// The description of a parameter by its qualified name, or nothing if the document has no such parameter.
std::optional<render::DocumentParameter> document_parameter(const render::Document& document, const std::string& name);

// The name of the object that a section of the document belongs to ("material.3"); otherwise a label of the section.
std::string section_label(const render::Document& document, const std::string& section);
// The label of a parameter with the object that it belongs to: "Roughness of Tall box".
std::string full_label(const render::Document& document, const render::DocumentParameter& parameter);

// The method of a document as `bench` writes it: "path:sampler=sobol:max-depth=3".
std::string method_spec(const render::MethodSettings& method);
// A method in short form: "path, sobol, max-depth=3".
std::string short_method_name(const std::string& spec);
// A method with the labels of its integrator and sampler: "Path tracing, Sobol', max-depth=3".
std::string method_label(const std::string& spec);
// The label of an integrator; its name if there is no such integrator.
std::string integrator_label(const std::string& name);

// A message of the renderer with labels in place of names: of the integrator in front, and of parameters.
struct LabelledMessage {
  std::string text;
  std::vector<std::string> parameters{};  // the qualified names that the message contains
};
LabelledMessage with_labels(const render::Document& document, const std::string& message);

// The name of the session, or of the scene if `session` is empty, for titles.
std::string title_of(const render::Document& document, const std::string& session);

// The name of the scene file without folder and extension, or "scene".
std::string scene_stem(const render::Document& document);

}  // namespace etendue::viewer
