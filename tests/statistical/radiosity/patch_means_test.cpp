// The irradiance of the sides of triangles in the Cornell box by radiosity, against paths that start on them.
//
// Paths have diffuse reflections only, so both compute ED*L. Radiosity is biased by its mesh: 1 % is allowed for it on the
// walls, 5 % on the blocks, which are small and in half-shadow, besides four standard errors (false-alarm rate at most
// 1e-4 per comparison). The standard errors must be below 0.5 % and 1.5 %. Light leaks into the closed cavities of the
// blocks through the patches of the floor that cross their lower edges.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "base/frame.h"
#include "base/warp.h"
#include "radiosity/reflectance.h"
#include "radiosity/scene_solution.h"
#include "scene/builtin/builtin.h"

namespace etendue::radiosity {
namespace {

// Paths from points of elements, with a light sample at every vertex.
class IrradiancePaths {
 public:
  IrradiancePaths(const scene::CompiledScene& scene, const PatchMesh& mesh)
      : scene_(scene), mesh_(mesh), reflectance_(patch_reflectances(scene, mesh)) {}

  // One estimate of the luminance of the irradiance of an element at a uniform point.
  double sample(uint32_t element) {
    Vec3 point = mesh_.patch_of(element).point(square_to_triangle({uniform(), uniform()}));
    Rgb throughput(1), sum(0);
    for (int vertex = 0;; ++vertex) {
      const Vec3 normal = mesh_.normal_of(element);
      const Vec3 start = point + normal * mesh_.patch_of(element).offset;
      sum += throughput * light_at(start, normal);
      const Ray ray{start, 0, Frame(normal).to_world(square_to_cosine_hemisphere({uniform(), uniform()})), kInfinity};
      const Hit hit = scene_.intersect(ray, 0);
      element = hit ? mesh_.element_at(hit, ray.direction) : kNoElement;
      if (element == kNoElement) break;
      point = ray.origin + ray.direction * hit.t;
      throughput = throughput * reflectance_[element / 2];
      if (vertex < 4) continue;
      const float survival = std::min(0.95f, max_component(throughput));
      if (uniform() >= survival) break;
      throughput /= survival;
    }
    return static_cast<double>(luminance(sum));
  }

 private:
  float uniform() { return std::uniform_real_distribution<float>(0, 1)(random_); }

  // The irradiance by one light sample.
  Rgb light_at(const Vec3& point, const Vec3& normal) {
    Vec3Lanes<16> from{};
    alignas(64) std::array<float, 16> choice{}, u0{}, u1{};
    std::array<LightSample, 16> lights;
    from.set(0, point);
    choice[0] = uniform();
    u0[0] = uniform();
    u1[0] = uniform();
    scene_.lights().sample({from, choice.data(), u0.data(), u1.data(), 1}, lights.data(), LightStrategy::automatic);
    const LightSample& light = lights[0];
    const float cosine = glm::dot(light.wi, normal);
    if (!(light.pdf > 0) || !(cosine > 0)) return Rgb(0);
    RayPacket shadow;
    std::array<uint32_t, RayPacket::kSize> seeds{};
    shadow.set(0, {point, 0, light.wi, light.distance * (1 - 1e-4f)});
    scene_.occluded(shadow, 1, seeds.data());
    if (shadow.is_occluded(0)) return Rgb(0);
    return scene_.radiance_of(light) * (cosine / light.pdf);
  }

  const scene::CompiledScene& scene_;
  const PatchMesh& mesh_;
  std::vector<Rgb> reflectance_;
  std::mt19937 random_{11};
};

TEST(RadiosityPatchMeans, CornellBoxAgreesWithPaths) {
  const auto scene =
      scene::compile(std::make_shared<const scene::Scene>(scene::find_builtin("cornell")->make()), Camera(), nullptr);
  const PatchMesh mesh(*scene, {Meshing::area, 2500, 0});
  SolutionPlan plan;
  plan.factors = {FormFactorMethod::hemisphere, 512};
  plan.light_samples = 128;
  SceneSolution solution(plan, mesh.element_count());
  for (int task = 0; task < solution.tasks(); ++task) solution.run(*scene, mesh, task, nullptr);
  solution.finish(mesh, patch_reflectances(*scene, mesh));
  // Lit sides of triangles with at least 20 patches, and the means of their elements.
  struct Side {
    std::vector<uint32_t> elements;
    double irradiance = 0;
  };
  std::map<std::tuple<uint32_t, uint32_t, bool>, Side> sides;
  for (uint32_t e = 0; e < mesh.element_count(); ++e) {
    const Patch& patch = mesh.patch_of(e);
    Side& side = sides[{patch.instance, patch.triangle, PatchMesh::is_front(e)}];
    side.elements.push_back(e);
    side.irradiance += static_cast<double>(luminance(solution.field().total[e]));
  }
  std::erase_if(sides,
                [](const auto& entry) { return entry.second.elements.size() < 20 || !(entry.second.irradiance > 0); });
  EXPECT_GE(sides.size(), 16u);
  IrradiancePaths paths(*scene, mesh);
  double brightest = 0;
  for (const auto& [key, side] : sides)
    brightest = std::max(brightest, side.irradiance / static_cast<double>(side.elements.size()));
  constexpr int kPaths = 100'000;
  int walls = 0;
  for (const auto& [key, side] : sides) {
    double sum = 0, squares = 0;
    for (int n = 0; n < kPaths; ++n) {
      const double h = paths.sample(side.elements[static_cast<size_t>(n) % side.elements.size()]);
      sum += h;
      squares += h * h;
    }
    const double mean = sum / kPaths, error = std::sqrt((squares / kPaths - mean * mean) / kPaths);
    const double radiosity = side.irradiance / static_cast<double>(side.elements.size());
    const std::string what =
        "instance " + std::to_string(std::get<0>(key)) + ", triangle " + std::to_string(std::get<1>(key));
    if (mean == 0) {
      EXPECT_LT(radiosity, 0.03 * brightest) << what << " is in a cavity";
      continue;
    }
    const bool is_wall = side.elements.size() >= 100;
    walls += is_wall ? 1 : 0;
    EXPECT_LT(error, (is_wall ? 0.005 : 0.015) * mean) << what;
    EXPECT_NEAR(radiosity, mean, (is_wall ? 0.01 : 0.05) * mean + 4 * error) << what;
  }
  EXPECT_EQ(walls, 10);
}

}  // namespace
}  // namespace etendue::radiosity
