#include "integration/looks/assets.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

namespace etendue::looks {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// The environments of most published images are not available. This studio is the closest: soft, almost grey light from
// all sides. At an exposure of -1 EV, white has about the published brightness.
constexpr const char* kUsualEnvironment = "env/brown_photostudio_02_1k.hdr";
constexpr float kUsualExposure = -1;

json read_json(const fs::path& file) {
  std::ifstream stream(file);
  return stream ? json::parse(stream, nullptr, false) : json();
}

Vec3 vector_of(const json& v) { return {v.at(0).get<float>(), v.at(1).get<float>(), v.at(2).get<float>()}; }

Camera camera_of(const json& c) {
  return look_at(vector_of(c.at("eye")), vector_of(c.at("target")), vector_of(c.at("up")),
                 c.at("yfov_degrees").get<float>() * kPi / 180);
}

// An orbit of radius zero denotes a camera that frames the model; only its direction is used.
bool has_view_direction(const json& c) { return c.at("eye") != c.at("target"); }

Vec3 orbit_direction(const json& orbit) {
  const float theta = orbit.at("theta").get<float>() * kPi / 180, phi = orbit.at("phi").get<float>() * kPi / 180;
  return {std::sin(phi) * std::sin(theta), std::cos(phi), std::sin(phi) * std::cos(theta)};
}

// The scenarios by the file that they show.
std::map<fs::path, json> scenarios(const fs::path& data) {
  std::map<fs::path, json> found;
  for (const json& s : read_json(data / "fidelity/scenarios.json"))
    found[(data / "fidelity" / s.at("model").get<std::string>()).lexically_normal()] = s;
  return found;
}

void take_scenario(const json& scenario, const fs::path& data, View& view) {
  if (has_view_direction(scenario.at("camera")))
    view.camera = camera_of(scenario.at("camera"));
  else
    view.from = orbit_direction(scenario.at("orbit"));
  view.exposure = kUsualExposure;
  view.background = scenario.at("background") == "environment";
  view.aspect = scenario.at("width").get<double>() / scenario.at("height").get<double>();
  for (const json& picture : scenario.at("pictures"))
    view.pictures.push_back(data / "fidelity" / scenario.at("name").get<std::string>() / picture.get<std::string>());
}

// The camera of the generator of the asset for this file, if its manifest has one. It is directed at the origin.
std::optional<Camera> generator_camera(const fs::path& file) {
  constexpr float kFov = 0.8f;  // of the viewer that rendered the images
  const json manifest = read_json(file.parent_path() / "Manifest.json");
  if (!manifest.is_object()) return {};
  for (const json& m : manifest.value("models", json::array())) {
    if (m.value("fileName", "") != file.filename() || !m.contains("camera")) continue;
    const Vec3 eye = vector_of(m["camera"].at("translation"));
    return look_at(eye, Vec3(0), Vec3(0, 1, 0), kFov);
  }
  return {};
}

// Generated assets have an image with the same name next to them.
void take_sample_image(View& view) {
  view.camera = generator_camera(view.file);
  fs::path picture = view.file.parent_path() / "Figures/SampleImages" / view.file.filename();
  if (fs::exists(picture.replace_extension(".png"))) view.pictures.push_back(picture);
}

// A camera from one side that sees the whole scene.
Camera needs_tangent(const scene::Scene& scene, const Vec3& from) {
  constexpr float kFov = kPi / 4;
  const Bounds bounds = scene::world_bounds(scene);
  return look_at(bounds.center() + from * (bounds.radius() / std::sin(kFov / 2)), bounds.center(), Vec3(0, 1, 0), kFov);
}

// Published images show files without animation. Only the environment is dimmed, because the emission of the files is
// absolute.
void as_published(const View& view, render::Document& d) {
  auto scene = std::make_shared<scene::Scene>(*d.scene);
  scene->animations.clear();
  scene->environment.tint *= std::exp2(view.exposure);
  d.scene = scene;
}

}  // namespace

std::vector<View> gallery(const fs::path& data) {
  const auto known = scenarios(data);
  std::vector<View> views;
  for (const auto& entry : fs::recursive_directory_iterator(data / "gltf")) {
    const fs::path& file = entry.path();
    if (file.extension() != ".glb" && file.extension() != ".gltf") continue;
    View view;
    view.name = fs::relative(file, data / "gltf").string();
    view.file = file;
    view.environment = data / kUsualEnvironment;
    if (const auto scenario = known.find(file.lexically_normal()); scenario != known.end())
      take_scenario(scenario->second, data, view);
    else
      take_sample_image(view);
    views.push_back(std::move(view));
  }
  std::sort(views.begin(), views.end(), [](const View& a, const View& b) { return a.name < b.name; });
  return views;
}

std::vector<Reference> references(const fs::path& data) {
  std::vector<Reference> found;
  const fs::path folder = data / "fidelity/cycles";
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".json") continue;
    const json j = read_json(entry.path());
    Reference r;
    r.view.name = entry.path().stem().string();
    r.view.file = folder / j.at("model").get<std::string>();
    r.view.environment = folder / j.at("environment").get<std::string>();
    r.view.camera = camera_of(j.at("camera"));
    r.width = j.at("width").get<int>();
    r.height = j.at("height").get<int>();
    r.view.aspect = static_cast<double>(r.width) / r.height;
    r.linear = fs::path(entry.path()).replace_extension(".exr");
    found.push_back(std::move(r));
  }
  std::sort(found.begin(), found.end(),
            [](const Reference& a, const Reference& b) { return a.view.name < b.view.name; });
  return found;
}

std::vector<Reference> scenes(const fs::path& data) {
  std::vector<Reference> found;
  for (const auto& entry : fs::directory_iterator(data / "scenes")) {
    if (!entry.is_directory()) continue;
    const std::string name = entry.path().filename().string();
    const json j = read_json(entry.path() / (name + ".json"));
    Reference r;
    r.view.name = name;
    r.view.file = entry.path() / (name + ".glb");
    r.width = j.at("width").get<int>();
    r.height = j.at("height").get<int>();
    r.view.aspect = static_cast<double>(r.width) / r.height;
    r.linear = entry.path() / "reference.exr";
    found.push_back(std::move(r));
  }
  std::sort(found.begin(), found.end(),
            [](const Reference& a, const Reference& b) { return a.view.name < b.view.name; });
  return found;
}

Result<render::Document> open(const View& view, int size, bool environment_visible) {
  auto d = render::new_document(view.file.string());
  if (d && !view.environment.empty()) d = render::with_environment(*d, view.environment.string());
  if (d && !environment_visible) d = render::with(*d, "environment.visible", false);
  if (d) d = render::with(*d, "environment.backdrop", false);
  if (!d) return d.error();
  if (!view.pictures.empty()) as_published(view, *d);
  if (view.from) d->camera = needs_tangent(*d->scene, *view.from);
  if (view.camera) d->camera = *view.camera;
  d->filter = film::FilterKind::box;
  d->display.curve = image::ToneCurve::aces;
  d->width = std::max(1, static_cast<int>(std::lround(size * std::min(1.0, view.aspect))));
  d->height = std::max(1, static_cast<int>(std::lround(size / std::max(1.0, view.aspect))));
  return d;
}

}  // namespace etendue::looks
