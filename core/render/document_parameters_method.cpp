// Sections: render, film, display, model, scene, and one for each integrator and sampler.
#include <algorithm>
#include <charconv>

#include "integrator/integrator.h"
#include "render/document_parameters.h"
#include "render/incompatibility.h"
#include "scene/pose.h"
#include "scene/variants.h"
#include "transport/model.h"
#include "transport/path_expression/path_expression.h"

namespace etendue::render {
namespace {

template <class Infos>
DocumentParameter registry_choice(const char* name, const char* label, const char* doc, const Infos& infos,
                                  const std::string& now, std::string MethodSettings::*member) {
  DocumentParameter b;
  b.section = "render";
  b.info.name = name, b.info.label = label, b.info.doc = doc;
  b.info.type = ParameterType::choice;
  for (const auto& info : infos) {
    b.info.options.push_back(info.name);
    b.info.option_labels.push_back(info.label);
  }
  b.info.default_value = now;
  b.assign = [member](Document& document, const Value& value) {
    document.method.*member = std::get<std::string>(value);
  };
  return b;
}

std::vector<DocumentParameter> render_bindings(const Document& d) {
  std::vector<DocumentParameter> list;
  list.push_back(registry_choice("render.integrator", "Integrator", "How light paths are found",
                                 integrator::integrator_infos(), d.method.integrator, &MethodSettings::integrator));
  list.push_back(registry_choice("render.sampler", "Sampler", "Where random numbers come from", sampler_infos(),
                                 d.method.sampler, &MethodSettings::sampler));
  list.push_back(binding("render",
                         Choice<Adaptive>{"adaptive", "Adaptive sampling", d.method.adaptive,
                                          "Half of the samples go where they bring most, decided so that the picture "
                                          "stays unbiased; samples are then counted on average"},
                         [](Document& doc, Adaptive v) { doc.method.adaptive = v; }));
  list.back().inactive_reason = adaptive_incompatibility(d.method.integrator);
  constexpr int kMost = 2'000'000'000;
  list.push_back(binding(
      "render",
      Number<int>{"seed", "Seed", static_cast<int>(d.seed), {0, kMost}, "Another seed is another, independent noise"},
      [](Document& doc, int v) { doc.seed = static_cast<uint64_t>(v); }));
  list.push_back(binding("render",
                         Number<int>{"samples",
                                     "Samples",
                                     static_cast<int>(d.limits.samples),
                                     {0, 1'000'000},
                                     "Stop at this many samples per pixel; 0 goes on",
                                     "spp",
                                     Scale::logarithmic},
                         [](Document& doc, int v) { doc.limits.samples = static_cast<uint32_t>(v); }));
  list.push_back(binding("render",
                         Number<float>{"seconds",
                                       "Time",
                                       static_cast<float>(d.limits.seconds),
                                       {0, 1e6f},
                                       "Stop after this time; 0 goes on",
                                       "s",
                                       Scale::logarithmic},
                         [](Document& doc, float v) { doc.limits.seconds = static_cast<double>(v); }));
  list.push_back(
      binding("render",
              Number<float>{"error",
                            "Error",
                            static_cast<float>(d.limits.rmse),
                            {0, 1e6f},
                            "Stop when the estimated root mean square error of the image is below this; 0 goes on",
                            "",
                            Scale::logarithmic},
              [](Document& doc, float v) { doc.limits.rmse = static_cast<double>(v); }));
  return list;
}

Result<void> accepts_paths(std::string_view text) {
  const auto parsed = transport::PathExpression::parse_paths(text);
  return parsed ? Result<void>() : parsed.error();
}

// Any path expression; offered are classes that people ask for. The second to the fifth part all paths between them.
DocumentParameter paths_binding(const Document& d) {
  constexpr std::array<Option, 6> kOffered{{{"", "All"},
                                            {"EL", "Light in view, EL"},
                                            {"E(D|G)L", "Direct light, E(D|G)L"},
                                            {"E(D|G).+L", "Indirect light, E(D|G).+L"},
                                            {"ES.*L", "Seen in mirrors and glass, ES.*L"},
                                            {"E.*DS+L", "Caustics, E.*DS+L"}}};
  DocumentParameter b;
  b.section = "film";
  b.info.name = "film.paths", b.info.label = "Paths";
  b.info.doc = "Only light paths that match count: E the eye, D diffuse, G glossy, S specular, L the light";
  b.info.type = ParameterType::choice;
  for (const Option& option : kOffered) {
    b.info.options.emplace_back(option.name);
    b.info.option_labels.emplace_back(option.label);
  }
  b.info.accepts_text = accepts_paths;
  b.info.default_value = d.method.paths;
  b.assign = [](Document& document, const Value& value) { document.method.paths = std::get<std::string>(value); };
  return b;
}

std::vector<DocumentParameter> film_bindings(const Document& d) {
  constexpr int kMost = 16384;
  return {binding("film", Number<int>{"width", "Width", d.width, {1, kMost}, "Width of the picture", "px"},
                  [](Document& doc, int v) { doc.width = v; }),
          binding("film", Number<int>{"height", "Height", d.height, {1, kMost}, "Height of the picture", "px"},
                  [](Document& doc, int v) { doc.height = v; }),
          binding("film",
                  Choice<film::FilterKind>{"filter", "Pixel filter", d.filter,
                                           "How samples are weighted around a pixel's centre"},
                  [](Document& doc, film::FilterKind v) { doc.filter = v; }),
          binding("film",
                  Choice<film::Fireflies>{"fireflies", "Fireflies", d.fireflies,
                                          "Bright samples too rare to be believed are shown darker; sums, errors and "
                                          "linear files keep them"},
                  [](Document& doc, film::Fireflies v) { doc.fireflies = v; }),
          paths_binding(d)};
}

std::vector<DocumentParameter> display_bindings(const Document& d) {
  return {binding(
      "display",
      Choice<image::ToneCurve>{"curve", "Tone curve", d.display.curve, "How radiance becomes what a screen can show"},
      [](Document& doc, image::ToneCurve v) { doc.display.curve = v; })};
}

// A camera that belongs to a node goes with it.
void show_at(Document& document, float time) {
  const int node = scene::node_of_camera(*document.scene, document.camera);
  edit_scene(document, [time](scene::Scene& s) { s.time = time; });
  if (node < 0) return;
  const auto world = scene::world_matrices(*document.scene);
  document.camera.to_world = scene::camera_to_world(world[static_cast<size_t>(node)]);
}

DocumentParameter variant_binding(const Document& d) {
  DocumentParameter b;
  b.section = "scene";
  b.info.name = "scene.variant", b.info.label = "Variant";
  b.info.doc = "Which of the file's sets of materials is worn";
  b.info.type = ParameterType::choice;
  b.info.options = b.info.option_labels = scene::variant_choices(*d.scene);
  b.info.default_value = b.info.options[static_cast<size_t>(d.scene->variant + 1)];
  b.assign = [options = b.info.options](Document& document, const Value& value) {
    const auto chosen = std::ranges::find(options, std::get<std::string>(value));
    edit_scene(document,
               [&](scene::Scene& s) { scene::show_variant(s, static_cast<int>(chosen - options.begin()) - 1); });
  };
  return b;
}

std::vector<DocumentParameter> scene_bindings(const Document& d) {
  float longest = 0;
  for (const auto& animation : d.scene->animations) longest = std::max(longest, animation->duration);
  std::vector<DocumentParameter> list{binding(
      "scene",
      Number<float>{
          "time", "Time", d.scene->time, {0, std::max(1e4f, longest)}, "The moment at which animations are shown", "s"},
      [](Document& doc, float v) { show_at(doc, v); })};
  if (!d.scene->variants.empty()) list.push_back(variant_binding(d));
  return list;
}

enum class Force { automatic, on };

std::vector<DocumentParameter> model_bindings(const Document& d);

// The parameters of an integrator or a sampler, with the values that the method gives them.
std::vector<DocumentParameter> owned_bindings(const Document& d, const std::string& owner,
                                              const std::vector<ParameterInfo>& parameters) {
  std::vector<DocumentParameter> list;
  for (const ParameterInfo& p : parameters) {
    DocumentParameter b;
    b.section = owner;
    b.info = p;
    b.info.name = owner + "." + p.name;
    for (const auto& [name, value] : d.method.settings)
      if (name == b.info.name) b.info.default_value = value;
    b.assign = [name = b.info.name, usual = p.default_value](Document& doc, const Value& value) {
      auto& settings = doc.method.settings;
      std::erase_if(settings, [&](const auto& s) { return s.first == name; });
      if (value != usual) settings.emplace_back(name, value);
      std::sort(settings.begin(), settings.end(), [](const auto& a, const auto& b2) { return a.first < b2.first; });
    };
    list.push_back(std::move(b));
  }
  return list;
}

// "material.12" -> 12, if there are that many.
bool indexed(std::string_view section, std::string_view kind, size_t count, size_t& index) {
  if (!section.starts_with(kind) || section.size() <= kind.size() || section[kind.size()] != '.') return false;
  const std::string_view digits = section.substr(kind.size() + 1);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
  return error == std::errc{} && end == digits.data() + digits.size() && index < count;
}

}  // namespace
}  // namespace etendue::render

template <>
struct etendue::Options<etendue::render::Force> {
  static constexpr std::array<etendue::Option, 2> kOptions{{{"auto", "As the scene needs"}, {"on", "On"}}};
};

namespace etendue::render {
namespace {

std::vector<DocumentParameter> model_bindings(const Document& d) {
  std::vector<DocumentParameter> list;
  for (const std::string& flag : transport::model_flags()) {
    const bool on = std::find(d.forced_flags.begin(), d.forced_flags.end(), flag) != d.forced_flags.end();
    DocumentParameter b =
        binding("model",
                Choice<Force>{flag.c_str(), flag.c_str(), on ? Force::on : Force::automatic,
                              "Runs the larger model even if the scene does not need it; the image stays the same"},
                [](Document&, Force) {});
    b.assign = [flag](Document& doc, const Value& value) {
      std::erase(doc.forced_flags, flag);
      if (std::get<std::string>(value) == "on") doc.forced_flags.push_back(flag);
      std::sort(doc.forced_flags.begin(), doc.forced_flags.end());
    };
    list.push_back(std::move(b));
  }
  return list;
}

}  // namespace

std::vector<DocumentParameter> section_parameters(const Document& d, std::string_view section) {
  if (section == "render") return render_bindings(d);
  if (section == "film") return film_bindings(d);
  if (section == "display") return display_bindings(d);
  if (section == "scene") return scene_bindings(d);
  if (section == "model") return model_bindings(d);
  if (section == "camera") return camera_bindings(d, "camera");
  if (section == "environment") return environment_bindings(d, "environment");
  if (const auto* info = integrator::find_integrator(section)) return owned_bindings(d, info->name, info->parameters);
  if (const auto* info = find_sampler(section)) return owned_bindings(d, info->name, info->parameters);
  size_t index = 0;
  const std::string name(section);
  if (indexed(section, "material", d.scene->materials.size(), index)) return material_bindings(d, index, name);
  if (indexed(section, "light", d.scene->lights.size(), index)) return light_bindings(d, index, name);
  if (indexed(section, "node", d.scene->nodes.size(), index)) return node_bindings(d, index, name);
  return {};
}

std::vector<std::string> sections(const Document& d) {
  std::vector<std::string> list{"render", "film", "camera", "display", "scene", "environment", "model"};
  for (const auto& info : integrator::integrator_infos()) list.push_back(info.name);
  for (const auto& info : sampler_infos()) list.push_back(info.name);
  for (size_t i = 0; i < d.scene->materials.size(); ++i) list.push_back("material." + std::to_string(i));
  for (size_t i = 0; i < d.scene->lights.size(); ++i) list.push_back("light." + std::to_string(i));
  for (size_t i = 0; i < d.scene->nodes.size(); ++i) list.push_back("node." + std::to_string(i));
  return list;
}

}  // namespace etendue::render
