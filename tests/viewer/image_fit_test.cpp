// The resolution of the image follows the viewport, until that would lose something.
#include "viewer/viewport/image_fit.h"

#include "render/document.h"
#include "scripted.h"

namespace etendue::image_fit_test {
namespace {

class ImageFit : public Viewer {
 protected:
  static json wait(double seconds) { return {{"do", "wait"}, {"seconds", seconds}}; }
  static json samples(int spp) { return {{"do", "wait"}, {"spp", spp}}; }
  double width(const std::string& file) const { return state(file)["parameters"]["film.width"]; }
};

TEST_F(ImageFit, TheSizeHasTheAspectRatioOfTheCamera) {
  render::Document d = *render::new_document("cornell");
  d.camera.aspect = 0;
  EXPECT_EQ(viewer::fitted_size(d, {800, 450}), Vec2i(800, 450));
  d.camera.aspect = 1;
  EXPECT_EQ(viewer::fitted_size(d, {800, 450}), Vec2i(450, 450));
  d.camera.aspect = 4;
  EXPECT_EQ(viewer::fitted_size(d, {800, 450}), Vec2i(800, 200));
  EXPECT_EQ(viewer::fitted_size(d, {3, 3}), Vec2i(16, 16));
}

// Also after the automatic choice of an integrator.
TEST_F(ImageFit, FollowsTheViewportWithoutAnEdit) {
  ASSERT_EQ(run(json::array({set("render.integrator", "auto"), samples(1), wait_for("automatic"),
                             file_step("state", path("a.json")), key("h"), wait(1.5), samples(1),
                             file_step("state", path("b.json"))}),
                "caustic-pool"),
            0);
  const json before = state("a.json"), after = state("b.json");
  EXPECT_GT(width("b.json"), width("a.json"));
  EXPECT_EQ(after["parameters"]["film.height"], after["image"][3]);
  EXPECT_EQ(after["undo_depth"], before["undo_depth"]);
  EXPECT_EQ(after["edited"], false);
}

TEST_F(ImageFit, KeepsAResolutionOfTheUser) {
  ASSERT_EQ(
      run(json::array({samples(1), set("film.width", 200), key("h"), wait(1.5), file_step("state", path("a.json"))}),
          "caustic-pool"),
      0);
  EXPECT_EQ(width("a.json"), 200);
}

// Samples of more than five seconds are not thrown away. A click on the zoom in the status bar renders in the new resolution.
TEST_F(ImageFit, KeepsALongRendering) {
  ASSERT_EQ(run(json::array({set("render.integrator", "path"),
                             samples(1),
                             file_step("state", path("a.json")),
                             wait(10),
                             {{"do", "drag"}, {"item", "layout.column"}, {"by", {-60, 0}}},
                             wait(1.5),
                             file_step("state", path("b.json")),
                             click("status.zoom"),
                             samples(1),
                             file_step("state", path("c.json"))}),
                "caustic-pool"),
            0);
  EXPECT_EQ(width("b.json"), width("a.json"));
  EXPECT_GT(state("b.json")["seconds"].get<double>(), 5);
  EXPECT_NE(width("c.json"), width("a.json"));
}

}  // namespace
}  // namespace etendue::image_fit_test
