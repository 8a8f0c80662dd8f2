// Everything a user can set, each parameter under one name.
//
// A Document is a plain value: scene, camera, rendering method, film and display settings. Every parameter has a
// qualified name ("render.integrator", "material.3.roughness", "path.roulette-start") and a description. Widgets,
// `--set`, scripts, snapshots and undo all use the same access by name. A Document is copied for each edit and kept for
// undo; copies share the large parts, such as the scene.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "camera/camera.h"
#include "film/error_measure.h"
#include "film/filter.h"
#include "film/firefly_reweighting.h"
#include "image/display.h"
#include "render/render_part.h"
#include "sampling/sampler.h"
#include "scene/scene.h"
#include "scene/structural_edit.h"
#include "transport/model.h"

namespace etendue::render {

// When a rendering stops: at the first limit that it reaches. 0 is no limit.
struct Limits {
  uint32_t samples = 0;  // per pixel
  double seconds = 0;
  double error = 0;  // estimated, in this measure
  film::ErrorMeasure measure = film::ErrorMeasure::rmse;

  bool any() const { return samples > 0 || seconds > 0 || error > 0; }
  friend bool operator==(const Limits&, const Limits&) = default;
};

// Whether sampling is adaptive, and the error that it minimises (adaptive_sampling.h).
enum class Adaptive { off, rmse, relmse };

// The rendering method: an integrator and a sampler with the values of their parameters.
struct MethodSettings {
  std::string integrator = "path", sampler = "sobol";
  Adaptive adaptive = Adaptive::off;
  transport::ColorMode color = transport::ColorMode::automatic;
  std::string paths;  // path expression of the light paths that count (transport/path_expression); empty: all
  // Values of parameters by qualified name ("path.max-depth"), only those that differ from their defaults.
  std::vector<std::pair<std::string, Value>> settings;

  // The values that belong to one integrator or sampler, by unqualified name.
  std::vector<Setting> settings_of(std::string_view owner) const;
  friend bool operator==(const MethodSettings&, const MethodSettings&) = default;
};

// Which integrators may be chosen automatically: by what their images converge to (integrator::Bias).
enum class AllowedIntegrators { unbiased, consistent, anything };

// What the automatic choice minimises: an error measure (film/error_measure.h), or the mean of FLIP.
enum class MinimisedError : uint8_t { rmse, relative, displayed, flip };

// The automatic choice of the method (lab/advisor/method_choice.h). It changes the document's method; a rendering uses
// the method of the document whether it was chosen automatically or not.
struct AutomaticMethod {
  bool enabled = false;
  AllowedIntegrators allow = AllowedIntegrators::unbiased;
  MinimisedError error = MinimisedError::relative;
  std::string reason;  // why the present method was chosen; empty: no choice has been made yet

  bool is_pending() const { return enabled && reason.empty(); }
  friend bool operator==(const AutomaticMethod&, const AutomaticMethod&) = default;
};
// The value of "render.integrator" that enables the automatic choice.
inline constexpr const char* kAutomatic = "auto";

struct Display {
  float exposure = 0;  // EV: displayed radiance is multiplied by 2^exposure
  image::ToneCurve curve = image::ToneCurve::none;

  film::DisplayTransform transform() const { return {exposure, curve}; }
  friend bool operator==(const Display&, const Display&) = default;
};

struct Document {
  std::shared_ptr<const scene::Scene> scene;
  std::string scene_name;  // the file, or the name of a built-in scene, from which the document can be opened again
  std::string camera_name;
  Camera camera;
  int width = 1280, height = 720;
  film::FilterKind filter = film::FilterKind::blackman_harris;
  film::Fireflies fireflies = film::Fireflies::keep;
  MethodSettings method;
  AutomaticMethod automatic;
  std::vector<std::string> forced_flags;  // flags of the transport model that are set to "on" (model.FLAG)
  uint64_t seed = 0;
  Limits limits;
  RenderPart part;
  Display display;
  bool lit_by_default = false;                   // the scene has no light, so new_document added the studio environment
  std::shared_ptr<const Document> origin;        // the document as it was opened; states record the differences from it
  std::vector<scene::StructuralEdit> structure;  // that led from the scene of the origin to this one
};

// One parameter of a document: its description, and a function that changes it.
struct DocumentParameter {
  ParameterInfo info;           // `name` is the qualified name, `default_value` the current value
  std::string section;          // "render", "camera", "material.3", ...
  std::string inactive_reason;  // why the parameter has no effect at present, and a remedy; empty if it has one
  std::function<void(Document&, const Value&)> assign;
};

// All sections of a document: "render", "auto", "film", "camera", "display", "scene", "environment", "model", the names of the
// integrators and samplers, "material.N", "light.N" and "node.N".
std::vector<std::string> sections(const Document& document);
// All parameters of a section; none if there is no such section.
std::vector<DocumentParameter> section_parameters(const Document& document, std::string_view section);

// The value of a parameter. An unknown name is a usage error that states the nearest known name.
Result<Value> get(const Document& document, std::string_view name);

// The document with one parameter changed. An unqualified name ("max-depth") belongs to the integrator, the sampler or
// the section "render", in this order.
Result<Document> with(const Document& document, std::string_view name, const Value& value);
// The same with the value as text.
Result<Document> with_text(const Document& document, std::string_view name, std::string_view text);

// A new document for a scene with the given camera, or with the scene's first one, and default settings.
Result<Document> new_document(const std::string& scene_file_or_name, const std::string& camera = "");

// The document after a structural edit: of objects, materials or textures. The error says why the edit is impossible,
// for instance because the file of a texture is not an image.
Result<Document> with_structural_edit(const Document& document, const scene::StructuralEdit& edit);

// The state of a document as JSON text, for snapshots and checkpoints: the scene's name and all parameters that differ
// from the document's origin. If a folder is given, files in it or below are named relative to it, others absolutely;
// otherwise they are named as they were opened. The state of a part of a rendering names the part.
std::string state_json(const Document& document, uint32_t samples, const std::string& folder = "");
// Opens the document of a state again. `source` is the file that contains the state, for error messages and relative
// paths.
Result<Document> document_from_state(const std::string& json, const std::string& source, uint32_t* samples = nullptr);
// The part of a rendering that a state names; the whole rendering if it names none. `document_from_state` ignores it.
RenderPart part_from_state(const std::string& json);
// The display settings of a state, without opening its scene. Missing settings have their default values.
Display display_from_state(const std::string& json);

// The document with an environment map from an .hdr or .exr file, or with a built-in environment by its name.
Result<Document> with_environment(const Document& document, const std::string& file);

}  // namespace etendue::render

template <>
struct etendue::Options<etendue::render::Adaptive> {
  static constexpr std::array<etendue::Option, 3> kOptions{
      {{"off", "Off"}, {"rmse", "Minimise RMSE"}, {"relmse", "Minimise relative error (relMSE)"}}};
};

template <>
struct etendue::Options<etendue::render::AllowedIntegrators> {
  static constexpr std::array<etendue::Option, 3> kOptions{
      {{"unbiased", "Unbiased"}, {"consistent", "Consistent"}, {"anything", "Anything"}}};
};

template <>
struct etendue::Options<etendue::render::MinimisedError> {
  static constexpr std::array<etendue::Option, 4> kOptions{
      {{"rmse", "RMSE"}, {"relative", "Relative error"}, {"displayed", "Displayed error"}, {"flip", "FLIP"}}};
};
