// The file dialog and the welcome page.
#include "scripted.h"
#include "viewer/tasks/file_thumbnails.h"

#include <chrono>
#include <thread>

namespace etendue::file_dialog_test {
namespace {

class FileDialog : public Viewer {};

TEST_F(FileDialog, AnExistingFileIsReplacedOnlyAfterAQuestion) {
  std::ofstream(path("a.png")) << "kept";
  const auto size = [&] { return fs::file_size(path("a.png")); };
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}},
                             key("ctrl+e"),
                             set("files.name", path("a.png")),
                             click("files.accept"),
                             {{"do", "wait"}, {"seconds", 0.5}},
                             click("files.cancel")})),
            0);
  EXPECT_EQ(size(), 4U);
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}},
                             key("ctrl+e"),
                             set("files.name", path("a.png")),
                             click("files.accept"),
                             click("files.accept"),
                             {{"do", "wait"}, {"seconds", 1}}})),
            0);
  EXPECT_GT(size(), 100U);
}

TEST_F(FileDialog, TheFilterHidesOtherNames) {
  for (const char* name : {"\u00e9toile \u2764.glb", "box.glb", "ball.glb"}) std::ofstream(path(name)) << "x";
  const json open = json::array({{{"do", "wait"}, {"spp", 1}},
                                 key("ctrl+o"),
                                 set("files.name", folder_.string()),
                                 click("files.accept"),
                                 set("files.filter", "\u2764")});
  EXPECT_EQ(run(joined(open, json::array({click("files.\u00e9toile \u2764.glb"), click("files.cancel")}))), 0);
  EXPECT_NE(run(joined(open, json::array({click("files.box.glb")}))), 0);
}

TEST_F(FileDialog, TheFilterIgnoresCaseInOtherAlphabets) {
  for (const char* name : {"\u0421\u0426\u0415\u041d\u0410.glb", "\u00c9TOILE.glb", "box.glb"})
    std::ofstream(path(name)) << "x";
  const json open = json::array(
      {{{"do", "wait"}, {"spp", 1}}, key("ctrl+o"), set("files.name", folder_.string()), click("files.accept")});
  for (const auto& [filter, name] : {std::pair("\u0441\u0446\u0435\u043d\u0430", "\u0421\u0426\u0415\u041d\u0410.glb"),
                                     std::pair("\u00e9toile", "\u00c9TOILE.glb"), std::pair("BOX", "box.glb")})
    EXPECT_EQ(run(joined(open, json::array({set("files.filter", filter), click(std::string("files.") + name),
                                            click("files.cancel")}))),
              0)
        << filter;
}

// Fonts are loaded again with the characters of names.
TEST_F(FileDialog, NamesInOtherAlphabetsHaveGlyphs) {
  const json before = file_step("state", path("before.json"));
  for (const char* name : {"\u0441\u0446\u0435\u043d\u0430.glb", "\u2764 \u267b.glb"}) std::ofstream(path(name)) << "x";
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}},
                             before,
                             key("ctrl+o"),
                             set("files.name", folder_.string()),
                             click("files.accept"),
                             {{"do", "wait"}, {"seconds", 0.2}},
                             file_step("screenshot", path("dialog.png")),
                             file_step("state", path("after.json"))})),
            0);
  EXPECT_EQ(state("before.json")["glyphs"]["added"], 0);
  EXPECT_GE(state("after.json")["glyphs"]["added"], 7);
  if (fs::exists("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf")) {
    EXPECT_EQ(state("after.json")["glyphs"]["missing"], 0);
  }
}

// The list of formats has all that can be written, and changes the extension.
TEST_F(FileDialog, ExportOffersAllWritableFormats) {
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}},
                             key("ctrl+e"),
                             set("files.name", path("a.png")),
                             click("files.format"),
                             click("files.format.hdr"),
                             click("files.accept"),
                             {{"do", "wait"}, {"seconds", 1}}})),
            0);
  EXPECT_TRUE(fs::exists(path("a.hdr")));
  EXPECT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}},
                             key("ctrl+e"),
                             click("files.format"),
                             click("files.format.tif"),
                             click("files.cancel")})),
            0);
}

TEST_F(FileDialog, TheWelcomePageOpensBuiltInScenes) {
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}},
                             click("app.welcome"),
                             click("welcome.glossy-plates"),
                             {{"do", "wait"}, {"seconds", 1}},
                             {{"do", "wait"}, {"spp", 1}},
                             file_step("state", path("s.json"))})),
            0);
  EXPECT_EQ(state("s.json")["scene"], "glossy-plates");
}

// The thumbnail of a file; null if it cannot be made.
const viewer::ThumbnailImage* wait_for(viewer::FileThumbnails& thumbnails, const std::string& file) {
  thumbnails.find(file);
  while (thumbnails.is_pending(file)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    thumbnails.find(file);
  }
  return thumbnails.find(file);
}

TEST_F(FileDialog, ThumbnailsAreReducedImagesAndRenderedScenes) {
  std::vector<float> rgb(400 * 100 * 3);
  for (size_t i = 0; i < rgb.size() / 3; ++i) rgb[3 * i] = i % 400 < 200 ? 0.25f : 0.75f;
  ASSERT_TRUE(image::write_hdr(path("a.hdr"), 400, 100, rgb));
  viewer::FileThumbnails thumbnails([] {});
  const auto* reduced = wait_for(thumbnails, path("a.hdr"));
  ASSERT_NE(reduced, nullptr);
  EXPECT_EQ(reduced->width, 192);
  EXPECT_EQ(reduced->height, 48);
  EXPECT_NEAR(reduced->pixels->front(), 0.25f, 0.01f);
  EXPECT_NEAR((*reduced->pixels)[3 * 191], 0.75f, 0.01f);
  const auto* rendered = wait_for(thumbnails, "cornell");
  ASSERT_NE(rendered, nullptr);
  EXPECT_EQ(std::max(rendered->width, rendered->height), 192);
  std::ofstream(path("damaged.glb")) << "glTF";
  EXPECT_EQ(wait_for(thumbnails, path("damaged.glb")), nullptr);
}

}  // namespace
}  // namespace etendue::file_dialog_test
