#include "experiments/operator_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "camera/camera_ray.h"
#include "radiosity/reflectance.h"
#include "render/document.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/shapes.h"
#include "scene/compiled_scene.h"

namespace etendue::experiments {
namespace {

using equations::Vector;
using radiosity::PatchMesh;

constexpr uint32_t kRays = 1024;         // per side of a patch
constexpr uint32_t kLightSamples = 256;  // per patch, for lights without patches
constexpr size_t kMostPatches = 1000;
constexpr double kShareOfFormFactors = 0.9;  // of the time

bool is_file(std::string_view text) { return text.ends_with(".gltf") || text.ends_with(".glb"); }

double component(const Rgb& color) { return double{color.g}; }

}  // namespace

Result<void> check_operator_scene(std::string_view text) {
  if (text == kFurnaceScene || is_file(text) || scene::find_builtin(text)) return {};
  return usage_error("'" + std::string(text) + "' is not a scene; give furnace, a .gltf or .glb file, or one of " +
                     scene::builtin_names());
}

Result<OperatorScene> operator_scene(const std::string& text, double furnace_albedo) {
  if (text == kFurnaceScene)
    return OperatorScene{std::make_shared<const scene::Scene>(scene::furnace(static_cast<float>(furnace_albedo))),
                         look_at({0.9f, 0.9f, 0.9f}, {0, 0, 0}, {0, 1, 0}, 1.2f)};
  const auto document = render::new_document(text);
  if (!document) return document.error();
  return OperatorScene{document->scene, document->camera};
}

OperatorModel::OperatorModel(const OperatorScene& scene, int patches)
    : camera_(scene.camera),
      scene_(scene::compile(scene.scene, scene.camera, nullptr)),
      mesh_(*scene_, {.meshing = radiosity::Meshing::area, .patches = patches}) {}

Result<OperatorModel> OperatorModel::make(const OperatorScene& scene, int patches) {
  const auto compiled = scene::compile(scene.scene, scene.camera, nullptr);
  const size_t count = radiosity::count_patches(*compiled, {.meshing = radiosity::Meshing::area, .patches = patches});
  if (count == 0) return input_error("the scene has no triangles with an area; give one with surfaces");
  if (count > kMostPatches)
    return input_error("the scene needs " + std::to_string(count) + " patches, more than the " +
                       std::to_string(kMostPatches) +
                       " that a matrix can have here; give a scene with fewer triangles");
  return OperatorModel(scene, patches);
}

Result<void> OperatorModel::build(const RunContext& context) {
  radiosity::SolutionPlan plan;
  plan.factors = {radiosity::FormFactorMethod::hemisphere, kRays};
  plan.light_samples = kLightSamples;
  plan.seed = context.seed;
  radiosity::SceneSolution solution(plan, mesh_.element_count());
  for (int task = 0; task < solution.tasks(); ++task) {
    if (!context.proceed(kShareOfFormFactors * task / solution.tasks())) return interrupted();
    solution.run(*scene_, mesh_, task, nullptr);
  }
  solution.finish(mesh_, radiosity::patch_reflectances(*scene_, mesh_));
  collect(solution);
  find_visible_elements();
  if (std::ranges::all_of(emitted_, [](double e) { return e == 0; }))
    return input_error("no light reaches the patches of the scene; give a scene with a light");
  return {};
}

void OperatorModel::collect(const radiosity::SceneSolution& solution) {
  const radiosity::FormFactors& factors = *solution.factors();
  const auto reflectance = radiosity::patch_reflectances(*scene_, mesh_);
  element_of_.assign(mesh_.element_count(), -1);
  for (uint32_t i = 0; i < mesh_.element_count(); ++i)
    if (!factors.exchanges(i).empty()) {
      element_of_[i] = static_cast<int>(sides_.size());
      sides_.push_back(i);
    }
  const size_t n = sides_.size();
  matrices_.propagation.assign(n, Vector(n, 0.0));
  for (size_t row = 0; row < n; ++row) {
    const double area = factors.areas()[sides_[row]];
    for (const auto& f : factors.exchanges(sides_[row]))
      matrices_.propagation[row][static_cast<size_t>(element_of_[f.element])] = static_cast<double>(f.value) / area;
    matrices_.area.push_back(area);
    matrices_.reflectance.push_back(component(reflectance[sides_[row] / 2]));
    emitted_.push_back(component(emission_of(sides_[row])));
  }
  if (std::ranges::any_of(emitted_, [](double e) { return e > 0; })) return;
  has_external_lights_ = true;
  for (size_t i = 0; i < n; ++i)
    emitted_[i] = matrices_.reflectance[i] * component(solution.direct()[sides_[i]]) / std::numbers::pi;
}

Rgb OperatorModel::emission_of(uint32_t side) const {
  const auto& instance = scene_->instances()[mesh_.patch_of(side).instance];
  const Material& material = scene_->materials()[instance.material].description;
  return PatchMesh::is_front(side) || material.double_sided ? material.emission : Rgb(0);
}

void OperatorModel::find_visible_elements() {
  const CameraRays rays(camera_, kViewSize, kViewSize);
  for (int y = 0; y < kViewSize; ++y)
    for (int x = 0; x < kViewSize; ++x) {
      const Ray ray = rays.ray(Vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f), Vec2(0.5f));
      const Hit hit = scene_->intersect(ray, 0);
      const uint32_t side = hit ? mesh_.element_at(hit, ray.direction) : radiosity::kNoElement;
      visible_.push_back(side == radiosity::kNoElement ? -1 : element_of_[side]);
    }
}

Vector OperatorModel::camera_importance() const {
  Vector importance(matrices_.size(), 0.0);
  for (const int element : visible_)
    if (element >= 0)
      importance[static_cast<size_t>(element)] +=
          1 / (static_cast<double>(visible_.size()) * std::numbers::pi * matrices_.area[static_cast<size_t>(element)]);
  return importance;
}

metrics::MatrixChart OperatorModel::picture(std::string title, const Vector& values) const {
  metrics::MatrixChart chart{.title = std::move(title), .x_label = "as the camera sees it", .y_label = {}, .rows = {}};
  for (size_t y = 0; y < kViewSize; ++y) {
    chart.rows.emplace_back();
    for (size_t x = 0; x < kViewSize; ++x) {
      const int element = visible_[y * kViewSize + x];
      chart.rows.back().push_back(element < 0 ? NAN : values[static_cast<size_t>(element)]);
    }
  }
  return chart;
}

}  // namespace etendue::experiments
