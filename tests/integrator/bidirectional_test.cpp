// Methods that walk from the lights against path tracing, on scenes that take everything apart that could be wrong:
// kinds of lights, smooth and rough glass, absorption, shading normals, the lens, path classes. z-tests over blocks of
// pixels, 1 % false alarms for each test.
#include <gtest/gtest.h>

#include "integrator/techniques.h"
#include "support/replicates.h"

namespace etendue {
namespace {

using render::Document;

Document with(const Document& d, const char* name, const std::string& value) {
  const auto changed = render::with_text(d, name, value);
  EXPECT_TRUE(changed) << name << " = " << value;
  return changed ? *changed : d;
}

Document by(const Document& d, const std::string& integrator) { return with(d, "render.integrator", integrator); }

// What light tracing can find.
Document without_mirrors_in_view(const Document& d) { return with(d, "film.paths", "E[(D|G).*]L"); }

Document cornell() { return test::cornell(test::kSize); }

// A floor, a smooth-shaded ball, one of glass that absorbs and one of clay, and room for lights.
scene::Scene balls() {
  scene::Scene scene;
  test::add(scene, test::quad(4), test::diffuse(Rgb(0.6f)));
  Material glass, clay;
  glass.metallic = 0, glass.transmission = 1, glass.thickness = 1, glass.roughness = 0;
  glass.attenuation_color = {0.4f, 0.8f, 0.9f}, glass.attenuation_distance = 0.7f;
  clay.base_color = {0.7f, 0.3f, 0.2f}, clay.metallic = 0, clay.roughness = 0.3f;
  const std::pair<Material, bool> materials[] = {{test::diffuse(Rgb(0.5f)), true}, {glass, false}, {clay, true}};
  for (int i = 0; i < 3; ++i) {
    Mat4 place(1);
    place[3] = Vec4(-1.2f + 1.2f * static_cast<float>(i), 0.6f, 0, 1);
    auto ball = std::make_shared<Mesh>(*test::sphere(0.55f, 8, false));
    if (materials[i].second)
      for (const Vec3& p : ball->positions) ball->normals.push_back(glm::normalize(p));
    test::add(scene, ball, materials[i].first, place);
  }
  return scene;
}

Document seen(scene::Scene scene) {
  return test::document(std::move(scene), look_at({0, 2, 4}, {0, 0.4f, 0}, {0, 1, 0}, 0.7f), test::kSize, test::kSize);
}

Document under_a_lamp() {
  auto scene = balls();
  Material light = test::diffuse(Rgb(0.3f), Rgb(6));
  Mat4 above(1);
  above[1][1] = -1, above[2][2] = -1;
  above[3] = Vec4(0, 3, 1, 1);
  test::add(scene, test::quad(1), light, above);
  return seen(std::move(scene));
}

Document under_a_sky() {
  auto scene = balls();
  scene.environment.tint = {0.7f, 0.8f, 1.0f};
  return seen(std::move(scene));
}

Document under(LightType type) {
  auto scene = balls();
  Light light;
  light.type = type;
  light.intensity = type == LightType::directional ? 3 : 12;
  light.outer_cone = 0.6f, light.inner_cone = 0.3f, light.range = type == LightType::point ? 5.0f : kInfinity;
  scene.lights.push_back(light);
  scene::Node node;
  node.light = 0;
  node.transform.matrix = look_at({0.8f, 3, 1}, {0, 0, 0}, {0, 1, 0}, 1).to_world;
  scene.nodes.push_back(node);
  scene.roots.push_back(static_cast<int>(scene.nodes.size()) - 1);
  return seen(std::move(scene));
}

Document through_a_lens(const Document& d) {
  return with(with(d, "camera.lens-radius", "0.25"), "camera.focus-distance", "4");
}

void expect_same(const Document& a, uint32_t samples_a, const Document& b, uint32_t samples_b, const std::string& what,
                 int comparisons) {
  test::expect_agreement(test::replicated(a, samples_a), test::replicated(b, samples_b), what, comparisons);
}

TEST(Bidirectional, AgreesWithPathTracing) {
  const std::pair<const char*, Document> places[] = {{"cornell", cornell()},
                                                     {"glossy things", test::glossy_things()},
                                                     {"lamp", under_a_lamp()},
                                                     {"sky", under_a_sky()},
                                                     {"lens", through_a_lens(under_a_lamp())}};
  for (const auto& [name, d] : places) expect_same(by(d, "path"), 512, by(d, "bdpt"), 128, name, 5);
}

TEST(Bidirectional, LightTracingAgreesWithPathTracing) {
  const std::pair<const char*, Document> places[] = {
      {"cornell", cornell()}, {"lamp", under_a_lamp()}, {"sky", under_a_sky()}, {"lens", through_a_lens(cornell())}};
  for (const auto& [name, place] : places) {
    const Document d = without_mirrors_in_view(place);
    expect_same(by(d, "path"), 512, by(d, "light"), 256, name, 4);
  }
}

// Light of points through glass onto something is not found by walks from the camera: light tracing and bidirectional
// path tracing are compared where path tracing has nothing to say.
TEST(Bidirectional, PunctualLights) {
  for (const LightType type : {LightType::point, LightType::spot, LightType::directional}) {
    const Document d = under(type), connected = with(d, "film.paths", "E.*(D|G)L");
    const std::string name = "light of type " + std::to_string(static_cast<int>(type));
    expect_same(by(connected, "path"), 256, by(connected, "bdpt"), 128, name, 6);
    const Document lit = without_mirrors_in_view(d);
    expect_same(by(lit, "light"), 512, by(lit, "bdpt"), 256, name + ", caustics included", 6);
  }
}

// Chance brings a walk onto a wide lens.
TEST(Bidirectional, PureLightTracingThroughALens) {
  Document d = with(with(cornell(), "camera.lens-radius", "1.5"), "camera.focus-distance", "8");
  expect_same(by(d, "path"), 256, by(d, "light-pure"), 4096, "wide lens", 1);
  d = with(d, "camera.lens-radius", "0");
  EXPECT_EQ(test::mean_of(test::rendered(by(d, "light-pure"), 4)).value, 0);
}

// Walks leave a lamp with two sides on either.
TEST(Bidirectional, ALampWithTwoSidesInView) {
  scene::Scene scene;
  test::add(scene, test::quad(1), test::diffuse(Rgb(0.5f), Rgb(1)));
  const Document d = seen(std::move(scene));
  const auto expected = test::replicated(by(d, "path"), 128);
  for (const char* method : {"light", "bdpt", "pssmlt"})
    test::expect_agreement(expected, test::replicated(by(d, method), 128), method, 3);
}

TEST(Bidirectional, ClassesOfPaths) {
  const Document d = under_a_lamp();
  const char* classes[] = {"EL", "EDL", "E(D|G)S+L|E.*DS+DL", "EGD.*L", "ED.*GL|ES.*L", "E.G.*L"};
  for (const char* paths : classes)
    expect_same(by(with(d, "film.paths", paths), "path"), 512, by(with(d, "film.paths", paths), "bdpt"), 128, paths, 6);
}

TEST(Bidirectional, EveryHeuristicAndEveryRestOfTechniques) {
  const Document d = cornell();
  const auto expected = test::replicated(by(d, "path"), 512);
  const std::pair<const char*, const char*> settings[] = {
      {"heuristic", "balance"}, {"heuristic", "maximum"}, {"without", "0,*"},        {"without", "1,*"},
      {"without", "*,1"},       {"without", "2,2 1,3"},   {"without", "2,* 3,* 4,*"}};
  for (const auto& [name, value] : settings)
    test::expect_agreement(expected, test::replicated(with(by(d, "bdpt"), name, value), 64),
                           std::string(name) + " " + value, 7);
}

// Sums of terms and the weights in constant time are the same numbers.
TEST(Bidirectional, WeightsInConstantTimeAreTheSumOfAllTerms) {
  for (const Document& place : {cornell(), through_a_lens(under_a_lamp()), under_a_sky()})
    for (const char* heuristic : {"balance", "power", "maximum"}) {
      const Document d = with(by(place, "bdpt"), "heuristic", heuristic);
      const auto quick = test::rendered(d, 8), slow = test::rendered(with(d, "without", "99,99"), 8);
      for (int y = 0; y < d.height; ++y)
        for (int x = 0; x < d.width; ++x)
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(quick.mean(x, y)[c], slow.mean(x, y)[c], 1e-4 * (quick.mean(x, y)[c] + 0.01)) << heuristic;
    }
}

// What techniques show of a path adds up to the picture.
TEST(Bidirectional, TechniquesAddUp) {
  const Document d = with(by(cornell(), "bdpt"), "max-depth", "3");
  const auto whole = test::rendered(d, 8);
  std::vector<double> sum(static_cast<size_t>(d.width * d.height), 0);
  for (int edges = 1; edges <= 3; ++edges)
    for (int s = 0; s <= edges + 1; ++s) {
      const auto part = test::rendered(with(d, "only", std::to_string(s) + "," + std::to_string(edges + 1 - s)), 8);
      for (int y = 0; y < d.height; ++y)
        for (int x = 0; x < d.width; ++x) sum[static_cast<size_t>(y * d.width + x)] += double{part.mean(x, y).g};
    }
  for (int y = 0; y < d.height; ++y)
    for (int x = 0; x < d.width; ++x)
      EXPECT_NEAR(sum[static_cast<size_t>(y * d.width + x)], whole.mean(x, y).g, 1e-4) << x << ' ' << y;
}

TEST(Bidirectional, TheSameBitsWithAnyNumberOfThreads) {
  for (const char* method : {"bdpt", "light", "light-pure"}) {
    Document d = through_a_lens(cornell());
    d.width = 70, d.height = 50;
    const auto one = test::rendered(by(d, method), 4, 1);
    for (const int threads : {2, 7}) {
      const auto many = test::rendered(by(d, method), 4, threads);
      for (size_t i = 0; i < one.pixels().size(); ++i)
        ASSERT_EQ(one.pixels()[i].sum, many.pixels()[i].sum) << method << ' ' << threads;
    }
  }
}

TEST(Techniques, AreReadAsPeopleWriteThem) {
  const auto set = integrator::Techniques::parse(" 0,* 2,3 ");
  ASSERT_TRUE(set);
  EXPECT_TRUE(set->contains(0, 5) && set->contains(2, 3));
  EXPECT_FALSE(set->contains(2, 2) || set->contains(1, 3));
  EXPECT_TRUE(integrator::Techniques::parse("")->empty());
  for (const char* wrong : {"2", "a,b", "1,2,3", "-1,2", "1;2"})
    EXPECT_FALSE(integrator::Techniques::parse(wrong)) << wrong;
}

}  // namespace
}  // namespace etendue
