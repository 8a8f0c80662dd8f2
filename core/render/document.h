// Everything a user can set, under one name each.
//
// A Document is a plain value: the scene, the camera, the method, the film, the display. Every setting has a qualified
// name
// ("render.integrator", "material.3.roughness", "path.roulette-start") with a description; widgets, `--set`, scripts,
// snapshots and undo all go through `get` and `set`. A Document is copied for an edit and kept for undo; the heavy
// parts are shared.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "camera/camera.h"
#include "film/filter.h"
#include "film/firefly_reweighting.h"
#include "image/display.h"
#include "sampling/sampler.h"
#include "scene/scene.h"

namespace etendue::render {

struct Limits {
  uint32_t samples = 0;  // per pixel; 0 is no limit
  double seconds = 0;
  double rmse = 0;

  friend bool operator==(const Limits&, const Limits&) = default;
};

// Whether samples go where the error is, and which error that is (render/allocation.h).
enum class Adaptive { off, rmse, relmse };

struct MethodSettings {
  std::string integrator = "path", sampler = "sobol";
  Adaptive adaptive = Adaptive::off;
  std::string paths;  // the expression of the paths that count (transport/path_expression.h); empty if all do
  // Parameters by qualified name ("path.max-depth"), only those that differ from their defaults.
  std::vector<std::pair<std::string, Value>> settings;

  // The settings of one integrator or sampler, without its name in front.
  std::vector<Setting> settings_of(std::string_view owner) const;
  friend bool operator==(const MethodSettings&, const MethodSettings&) = default;
};

struct Display {
  float exposure = 0;  // EV: the picture is multiplied by 2^exposure
  image::ToneCurve curve = image::ToneCurve::none;

  friend bool operator==(const Display&, const Display&) = default;
};

struct Document {
  std::shared_ptr<const scene::Scene> scene;
  std::string scene_name;  // what --like opens again: a file or the name of a built-in scene
  std::string camera_name;
  Camera camera;
  int width = 1280, height = 720;
  film::FilterKind filter = film::FilterKind::blackman_harris;
  film::Fireflies fireflies = film::Fireflies::keep;
  MethodSettings method;
  std::vector<std::string> forced_flags;  // model.FLAG=on
  uint64_t seed = 0;
  Limits limits;
  Display display;
  bool lit_by_default = false;  // the scene had no light: its environment is the neutral one that new_document added
  std::shared_ptr<const Document> origin;  // as it was when the scene was opened: what a state is told apart from
};

// One setting of a document: its description and how to read and write it.
struct DocumentParameter {
  ParameterInfo info;           // info.name is the qualified name; default_value is the value now
  std::string section;          // "render", "camera", "material.3", ...
  std::string inactive_reason;  // why it changes nothing now, and what to do; empty if it does
  std::function<void(Document&, const Value&)> assign;
};

// All settings of one section. Sections are "render", "film", "camera", "display", "scene", "environment", "model",
// "material.N", "light.N", "node.N", and the names of the integrators and samplers.
std::vector<DocumentParameter> section_parameters(const Document& document, std::string_view section);
std::vector<std::string> sections(const Document& document);

// The current value of a setting; an unknown name is a usage error that names the nearest known one.
Result<Value> get(const Document& document, std::string_view name);

// The document with a setting changed. A bare name ("max-depth") belongs to the current integrator or sampler, or
// to "render".
Result<Document> with(const Document& document, std::string_view name, const Value& value);
// The same with the value as a user writes it.
Result<Document> with_text(const Document& document, std::string_view name, std::string_view text);

// A new document for a scene: its first camera (or `camera`), default settings.
Result<Document> new_document(const std::string& scene_file_or_name, const std::string& camera = "");

// What differs from the document's origin: the JSON text that a snapshot carries, and its way back.
std::string state_json(const Document& document, uint32_t samples);
Result<Document> document_from_state(const std::string& json, const std::string& source, uint32_t* samples = nullptr);
// How a snapshot was shown, without opening its scene; what its text does not say is as a new document has it.
Display display_from_state(const std::string& json);

// Sets the environment from a .hdr or .exr file.
Result<Document> with_environment(const Document& document, const std::string& file);

}  // namespace etendue::render

template <>
struct etendue::Options<etendue::render::Adaptive> {
  static constexpr std::array<etendue::Option, 3> kOptions{
      {{"off", "Off"}, {"rmse", "For the least RMSE"}, {"relmse", "For the least relative error"}}};
};
