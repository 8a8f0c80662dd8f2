#include "looks/assets.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

namespace etendue::looks {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// What most published pictures are lit by is not to be had; this studio comes closest: bright, soft, almost grey.
constexpr const char* kUsualEnvironment = "env/studio_small_05_1k.hdr";

json read_json(const fs::path& file) {
  std::ifstream stream(file);
  return stream ? json::parse(stream, nullptr, false) : json();
}

Vec3 vector_of(const json& v) { return {v.at(0).get<float>(), v.at(1).get<float>(), v.at(2).get<float>()}; }

Camera camera_of(const json& c) {
  return look_at(vector_of(c.at("eye")), vector_of(c.at("target")), vector_of(c.at("up")),
                 c.at("yfov_degrees").get<float>() * kPi / 180);
}

// An eye that lies in its target says nothing about where it looks.
bool looks_somewhere(const json& c) { return c.at("eye") != c.at("target"); }

// The scenarios by the file they show.
std::map<fs::path, json> scenarios(const fs::path& data) {
  std::map<fs::path, json> found;
  for (const json& s : read_json(data / "fidelity/scenarios.json"))
    found[(data / "fidelity" / s.at("model").get<std::string>()).lexically_normal()] = s;
  return found;
}

void take_scenario(const json& scenario, const fs::path& data, View& view) {
  if (looks_somewhere(scenario.at("camera"))) view.camera = camera_of(scenario.at("camera"));
  view.aspect = scenario.at("width").get<double>() / scenario.at("height").get<double>();
  for (const json& picture : scenario.at("pictures"))
    view.pictures.push_back(data / "fidelity" / scenario.at("name").get<std::string>() / picture.get<std::string>());
}

// The generator's files have a picture of the same name beside them.
void take_sample_image(View& view) {
  fs::path picture = view.file.parent_path() / "Figures/SampleImages" / view.file.filename();
  if (fs::exists(picture.replace_extension(".png"))) view.pictures.push_back(picture);
}

}  // namespace

std::vector<View> gallery(const fs::path& data) {
  const auto known = scenarios(data);
  std::vector<View> views;
  for (const auto& entry : fs::recursive_directory_iterator(data / "gltf")) {
    const fs::path& file = entry.path();
    if (file.extension() != ".glb" && file.extension() != ".gltf") continue;
    View view;
    view.name = fs::relative(file, data / "gltf").string(), view.file = file;
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
    r.width = j.at("width").get<int>(), r.height = j.at("height").get<int>();
    r.view.aspect = static_cast<double>(r.width) / r.height;
    r.linear = fs::path(entry.path()).replace_extension(".exr");
    found.push_back(std::move(r));
  }
  std::sort(found.begin(), found.end(),
            [](const Reference& a, const Reference& b) { return a.view.name < b.view.name; });
  return found;
}

Result<render::Document> open(const View& view, int size, bool environment_visible) {
  auto opened = render::new_document(view.file.string());
  if (!opened) return opened.error();
  auto lit = render::with_environment(*opened, view.environment.string());
  if (!lit) return lit.error();
  auto d = render::with(*lit, "environment.visible", environment_visible);
  if (!d) return d.error();
  if (view.camera) d->camera = *view.camera;
  d->filter = film::FilterKind::box;
  d->display.curve = image::ToneCurve::aces;
  d->width = std::max(1, static_cast<int>(std::lround(size * std::min(1.0, view.aspect))));
  d->height = std::max(1, static_cast<int>(std::lround(size / std::max(1.0, view.aspect))));
  return d;
}

}  // namespace etendue::looks
