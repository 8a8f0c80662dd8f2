// Sessions: images independent of the number of threads, incremental rebuilds after edits, checkpoints, limits.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <thread>

#include "render/checkpoint.h"
#include "render/session.h"
#include "scene/compiled_scene.h"
#include "support/independent_estimates.h"
#include "support/scenes.h"

namespace etendue {
namespace {

bool same_bits(const film::Film& a, const film::Film& b) {
  return a.pixels().size() == b.pixels().size() &&
         std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size_bytes()) == 0;
}

TEST(Session, BitIdenticalWithOneTwoAndSevenThreads) {
  for (const char* sampler : {"sobol", "halton", "stratified", "random"}) {
    auto d = test::cornell(53);
    d.method.sampler = sampler;
    const auto one = test::rendered(d, 5, 1);
    EXPECT_TRUE(same_bits(one, test::rendered(d, 5, 2))) << sampler;
    EXPECT_TRUE(same_bits(one, test::rendered(d, 5, 7))) << sampler;
  }
}

TEST(Session, AnotherSeedIsAnotherImage) {
  auto d = test::cornell(32);
  const auto a = test::rendered(d, 4);
  d.seed = 1;
  EXPECT_FALSE(same_bits(a, test::rendered(d, 4)));
}

// An image of radiosity begins with form factors, here of 50 million rays on one thread. Meanwhile there is a frame by path
// tracing, also of an edit.
TEST(Session, LongPhasesAreBridgedByASubstitute) {
  render::Document d = test::cornell(300);
  d = *render::with_text(d, "render.integrator", "radiosity");
  d = *render::with_text(d, "radiosity.patches", "3000");
  d = *render::with_text(d, "radiosity.rays", "4096");
  render::Session session({.threads = 1, .interactive = true});
  const auto frame_of = [&](const render::Document& document) {
    const uint64_t version = session.submit(document);
    while (!session.frame() || session.frame()->version < version)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return session.frame();
  };
  EXPECT_TRUE(frame_of(d)->is_substitute);
  EXPECT_GT(session.frame()->preview_scale, 1);
  d.camera.yfov *= 1.1f;
  EXPECT_TRUE(frame_of(d)->is_substitute);
  // Fewer patches are soon ready.
  d = *render::with_text(d, "radiosity.patches", "100");
  d = *render::with_text(d, "radiosity.rays", "64");
  d.limits.samples = 1;
  session.submit(d);
  session.finish();
  EXPECT_FALSE(session.frame()->is_substitute);
}

TEST(Session, LargerModelsGiveTheSameImage) {
  for (const auto& d : {test::cornell(48), test::glossy_scene()})
    for (const char* integrator : {"path", "path-pure", "raycast", "whitted", "distribution"}) {
      const auto document = *render::with_text(d, "render.integrator", integrator);
      const auto small = test::rendered(document, 16);
      for (const std::string& flag : transport::model_flags()) {
        const auto forced = *render::with_text(document, "model." + flag, "on");
        EXPECT_TRUE(same_bits(small, test::rendered(forced, 16))) << integrator << ' ' << flag;
      }
    }
}

TEST(Session, LargerSpectralModelsGiveTheSameImage) {
  const auto spectral = *render::with_text(test::cornell(48), "render.color", "spectral");
  for (const char* integrator : {"path", "path-pure"}) {
    const auto document = *render::with_text(spectral, "render.integrator", integrator);
    const auto small = test::rendered(document, 16);
    for (const char* flag : {"surfaces", "media", "classes"}) {
      const auto forced = *render::with_text(document, std::string("model.") + flag, "on");
      EXPECT_TRUE(same_bits(small, test::rendered(forced, 16))) << integrator << ' ' << flag;
    }
  }
}

TEST(Checkpoint, ResumesToTheSameBits) {
  const auto path = std::filesystem::temp_directory_path() / "etendue-test.checkpoint";
  auto d = test::cornell(64);
  const auto whole = test::rendered(d, 12);

  render::Session first({.threads = 2, .interactive = false});
  d.limits = {100'000, 0, 0};
  first.submit(d);
  while (first.status().samples < 3) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  first.stop();
  auto cut = first.film_copy();
  // Samples beyond the twelfth cannot be removed: only a shorter film is useful here.
  if (cut.samples(0, 0) > 12) cut = test::rendered(d, 5);
  ASSERT_TRUE(render::write_checkpoint(path, {render::state_json(d, 3), cut, 1.5}));

  auto read = render::read_checkpoint(path);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(same_bits(read->film, cut));
  auto document = render::document_from_state(read->state, "checkpoint");
  ASSERT_TRUE(document) << document.error().message;
  document->limits = {12, 0, 0};
  render::Session second({.threads = 1, .interactive = false});
  second.submit(*document, std::move(read->film));
  second.finish();
  EXPECT_TRUE(same_bits(second.film_copy(), whole));
  std::filesystem::remove(path);
}

// Time limits include the earlier time, and speeds are those of the new samples.
TEST(Checkpoint, TheTimeOfEarlierSamplesCounts) {
  auto d = test::cornell(32);
  d.limits = {0, 4, 0};
  render::ResumePoint point(test::rendered(d, 2));
  point.seconds = 5;
  render::Session over({.threads = 1, .interactive = false});
  over.submit(d, point);
  over.finish();
  EXPECT_EQ(over.status().samples, 2U);
  EXPECT_GE(over.status().seconds, 5);
  EXPECT_EQ(over.status().paths_per_second, 0);

  d.limits = {4, 0, 0};
  point.seconds = 1e6;
  render::Session longer({.threads = 1, .interactive = false});
  longer.submit(d, point);
  longer.finish();
  EXPECT_GT(longer.status().seconds, 1e6);
  EXPECT_GT(longer.status().paths_per_second, 100) << "relative to a million seconds, it would be next to nothing";
}

TEST(Checkpoint, DamagedFilesAreRejected) {
  const auto path = std::filesystem::temp_directory_path() / "etendue-damaged.checkpoint";
  ASSERT_TRUE(render::write_checkpoint(path, {"{}", film::Film(8, 8), 0}));
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
  const auto read = render::read_checkpoint(path);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("truncated"), std::string::npos) << read.error().message;
  std::filesystem::remove(path);
}

TEST(Compile, EditsRebuildOnlyWhatTheyAffect) {
  auto d = test::cornell(16);
  // An object that is used twice is an instance with its own acceleration structure.
  test::add(const_cast<scene::Scene&>(*d.scene), test::sphere(0.3f, 8, false), test::diffuse(Rgb(0.5f)));
  auto scene = std::make_shared<scene::Scene>(*d.scene);
  scene::Node twin = scene->nodes.back();
  twin.transform.matrix = Mat4(1);
  (*twin.transform.matrix)[3] = Vec4(2, 2, 2, 1);
  scene->nodes.push_back(twin);
  scene->roots.push_back(static_cast<int>(scene->nodes.size()) - 1);
  d.scene = scene;
  const auto first = scene::compile(d.scene, d.camera, nullptr);
  EXPECT_EQ(first->report().meshes_built, 1);

  Camera moved = d.camera;
  moved.to_world[3].x += 1;
  const auto camera = scene::compile(d.scene, moved, first);
  EXPECT_FALSE(camera->report().top_level_built || camera->report().lights_built || camera->report().materials_built);

  const auto painted = *render::with_text(d, "material.0.base-color.r", "0.1");
  const auto material = scene::compile(painted.scene, d.camera, first);
  EXPECT_FALSE(material->report().top_level_built || material->report().lights_built);
  EXPECT_TRUE(material->report().materials_built);

  const auto brighter = *render::with_text(d, "material.3.emission.r", "40");
  const auto light = scene::compile(brighter.scene, d.camera, first);
  EXPECT_FALSE(light->report().top_level_built);
  EXPECT_TRUE(light->report().lights_built);

  const auto shifted = *render::with_text(d, "node.7.translation.x", "0.2");
  const auto transform = scene::compile(shifted.scene, d.camera, first);
  EXPECT_TRUE(transform->report().top_level_built);
  EXPECT_EQ(transform->report().meshes_built, 0);
  EXPECT_GE(transform->report().meshes_reused, 1);
}

TEST(Compile, MovedMeshesBecomeInstancesThatAreReused) {
  auto d = test::cornell(16);
  auto scene = std::make_shared<scene::Scene>(*d.scene);
  const int node = test::add(*scene, test::sphere(0.3f, 80, false), test::diffuse(Rgb(0.5f)));
  const auto moved = [&](const std::shared_ptr<const scene::Scene>& from, float x) {
    auto result = std::make_shared<scene::Scene>(*from);
    (*result->nodes[static_cast<size_t>(node)].transform.matrix)[3].x = x;
    return result;
  };
  const auto first = scene::compile(scene, d.camera, nullptr);
  EXPECT_EQ(first->report().meshes_built, 0);
  const auto second_scene = moved(scene, 0.1f);
  const auto second = scene::compile(second_scene, d.camera, first);
  EXPECT_EQ(second->report().meshes_built, 1);
  const auto third = scene::compile(moved(second_scene, 0.2f), d.camera, second);
  EXPECT_EQ(third->report().meshes_built, 0);
  EXPECT_EQ(third->report().meshes_reused, 1);
  EXPECT_TRUE(third->report().top_level_built);
}

// Objects that emit nothing move without a new light table.
TEST(Compile, MovedObjectsKeepTheLightsUnlessTheyEmit) {
  auto d = test::cornell(24);
  auto scene = std::make_shared<scene::Scene>(*d.scene);
  const int grey = test::add(*scene, test::sphere(0.3f, 80, false), test::diffuse(Rgb(0.5f)));
  Material glowing = test::diffuse(Rgb(0.5f));
  glowing.emission = Rgb(2);
  const int lamp = test::add(*scene, test::sphere(0.2f, 80, false), glowing);
  const auto compile_moved = [&](int node, float y, const std::shared_ptr<const scene::CompiledScene>& before) {
    auto moved = std::make_shared<scene::Scene>(before->description());
    (*moved->nodes[static_cast<size_t>(node)].transform.matrix)[3] = Vec4(2, y, 2, 1);
    return scene::compile(moved, d.camera, before);
  };
  auto compiled = compile_moved(lamp, 3, compile_moved(grey, 1, scene::compile(scene, d.camera, nullptr)));
  compiled = compile_moved(grey, 1.1f, compiled);
  compiled = compile_moved(grey, 1.2f, compiled);
  EXPECT_TRUE(compiled->report().top_level_built);
  EXPECT_FALSE(compiled->report().lights_built);
  const auto anew = scene::compile(std::make_shared<scene::Scene>(compiled->description()), d.camera, nullptr);
  ASSERT_EQ(compiled->lights().triangles().size(), anew->lights().triangles().size());
  for (size_t i = 0; i < anew->instances().size(); ++i)
    EXPECT_EQ(compiled->instances()[i].first_light, anew->instances()[i].first_light) << i;
  EXPECT_TRUE(compile_moved(lamp, 3.1f, compiled)->report().lights_built);
}

// The means of textured emission are taken from the previous scene; they have the bits of a scene that is compiled anew.
TEST(Compile, MovedTexturedEmitterHasTheLightsOfAFreshScene) {
  auto d = test::cornell(16);
  auto scene = std::make_shared<scene::Scene>(*d.scene);
  auto texels = std::make_shared<image::Image>();
  texels->width = texels->height = 4;
  texels->channels = 3;
  for (int i = 0; i < 4 * 4 * 3; ++i) texels->bytes.push_back(static_cast<uint8_t>(i < 24 ? 0 : 5 * i));
  scene->textures.emplace_back().image = texels;
  Material material = test::diffuse(Rgb(0.5f), Rgb(3));
  material.emission_texture.texture = static_cast<int>(scene->textures.size()) - 1;
  auto mesh = std::make_shared<Mesh>(*test::sphere(0.3f, 24, false));
  for (const Vec3& p : mesh->positions) mesh->uvs[0].emplace_back(0.5f + p.x, 0.5f + p.y);
  const auto node = static_cast<size_t>(test::add(*scene, mesh, material));
  const auto first = scene::compile(scene, d.camera, nullptr);
  auto moved = std::make_shared<scene::Scene>(*scene);
  (*moved->nodes[node].transform.matrix)[3].x = 0.25f;
  const auto edited = scene::compile(moved, d.camera, first), fresh = scene::compile(moved, d.camera, nullptr);
  const auto &a = edited->lights().triangles(), &b = fresh->lights().triangles();
  ASSERT_EQ(a.size(), b.size());
  EXPECT_TRUE(a.back().textured);
  const scene::InstanceData &x = edited->instances().back(), &y = fresh->instances().back();
  ASSERT_TRUE(x.emitting && y.emitting) << "the texture is black on some triangles";
  EXPECT_GT(x.emitting->count, 0U);
  EXPECT_EQ(x.emitting->numbers, y.emitting->numbers);
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].radiance, b[i].radiance) << i;
    EXPECT_EQ(a[i].p0, b[i].p0) << i;
    EXPECT_EQ(a[i].textured, b[i].textured) << i;
  }
}

TEST(State, EveryParameterIsRestored) {
  auto d = test::cornell(40);
  const std::pair<const char*, const char*> edits[] = {
      {"render.integrator", "path-pure"}, {"path.roulette-start", "7"},
      {"stratified.side", "5"},           {"film.filter", "tent"},
      {"camera.exposure", "1.25"},        {"camera.eye.x", "0.3"},
      {"material.5.roughness", "0.31"},   {"model.media", "on"},
      {"node.6.visible", "false"},        {"node.5.rotation.y", "0.25"},
      {"node.5.scale.z", "-2"},           {"node.8.rotation.x", "0.5"}};
  for (const auto& [name, value] : edits) {
    auto edited = render::with_text(d, name, value);
    ASSERT_TRUE(edited) << edited.error().message;
    d = *edited;
  }
  const auto back = render::document_from_state(render::state_json(d, 17), "state");
  ASSERT_TRUE(back) << back.error().message;
  for (const auto& [name, value] : edits) EXPECT_EQ(*render::get(*back, name), *render::get(d, name)) << name;
  EXPECT_EQ(back->width, 40);
  for (size_t i = 0; i < d.scene->nodes.size(); ++i)
    EXPECT_EQ(back->scene->nodes[i].transform, d.scene->nodes[i].transform) << i;
}

TEST(Settings, InvalidNamesAndValuesAreExplained) {
  const auto d = test::cornell(16);
  const auto name = render::with_text(d, "render.integrater", "path");
  ASSERT_FALSE(name);
  EXPECT_NE(name.error().message.find("'render.integrator'"), std::string::npos) << name.error().message;
  const auto value = render::with_text(d, "render.sampler", "sobel");
  ASSERT_FALSE(value);
  EXPECT_NE(value.error().message.find("halton"), std::string::npos) << value.error().message;
  EXPECT_FALSE(render::with_text(d, "film.width", "-3"));
  EXPECT_FALSE(render::with_text(d, "camera.exposure", "nan"));
}

}  // namespace
}  // namespace etendue
