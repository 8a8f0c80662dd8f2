// The gallery of snapshots: notes, differences, comparison, and renderings that continue.
#include <chrono>
#include <ctime>
#include <thread>

#include "base/file.h"
#include "home_folder.h"
#include "render/checkpoint.h"
#include "viewer/files/loader.h"
#include "viewer/files/snapshot_list.h"

namespace etendue::snapshots_test {
namespace {

json holding(const char* modifier, json step) {
  step["holding"] = modifier;
  return step;
}

class Snapshots : public HomeFolder {
 protected:
  void SetUp() override {
    HomeFolder::SetUp();
    fs::create_directories(folder_ / "Pictures");
  }

  fs::path gallery() const { return folder_ / "Pictures" / "etendue"; }

  // Saves a snapshot, and waits until the panel shows it.
  static json save() { return json::array({key("f12"), wait_for("snapshots")}); }
  static json open_panel() { return json::array({click("panel.snapshots")}); }

  std::vector<std::string> files(const char* extension) const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(gallery()))
      if (entry.path().extension() == extension) found.push_back(entry.path().string());
    std::ranges::sort(found);
    return found;
  }

  // One snapshot of the Cornell box with four samples.
  std::string saved_snapshot() {
    EXPECT_EQ(run(joined(joined(small(), open_panel()), save()), "cornell"), 0);
    const auto found = files(".exr");
    EXPECT_EQ(found.size(), 1U);
    return found.front();
  }

  // Opens a snapshot whose limit is reached, without tracing anything if it continues.
  uint64_t paths_after_opening(const std::string& file) {
    EXPECT_EQ(run(json::array({{{"do", "wait"}, {"spp", 4}}, file_step("state", path("opened.json"))}), file), 0);
    EXPECT_EQ(state("opened.json")["samples"], 4);
    return state("opened.json")["traced_paths"];
  }
};

TEST_F(Snapshots, ContinueWithTheirSamples) {
  const std::string file = saved_snapshot();
  EXPECT_TRUE(fs::exists(render::checkpoint_of_image(file)));
  EXPECT_EQ(paths_after_opening(file), 0U);
  const auto to_eight = json::array({set("render.samples", 8), wait_for("limit")});
  ASSERT_EQ(run(joined(to_eight,
                       json::array({file_step("image", path("continued.exr")), file_step("state", path("c.json"))})),
                file),
            0);
  EXPECT_EQ(state("c.json")["traced_paths"], 4 * 96 * 96) << "the first four samples are those of the snapshot";
  ASSERT_EQ(run(joined(small(8), json::array({file_step("image", path("whole.exr"))})), "cornell"), 0);
  EXPECT_EQ(saved_image("continued.exr").find("")->pixels, saved_image("whole.exr").find("")->pixels);
}

TEST_F(Snapshots, StartAgainWithoutSamplesThatFit) {
  const std::string file = saved_snapshot(), checkpoint = render::checkpoint_of_image(file);
  const auto original = read_file(checkpoint);
  ASSERT_TRUE(original);
  // Damaged samples.
  fs::resize_file(checkpoint, original->size() / 2);
  EXPECT_EQ(paths_after_opening(file), 4U * 96 * 96);
  // Samples of another rendering.
  ASSERT_TRUE(write_file(checkpoint, original->data(), original->size()));
  auto other = render::read_checkpoint(checkpoint);
  ASSERT_TRUE(other);
  const size_t at = other->state.find("\"film.width\":96");
  ASSERT_NE(at, std::string::npos) << other->state;
  other->state.replace(at, 15, "\"film.width\":97");
  ASSERT_TRUE(render::write_checkpoint(checkpoint, *other));
  EXPECT_EQ(paths_after_opening(file), 4U * 96 * 96);
  fs::remove(checkpoint);
  EXPECT_EQ(paths_after_opening(file), 4U * 96 * 96);
}

TEST_F(Snapshots, PreferencesLeaveOutTheSamples) {
  json steps = joined(small(), json::array({key("ctrl+,"), set("preferences.snapshot-samples", false), key("escape")}));
  ASSERT_EQ(run(joined(joined(steps, open_panel()), save()), "cornell"), 0);
  EXPECT_EQ(files(".exr").size(), 1U);
  EXPECT_TRUE(files(".checkpoint").empty());
}

TEST_F(Snapshots, NotesAreKeptInTheFile) {
  const std::string file = saved_snapshot();
  const auto pixels = image::read_exr(file)->find("")->pixels;
  const std::string text = "first try\nnoise in the corner: \u00c9";
  ASSERT_EQ(run(json::array({click("panel.snapshots"), wait_for("snapshots"), click("snapshots.0"),
                             set("snapshots.notes", text), wait_for("snapshots"), file_step("state", path("s.json"))}),
                "cornell"),
            0);
  EXPECT_EQ(state("s.json")["snapshots"]["files"][0]["notes"], text);
  EXPECT_EQ(state("s.json")["snapshots"]["selected"], fs::path(file).filename().string());
  const auto image = image::read_exr(file);
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->attributes.at(viewer::kNotesAttribute), text);
  EXPECT_EQ(image->find("")->pixels, pixels);
  // The samples still belong to the image.
  EXPECT_EQ(paths_after_opening(file), 0U);
}

TEST_F(Snapshots, DifferencesHaveLabelsAndValues) {
  saved_snapshot();
  const auto steps = json::array({click("panel.snapshots"), wait_for("snapshots"), click("snapshots.0"),
                                  set("material.5.roughness", 0.25), set("render.integrator", "bdpt"),
                                  file_step("state", path("s.json"))});
  ASSERT_EQ(run(joined(small(), steps), "cornell"), 0);
  std::map<std::string, std::pair<std::string, std::string>> rows;
  const json report = state("s.json")["snapshots"];
  for (const auto& row : report["differences"]) rows[row[0]] = {row[1], row[2]};
  ASSERT_EQ(rows.size(), 2U) << report;
  const std::pair<std::string, std::string> integrators{"Bidirectional path tracing", "Path tracing"};
  EXPECT_EQ(rows.at("Integrator"), integrators);
  const auto roughness =
      std::ranges::find_if(rows, [](const auto& row) { return row.first.starts_with("Roughness of "); });
  ASSERT_NE(roughness, rows.end());
  EXPECT_EQ(roughness->second.first, "0.25");
  EXPECT_NE(roughness->second.second, "0.25");
}

TEST_F(Snapshots, TwoOfThemAreComparedAsAAndB) {
  const auto steps =
      joined(joined(joined(joined(small(), open_panel()), save()),
                    joined(json::array({set("material.5.roughness", 0.25), {{"do", "wait"}, {"spp", 4}}}), save())),
             json::array({set("film.width", 64),
                          {{"do", "wait"}, {"spp", 4}},
                          click("snapshots.0"),
                          holding("ctrl", click("snapshots.1")),
                          file_step("state", path("chosen.json")),
                          click("snapshots.compare"),
                          {{"do", "wait"}, {"seconds", 1}},
                          wait_for("comparison"),
                          file_step("state", path("compared.json")),
                          click("compare.live-a"),
                          file_step("state", path("live.json"))}));
  ASSERT_EQ(run(steps, "cornell"), 0);
  const auto saved = files(".exr");
  ASSERT_EQ(saved.size(), 2U) << "names of one second must differ";
  const json chosen = state("chosen.json")["snapshots"];
  EXPECT_EQ(chosen["differences"].size(), 1U) << chosen;
  const json comparison = state("compared.json")["comparison"];
  EXPECT_EQ(comparison["a"], chosen["selected"]);
  EXPECT_EQ(comparison["b"], chosen["other"]);
  EXPECT_EQ(comparison["mode"], "wipe");
  EXPECT_FALSE(comparison.contains("problem")) << comparison;
  // They keep their shape, although the image that is rendered is narrower.
  const auto place = state("compared.json")["image"].get<std::vector<double>>();
  EXPECT_NEAR(place[2], place[3], 1);
  EXPECT_TRUE(state("live.json")["comparison"].contains("problem"));
}

TEST_F(Snapshots, ImageBMustHaveTheSizeOfA) {
  const auto steps =
      joined(joined(joined(small(), open_panel()), save()), json::array({set("film.width", 64),
                                                                         {{"do", "wait"}, {"spp", 4}},
                                                                         click("snapshots.0"),
                                                                         click("snapshots.use-b"),
                                                                         {{"do", "wait"}, {"seconds", 1}},
                                                                         file_step("state", path("refused.json")),
                                                                         click("snapshots.use-a"),
                                                                         {{"do", "wait"}, {"seconds", 1}},
                                                                         click("snapshots.use-b"),
                                                                         {{"do", "wait"}, {"seconds", 1}},
                                                                         file_step("state", path("both.json"))}));
  ASSERT_EQ(run(steps, "cornell"), 0);
  const json errors = state("refused.json")["errors"];
  ASSERT_EQ(errors.size(), 1U) << errors;
  EXPECT_NE(errors[0].get<std::string>().find("is 96 x 96, the image is 64 x 96"), std::string::npos) << errors;
  EXPECT_EQ(state("both.json")["comparison"]["a"], state("both.json")["comparison"]["b"]);
  EXPECT_FALSE(state("both.json")["comparison"].contains("problem"));
}

TEST_F(Snapshots, DeletingAsksFirstAndRemovesTheSamples) {
  saved_snapshot();
  const auto ask =
      json::array({click("panel.snapshots"), wait_for("snapshots"), click("snapshots.0"), click("snapshots.delete")});
  ASSERT_EQ(run(joined(ask, json::array({click("snapshots.delete-no")})), "cornell"), 0);
  EXPECT_EQ(files(".exr").size(), 1U);
  ASSERT_EQ(run(joined(ask, json::array({click("snapshots.delete-yes"), wait_for("snapshots"),
                                         file_step("state", path("s.json"))})),
                "cornell"),
            0);
  EXPECT_TRUE(files(".exr").empty());
  EXPECT_TRUE(files(".checkpoint").empty());
  EXPECT_TRUE(state("s.json")["snapshots"]["files"].empty());
  EXPECT_FALSE(state("s.json")["snapshots"].contains("selected"));
}

TEST_F(Snapshots, FilesThatAreNotSnapshotsAreNotListed) {
  const std::string file = saved_snapshot();
  std::ofstream(gallery() / "broken.exr") << "this is not an image";
  ASSERT_TRUE(image::write_exr(gallery() / "foreign.exr",
                               {.width = 2, .height = 1, .layers = {{"", {"R", "G", "B"}, std::vector<float>(6)}}}));
  ASSERT_EQ(run(json::array({click("panel.snapshots"), wait_for("snapshots"), file_step("state", path("s.json"))}),
                "cornell"),
            0);
  ASSERT_EQ(state("s.json")["snapshots"]["files"].size(), 1U);
  EXPECT_EQ(state("s.json")["snapshots"]["files"][0]["name"], fs::path(file).filename().string());
}

// The image is complete, and a message says that it has no samples.
TEST_F(Snapshots, AFullDiskForTheSamplesIsAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  fs::create_directories(gallery());
  const std::time_t now = std::time(nullptr);
  for (std::time_t t = now; t < now + 30; ++t) {
    char stamp[32] = "";
    std::tm local{};
    localtime_r(&t, &local);
    std::strftime(stamp, sizeof stamp, "%Y%m%d-%H%M%S", &local);
    fs::create_symlink("/dev/full", gallery() / ("cornell-" + std::string(stamp) + ".exr.checkpoint"));
  }
  ASSERT_EQ(
      run(joined(joined(joined(small(), open_panel()), save()), json::array({file_step("state", path("s.json"))})),
          "cornell"),
      0);
  const json errors = state("s.json")["errors"];
  ASSERT_EQ(errors.size(), 1U) << errors;
  EXPECT_NE(errors[0].get<std::string>().find(".exr.checkpoint"), std::string::npos) << errors;
  const auto saved = files(".exr");
  ASSERT_EQ(saved.size(), 1U);
  EXPECT_EQ(paths_after_opening(saved.front()), 4U * 96 * 96);
}

// The picture is known while the scene is still being read.
TEST_F(Snapshots, ThePictureIsKnownBeforeTheScene) {
  const std::string file = saved_snapshot();
  const auto stored = image::read_exr(file)->find("")->pixels;
  viewer::Loader loader([] {});
  loader.open(file, {}, "");
  const auto start = std::chrono::steady_clock::now();
  while (!loader.picture() && std::chrono::steady_clock::now() - start < std::chrono::seconds(20))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const auto picture = loader.picture();
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->width, 96);
  ASSERT_EQ(picture->pixels.size() * 3, stored.size());
  EXPECT_EQ(picture->pixels[1234].g, stored[3 * 1234 + 1]);
  loader.cancel();
  EXPECT_FALSE(loader.picture());
}

}  // namespace
}  // namespace etendue::snapshots_test
