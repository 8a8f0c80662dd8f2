// Sections "scene", "environment" and "atmosphere".
#include <algorithm>
#include <filesystem>

#include "light/environments/sky.h"
#include "light/environments/uniform.h"
#include "render/document_parameters_medium.h"
#include "scene/animation.h"
#include "scene/keyframes.h"
#include "scene/pose.h"
#include "scene/variants.h"

namespace etendue {

template <>
struct Options<SunPosition> {
  static constexpr std::array<Option, 2> kOptions{{{"angles", "Elevation and azimuth"}, {"time", "Place and time"}}};
};

}  // namespace etendue

namespace etendue::render {
namespace {

// Changes the time or the clip of the animations. A camera that belongs to a node moves with it.
void change_pose(Document& document, const std::function<void(scene::Scene&)>& change) {
  const int node = scene::node_of_camera(*document.scene, document.camera);
  edit_scene(document, change);
  if (node < 0) return;
  const auto world = scene::world_matrices(*document.scene);
  document.camera.to_world = scene::camera_to_world(world[static_cast<size_t>(node)]);
}

DocumentParameter clip_choice(const scene::Scene& scene) {
  DocumentParameter parameter = choice_parameter(
      "scene", "clip", "Clip",
      "The animation of the file that plays. All: every one that moves other nodes than those before it");
  parameter.info.options = scene::clip_labels(scene);
  parameter.info.option_labels = parameter.info.options;
  parameter.info.option_labels.front() = "All";
  const bool is_known = scene.clip >= 0 && static_cast<size_t>(scene.clip) < scene.animations.size();
  parameter.info.default_value = parameter.info.options[is_known ? static_cast<size_t>(scene.clip) + 1 : 0];
  parameter.assign = [options = parameter.info.options](Document& d, const Value& v) {
    const auto chosen = std::ranges::find(options, std::get<std::string>(v));
    const int clip = static_cast<int>(chosen - options.begin()) - 1;
    change_pose(d, [clip](scene::Scene& s) { s.clip = clip; });
  };
  return parameter;
}

DocumentParameter variant_choice(const scene::Scene& scene) {
  DocumentParameter parameter = choice_parameter("scene", "variant", "Material variant",
                                                 "The set of materials that the file offers under this name");
  parameter.info.options = scene::variant_labels(scene);
  parameter.info.option_labels = parameter.info.options;
  parameter.info.default_value = parameter.info.options[static_cast<size_t>(scene.variant + 1)];
  parameter.assign = [options = parameter.info.options](Document& d, const Value& v) {
    const auto chosen = std::ranges::find(options, std::get<std::string>(v));
    const int variant = static_cast<int>(chosen - options.begin()) - 1;
    edit_scene(d, [&](scene::Scene& s) { scene::select_variant(s, variant); });
  };
  return parameter;
}

constexpr const char* kNone = "none";
constexpr const char* kFile = "file";

std::string environment_name(const Environment& e) {
  if (e.map) return find_builtin_environment(e.file) ? e.file : kFile;
  return e.black() ? kNone : kUniform.name;
}

void select_environment(Environment& environment, const std::string& name) {
  const BuiltinEnvironment* builtin = find_builtin_environment(name);
  if (!builtin && name != kNone) return;
  Environment selected = builtin ? make_environment(*builtin) : Environment{};
  selected.keep_settings_of(environment);
  environment = std::move(selected);
}

DocumentParameter environment_choice(const Environment& environment) {
  DocumentParameter parameter =
      choice_parameter("environment", "preset", "Environment", "Light from infinity. None: black.");
  ParameterInfo& info = parameter.info;
  info.options = {kNone};
  info.option_labels = {"None"};
  for (const BuiltinEnvironment& e : builtin_environments()) {
    info.options.emplace_back(e.name);
    info.option_labels.emplace_back(e.label);
    info.doc += std::string(" ") + e.label + ": " + e.doc + ".";
  }
  info.default_value = environment_name(environment);
  if (environment_name(environment) == kFile) {
    info.options.emplace_back(kFile);
    info.option_labels.push_back(std::filesystem::path(environment.file).filename().string());
  }
  parameter.assign = [](Document& d, const Value& v) {
    edit_scene(d, [&](scene::Scene& s) { select_environment(s.environment, std::get<std::string>(v)); });
  };
  return parameter;
}

// A sky is computed anew when one of its parameters changes; the other properties of the environment stay.
void set_sky(Document& document, const Sky& sky) {
  edit_scene(document, [&](scene::Scene& s) {
    Environment made = make_sky(sky);
    made.tint = s.environment.tint;
    made.keep_settings_of(s.environment);
    s.environment = std::move(made);
  });
}

void add_sky_parameters(DocumentParameters& list, const Sky& sky) {
  const auto store = [](auto Sky::*member) {
    return [member](Document& d, auto v) {
      Sky changed = d.scene->environment.sky.value_or(Sky());
      changed.*member = v;
      set_sky(d, changed);
    };
  };
  const auto add_number = [&](const char* name, const char* label, float Sky::*member, Range<float> range,
                              const char* doc, const char* unit) {
    list.push_back(
        make_parameter("environment", Number<float>{name, label, sky.*member, range, doc, unit}, store(member)));
  };
  const auto needs = [&](SunPosition position, const char* reason) {
    if (sky.sun_position != position) list.back().inactive_reason = reason;
  };
  constexpr const char* kNeedsAngles = "the place and the time determine it: set environment.sun-position to angles";
  constexpr const char* kNeedsTime = "the sun has given angles: set environment.sun-position to time";
  list.push_back(make_parameter("environment",
                                Choice<SunPosition>{"sun-position", "Sun position", sky.sun_position,
                                                    "Whether the angles of the sun are given or follow from a place "
                                                    "and a time"},
                                store(&Sky::sun_position)));
  add_number("sun-elevation", "Sun elevation", &Sky::sun_elevation, {0, kPi / 2},
             "Angle of the sun above the horizon. Low suns are red and weak", "rad");
  needs(SunPosition::angles, kNeedsAngles);
  add_number("sun-azimuth", "Sun azimuth", &Sky::sun_azimuth, {-2 * kPi, 2 * kPi},
             "Angle of the sun about the vertical axis, from +z towards +x", "rad");
  needs(SunPosition::angles, kNeedsAngles);
  add_number("latitude", "Latitude", &Sky::latitude, {-kPi / 2, kPi / 2},
             "Latitude of the place. North is positive; -z is north and +x is east", "rad");
  needs(SunPosition::time, kNeedsTime);
  list.push_back(make_parameter(
      "environment",
      Number<int>{
          "day", "Day of the year", sky.day, {1, 365}, "The equinoxes are days 81 and 264, the solstices 172 and 355"},
      store(&Sky::day)));
  needs(SunPosition::time, kNeedsTime);
  add_number("hour", "Time of day", &Sky::hour, {0, 24},
             "Local solar time: the sun is highest at 12. At night the sky is that of sunset without the sun", "h");
  needs(SunPosition::time, kNeedsTime);
  add_number(
      "turbidity", "Turbidity", &Sky::turbidity, {least_turbidity(sky.model), kLargestTurbidity},
      "Haze: optical depth of the atmosphere relative to pure air. 2 is very clear, 6 hazy; higher makes the sky "
      "paler and the sun weaker",
      "");
  add_number("ground-albedo", "Ground albedo", &Sky::ground_albedo, {0, 1},
             "Reflectance of the ground below the horizon. Higher brightens surfaces that face down", "");
  list.push_back(make_parameter("environment",
                                Toggle{"sun-disk", "Sun disk", sky.sun_disk,
                                       "Includes the disk of the sun, of 0.533 degrees. Off: the sky alone"},
                                store(&Sky::sun_disk)));
}

}  // namespace

DocumentParameters scene_parameters(const Document& document) {
  const scene::Scene& scene = *document.scene;
  const float duration = scene::animation_duration(scene);
  DocumentParameters list{
      make_parameter("scene",
                     Number<float>{"time",
                                   "Time",
                                   scene.time,
                                   {0, std::max(scene::kLongestAnimation, duration)},
                                   "Time at which animations are evaluated",
                                   "s"},
                     [](Document& d, float v) { change_pose(d, [v](scene::Scene& s) { s.time = v; }); })};
  if (scene.animations.size() > 1) list.push_back(clip_choice(scene));
  if (!scene.variants.empty()) list.push_back(variant_choice(scene));
  return list;
}

DocumentParameters atmosphere_parameters(const Document& document) {
  const std::string section = "atmosphere";
  const scene::Atmosphere& a = document.scene->atmosphere;
  DocumentParameters list;
  add_medium_parameters(list, {section, [](scene::Scene& s) -> MediumDescription& { return s.atmosphere.medium; }},
                        a.medium);
  list.push_back(make_parameter(
      section,
      Number<float>{"radius",
                    "Radius",
                    std::min(a.radius, kLargestLength),
                    {1e-3f, kLargestLength},
                    "Extent of the medium around the centre of the scene; beyond is a vacuum. "
                    "The largest value stands for no bound, which light from infinity does "
                    "not pass",
                    "m",
                    Scale::logarithmic},
      [](Document& d, float v) {
        edit_scene(d, [&](scene::Scene& s) { s.atmosphere.radius = v >= kLargestLength ? kInfinity : v; });
      }));
  return list;
}

DocumentParameters environment_parameters(const Document& document) {
  const std::string section = "environment";
  const Environment& e = document.scene->environment;
  const auto store = [](auto Environment::*member) {
    return [member](Document& d, auto v) { edit_scene(d, [&](scene::Scene& s) { s.environment.*member = v; }); };
  };
  DocumentParameters list{environment_choice(e)};
  add_triple(list, section,
             {.names = {"tint.r", "tint.g", "tint.b"},
              .label = "Luminance",
              .value = Vec3(e.tint.r, e.tint.g, e.tint.b),
              .range = {0, 1e6f},
              .doc = "Constant luminance of the environment, or a factor on its map",
              .unit = "cd/m\u00b2"},
             [](Document& d, int c, float v) { edit_scene(d, [&](scene::Scene& s) { s.environment.tint[c] = v; }); });
  list.push_back(make_parameter(section,
                                Number<float>{"rotation",
                                              "Rotation",
                                              e.rotation,
                                              {-2 * kPi, 2 * kPi},
                                              "Rotates the environment map about the vertical axis",
                                              "rad"},
                                store(&Environment::rotation)));
  list.push_back(make_parameter(section,
                                Toggle{"visible", "Visible to camera", e.visible,
                                       "Shows the environment as background. It illuminates the scene in either case"},
                                store(&Environment::visible)));
  list.push_back(
      make_parameter(section,
                     Toggle{"backdrop", "Grey backdrop", e.backdrop,
                            "Background where the environment is hidden: a grey gradient, darker than a white "
                            "surface, which emits no light. Off: black"},
                     store(&Environment::backdrop)));
  if (e.visible) list.back().inactive_reason = "the environment is visible to the camera";
  list.push_back(make_parameter(section,
                                Number<float>{"backdrop-brightness",
                                              "Backdrop brightness",
                                              e.backdrop_brightness,
                                              {0, 10},
                                              "Factor on the grey backdrop. 1: a middle grey"},
                                store(&Environment::backdrop_brightness)));
  if (e.visible || !e.backdrop) list.back().inactive_reason = "the backdrop is not shown";
  list.push_back(make_parameter(
      section, emission_spectrum_parameter("spectrum", e.spectrum), [](Document& d, const std::string& name) {
        edit_scene(d, [&](scene::Scene& s) { s.environment.spectrum = emission_spectrum_or_none(name); });
      }));
  if (e.sky) add_sky_parameters(list, *e.sky);
  return list;
}

}  // namespace etendue::render
