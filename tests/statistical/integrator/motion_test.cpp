// Motion blur: images with closed-form solutions, and blurred images against the mean of still images.
//
// t-tests and z-tests with a false-alarm rate of 1 % for all columns or blocks of one comparison.
#include <gtest/gtest.h>

#include "base/hash.h"
#include "scene/compiled_scene.h"
#include "support/independent_estimates.h"
#include "support/moving_scenes.h"

namespace etendue::motion_test {
namespace {

using scene::AnimatedPath;
using test::animate;
using test::same_bits;

// An image of the xy plane, 2 m high, with a box filter within the pixel; every sample is zero or one.
render::Document silhouette(scene::Scene scene, int size) {
  Camera camera = look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1);
  camera.projection = Projection::orthographic;
  auto d = test::document(std::move(scene), camera, size, size);
  d.filter = film::FilterKind::box;
  d.method.sampler = "random";
  return d;
}

const Material& white() {
  static const Material material = test::diffuse(Rgb(0), Rgb(1));
  return material;
}

// A rectangle in the xy plane with corners at these x and y.
std::shared_ptr<const Mesh> rectangle(float x0, float x1, float y0, float y1) {
  auto mesh = std::make_shared<Mesh>();
  mesh->positions.reserve(5);
  mesh->positions = {{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

// Compares a binomial proportion of `n` samples with its expectation.
void expect_proportion(double measured, double expected, double n, int comparisons, const std::string& what) {
  double z = 0;
  while (std::pow(std::erf(z / std::sqrt(2.0)), comparisons) < 0.99) z += 0.01;
  const double error = std::sqrt(std::max(0.0, expected * (1 - expected)) / n);
  EXPECT_NEAR(measured, expected, z * error + 1e-6) << what;
}

constexpr int kEdgeSize = 16;
constexpr float kPixel = 2.0f / kEdgeSize;

// The columns of an image with an edge that starts between columns 4 and 5 and moves eight pixels to the right. The
// area left of the edge is white, so the coverage is a linear ramp over the eight pixels.
void expect_ramp(render::Document d, const std::string& what) {
  d.camera.shutter = 1;
  constexpr uint32_t kSamples = 256;
  const auto film = test::rendered(d, kSamples);
  for (int x = 0; x < kEdgeSize; ++x) {
    double mean = 0;
    for (int y = 0; y < kEdgeSize; ++y) mean += average(film.mean(x, y)) / kEdgeSize;
    const double expected = std::clamp(1 - (x + 0.5 - 4) / 8, 0.0, 1.0);
    expect_proportion(mean, expected, kSamples * kEdgeSize, kEdgeSize, what + " column " + std::to_string(x));
  }
}

constexpr float kEdgeAt = -1 + 4 * kPixel, kEdgeMoves = 8 * kPixel;

TEST(MovingEdge, NodeLeavesALinearRamp) {
  scene::Scene scene;
  const int node = test::add(scene, rectangle(-5, kEdgeAt, -2, 2), white());
  animate(scene, node, AnimatedPath::translation, {0, 1}, {0, 0, 0, kEdgeMoves, 0, 0});
  expect_ramp(silhouette(scene, kEdgeSize), "node");
}

// The same motion between keys that do not coincide with the ends of the shutter interval, in two segments.
TEST(MovingEdge, PartOfAnAnimation) {
  scene::Scene scene;
  const int node = test::add(scene, rectangle(-5, kEdgeAt, -2, 2), white());
  animate(scene, node, AnimatedPath::translation, {0, 2.75f, 6},
          {-2 * kEdgeMoves, 0, 0, 0.75f * kEdgeMoves, 0, 0, 4 * kEdgeMoves, 0, 0});
  scene.time = 2;
  expect_ramp(silhouette(scene, kEdgeSize), "part");
}

TEST(MovingEdge, MorphTarget) {
  scene::Scene scene;
  const int node = test::add(scene, rectangle(-5, kEdgeAt, -2, 2), white());
  auto deformation = std::make_shared<scene::Deformation>();
  deformation->targets.push_back({{{0, 0, 0}, {kEdgeMoves, 0, 0}, {kEdgeMoves, 0, 0}, {0, 0, 0}}, {}, {}});
  scene.meshes[0].primitives[0].deformation = deformation;
  scene.meshes[0].weights = {0};
  animate(scene, node, AnimatedPath::weights, {0, 1}, {0, 1});
  expect_ramp(silhouette(scene, kEdgeSize), "morph");
}

TEST(MovingEdge, Skin) {
  scene::Scene scene;
  const int node = test::add(scene, rectangle(-5, kEdgeAt, -2, 2), white());
  scene.nodes.emplace_back();  // the joint
  scene.roots.push_back(1);
  scene.nodes[static_cast<size_t>(node)].skin = 0;
  scene.skins.push_back(std::make_shared<scene::Skin>(scene::Skin{{1}, {Mat4(1)}}));
  auto deformation = std::make_shared<scene::Deformation>();
  deformation->joint_sets = 1;
  deformation->joints.assign(4, {0, 0, 0, 0});
  deformation->weights.assign(4, Vec4(1, 0, 0, 0));
  scene.meshes[0].primitives[0].deformation = deformation;
  animate(scene, 1, AnimatedPath::translation, {0, 1}, {0, 0, 0, kEdgeMoves, 0, 0});
  expect_ramp(silhouette(scene, kEdgeSize), "skin");
}

// The camera moves to the left, so that everything moves to the right in the image.
TEST(MovingEdge, MovingCamera) {
  scene::Scene scene;
  test::add(scene, rectangle(-5, kEdgeAt, -2, 2), white());
  Camera camera = look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1);
  const int eye = test::add_camera(scene, camera);
  animate(scene, eye, AnimatedPath::translation, {0, 1}, {0, 0, 5, -kEdgeMoves, 0, 5});
  auto d = silhouette(scene, kEdgeSize);
  expect_ramp(d, "camera");
  // A camera that is moved away from its node is not animated.
  d.camera.to_world[3].z = 5.5f;
  auto instant = d;
  d.camera.shutter = 1;
  EXPECT_TRUE(same_bits(test::rendered(d, 4), test::rendered(instant, 4)));
}

// The fraction of the shutter interval in which a half-plane, rotated by `turned` about the origin in total, covers the
// direction `phi`. Initially it covers the directions around 0.
double covered(double phi, double turned) {
  const double from = std::max(0.0, (phi - kPi / 2) / turned), to = std::min(1.0, (phi + kPi / 2) / turned);
  return std::max(0.0, to - from);
}

// A blade that rotates by a right angle: its edge sweeps at constant speed and remains straight.
TEST(RotatingBlade, CoverageIsTheSweptFraction) {
  constexpr int kSize = 16, kFine = 32;
  constexpr double kTurned = kPi / 2;
  constexpr uint32_t kSamples = 2048;
  scene::Scene scene;
  const int node = test::add(scene, rectangle(0, 4, -4, 4), white());
  const Vec4 turned = test::turn({0, 0, 1}, static_cast<float>(kTurned));
  animate(scene, node, AnimatedPath::rotation, {0, 1}, {0, 0, 0, 1, turned.x, turned.y, turned.z, turned.w});
  auto d = silhouette(scene, kSize);
  d.camera.shutter = 1;
  const auto film = test::rendered(d, kSamples);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      double expected = 0;
      for (int j = 0; j < kFine; ++j)
        for (int i = 0; i < kFine; ++i) {
          const double px = x + (i + 0.5) / kFine - kSize / 2.0, py = kSize / 2.0 - (y + (j + 0.5) / kFine);
          double phi = std::atan2(py, px);
          if (phi < -kPi / 2) phi += 2 * kPi;
          expected += covered(phi, kTurned) / (kFine * kFine);
        }
      // The coverage varies too fast for this sum in the four central pixels.
      if (std::abs(x - 7.5) < 1 && std::abs(y - 7.5) < 1) continue;
      expect_proportion(average(film.mean(x, y)), expected, kSamples, kSize * kSize,
                        std::to_string(x) + ' ' + std::to_string(y));
    }
}

TEST(Shutter, DoesNotAffectStaticScenes) {
  for (const char* integrator : {"path", "path-pure", "raycast"}) {
    auto d = test::cornell(32);
    d.method.integrator = integrator;
    const auto instant = test::rendered(d, 4);
    d.camera.shutter = 10;
    EXPECT_TRUE(same_bits(instant, test::rendered(d, 4))) << integrator;
  }
}

TEST(Shutter, ZeroDurationGivesTheStillImage) {
  auto d = *render::with(test::motion_and_lens_scene(), "scene.time", 0.5);
  d.camera.shutter = 0;
  auto still = *d.scene;
  still.animations.clear();
  const auto world = scene::world_matrices(*d.scene);
  for (size_t i = 0; i < still.nodes.size(); ++i) still.nodes[i].transform.matrix = world[i];
  auto other = d;
  other.scene = std::make_shared<const scene::Scene>(still);
  EXPECT_TRUE(same_bits(test::rendered(d, 4), test::rendered(other, 4)));
  // The shortest interval: all times are equal in floating point.
  d.camera.shutter = 1e-30f;
  EXPECT_TRUE(same_bits(test::rendered(d, 4), test::rendered(other, 4)));
}

// Motion of hidden nodes and motion outside the shutter interval has no effect.
TEST(Shutter, OnlyVisibleMotionCounts) {
  auto scene = *test::cornell(8).scene;
  const int node = test::add(scene, test::cube(0.1f, false), test::diffuse(Rgb(1)));
  animate(scene, node, AnimatedPath::translation, {0, 1}, {0, 0, 0, 1, 1, 1});
  const Camera camera = test::cornell(8).camera;
  const auto moving = [&](const scene::Scene& s, float shutter) {
    Camera open = camera;
    open.shutter = shutter;
    return scene::compile(std::make_shared<const scene::Scene>(s), open, nullptr)->moving();
  };
  EXPECT_NE(moving(scene, 0.5f), "");
  EXPECT_EQ(moving(scene, 0), "");
  auto over = scene;
  over.time = 1;
  EXPECT_EQ(moving(over, 0.5f), "");
  scene.nodes[static_cast<size_t>(node)].visible = false;
  EXPECT_EQ(moving(scene, 0.5f), "");
}

// Still images at jittered times, one in each stratum of the shutter interval. Their mean has the expectation of the
// blurred image.
test::Blocks mean_of_moments(render::Document d, uint32_t samples, uint64_t seed) {
  constexpr int kMoments = 24;
  const float shutter = std::exchange(d.camera.shutter, 0.0f);
  test::Blocks sum;
  for (int i = 0; i < kMoments; ++i) {
    const uint64_t random = mix_bits(seed * kMoments + static_cast<uint64_t>(i));
    d.seed = random;
    const float time = shutter * (static_cast<float>(i) + to_unit_float(static_cast<uint32_t>(random))) / kMoments;
    const auto means = test::block_means(test::rendered(*render::with(d, "scene.time", double{time}), samples));
    sum.resize(means.size());
    for (size_t k = 0; k < means.size(); ++k) sum[k] += means[k] / kMoments;
  }
  return sum;
}

void expect_mean_of_moments(const render::Document& d, uint32_t samples, uint32_t samples_of_each,
                            const std::string& what) {
  const auto still = test::replicated([&](uint64_t seed) { return mean_of_moments(d, samples_of_each, seed); }, 5000);
  test::expect_agreement(test::replicated(d, samples), still, what);
}

// Lights that move over a floor with a post: a rotating area light and a panning spot light.
scene::Scene lights_on_the_move() {
  scene::Scene scene;
  test::add(scene, test::quad(3), test::diffuse(Rgb(0.7f)));
  Mat4 post(1);
  post[3] = Vec4(0, 0.5f, 0, 1);
  test::add(scene, test::cube(0.5f, false), test::diffuse({0.8f, 0.6f, 0.4f}), post);
  const int light = test::add(scene, test::quad(0.4f), test::diffuse(Rgb(0), Rgb(20)));
  const Vec4 a = test::turn({1, 0, 0}, kPi - 0.8f), b = test::turn({1, 0, 0}, kPi + 0.8f);
  animate(scene, light, AnimatedPath::translation, {0, 1}, {-2, 2, 0, 2, 1.5f, 0});
  animate(scene, light, AnimatedPath::rotation, {0, 1}, {a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w});
  scene.lights.push_back(make_light("spot", {{"intensity", 10.0}, {"inner-cone", 0.3}, {"outer-cone", 0.5}}));
  const auto node = scene.nodes.size();
  scene.nodes.emplace_back().light = 0;
  scene.roots.push_back(static_cast<int>(node));
  const Vec4 c = test::turn({1, 0, 0}, -kPi / 2 - 0.5f), e = test::turn({1, 0, 0}, -kPi / 2 + 0.5f);
  scene.nodes[node].transform.translation = {1, 3, 1};
  animate(scene, static_cast<int>(node), AnimatedPath::rotation, {0, 1}, {c.x, c.y, c.z, c.w, e.x, e.y, e.z, e.w});
  return scene;
}

TEST(MotionBlur, EqualsTheMeanOfStillImagesUnderMovingLights) {
  auto d =
      test::document(lights_on_the_move(), look_at({0, 3, 4}, {0, 0, 0}, {0, 1, 0}, 0.9f), test::kSize, test::kSize);
  d.camera.shutter = 1;
  expect_mean_of_moments(d, 1024, 48, "lights");
}

// A quad, a disk, a sphere and a quad with point samples move over a floor with a post and rotate.
TEST(MotionBlur, EqualsTheMeanOfStillImagesUnderMovingAnalyticLights) {
  scene::Scene scene;
  test::add(scene, test::quad(3), test::diffuse(Rgb(0.7f)));
  Mat4 post(1);
  post[3] = Vec4(0, 0.5f, 0, 1);
  test::add(scene, test::cube(0.5f, false), test::diffuse({0.8f, 0.6f, 0.4f}), post);
  const auto add_light = [&](Light light, float x) {
    light.set("intensity", 8.0);
    const int node = test::add(scene, light, {});
    const Vec4 a = test::turn({1, 0, 0}, -kPi / 2 - 0.6f), b = test::turn({1, 0, 0}, -kPi / 2 + 0.6f);
    animate(scene, node, AnimatedPath::translation, {0, 1}, {x, 2, -1, x + 0.5f, 1.5f, 1});
    animate(scene, node, AnimatedPath::rotation, {0, 1}, {a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w});
  };
  add_light(make_light("quad", {{"width", 0.8}, {"height", 0.5}}), -2);
  add_light(make_light("disk", {{"radius", 0.4}}), -1);
  add_light(make_light("sphere", {{"radius", 0.4}}), 1);
  add_light(make_light("quad", {{"width", 0.8}, {"height", 0.5}, {"points", 5}}), 0.3f);
  auto d = test::document(std::move(scene), look_at({0, 3, 4}, {0, 0, 0}, {0, 1, 0}, 0.9f), test::kSize, test::kSize);
  d.camera.shutter = 1;
  expect_mean_of_moments(d, 1024, 48, "surface lights");
}

TEST(MotionBlur, EqualsTheMeanOfStillImagesOfAFullScene) {
  expect_mean_of_moments(test::motion_and_lens_scene(), 1024, 48, "everything");
}

// Photons and virtual lights have the time of the paths that use them. The integrators are biased, but equally so in
// all images.
TEST(MotionBlur, EqualsTheMeanOfStillImagesWithTwoPassIntegrators) {
  const std::vector<std::vector<std::pair<const char*, const char*>>> methods{
      {{"render.integrator", "sppm"}, {"sppm.photons", "2000"}, {"sppm.alpha", "1"}},
      {{"render.integrator", "photonmap"},
       {"photonmap.photons", "2000"},
       {"photonmap.caustic-photons", "2000"},
       {"photonmap.mode", "direct"},
       {"photonmap.renew", "on"}},
      {{"render.integrator", "igi"}, {"igi.light-paths", "20"}}};
  for (const auto& settings : methods) {
    auto d = test::motion_and_lens_scene();
    for (const auto& [name, value] : settings) d = *render::with_text(d, name, value);
    const auto still = test::replicated([&](uint64_t seed) { return mean_of_moments(d, 4, seed); }, 5000);
    test::expect_agreement(test::replicated(d, 96), still, settings[0].second, static_cast<int>(methods.size()));
  }
}

// A camera that rotates in a room.
TEST(MotionBlur, EqualsTheMeanOfStillImagesFromAMovingCamera) {
  const auto cornell = test::cornell(test::kSize);
  auto scene = *cornell.scene;
  const auto with_camera = std::ranges::find_if(scene.nodes, [](const auto& n) { return n.camera >= 0; });
  const auto eye = static_cast<int>(with_camera - scene.nodes.begin());
  const Vec3 from(cornell.camera.to_world[3]);
  const Vec4 before(0, 1, 0, 0), after = test::turn({0, 1, 0}, kPi + 0.2f);
  animate(scene, eye, AnimatedPath::rotation, {0, 1},
          {before.x, before.y, before.z, before.w, after.x, after.y, after.z, after.w});
  animate(scene, eye, AnimatedPath::translation, {0, 1},
          {from.x, from.y, from.z, from.x + 0.5f, from.y + 0.2f, from.z + 1});
  auto d = test::from_scene_camera(scene, test::kSize);
  d.camera.shutter = 1;
  expect_mean_of_moments(d, 512, 24, "camera");
}

// A rotating normal-mapped cube, a morphing cube, a skinned fox and spinning wheels.
TEST(MotionBlur, EqualsTheMeanOfStillImagesOfRealFiles) {
  const std::string folder = test::data_folder();
  if (folder.empty()) GTEST_SKIP() << "no data";
  for (const char* file :
       {"AnimatedCube/glTF/AnimatedCube.gltf", "AnimatedMorphCube.glb", "Fox.glb", "CesiumMilkTruck.glb"}) {
    auto d = *render::new_document(folder + "/gltf/" + file);
    d.width = d.height = test::kSize;
    d.camera.shutter = 0.4f;
    // Blocks beside the truck rarely see it move: with a quarter of these samples their means are far from normal.
    expect_mean_of_moments(d, 1024, 48, file);
  }
}

}  // namespace
}  // namespace etendue::motion_test
