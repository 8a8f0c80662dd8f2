// Spectra as points: replacing a spectrum, dragging, adding and removing points, undo.
#include <cmath>

#include "scripted.h"
#include "spectrum/spectrum_names.h"
#include "spectrum/spectrum_points.h"

namespace etendue::spectrum_editor_test {
namespace {

class SpectrumEditor : public Viewer {
 protected:
  static json opened() {
    return joined(small(1),
                  json::array_t({click("tab.material"), click("material.choose"), click("material.choose.3")}));
  }
  std::vector<Spectrum::Sample> points(const char* file) const {
    const auto found = parse_points(state(file)["parameters"]["material.3.emission-spectrum"].get<std::string>());
    EXPECT_TRUE(found);
    return found ? *found : std::vector<Spectrum::Sample>{};
  }
};

constexpr const char* kSpectrum = "material.3.emission-spectrum";
constexpr const char* kChart = "material.3.emission-spectrum.points";

// The points of an illuminant follow it within one per cent of its largest value.
TEST_F(SpectrumEditor, PointsReplaceAnIlluminant) {
  const auto steps = joined(opened(), json::array_t({set(kSpectrum, "a"), click("material.3.emission-spectrum.edit"),
                                                     file_step("state", path("points.json")), key("ctrl+z"),
                                                     file_step("state", path("back.json"))}));
  ASSERT_EQ(run(steps, "cornell", 1200, 700), 0);
  const Spectrum lamp = *find_spectrum("a"), replaced = *Spectrum::piecewise_linear(points("points.json"));
  for (double nm = 380; nm <= 780; nm += 5) EXPECT_NEAR(replaced(nm), lamp(nm) / lamp(780), 0.0102) << nm;
  EXPECT_EQ(state("back.json")["parameters"][kSpectrum], "a");
}

// A drag from the centre of the chart moves the point there, in one step of undo. 580 nm is the centre of the axis; the
// chart has more space above the curve than below the centre, so the point is where the value is 0.65 of the largest.
TEST_F(SpectrumEditor, DragMovesAPoint) {
  const char* text = "380:1 780:1";
  const auto steps = joined(opened(), json::array_t({set(kSpectrum, text),
                                                     {{"do", "click"}, {"item", kChart}, {"double", true}},
                                                     file_step("state", path("added.json")),
                                                     {{"do", "drag"}, {"item", kChart}, {"by", {0, -12}}},
                                                     file_step("state", path("moved.json")),
                                                     file_step("screenshot", path("editor.png")),
                                                     key("ctrl+z"),
                                                     file_step("state", path("undone.json")),
                                                     key("ctrl+z"),
                                                     file_step("state", path("back.json"))}));
  ASSERT_EQ(run(steps, "cornell", 1200, 700), 0);
  const auto added = points("added.json"), moved = points("moved.json");
  ASSERT_EQ(added.size(), 3u);
  ASSERT_EQ(moved.size(), 3u);
  EXPECT_EQ(added[1].wavelength, moved[1].wavelength);
  EXPECT_GT(moved[1].value, added[1].value + 0.02);
  EXPECT_EQ(moved[0].value, added[0].value);
  EXPECT_EQ(state("undone.json")["parameters"][kSpectrum], state("added.json")["parameters"][kSpectrum]);
  EXPECT_EQ(state("back.json")["parameters"][kSpectrum], text);
}

}  // namespace
}  // namespace etendue::spectrum_editor_test
